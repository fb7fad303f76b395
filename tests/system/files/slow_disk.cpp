// For LD_PRELOAD: opening files of a folder `files`, writing at a place, and fsync take
// STRIDE_DISK_MS milliseconds; both of the latter fail with the errno STRIDE_DISK_ERROR.
#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

namespace {

int setting(const char *name) {
  const char *const text = std::getenv(name);
  return text == nullptr ? 0 : std::atoi(text);
}

void wait() { ::usleep(static_cast<useconds_t>(setting("STRIDE_DISK_MS")) * 1000); }

bool fails() {
  wait();
  errno = setting("STRIDE_DISK_ERROR");
  return errno != 0;
}

template <class F> F *next(const char *name) {
  return reinterpret_cast<F *>(::dlsym(RTLD_NEXT, name));
}

} // namespace

extern "C" {

ssize_t pwrite(int file, const void *data, size_t size, off_t at) {
  static auto *const original = next<ssize_t(int, const void *, size_t, off_t)>("pwrite");
  return fails() ? -1 : original(file, data, size, at);
}

int fsync(int file) {
  static auto *const original = next<int(int)>("fsync");
  return fails() ? -1 : original(file);
}

int open(const char *path, int flags, ...) {
  static auto *const original = next<int(const char *, int, ...)>("open");
  std::va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? static_cast<mode_t>(va_arg(arguments, int)) : 0;
  va_end(arguments);
  if (std::strstr(path, "/files/") != nullptr)
    wait();
  return original(path, flags, mode);
}

} // extern "C"
