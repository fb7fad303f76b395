#include "compiler/project/file_system.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace stc {

namespace fs = std::filesystem;

std::optional<std::string> readFile(const fs::path &path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0)
    return std::nullopt;
  struct stat status {};
  std::string text;
  bool good = ::fstat(fd, &status) == 0;
  if (good && S_ISDIR(status.st_mode)) {
    errno = EISDIR;
    good = false;
  }
  if (good)
    text.resize(status.st_size > 0 ? static_cast<std::size_t>(status.st_size) : 0);
  std::size_t filled = 0;
  while (good) {
    if (filled == text.size())
      text.resize(text.size() + 4096); // a pipe, or it grows
    const ssize_t count = ::read(fd, text.data() + filled, text.size() - filled);
    if (count < 0 && errno == EINTR)
      continue;
    good = count >= 0;
    if (count <= 0)
      break;
    filled += static_cast<std::size_t>(count);
  }
  const int error = errno;
  ::close(fd);
  errno = error;
  if (!good)
    return std::nullopt;
  text.resize(filled);
  return text;
}

bool writeFile(const fs::path &path, std::string_view text) { return writeFile(path, text, 0666); }

bool writeFile(const fs::path &path, std::string_view text, unsigned mode) {
  std::error_code error;
  if (path.has_parent_path())
    fs::create_directories(path.parent_path(), error);
  const std::string beside = path.string() + fmt::format(".{}.tmp", ::getpid());
  const int fd = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, mode);
  if (fd < 0)
    return false;
  bool good = true;
  while (good && !text.empty()) {
    const ssize_t count = ::write(fd, text.data(), text.size());
    if (count < 0 && errno == EINTR)
      continue;
    good = count > 0;
    if (good)
      text.remove_prefix(static_cast<std::size_t>(count));
  }
  good = ::close(fd) == 0 && good;
  good = good && ::rename(beside.c_str(), path.c_str()) == 0;
  if (!good) {
    const int saved = errno;
    ::unlink(beside.c_str());
    errno = saved;
  }
  return good;
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

bool writeIfDifferent(const fs::path &path, std::string_view text) {
  const std::optional<std::string> old = readFile(path);
  return (old && *old == text) || writeFile(path, text);
}

std::string lastError() { return std::strerror(errno); }

std::string fileStamp(const fs::path &path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return {};
  return fmt::format("{}:{}:{}.{}", path.string(), status.st_size, status.st_mtim.tv_sec,
                     status.st_mtim.tv_nsec);
}

} // namespace stc
