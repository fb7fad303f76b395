#include "runtime/host/output.hpp"

#include "runtime/app/error.hpp"
#include "runtime/common/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstring>

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

namespace stride::host {

namespace {

constexpr std::string_view kShown = "\n\t";

} // namespace

std::string shownOn(std::FILE *file, std::string text) {
  if (::isatty(::fileno(file)) != 0)
    common::hideControls(text, kShown);
  return text;
}

Output::Output(const std::string &path, size_t capacity, Wait wait)
    : wait_(wait), capacity_(capacity) {
  text_.reserve(capacity);
  handle_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (handle_ < 0)
    throw app::Error(fmt::format("cannot write '{}': {}", path, std::strerror(errno)));
  owned_ = true;
  // Only now: a named pipe without a reader is waited for, before anything moves.
  if (wait == Wait::Never)
    ::fcntl(handle_, F_SETFL, ::fcntl(handle_, F_GETFL) | O_NONBLOCK);
}

/// Whether a write waits is a flag of the open file, which the shell and others have, too. So a
/// pipe or a terminal is opened once more; what cannot be is asked before each write.
Output::Output(int handle, size_t capacity, Wait wait)
    : handle_(handle), wait_(wait), capacity_(capacity) {
  text_.reserve(capacity);
  isTerminal_ = ::isatty(handle) != 0;
  struct ::stat about {};
  if (wait == Wait::Always || ::fstat(handle, &about) != 0)
    return;
  isSocket_ = S_ISSOCK(about.st_mode);
  const bool mayWrite = (::fcntl(handle, F_GETFL) & O_ACCMODE) != O_RDONLY;
  if (!mayWrite || (!S_ISFIFO(about.st_mode) && !S_ISCHR(about.st_mode)))
    return;
  const std::string name = fmt::format("/proc/self/fd/{}", handle);
  const int own = ::open(name.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  byPoll_ = own < 0;
  if (own >= 0) {
    handle_ = own;
    owned_ = true;
  }
}

Output::~Output() {
  if (owned_ && handle_ >= 0)
    ::close(handle_);
}

bool Output::room(size_t size) noexcept {
  if (capacity_ - text_.size() >= size)
    return true;
  text_.erase(0, written_);
  screened_ -= std::min(screened_, written_);
  written_ = 0;
  return capacity_ - text_.size() >= size;
}

bool Output::ready(size_t size) noexcept {
  if (room(size))
    return true;
  advance();
  return wait_ == Wait::Always || room(size);
}

bool Output::append(std::string_view text) noexcept {
  if (!ready(text.size()))
    return false;
  while (wait_ == Wait::Always && error_ == 0 && !room(text.size())) {
    const size_t piece = std::min(text.size(), capacity_ - text_.size());
    text_.append(text.substr(0, piece));
    text.remove_prefix(piece);
    advance();
  }
  if (!room(text.size()))
    return false;
  text_.append(text);
  return true;
}

bool Output::appendControls(std::string_view text) noexcept {
  if (isTerminal_)
    screen();
  if (!append(text))
    return false;
  screened_ = text_.size();
  return true;
}

void Output::screen() noexcept {
  common::hideControls(text_, kShown, std::max(screened_, written_));
  screened_ = text_.size();
}

/// As ::write().
long Output::writeSome(std::string_view text) const noexcept {
  if (isSocket_)
    return ::send(handle_, text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (!byPoll_)
    return ::write(handle_, text.data(), text.size());
  if (!waitForReader(0)) {
    errno = EAGAIN;
    return -1;
  }
  return ::write(handle_, text.data(), std::min<size_t>(text.size(), PIPE_BUF));
}

bool Output::waitForReader(int limitMs) const noexcept {
  ::pollfd file{handle_, POLLOUT, 0};
  return ::poll(&file, 1, limitMs) > 0;
}

bool Output::advance() noexcept {
  if (isTerminal_)
    screen();
  while (error_ == 0 && !empty()) {
    const long done = writeSome(rest());
    if (done > 0) {
      written_ += static_cast<size_t>(done);
      continue;
    }
    const int reason = done < 0 ? errno : ENOSPC;
    if (reason == EINTR)
      continue;
    if (reason != EAGAIN)
      error_ = reason;
    else if (wait_ == Wait::Never)
      return false;
    else
      waitForReader(-1);
  }
  if (!empty())
    return false;
  text_.clear();
  written_ = 0;
  screened_ = 0;
  return error_ == 0;
}

bool Output::settle(std::chrono::milliseconds patience) noexcept {
  while (!advance()) {
    if (error_ != 0 || !waitForReader(static_cast<int>(patience.count())))
      return false;
  }
  return true;
}

void Output::forgive() noexcept {
  error_ = 0;
  text_.clear();
  written_ = 0;
  screened_ = 0;
}

bool Output::finish(std::chrono::milliseconds patience) noexcept {
  const bool all = settle(patience);
  if (owned_ && ::close(handle_) != 0 && error_ == 0)
    error_ = errno;
  if (owned_)
    handle_ = -1;
  owned_ = false;
  return all && error_ == 0;
}

} // namespace stride::host
