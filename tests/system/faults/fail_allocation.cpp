// Loaded before a program (LD_PRELOAD): allocations of it fail.
//   STRIDE_FAIL_ALLOCATION=N       the N-th one after the program has begun; 0: none
//   STRIDE_FAIL_ALLOCATIONS=COUNT  and so many in all, from it on (1)
//   STRIDE_COUNT_ALLOCATIONS=FILE  writes there at the end how many there were
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

extern "C" {
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
}

namespace {

std::atomic<unsigned long> calls{0};
std::atomic<bool> begun{false};
unsigned long first = 0;
unsigned long count = 1;

unsigned long numberIn(const char *name, unsigned long otherwise) {
  const char *text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoul(text, nullptr, 10);
}

using Main = int(int, char **, char **);
Main *program = nullptr;

int begin(int argc, char **argv, char **environment) {
  first = numberIn("STRIDE_FAIL_ALLOCATION", 0);
  count = numberIn("STRIDE_FAIL_ALLOCATIONS", 1);
  begun.store(true);
  return program(argc, argv, environment);
}

__attribute__((destructor)) void end() {
  begun.store(false);
  const char *name = std::getenv("STRIDE_COUNT_ALLOCATIONS");
  const int file = name == nullptr ? -1 : ::open(name, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0)
    return;
  char text[32];
  const int size = std::snprintf(text, sizeof text, "%lu\n", calls.load());
  (void)!::write(file, text, static_cast<size_t>(size));
  ::close(file);
}

bool fails() {
  if (!begun.load(std::memory_order_relaxed))
    return false;
  const unsigned long number = calls.fetch_add(1, std::memory_order_relaxed) + 1;
  if (first == 0 || number < first || number - first >= count)
    return false;
  errno = ENOMEM;
  return true;
}

} // namespace

extern "C" {

/// The program begins after the constructors of all libraries.
int __libc_start_main(Main *main, int argc, char **argv, void (*init)(), void (*fini)(),
                      void (*loaderFini)(), void *stackEnd) {
  program = main;
  const auto next =
      reinterpret_cast<decltype(&__libc_start_main)>(::dlsym(RTLD_NEXT, "__libc_start_main"));
  return next(begin, argc, argv, init, fini, loaderFini, stackEnd);
}

void *malloc(size_t size) { return fails() ? nullptr : __libc_malloc(size); }
void *calloc(size_t number, size_t size) { return fails() ? nullptr : __libc_calloc(number, size); }
void *realloc(void *memory, size_t size) {
  return fails() ? nullptr : __libc_realloc(memory, size);
}
void *memalign(size_t alignment, size_t size) {
  return fails() ? nullptr : __libc_memalign(alignment, size);
}
void *aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
int posix_memalign(void **memory, size_t alignment, size_t size) {
  *memory = memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}

} // extern "C"
