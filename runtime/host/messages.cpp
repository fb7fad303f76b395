#include "runtime/host/messages.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>

namespace stride::host {

namespace {

constexpr size_t kCapacity = size_t{256} << 10;
constexpr std::string_view kClearLine = "\r\033[K";

uint64_t linesOf(std::string_view text) {
  return static_cast<uint64_t>(std::count(text.begin(), text.end(), '\n'));
}

/// A name for an error without memory of its own.
const char *reasonOf(int error) {
  const char *const text = error == 0 ? nullptr : ::strerrordesc_np(error);
  return text == nullptr ? "nobody read them" : text;
}

} // namespace

Messages::Messages(Output::Wait wait, int handle) : output_(handle, kCapacity, wait) {}

void Messages::say(std::initializer_list<std::string_view> parts) noexcept {
  const std::lock_guard lock(mutex_);
  hideStatus();
  tellLosses();
  size_t size = 1;
  uint64_t lines = 0;
  bool ended = false;
  for (const std::string_view part : parts) {
    size += part.size();
    lines += linesOf(part);
    ended = part.empty() ? ended : part.back() == '\n';
  }
  if (lost_ != 0 || !output_.ready(size)) {
    lost_ += lines + (ended ? 0 : 1);
    return;
  }
  for (const std::string_view part : parts)
    output_.append(part);
  if (!ended)
    output_.append("\n");
  push();
}

/// Whatever is said next begins where it has stood.
void Messages::hideStatus() noexcept {
  if (status_)
    output_.appendControls(kClearLine);
  status_ = false;
}

void Messages::showStatus(std::string_view text) noexcept {
  const std::lock_guard lock(mutex_);
  hideStatus();
  if (lost_ == 0 && !text.empty())
    status_ = output_.append(text);
  push();
}

void Messages::show(std::string_view text) noexcept {
  const std::lock_guard lock(mutex_);
  if (lost_ == 0 && output_.appendControls(text))
    push();
}

void Messages::lookAfter() noexcept {
  const std::lock_guard lock(mutex_);
  push();
}

/// First of all what is missing, once there is so much room that other lines find some after it.
void Messages::tellLosses() noexcept {
  push();
  if (lost_ == 0 || !output_.room(kCapacity / 2))
    return;
  char digits[24];
  const auto end = std::to_chars(digits, digits + sizeof digits, lost_).ptr;
  for (const std::string_view part :
       {std::string_view(cutOff_ ? "\n" : ""), std::string_view("warning: "),
        std::string_view(digits, static_cast<size_t>(end - digits)),
        std::string_view(lost_ == 1 ? " line" : " lines"),
        std::string_view(" of messages could not be written: "),
        std::string_view(reasonOf(reason_)), std::string_view("\n")})
    output_.append(part);
  output_.advance();
  if (const int error = output_.error(); error != 0) {
    reason_ = error;
    output_.forgive();
    return;
  }
  lost_ = 0;
  reason_ = 0;
  cutOff_ = false;
}

void Messages::push() noexcept {
  const size_t before = output_.rest().size();
  output_.advance();
  if (output_.error() == 0)
    return;
  lost_ += linesOf(output_.rest());
  cutOff_ = cutOff_ || output_.rest().size() != before;
  reason_ = output_.error();
  output_.forgive();
}

bool Messages::finish() noexcept {
  const std::lock_guard lock(mutex_);
  if (output_.settle())
    tellLosses();
  push();
  return lost_ == 0 && output_.settle();
}

} // namespace stride::host
