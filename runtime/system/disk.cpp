#include "runtime/system/disk.hpp"

#include "runtime/system/handle.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace stride::system {

namespace {

Outcome failed(int number) { return {fileErrorOf(number), 0}; }

/// Calls `part(done)`, which may do less than what is left, until all is done or nothing more is.
template <class Part> Outcome inParts(uint64_t size, Part part) {
  uint64_t done = 0;
  while (done < size) {
    const ssize_t count = part(done);
    if (count < 0 && errno == EINTR)
      continue;
    if (count < 0)
      return {fileErrorOf(errno), done};
    if (count == 0)
      break;
    done += static_cast<uint64_t>(count);
  }
  return {FileError::None, done};
}

/// A disk that takes nothing and says nothing is broken.
Outcome allOf(Outcome written, uint64_t size) {
  if (written.error == FileError::None && written.value < size)
    written.error = FileError::Device;
  return written;
}

/// Whether links on the way lead out of the folder: from the deepest part of the path that is
/// there. Allocates nothing: in virtual time it is done within a cycle.
bool leadsOut(const std::string &folder, const std::string &path) {
  std::array<char, PATH_MAX> root{};
  if (::realpath(folder.c_str(), root.data()) == nullptr)
    return errno != ENOENT; // nothing is there yet
  std::array<char, PATH_MAX> part{};
  if (path.size() >= part.size())
    return true;
  path.copy(part.data(), path.size());
  std::array<char, PATH_MAX> real{};
  while (::realpath(part.data(), real.data()) == nullptr) {
    struct stat about {};
    char *const slash = std::strrchr(part.data(), '/');
    if (errno != ENOENT || slash == nullptr || slash < part.data() + folder.size() ||
        ::lstat(part.data(), &about) == 0) // a link to what is not there
      return true;
    *slash = 0;
  }
  const std::string_view inside(root.data());
  const std::string_view at(real.data());
  return !(at.starts_with(inside) &&
           (at.size() == inside.size() || inside == "/" || at[inside.size()] == '/'));
}

/// As many bytes as there are.
Outcome readAll(int file, std::byte *data, uint64_t size) {
  return inParts(size, [&](uint64_t done) { return ::read(file, data + done, size - done); });
}

} // namespace

FileError fileErrorOf(int number) {
  switch (number) {
  case ENOENT:
  case ENOTDIR:
    return FileError::NotFound;
  case EEXIST:
  case ENOTEMPTY:
    return FileError::Exists;
  case ENAMETOOLONG:
  case EINVAL:
  case EISDIR:
    return FileError::BadName;
  case EBADF:
    return FileError::BadHandle;
  case ENOSPC:
  case EDQUOT:
    return FileError::NoSpace;
  case EACCES:
  case EPERM:
  case EROFS:
    return FileError::AccessDenied;
  case EMFILE:
  case ENFILE:
    return FileError::TooMany;
  case EFBIG:
    return FileError::TooLarge;
  default:
    return FileError::Device;
  }
}

Disk::~Disk() {
  for (const File &file : files_)
    if (file.descriptor >= 0)
      (void)finish(file.descriptor, (file.mode & kFileWrite) != 0);
}

std::string Disk::resolve(std::string_view name, FileError &error) const {
  std::string path(name);
  std::replace(path.begin(), path.end(), '\\', '/'); // as V2.3's programs write it
  error = FileError::BadName;
  if (path.empty() || path.back() == '/')
    return {};
  error = FileError::Outside;
  const bool absolute = path.front() == '/';
  if (!anywhere_) {
    if (absolute || (path.size() > 1 && path[1] == ':'))
      return {};
    for (size_t at = 0; at <= path.size();) {
      const size_t end = std::min(path.find('/', at), path.size());
      if (std::string_view(path).substr(at, end - at) == "..")
        return {};
      at = end + 1;
    }
    if (leadsOut(root_, root_ + '/' + path))
      return {};
  }
  error = FileError::None;
  return absolute ? path : root_ + '/' + path;
}

