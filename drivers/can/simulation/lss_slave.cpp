#include "drivers/can/simulation/lss_slave.hpp"

#include "drivers/can/simulation/dictionary.hpp"

#include <utility>

namespace stride::can::simulation {
namespace {

constexpr uint8_t kSwitchGlobal = 0x04;
constexpr uint8_t kConfigureId = 0x11;
constexpr uint8_t kConfigureBitRate = 0x13;
constexpr uint8_t kStore = 0x17;
constexpr uint8_t kSelectFirst = 0x40; ///< And three more: vendor, product, revision, serial.
constexpr uint8_t kSelected = 0x44;
constexpr uint8_t kIdentifyFirst = 0x46; ///< And five more, with ranges of the last two.
constexpr uint8_t kIdentifyUnconfigured = 0x4C;
constexpr uint8_t kIdentified = 0x4F;
constexpr uint8_t kUnconfiguredThere = 0x50;
constexpr uint8_t kFastScan = 0x51;
constexpr uint8_t kInquireFirst = 0x5A; ///< And three more.
constexpr uint8_t kInquireId = 0x5E;
constexpr uint8_t kParts = 4;
constexpr uint8_t kRanges = 6;
constexpr uint8_t kLastId = 127;
constexpr uint8_t kReservedBitRate = 5;
constexpr uint8_t kLastBitRate = 8;

} // namespace

void LssSlave::powerOn() {
  next_ = stored_;
  configuration_ = answers_ = start_ = false;
  selected_ = identified_ = scanned_ = 0;
}

uint8_t LssSlave::activate() {
  active_ = next_;
  start_ = false;
  return active_;
}

bool LssSlave::takeStart() noexcept { return std::exchange(start_, false); }

void LssSlave::answer(uint8_t command, uint32_t value) noexcept {
  answer_ = {};
  answer_.id = kAnswerId;
  answer_.length = Frame::kMostBytes;
  answer_.data[0] = command;
  encode(value, std::span(answer_.data).subspan(1, 4));
  answers_ = true;
}

bool LssSlave::transmit(Frame &frame) noexcept {
  if (!std::exchange(answers_, false))
    return false;
  frame = answer_;
  return true;
}

void LssSlave::switchState(bool configuration) noexcept {
  if (configuration_ && !configuration && active_ == kUnconfigured && next_ != kUnconfigured)
    start_ = true;
  configuration_ = configuration;
  selected_ = 0;
}

/// All four parts in their order, and all of them ours.
void LssSlave::select(uint8_t part, uint32_t number) noexcept {
  if (configuration_)
    return;
  const bool fits = part == selected_ && identity_[part] == number;
  selected_ = fits ? static_cast<uint8_t>(part + 1) : uint8_t{0};
  if (selected_ != kParts)
    return;
  switchState(true);
  answer(kSelected);
}

/// Vendor, product, least and last revision, least and last serial number.
void LssSlave::identify(uint8_t part, uint32_t number) noexcept {
  const uint32_t own = identity_[part < 2 ? part : static_cast<size_t>(part / 2 + 1)];
  const bool least = part == 2 || part == 4;
  const bool last = part == 3 || part == 5;
  const bool fits = part == identified_ && (least  ? own >= number
                                            : last ? own <= number
                                                   : own == number);
  identified_ = fits ? static_cast<uint8_t>(part + 1) : uint8_t{0};
  if (identified_ != kRanges)
    return;
  identified_ = 0;
  answer(kIdentified);
}

/// Bit by bit: whoever agrees so far says so.
void LssSlave::fastScan(const Frame &frame) noexcept {
  constexpr uint8_t kReset = 0x80;
  constexpr uint8_t kLastBit = 31;
  if (active_ != kUnconfigured || next_ != kUnconfigured || configuration_)
    return;
  const auto number = static_cast<uint32_t>(decode(std::span(frame.data).subspan(1, 4)));
  const uint8_t bit = frame.data[5];
  const uint8_t part = frame.data[6];
  const uint8_t next = frame.data[7];
  if (bit == kReset) {
    scanned_ = 0;
    answer(kIdentified);
    return;
  }
  if (bit > kLastBit || part >= kParts || next >= kParts || part != scanned_ ||
      number >> bit != identity_[part] >> bit)
    return;
  answer(kIdentified);
  if (bit != 0)
    return;
  scanned_ = next;
  if (next < part)
    switchState(true);
}

void LssSlave::configure(const Frame &frame) noexcept {
  constexpr uint32_t kOutOfRange = 1;
  const uint8_t command = frame.data[0];
  switch (command) {
  case kConfigureId: {
    const uint8_t id = frame.data[1];
    const bool valid = (id >= 1 && id <= kLastId) || id == kUnconfigured;
    if (valid)
      next_ = id;
    answer(command, valid ? 0 : kOutOfRange);
    break;
  }
  case kConfigureBitRate: // the table of the standard, as if the node had a bit rate of its own
    answer(command,
           frame.data[1] == 0 && frame.data[2] <= kLastBitRate && frame.data[2] != kReservedBitRate
               ? 0
               : kOutOfRange);
    break;
  case kStore:
    stored_ = next_;
    answer(command);
    break;
  case kInquireId:
    answer(command, active_);
    break;
  default:
    if (command >= kInquireFirst && command < kInquireFirst + kParts)
      answer(command, identity_[command - size_t{kInquireFirst}]);
    break;
  }
}

void LssSlave::receive(const Frame &frame) noexcept {
  if (frame.length != Frame::kMostBytes || frame.remote)
    return;
  const uint8_t command = frame.data[0];
  const auto number = static_cast<uint32_t>(decode(std::span(frame.data).subspan(1, 4)));
  if (command == kSwitchGlobal) {
    if (frame.data[1] <= 1)
      switchState(frame.data[1] == 1);
  } else if (command >= kSelectFirst && command < kSelectFirst + kParts) {
    select(static_cast<uint8_t>(command - kSelectFirst), number);
  } else if (command >= kIdentifyFirst && command < kIdentifyFirst + kRanges) {
    identify(static_cast<uint8_t>(command - kIdentifyFirst), number);
  } else if (command == kIdentifyUnconfigured) {
    if (active_ == kUnconfigured && next_ == kUnconfigured)
      answer(kUnconfiguredThere);
  } else if (command == kFastScan) {
    fastScan(frame);
  } else if (configuration_) {
    configure(frame);
  }
}

} // namespace stride::can::simulation
