#include "compiler/project/output_folder.hpp"

#include "compiler/project/file_system.hpp"

#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace stc {

namespace fs = std::filesystem;

namespace {

bool isLink(int folder, const char *name) {
  struct stat status {};
  return ::fstatat(folder, name, &status, AT_SYMLINK_NOFOLLOW) == 0 && S_ISLNK(status.st_mode);
}

/// Opens a folder in a folder; -1: errno, ELOOP for a link.
int enter(int folder, const char *name, bool make) {
  constexpr int kFlags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
  int fd = ::openat(folder, name, kFlags);
  if (fd < 0 && errno == ENOENT && make && (::mkdirat(folder, name, 0777) == 0 || errno == EEXIST))
    fd = ::openat(folder, name, kFlags);
  if (fd < 0 && errno == ENOTDIR && isLink(folder, name))
    errno = ELOOP;
  return fd;
}

void closeKeepingError(int fd) {
  const int saved = errno;
  ::close(fd);
  errno = saved;
}

} // namespace

std::optional<OutputFolder> OutputFolder::open(const fs::path &folder) {
  const fs::path named = folder.empty() ? fs::path(".") : folder;
  std::error_code ignored; // open() says what is wrong
  fs::create_directories(named, ignored);
  const int handle = ::open(named.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0)
    return std::nullopt;
  return OutputFolder(handle);
}

OutputFolder::OutputFolder(OutputFolder &&other) noexcept : handle_(other.handle_) {
  other.handle_ = -1;
}

OutputFolder::~OutputFolder() {
  if (handle_ >= 0)
    ::close(handle_);
}

/// The open folder that `name` lies in; -1: errno.
int OutputFolder::parentOf(const fs::path &name, bool make) const {
  if (name.empty() || name.is_absolute() || !name.has_filename()) {
    errno = EINVAL;
    return -1;
  }
  int at = ::openat(handle_, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  for (const fs::path &part : name.parent_path()) {
    if (at < 0)
      break;
    if (part == "..") {
      errno = EINVAL;
      closeKeepingError(at);
      return -1;
    }
    const int next = enter(at, part.c_str(), make);
    closeKeepingError(at);
    at = next;
  }
  return at;
}

bool OutputFolder::write(const fs::path &name, std::string_view text, unsigned mode) const {
  const int parent = parentOf(name, true);
  if (parent < 0)
    return false;
  const bool good = writeAt(parent, name.filename().string(), text, mode);
  closeKeepingError(parent);
  return good;
}

std::optional<std::string> OutputFolder::read(const fs::path &name, uintmax_t limit) const {
  const int parent = parentOf(name, false);
  if (parent < 0)
    return std::nullopt;
  std::optional<std::string> text = readRegularFileAt(parent, name.filename().string(), limit);
  closeKeepingError(parent);
  return text;
}

bool OutputFolder::hasFile(const fs::path &name) const {
  const int parent = parentOf(name, false);
  struct stat status {};
  const bool good = parent >= 0 &&
                    ::fstatat(parent, name.filename().c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
                    S_ISREG(status.st_mode);
  if (parent >= 0)
    closeKeepingError(parent);
  return good;
}

bool OutputFolder::remove(const fs::path &name) const {
  const int parent = parentOf(name, false);
  if (parent < 0)
    return false;
  const bool good = ::unlinkat(parent, name.filename().c_str(), 0) == 0;
  closeKeepingError(parent);
  return good;
}

bool hideBuilds(const OutputFolder &project) {
  const fs::path ignore = "build/.gitignore";
  return project.hasFile(ignore) || project.write(ignore, "*\n");
}

} // namespace stc
