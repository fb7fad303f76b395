#include "compiler/cli/file_watch.hpp"

#include <cerrno>
#include <climits>
#include <cstring>
#include <poll.h>
#include <string_view>
#include <sys/inotify.h>
#include <unistd.h>

namespace stc::cli {

namespace fs = std::filesystem;

namespace {

/// An editor may write a file in several steps, and save several files.
constexpr int kQuietMs = 100;
constexpr uint32_t kEvents =
    IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE | IN_CREATE | IN_ONLYDIR;

bool isLookedInto(const fs::path &folder) {
  const std::string name = folder.filename().string();
  return !name.starts_with('.') && name != "build";
}

bool isPart(std::string_view name) {
  return !name.starts_with('.') &&
         (name.ends_with(".st") || name.ends_with(".ST") || name.ends_with(".toml"));
}

bool isReadable(int handle, int limitMs) {
  ::pollfd wait = {handle, POLLIN, 0};
  return ::poll(&wait, 1, limitMs) > 0;
}

} // namespace

FileWatch::FileWatch(const fs::path &path)
    : folder_(path.empty() ? fs::path(".") : path),
      handle_(::inotify_init1(IN_CLOEXEC | IN_NONBLOCK)) {
  std::error_code error;
  if (!fs::is_directory(folder_, error)) {
    if (folder_.filename() != "stride.toml")
      only_ = folder_.filename().string();
    folder_ = folder_.has_parent_path() ? folder_.parent_path() : fs::path(".");
  }
  refresh();
}

FileWatch::~FileWatch() {
  if (handle_ >= 0)
    ::close(handle_);
}

void FileWatch::add(const fs::path &folder) const {
  static_cast<void>(::inotify_add_watch(handle_, folder.c_str(), kEvents));
}

void FileWatch::refresh() {
  if (handle_ < 0)
    return;
  add(folder_);
  if (!only_.empty())
    return;
  std::error_code error;
  fs::recursive_directory_iterator at(folder_, fs::directory_options::skip_permission_denied,
                                      error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    std::error_code ignored;
    if (!at->is_directory(ignored))
      continue;
    if (isLookedInto(at->path()))
      add(at->path());
    else
      at.disable_recursion_pending();
  }
}

/// Whether what has been seen concerns the project.
bool FileWatch::take() const {
  alignas(::inotify_event) char buffer[4096 + sizeof(::inotify_event) + NAME_MAX + 1];
  bool any = false;
  for (ssize_t size = 0; (size = ::read(handle_, buffer, sizeof buffer)) > 0;)
    for (ssize_t at = 0; at < size;) {
      ::inotify_event event{};
      std::memcpy(&event, buffer + at, sizeof event);
      const std::string_view name = event.len == 0 ? "" : buffer + at + sizeof event;
      any = any || (event.mask & (IN_Q_OVERFLOW | IN_ISDIR)) != 0 ||
            (only_.empty() ? isPart(name) : name == only_);
      at += static_cast<ssize_t>(sizeof event + event.len);
    }
  return any;
}

FileWatch::Event FileWatch::wait(int limitMs) {
  if (handle_ < 0)
    return Event::Failed;
  if (!isReadable(handle_, limitMs) || !take())
    return Event::Nothing;
  while (isReadable(handle_, kQuietMs))
    static_cast<void>(take());
  return Event::Changed;
}

} // namespace stc::cli
