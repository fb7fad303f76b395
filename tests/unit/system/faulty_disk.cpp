#include "tests/unit/system/faulty_disk.hpp"

#include <cerrno>
#include <chrono>
#include <thread>

#include <dlfcn.h>
#include <sys/types.h>

namespace stride::test {

FaultyDisk &faultyDisk() {
  static FaultyDisk disk;
  return disk;
}

namespace {

bool fails() {
  const FaultyDisk &disk = faultyDisk();
  if (disk.delayMs != 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(disk.delayMs));
  if (disk.error == 0)
    return false;
  errno = disk.error;
  return true;
}

template <class F> F *next(const char *name) {
  return reinterpret_cast<F *>(::dlsym(RTLD_NEXT, name));
}

} // namespace
} // namespace stride::test

extern "C" {

ssize_t pwrite(int file, const void *data, size_t size, off_t at);
ssize_t pwrite(int file, const void *data, size_t size, off_t at) {
  static auto *const original =
      stride::test::next<ssize_t(int, const void *, size_t, off_t)>("pwrite");
  return stride::test::fails() ? -1 : original(file, data, size, at);
}

int fsync(int file);
int fsync(int file) {
  static auto *const original = stride::test::next<int(int)>("fsync");
  return stride::test::fails() ? -1 : original(file);
}

} // extern "C"
