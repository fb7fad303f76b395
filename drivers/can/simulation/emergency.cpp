#include "drivers/can/simulation/emergency.hpp"

#include <algorithm>

namespace stride::can::simulation {
namespace {

constexpr uint64_t kInvalid = 0x80000000;

} // namespace

Emergency::Emergency(Dictionary &dictionary)
    : register_(dictionary.at(0x1001)), cobId_(dictionary.at(0x1014)),
      inhibit_(dictionary.at(0x1015)) {
  for (uint8_t i = 0; i <= kErrorHistory; ++i)
    history_[i] = &dictionary.at(0x1003, i);
}

bool Emergency::active(uint16_t code) const noexcept {
  return std::any_of(errors_.begin(), errors_.begin() + active_,
                     [code](const Error &error) { return error.code == code; });
}

void Emergency::updateRegister() noexcept {
  uint8_t bits = 0;
  for (size_t i = 0; i < active_; ++i)
    bits |= static_cast<uint8_t>(errors_[i].registerBits | kGenericError);
  register_.value = bits;
}

void Emergency::raise(uint16_t code, uint8_t registerBits) noexcept {
  if (active(code) || active_ == kActive)
    return;
  errors_[active_++] = {code, registerBits};
  updateRegister();
  for (size_t i = kErrorHistory; i > 1; --i)
    history_[i]->value = history_[i - 1]->value;
  history_[1]->value = code;
  history_[0]->value = std::min<uint64_t>(history_[0]->value + 1, kErrorHistory);
  queue(code);
}

void Emergency::clear(uint16_t code) noexcept {
  if (!active(code))
    return;
  auto *const end = errors_.begin() + active_;
  auto *const found =
      std::find_if(errors_.begin(), end, [code](const Error &error) { return error.code == code; });
  std::copy(found + 1, end, found);
  --active_;
  updateRegister();
  queue(0);
}

void Emergency::reset() noexcept {
  active_ = 0;
  queued_ = 0;
  allowedNs_ = 0;
  updateRegister();
}

void Emergency::forget() noexcept {
  for (Entry *entry : history_)
    entry->value = 0;
}

void Emergency::queue(uint16_t code) noexcept {
  if (queued_ == kActive)
    return; // the list of errors has it
  Frame &frame = waiting_[queued_++];
  frame = {};
  frame.length = Frame::kMostBytes;
  frame.data[0] = static_cast<uint8_t>(code & 0xFFU);
  frame.data[1] = static_cast<uint8_t>(code >> 8U);
  frame.data[2] = static_cast<uint8_t>(register_.value);
}

bool Emergency::transmit(Frame &frame, int64_t nowNs) noexcept {
  if (queued_ == 0 || nowNs < allowedNs_)
    return false;
  frame = waiting_[0];
  frame.id = static_cast<uint16_t>(cobId_.value & Frame::kLastId);
  std::copy(waiting_.begin() + 1, waiting_.begin() + queued_, waiting_.begin());
  --queued_;
  allowedNs_ = nowNs + static_cast<int64_t>(inhibit_.value) * kInhibitUnit;
  return (cobId_.value & kInvalid) == 0;
}

int64_t Emergency::nextNs() const noexcept { return queued_ > 0 ? allowedNs_ : kNever; }

} // namespace stride::can::simulation
