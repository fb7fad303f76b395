#include "runtime/app/retain_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace stride::app {

namespace {

/// Retained data are small; what is larger is none.
constexpr off_t kMostBytes = off_t{1} << 31;

class SystemFiles final : public RetainFiles {
public:
  int create(const std::string &path, int &handle) override {
    // What a process that was ended has left, or a link that somebody has put there.
    if (::unlink(path.c_str()) != 0 && errno != ENOENT)
      return errno;
    handle = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
    return handle < 0 ? errno : 0;
  }
  int write(int handle, std::span<const std::byte> bytes) override {
    while (!bytes.empty()) {
      const ssize_t done = ::write(handle, bytes.data(), bytes.size());
      if (done < 0 && errno == EINTR)
        continue;
      if (done <= 0)
        return done < 0 ? errno : ENOSPC;
      bytes = bytes.subspan(static_cast<size_t>(done));
    }
    return 0;
  }
  int sync(int handle) override { return ::fsync(handle) == 0 ? 0 : errno; }
  int close(int handle) override { return ::close(handle) == 0 ? 0 : errno; }
  int rename(const std::string &from, const std::string &to) override {
    return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
  }
  int remove(const std::string &path) override { return ::unlink(path.c_str()) == 0 ? 0 : errno; }
  int syncFolder(const std::string &folder) override {
    const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (handle < 0)
      return errno;
    const int error = ::fsync(handle) == 0 ? 0 : errno;
    ::close(handle);
    return error;
  }
  int read(const std::string &path, std::vector<std::byte> &bytes) override {
    const int handle = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (handle < 0)
      return errno;
    const int error = readAll(handle, bytes);
    ::close(handle);
    return error;
  }

private:
  static int readAll(int handle, std::vector<std::byte> &bytes) {
    struct ::stat info {};
    if (::fstat(handle, &info) != 0)
      return errno;
    if (!S_ISREG(info.st_mode))
      return S_ISDIR(info.st_mode) ? EISDIR : EINVAL;
    if (info.st_size > kMostBytes)
      return EFBIG;
    bytes.resize(static_cast<size_t>(info.st_size));
    size_t at = 0;
    while (at < bytes.size()) {
      const ssize_t done = ::read(handle, bytes.data() + at, bytes.size() - at);
      if (done < 0 && errno == EINTR)
        continue;
      if (done < 0)
        return errno;
      if (done == 0)
        break;
      at += static_cast<size_t>(done);
    }
    bytes.resize(at);
    return 0;
  }
};

std::string folderOf(const std::string &file) {
  const std::string folder = std::filesystem::path(file).parent_path().string();
  return folder.empty() ? "." : folder;
}

} // namespace

RetainFiles &systemFiles() {
  static SystemFiles files; // without state
  return files;
}

RetainStore::RetainStore(std::string file, RetainFiles &files)
    : file_(std::move(file)), folder_(folderOf(file_)), files_(&files) {}

void RetainStore::fail(const char *what, const std::string &path, int error) const {
  const char *help = "";
  if (error == ENOSPC || error == EDQUOT)
    help = "\n  make room on that disk; it is tried again";
  else if (error == EACCES || error == EPERM || error == EROFS)
    help = "\n  give the user who runs it the right to write there, or name another file in "
           "[retain] of stride.toml";
  throw Error(fmt::format("cannot {} '{}': {}{}", what, path, std::strerror(error), help));
}

std::optional<RetainImage> RetainStore::load(std::vector<std::string> &problems) {
  std::array<std::optional<RetainImage>, 2> found;
  for (size_t i = 0; i < found.size(); ++i) {
    const std::string path = file_ + (i == 0 ? ".a" : ".b");
    std::vector<std::byte> bytes;
    if (const int error = files_->read(path, bytes); error == ENOENT)
      continue;
    else if (error != 0)
      fail("read the retained data in", path, error);
    try {
      found[i] = decodeImage(bytes);
    } catch (const RetainVersionError &error) {
      throw Error(fmt::format("the retained data in '{}' cannot be used: {}\n  use that Stride, or "
                              "start anew with 'stride reset origin'",
                              path, error.what()));
    } catch (const Error &error) {
      problems.push_back(fmt::format("'{}' is not used: {}", path, error.what()));
    }
  }
  const bool b = found[1] && (!found[0] || found[1]->head.sequence > found[0]->head.sequence);
  std::optional<RetainImage> &newest = found[b ? 1 : 0];
  nextIsB_ = found[0].has_value() && !b;
  if (newest) {
    sequence_ = newest->head.sequence;
    // Its name may not be on the disk yet, if the last process ended after the renaming.
    static_cast<void>(files_->syncFolder(folder_));
  }
  return std::move(newest);
}

