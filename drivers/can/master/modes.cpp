#include "drivers/can/master/modes.hpp"

#include <algorithm>
#include <array>

namespace stride::can {
namespace {

/// A controller mode, and the modes for it in the order in which they are taken.
struct ModeRow {
  uint8_t controllerMode;
  int8_t cyclic;
  int8_t other;
};
constexpr std::array<ModeRow, 3> kModeRows = {{
    {1, mode::kCyclicTorque, mode::kProfileTorque},
    {2, mode::kCyclicVelocity, mode::kProfileVelocity},
    {3, mode::kCyclicPosition, mode::kInterpolatedPosition},
}};

} // namespace

bool isSupported(int8_t mode, uint32_t supported) {
  return mode > 0 && mode <= 32 && (supported >> (mode - 1) & 1U) != 0;
}

int8_t modeFor(uint8_t controllerMode, uint32_t supported) {
  for (const ModeRow &row : kModeRows) {
    if (row.controllerMode != controllerMode)
      continue;
    if (isSupported(row.cyclic, supported))
      return row.cyclic;
    return isSupported(row.other, supported) ? row.other : mode::kNone;
  }
  return mode::kNone;
}

uint8_t controllerModeOf(int8_t mode) {
  for (const ModeRow &row : kModeRows)
    if (mode == row.cyclic || mode == row.other)
      return row.controllerMode;
  return 0;
}

void ModeControl::begin(int8_t mode) {
  current_ = wanted_ = written_ = mode;
  waited_ = 0;
}

void ModeControl::seen(int8_t display) {
  if (inPdos_)
    current_ = display;
}

void ModeControl::want(int8_t mode) {
  if (mode != wanted_) {
    wanted_ = mode;
    waited_ = 0;
  }
  waited_ = current_ == wanted_ ? 0 : std::min(waited_ + 1, timeout_);
}

ObjectWish ModeControl::wish() const {
  if (inPdos_)
    return {};
  if (written_ != wanted_)
    return {ObjectWish::Kind::Write, object::kMode, 1, static_cast<uint8_t>(wanted_)};
  if (current_ != wanted_)
    return {ObjectWish::Kind::Read, object::kModeDisplay};
  return {};
}

void ModeControl::answered(const ObjectWish &wish, const ObjectAnswer &answer) {
  if (!answer.done) // it is asked again until it is too late
    return;
  if (wish.kind == ObjectWish::Kind::Write)
    written_ = static_cast<int8_t>(wish.value);
  else
    current_ = static_cast<int8_t>(answer.value);
}

} // namespace stride::can
