// Linked into a stride-host of its own: allocations, locks and waits inside a cycle end the program
// with the calls that led there. TaskSet::runCycle and takeModeOver are wrapped by the linker
// (--wrap), malloc and the others by defining them here.
#include "runtime/host/host_main.hpp"

#include <dlfcn.h>
#include <execinfo.h>
#include <pthread.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace stride::task {
class TaskSet;
}

extern "C" {
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void __libc_free(void *memory);
}

namespace {

thread_local bool insideCycle = false;

void say(const char *text) {
  if (::write(STDERR_FILENO, text, std::strlen(text)) < 0)
    std::_Exit(99);
}

/// Nothing may have happened if this thread is inside a cycle.
void forbid(const char *what) {
  if (!insideCycle)
    return;
  insideCycle = false;
  say("TRAP: ");
  say(what);
  say(" inside of a cycle\n");
  void *calls[40];
  ::backtrace_symbols_fd(calls, ::backtrace(calls, 40), STDERR_FILENO);
  std::_Exit(99);
}

template <class F> F *next(const char *name) {
  return reinterpret_cast<F *>(::dlsym(RTLD_NEXT, name));
}

/// Found before main, when nobody is inside a cycle.
struct Originals {
  decltype(::pthread_mutex_lock) *mutexLock =
      next<decltype(::pthread_mutex_lock)>("pthread_mutex_lock");
  decltype(::pthread_cond_wait) *condWait =
      next<decltype(::pthread_cond_wait)>("pthread_cond_wait");
  decltype(::pthread_rwlock_rdlock) *readLock =
      next<decltype(::pthread_rwlock_rdlock)>("pthread_rwlock_rdlock");
  decltype(::pthread_rwlock_wrlock) *writeLock =
      next<decltype(::pthread_rwlock_wrlock)>("pthread_rwlock_wrlock");
  decltype(::fwrite) *write = next<decltype(::fwrite)>("fwrite");
  decltype(::fputs) *put = next<decltype(::fputs)>("fputs");
};

const Originals &originals() {
  static const Originals found;
  return found;
}

__attribute__((constructor)) void findOriginals() {
  (void)originals();
  void *calls[2];
  (void)::backtrace(calls, 2); // loads libgcc now
}

} // namespace

extern "C" {

void *malloc(size_t size) {
  forbid("malloc");
  return __libc_malloc(size);
}
void *calloc(size_t count, size_t size) {
  forbid("calloc");
  return __libc_calloc(count, size);
}
void *realloc(void *memory, size_t size) {
  forbid("realloc");
  return __libc_realloc(memory, size);
}
void *memalign(size_t alignment, size_t size) {
  forbid("memalign");
  return __libc_memalign(alignment, size);
}
void *aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
int posix_memalign(void **memory, size_t alignment, size_t size) {
  *memory = memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}
void free(void *memory) {
  if (memory != nullptr)
    forbid("free");
  __libc_free(memory);
}

int pthread_mutex_lock(pthread_mutex_t *mutex) {
  forbid("pthread_mutex_lock");
  return originals().mutexLock(mutex);
}
int pthread_cond_wait(pthread_cond_t *condition, pthread_mutex_t *mutex) {
  forbid("pthread_cond_wait");
  return originals().condWait(condition, mutex);
}
int pthread_rwlock_rdlock(pthread_rwlock_t *lock) {
  forbid("pthread_rwlock_rdlock");
  return originals().readLock(lock);
}
int pthread_rwlock_wrlock(pthread_rwlock_t *lock) {
  forbid("pthread_rwlock_wrlock");
  return originals().writeLock(lock);
}

// A stream has a lock of its own, and who reads it may be slow.
size_t fwrite(const void *data, size_t size, size_t count, FILE *file) {
  forbid("fwrite");
  return originals().write(data, size, count, file);
}
int fputs(const char *text, FILE *file) {
  forbid("fputs");
  return originals().put(text, file);
}
int fprintf(FILE *file, const char *format, ...) {
  forbid("fprintf");
  std::va_list arguments;
  va_start(arguments, format);
  const int count = std::vfprintf(file, format, arguments);
  va_end(arguments);
  return count;
}

// void stride::task::TaskSet::runCycle(uint32_t, int64_t, int64_t) noexcept
void __real__ZN6stride4task7TaskSet8runCycleEjll(stride::task::TaskSet *self, uint32_t task,
                                                 int64_t startNs, int64_t latencyNs);
void __wrap__ZN6stride4task7TaskSet8runCycleEjll(stride::task::TaskSet *self, uint32_t task,
                                                 int64_t startNs, int64_t latencyNs) {
  insideCycle = true;
  if (std::getenv("STRIDE_TRAP_SELF_TEST") != nullptr) {
    pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    ::pthread_mutex_lock(&mutex);
  }
  __real__ZN6stride4task7TaskSet8runCycleEjll(self, task, startNs, latencyNs);
  insideCycle = false;
}

// void stride::task::TaskSet::takeModeOver(uint32_t, int64_t) noexcept
void __real__ZN6stride4task7TaskSet12takeModeOverEjl(stride::task::TaskSet *self, uint32_t task,
                                                     int64_t startNs);
void __wrap__ZN6stride4task7TaskSet12takeModeOverEjl(stride::task::TaskSet *self, uint32_t task,
                                                     int64_t startNs) {
  insideCycle = true;
  __real__ZN6stride4task7TaskSet12takeModeOverEjl(self, task, startNs);
  insideCycle = false;
}

} // extern "C"

int main(int argc, char **argv) { return stride::host::hostMain(argc, argv, nullptr); }