void RetainStore::save(const std::string &application, uint64_t buildHash,
                       std::span<const std::byte> layout, std::span<const std::byte> values) {
  const std::vector<std::byte> bytes =
      encodeImage({application, buildHash, sequence_ + 1}, layout, values);
  const std::string fresh = file_ + ".new";
  const std::string target = file_ + (nextIsB_ ? ".b" : ".a");
  int handle = -1;
  if (const int error = files_->create(fresh, handle); error != 0)
    fail("write", fresh, error);
  int error = files_->write(handle, bytes);
  const char *what = "write";
  if (error == 0) {
    error = files_->sync(handle);
    what = "make durable";
  }
  if (const int closed = files_->close(handle); error == 0)
    error = closed;
  if (error != 0)
    fail(what, fresh, error);
  if (const int renamed = files_->rename(fresh, target); renamed != 0)
    fail("rename to", target, renamed);
  // A number is used once, also when it is not known whether it got there.
  ++sequence_;
  if (const int synced = files_->syncFolder(folder_); synced != 0)
    fail("make durable the folder", folder_, synced);
  nextIsB_ = !nextIsB_;
}

/// A name that a project has given may be that of somebody's photograph.
void RetainStore::refuseOthers() const {
  for (const char *ending : {".a", ".b", ".new"}) {
    std::vector<std::byte> bytes;
    if (files_->read(file_ + ending, bytes) == 0 && !mayBeImage(bytes))
      throw Error(fmt::format("'{}{}' does not begin as retained data do, so nothing is removed\n"
                              "  remove it yourself if it is not needed",
                              file_, ending));
  }
}

void RetainStore::clear() {
  refuseOthers();
  // What cannot be read counts as older than all else.
  std::array<std::pair<uint64_t, std::string>, 2> images;
  for (size_t i = 0; i < images.size(); ++i) {
    images[i] = {0, file_ + (i == 0 ? ".a" : ".b")};
    std::vector<std::byte> bytes;
    if (files_->read(images[i].second, bytes) != 0)
      continue;
    try {
      images[i].first = decodeImage(bytes).head.sequence;
    } catch (const Error &) { // removed all the same
      continue;
    }
  }
  std::sort(images.begin(), images.end());
  for (const std::string &path : {file_ + ".new", images[0].second, images[1].second}) {
    const int error = files_->remove(path);
    if (error != 0 && error != ENOENT)
      fail("remove", path, error);
    // One after the other, so that the newest does not go before the older one.
    if (const int synced = error == 0 ? files_->syncFolder(folder_) : 0; synced != 0)
      fail("make durable the folder", folder_, synced);
  }
}

RetainLock::RetainLock(const std::string &file) {
  std::error_code ignored;
  std::filesystem::create_directories(folderOf(file), ignored);
  const std::string path = file + ".lock";
  handle_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0644);
  if (handle_ < 0)
    throw Error(fmt::format("cannot create '{}': {}\n  name a file for the retained data where you "
                            "may write, in [retain] of stride.toml or with --retain",
                            path, std::strerror(errno)));
  if (::flock(handle_, LOCK_EX | LOCK_NB) == 0)
    return;
  ::close(handle_);
  throw Error(
      fmt::format("the retained data '{}' are in use by another application, in this run "
                  "or in another process\n  stop that one first, or give each a file of its "
                  "own in [retain] of stride.toml",
                  file));
}

RetainLock::~RetainLock() { ::close(handle_); }

} // namespace stride::app