Outcome Disk::openFile(std::string_view name, uint32_t mode) {
  FileError error{};
  const std::string path = resolve(name, error);
  if (error != FileError::None)
    return {error, 0};
  int flags = O_CLOEXEC | O_NONBLOCK; // a FIFO would wait for its other end
  flags |= (mode & kFileWrite) == 0 ? O_RDONLY : (mode & kFileRead) != 0 ? O_RDWR : O_WRONLY;
  if ((mode & kFileAppend) != 0)
    flags |= O_APPEND;
  if ((mode & kFileTruncate) != 0)
    flags |= O_TRUNC;
  if ((mode & kFileCreate) != 0) {
    flags |= O_CREAT;
    std::error_code ignored; // open() says what is wrong
    std::filesystem::create_directories(root_, ignored);
  }
  const int file = ::open(path.c_str(), flags, 0644);
  if (file < 0)
    return failed(errno);
  struct stat about {};
  if (::fstat(file, &about) != 0 || !S_ISREG(about.st_mode)) {
    ::close(file);
    return {FileError::BadName, 0};
  }
  return {FileError::None, static_cast<uint64_t>(file)};
}

Outcome Disk::finish(int file, bool written) {
  const int synced = written ? ::fsync(file) : 0;
  const int number = errno;
  const bool closed = ::close(file) == 0;
  if (synced != 0)
    return failed(number);
  return closed ? Outcome{} : failed(errno);
}

Outcome Disk::writeAll(int file, const std::byte *data, uint64_t size) {
  const auto part = [&](uint64_t done) { return ::write(file, data + done, size - done); };
  return allOf(inParts(size, part), size);
}

Outcome Disk::writeAllAt(int file, const std::byte *data, uint64_t size, uint64_t position) {
  const auto part = [&](uint64_t done) {
    return ::pwrite(file, data + done, size - done, static_cast<off_t>(position + done));
  };
  return allOf(inParts(size, part), size);
}

Disk::File *Disk::find(uint32_t handle) {
  const Handle at(handle);
  if (at.index() >= files_.size() || files_[at.index()].descriptor < 0 ||
      files_[at.index()].generation != at.generation())
    return nullptr;
  return &files_[at.index()];
}

Outcome Disk::open(std::string_view name, uint32_t mode) {
  const auto place = std::find_if(files_.begin(), files_.end(),
                                  [](const File &file) { return file.descriptor < 0; });
  if (place == files_.end())
    return {FileError::TooMany, 0};
  const Outcome opened = openFile(name, mode);
  if (opened.error != FileError::None)
    return opened;
  place->descriptor = static_cast<int>(opened.value);
  place->generation = Handle::next(place->generation);
  place->mode = mode;
  const Handle handle(static_cast<size_t>(place - files_.begin()), place->generation);
  return {FileError::None, handle.number()};
}

Outcome Disk::close(uint32_t handle) {
  File *const file = find(handle);
  if (file == nullptr)
    return {FileError::BadHandle, 0};
  const int descriptor = file->descriptor;
  file->descriptor = -1;
  return finish(descriptor, (file->mode & kFileWrite) != 0);
}

Outcome Disk::read(uint32_t handle, std::byte *data, uint64_t size) {
  const File *const file = find(handle);
  if (file == nullptr)
    return {FileError::BadHandle, 0};
  if ((file->mode & kFileRead) == 0)
    return {FileError::NotPossible, 0};
  return readAll(file->descriptor, data, size);
}

Outcome Disk::write(uint32_t handle, const std::byte *data, uint64_t size) {
  const File *const file = find(handle);
  if (file == nullptr)
    return {FileError::BadHandle, 0};
  if ((file->mode & kFileWrite) == 0)
    return {FileError::NotPossible, 0};
  return writeAll(file->descriptor, data, size);
}

Outcome Disk::setPosition(uint32_t handle, uint64_t position) {
  const File *const file = find(handle);
  if (file == nullptr)
    return {FileError::BadHandle, 0};
  if (::lseek(file->descriptor, static_cast<off_t>(position), SEEK_SET) < 0)
    return failed(errno);
  return {FileError::None, position};
}

Outcome Disk::position(uint32_t handle) {
  const File *const file = find(handle);
  if (file == nullptr)
    return {FileError::BadHandle, 0};
  const off_t at = ::lseek(file->descriptor, 0, SEEK_CUR);
  return at < 0 ? failed(errno) : Outcome{FileError::None, static_cast<uint64_t>(at)};
}

