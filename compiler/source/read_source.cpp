#include "compiler/source/read_source.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace stc {

namespace {

/// Nothing else sets it here.
constexpr int kNotRegular = ENOTSUP;

/// Appends the file's bytes; 0 or the error.
int readAll(int fd, std::string &text, size_t most) {
  struct stat status {};
  if (::fstat(fd, &status) != 0)
    return errno;
  if (S_ISDIR(status.st_mode))
    return EISDIR;
  if (!S_ISREG(status.st_mode))
    return kNotRegular;
  if (status.st_size > static_cast<off_t>(most))
    return EFBIG;
  // One byte more than the file has, so that its end is seen without growing.
  text.resize(static_cast<size_t>(status.st_size) + 1);
  size_t filled = 0;
  for (;;) {
    if (filled == text.size())
      text.resize(text.size() + 4096); // it grows, or says that it is empty (/proc)
    const ssize_t count = ::read(fd, text.data() + filled, text.size() - filled);
    if (count < 0 && errno == EINTR)
      continue;
    if (count < 0)
      return errno;
    if (count == 0)
      break;
    filled += static_cast<size_t>(count);
    if (filled > most)
      return EFBIG;
  }
  text.resize(filled);
  return 0;
}

} // namespace

std::optional<std::string> readSource(const std::filesystem::path &path, size_t most) {
  // To open a pipe does not wait for its writer, and a device is not asked for anything.
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return std::nullopt;
  if (!S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) {
    errno = kNotRegular;
    return std::nullopt;
  }
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0)
    return std::nullopt;
  std::string text;
  const int error = readAll(fd, text, most);
  ::close(fd);
  errno = error;
  if (error != 0)
    return std::nullopt;
  return text;
}

std::string readSourceError(size_t most) {
  switch (errno) {
  case kNotRegular:
    return "it is not a regular file";
  case EFBIG:
    return "it is longer than " + std::to_string(most >> 20U) + " MiB";
  default:
    return std::strerror(errno);
  }
}

} // namespace stc
