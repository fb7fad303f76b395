#include "drivers/can/simulation/encoder406.hpp"

#include "runtime/iec/math.h"

#include <algorithm>

namespace stride::can::simulation {
namespace {

using Type = DataType;

constexpr uint32_t kMultiTurn = 0x00020196; ///< Absolute, rotary, several turns; profile 406.
constexpr uint16_t kOperating = 0x6000;
constexpr uint16_t kPerRevolution = 0x6001;
constexpr uint16_t kRange = 0x6002;
constexpr uint16_t kPreset = 0x6003;
constexpr uint16_t kPosition = 0x6004;
constexpr uint16_t kSpeed = 0x6030;
constexpr uint16_t kCyclicTimer = 0x6200;

// Bits of 6000h.
constexpr uint64_t kReversed = 0x01;
constexpr uint64_t kScaled = 0x04;

DeviceRows encoderRows(const Encoder406Setup &setup) {
  const uint64_t range = uint64_t{setup.perTurn} * setup.turns;
  const auto most = static_cast<int64_t>(0xFFFFFFFF);
  DeviceRows device;
  device.deviceType = kMultiTurn;
  device.objects = setup.more; // of several for the same object the last one counts
  const std::vector<ObjectRow> profile = {
      {.index = kOperating, .type = Type::Unsigned16, .low = 0, .high = 5},
      {.index = kPerRevolution, .value = setup.perTurn, .low = 1, .high = setup.perTurn},
      {.index = kRange, .value = std::min<uint64_t>(range, 0xFFFFFFFF), .low = 1, .high = most},
      {.index = kPreset},
      {.index = kPosition, .access = Access::ReadOnly, .mapping = kInTransmit},
      {.index = kSpeed, .type = Type::Unsigned8, .access = Access::Const, .value = 1},
      {.index = kSpeed,
       .sub = 1,
       .type = Type::Integer16,
       .access = Access::ReadOnly,
       .mapping = kInTransmit},
      {.index = kCyclicTimer, .type = Type::Unsigned16},
      {.index = 0x6500, .type = Type::Unsigned16, .access = Access::ReadOnly},
      {.index = 0x6501, .access = Access::ReadOnly, .value = setup.perTurn},
      {.index = 0x6502, .type = Type::Unsigned16, .access = Access::ReadOnly, .value = setup.turns},
      {.index = 0x6503,
       .type = Type::Unsigned16,
       .access = Access::ReadOnly,
       .mapping = kInTransmit},
      {.index = 0x6505,
       .type = Type::Unsigned16,
       .access = Access::ReadOnly,
       .mapping = kInTransmit}};
  device.objects.insert(device.objects.end(), profile.begin(), profile.end());
  // The first one by events and its timer, the second one with SYNC; two for whatever is wanted.
  device.transmit = {{.cobId = 0x40000180, .type = 254, .map = {0x60040020}},
                     {.cobId = 0x40000280, .type = 1, .map = {0x60040020}},
                     {.cobId = 0xC0000380},
                     {.cobId = 0xC0000480}};
  return device;
}

} // namespace

SimulatedEncoder406::SimulatedEncoder406(const Encoder406Setup &setup)
    : CanopenNode(setup.node, encoderRows(setup)), setup_(setup) {}

/// How far the disc has turned.
int64_t SimulatedEncoder406::steps() const noexcept {
  if (drive_ != nullptr) {
    const double place =
        static_cast<double>(drive_->mechanics().position()) + drive_->mechanics().fraction();
    return static_cast<int64_t>(stride::floor(place * setup_.stepsPerIncrement + 0.5));
  }
  const double seconds = static_cast<double>(nowNs()) / 1e9;
  return static_cast<int64_t>(stride::floor(setup_.velocity * seconds));
}

/// In measuring units and within the range, without the preset.
uint32_t SimulatedEncoder406::scaled() const noexcept {
  const uint64_t mode = objects().value(kOperating);
  int64_t value = steps();
  if ((mode & kReversed) != 0)
    value = -value;
  auto range = static_cast<int64_t>(uint64_t{setup_.perTurn} * setup_.turns);
  if ((mode & kScaled) != 0) {
    const auto units = static_cast<double>(objects().value(kPerRevolution));
    value =
        static_cast<int64_t>(stride::floor(static_cast<double>(value) * units / setup_.perTurn));
    range = static_cast<int64_t>(objects().value(kRange));
  }
  range = std::max<int64_t>(range, 1);
  const int64_t inside = value % range;
  return static_cast<uint32_t>(inside < 0 ? inside + range : inside);
}

void SimulatedEncoder406::show() noexcept {
  const uint64_t mode = objects().value(kOperating);
  uint64_t range = uint64_t{setup_.perTurn} * setup_.turns;
  if ((mode & kScaled) != 0)
    range = objects().value(kRange);
  objects().at(kPosition).value = (uint64_t{scaled()} + shift_) % std::max<uint64_t>(range, 1);
  const double speed = drive_ != nullptr ? drive_->mechanics().velocity() * setup_.stepsPerIncrement
                                         : setup_.velocity;
  const double limited = std::clamp((mode & kReversed) != 0 ? -speed : speed, -32767.0, 32767.0);
  objects().at(kSpeed, 1).value = static_cast<uint64_t>(static_cast<int64_t>(limited));
}

void SimulatedEncoder406::onReset() noexcept {
  shift_ = 0;
  lookNs_ = nowNs();
  show();
}

Abort SimulatedEncoder406::onWrite(const Entry &entry, uint64_t value) noexcept {
  if (entry.row.index != kPreset)
    return Abort::None;
  const bool scales = (objects().value(kOperating) & kScaled) != 0;
  const uint64_t range = scales ? objects().value(kRange) : uint64_t{setup_.perTurn} * setup_.turns;
  return value < range ? Abort::None : Abort::ValueHigh;
}

/// A preset is what the position is now.
void SimulatedEncoder406::onWritten(Entry &entry) noexcept {
  if (entry.row.index == kPreset) {
    const bool scales = (objects().value(kOperating) & kScaled) != 0;
    const uint64_t range =
        scales ? objects().value(kRange) : uint64_t{setup_.perTurn} * setup_.turns;
    shift_ = static_cast<uint32_t>((entry.value + range - scaled() % range) % range);
  } else if (entry.row.index == kOperating || entry.row.index == kPerRevolution ||
             entry.row.index == kRange) {
    shift_ = 0;
  } else if (entry.row.index == kCyclicTimer) {
    objects().at(0x1800, 5).value = entry.value; // both are the timer of the first PDO
  }
  show();
}

void SimulatedEncoder406::onRead(Entry & /*entry*/) noexcept { show(); }

void SimulatedEncoder406::onTime() noexcept {
  constexpr int64_t kLook = 1'000'000;
  lookNs_ = nowNs() + kLook;
  show();
}

} // namespace stride::can::simulation