Outcome Disk::atEnd(uint32_t handle) {
  const Outcome at = position(handle);
  if (at.error != FileError::None)
    return at;
  struct stat about {};
  if (::fstat(find(handle)->descriptor, &about) != 0)
    return failed(errno);
  return {FileError::None, at.value >= static_cast<uint64_t>(about.st_size) ? 1U : 0U};
}

Outcome Disk::size(std::string_view name) {
  FileError error{};
  const std::string path = resolve(name, error);
  struct stat about {};
  if (error != FileError::None)
    return {error, 0};
  if (::stat(path.c_str(), &about) != 0)
    return failed(errno);
  if (!S_ISREG(about.st_mode))
    return {FileError::BadName, 0};
  return {FileError::None, static_cast<uint64_t>(about.st_size)};
}

Outcome Disk::times(std::string_view name, uint64_t (&times)[3]) {
  FileError error{};
  const std::string path = resolve(name, error);
  struct stat about {};
  if (error != FileError::None)
    return {error, 0};
  if (::stat(path.c_str(), &about) != 0)
    return failed(errno);
  // Not every file system knows when a file was made: what it knows is not before its last change.
  times[0] = static_cast<uint64_t>(std::min(about.st_ctim.tv_sec, about.st_mtim.tv_sec));
  times[1] = static_cast<uint64_t>(about.st_atim.tv_sec);
  times[2] = static_cast<uint64_t>(about.st_mtim.tv_sec);
  return {};
}

Outcome Disk::remove(std::string_view name) {
  FileError error{};
  const std::string path = resolve(name, error);
  if (error != FileError::None)
    return {error, 0};
  return ::unlink(path.c_str()) == 0 ? Outcome{} : failed(errno);
}

Outcome Disk::rename(std::string_view from, std::string_view to) {
  FileError error{};
  const std::string old = resolve(from, error);
  if (error != FileError::None)
    return {error, 0};
  const std::string fresh = resolve(to, error);
  if (error != FileError::None)
    return {error, 0};
  std::error_code unknown;
  if (std::filesystem::exists(fresh, unknown))
    return {FileError::Exists, 0};
  return std::rename(old.c_str(), fresh.c_str()) == 0 ? Outcome{} : failed(errno);
}

Outcome Disk::copy(std::string_view from, std::string_view to) {
  std::vector<std::byte> part(65536);
  const Outcome source = openFile(from, kFileRead);
  if (source.error != FileError::None)
    return source;
  const int in = static_cast<int>(source.value);
  struct stat a {};
  struct stat b {};
  FileError error{};
  const std::string path = resolve(to, error);
  if (error == FileError::None && ::fstat(in, &a) == 0 && ::stat(path.c_str(), &b) == 0 &&
      a.st_dev == b.st_dev && a.st_ino == b.st_ino) {
    ::close(in);
    return {FileError::Exists, 0}; // it would be emptied first
  }
  const Outcome target = openFile(to, kFileWrite | kFileCreate | kFileTruncate);
  if (target.error != FileError::None) {
    ::close(in);
    return target;
  }
  const int out = static_cast<int>(target.value);
  Outcome result;
  for (bool more = true; more;) {
    const Outcome got = readAll(in, part.data(), part.size());
    const Outcome written = writeAll(out, part.data(), got.value);
    result.value += written.value;
    result.error = got.error != FileError::None ? got.error : written.error;
    more = result.error == FileError::None && got.value == part.size();
  }
  ::close(in);
  const Outcome end = finish(out, true);
  if (result.error == FileError::None)
    result.error = end.error;
  return result;
}

Outcome Disk::load(std::string_view name, std::vector<std::byte> &content, uint64_t limit) {
  const Outcome opened = openFile(name, kFileRead);
  if (opened.error != FileError::None)
    return opened;
  const int file = static_cast<int>(opened.value);
  struct stat about {};
  Outcome result;
  if (::fstat(file, &about) != 0)
    result.error = fileErrorOf(errno);
  else if (static_cast<uint64_t>(about.st_size) > limit)
    result.error = FileError::TooLarge;
  else
    content.resize(static_cast<size_t>(about.st_size));
  if (result.error == FileError::None)
    result = readAll(file, content.data(), content.size());
  content.resize(static_cast<size_t>(result.value));
  ::close(file);
  return result;
}

} // namespace stride::system
