#include "compiler/project/file_system.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

namespace stc {

namespace fs = std::filesystem;

namespace {

/// Reads and closes; nothing: errno.
std::optional<std::string> readAndClose(int fd, off_t size) {
  std::string text(size > 0 ? static_cast<size_t>(size) : 0, '\0');
  size_t filled = 0;
  bool good = true;
  while (good) {
    if (filled == text.size())
      text.resize(text.size() + 4096); // a pipe, or it grows
    const ssize_t count = ::read(fd, text.data() + filled, text.size() - filled);
    if (count < 0 && errno == EINTR)
      continue;
    good = count >= 0;
    if (count <= 0)
      break;
    filled += static_cast<size_t>(count);
  }
  const int error = errno;
  ::close(fd);
  errno = error;
  if (!good)
    return std::nullopt;
  text.resize(filled);
  return text;
}

std::optional<std::string> refuse(int fd, int error) {
  ::close(fd);
  errno = error;
  return std::nullopt;
}

} // namespace

std::optional<std::string> readFile(const fs::path &path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status {};
  if (fd < 0)
    return std::nullopt;
  if (::fstat(fd, &status) != 0 || S_ISDIR(status.st_mode))
    return refuse(fd, S_ISDIR(status.st_mode) ? EISDIR : errno);
  return readAndClose(fd, status.st_size);
}

std::optional<std::string> readRegularFile(const fs::path &path, uintmax_t limit) {
  return readRegularFileAt(AT_FDCWD, path.string(), limit);
}

std::optional<std::string> readRegularFileAt(int folder, const std::string &name, uintmax_t limit) {
  const int fd = ::openat(folder, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  struct stat status {};
  if (fd < 0)
    return std::nullopt;
  if (::fstat(fd, &status) != 0)
    return refuse(fd, errno);
  if (!S_ISREG(status.st_mode))
    return refuse(fd, EINVAL);
  if (static_cast<uintmax_t>(status.st_size) > limit)
    return refuse(fd, EFBIG);
  return readAndClose(fd, status.st_size);
}

namespace {

/// A new file in the folder under a name that nobody can know before; -1: errno.
int createUnique(int folder, std::string &name, unsigned mode) {
  constexpr int kTries = 8; // even the second one is not to be expected
  for (int i = 0; i < kTries; ++i) {
    uint64_t random = 0;
    if (::getrandom(&random, sizeof random, 0) != static_cast<ssize_t>(sizeof random))
      return -1;
    name = fmt::format(".stride-{:016x}.tmp", random);
    const int fd =
        ::openat(folder, name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
    if (fd >= 0 || errno != EEXIST)
      return fd;
  }
  return -1;
}

bool writeAll(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(fd, text.data(), text.size());
    if (count < 0 && errno == EINTR)
      continue;
    if (count == 0)
      errno = ENOSPC; // a disk that takes nothing and says nothing
    if (count <= 0)
      return false;
    text.remove_prefix(static_cast<size_t>(count));
  }
  return true;
}

/// The same, and closes it; false also where only that fails (errno).
bool writeAndClose(int fd, std::string_view text) {
  bool good = writeAll(fd, text);
  int saved = errno;
  if (::close(fd) != 0 && good) {
    saved = errno;
    good = false;
  }
  errno = saved;
  return good;
}

} // namespace

bool writeAt(int folder, const std::string &name, std::string_view text, unsigned mode) {
  std::string beside;
  const int fd = createUnique(folder, beside, mode);
  if (fd < 0)
    return false;
  bool good = writeAndClose(fd, text);
  int saved = errno;
  if (good && ::renameat(folder, beside.c_str(), folder, name.c_str()) != 0) {
    saved = errno;
    good = false;
  }
  if (!good)
    ::unlinkat(folder, beside.c_str(), 0);
  errno = saved;
  return good;
}

bool writeFile(const fs::path &path, std::string_view text) { return writeFile(path, text, 0666); }

bool writeFile(const fs::path &path, std::string_view text, unsigned mode) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) {
    // a device or a pipe takes the text: a file in its place would end it for everybody
    const int device = ::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
    return device >= 0 && writeAndClose(device, text);
  }
  std::error_code error;
  const fs::path parent = path.has_parent_path() ? path.parent_path() : fs::path(".");
  fs::create_directories(parent, error);
  const int folder = ::open(parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0)
    return false;
  const bool good = writeAt(folder, path.filename().string(), text, mode);
  const int saved = errno;
  ::close(folder);
  errno = saved;
  return good;
}

bool writeNewFile(const fs::path &path, std::string_view text) {
  constexpr int kFlags = O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC;
  int file = ::open(path.c_str(), kFlags, 0666);
  if (file < 0 && errno == ENOENT) {
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    file = ::open(path.c_str(), kFlags, 0666);
  }
  return file >= 0 && writeAndClose(file, text);
}

bool replaceFile(const fs::path &path, std::string_view text) {
  std::error_code error;
  const fs::path target = fs::canonical(path, error); // a link stays one
  struct stat status {};
  if (error || ::stat(target.c_str(), &status) != 0) {
    errno = error ? error.value() : errno;
    return false;
  }
  constexpr unsigned kModes = 07777;
  if (::access(target.c_str(), W_OK) != 0 || !writeFile(target, text, status.st_mode & 0700))
    return false;
  return ::chmod(target.c_str(), status.st_mode & kModes) == 0;
}

bool leadsOut(const fs::path &folder, const fs::path &path) {
  std::error_code error;
  const fs::path root = fs::weakly_canonical(fs::absolute(folder, error), error);
  fs::path part = fs::absolute(path, error);
  for (; !fs::exists(part, error) && part.has_relative_path(); part = part.parent_path())
    if (fs::is_symlink(fs::symlink_status(part, error)))
      return true; // to what is not there, but could be made there
  const fs::path real = fs::weakly_canonical(part, error);
  return error ||
         std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first != root.end();
}

bool writeIfDifferent(const fs::path &path, std::string_view text) {
  const std::optional<std::string> old = readFile(path);
  return (old && *old == text) || writeFile(path, text);
}

std::string lastError() { return std::strerror(errno); }

std::string fileStamp(const fs::path &path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return {};
  return fmt::format("{}:{}:{}.{}:{}.{}:{}", path.string(), status.st_size, status.st_mtim.tv_sec,
                     status.st_mtim.tv_nsec, status.st_ctim.tv_sec, status.st_ctim.tv_nsec,
                     status.st_ino);
}

} // namespace stc
