// For LD_PRELOAD: files of a folder `files` are on a disk of which every operation takes
// STRIDE_DISK_MS milliseconds; writing and fsync fail with the errno STRIDE_DISK_ERROR.
#include <atomic>
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

/// Descriptors of such files.
std::atomic<bool> onDisk[1024];
bool isOnDisk(int file) { return file >= 0 && file < 1024 && onDisk[file]; }

void wait() { ::usleep(static_cast<useconds_t>(setting("STRIDE_DISK_MS")) * 1000); }

/// Of something that writes.
bool fails(int file) {
  if (!isOnDisk(file))
    return false;
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
  return fails(file) ? -1 : original(file, data, size, at);
}

ssize_t write(int file, const void *data, size_t size) {
  static auto *const original = next<ssize_t(int, const void *, size_t)>("write");
  return fails(file) ? -1 : original(file, data, size);
}

ssize_t read(int file, void *data, size_t size) {
  static auto *const original = next<ssize_t(int, void *, size_t)>("read");
  if (isOnDisk(file))
    wait();
  return original(file, data, size);
}

int fsync(int file) {
  static auto *const original = next<int(int)>("fsync");
  return fails(file) ? -1 : original(file);
}

int open(const char *path, int flags, ...) {
  static auto *const original = next<int(const char *, int, ...)>("open");
  std::va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? static_cast<mode_t>(va_arg(arguments, int)) : 0;
  va_end(arguments);
  const bool slow = std::strstr(path, "/files/") != nullptr;
  if (slow)
    wait();
  const int file = original(path, flags, mode);
  if (file >= 0 && file < 1024)
    onDisk[file] = slow;
  return file;
}

} // extern "C"
