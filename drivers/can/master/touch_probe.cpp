#include "drivers/can/master/touch_probe.hpp"

namespace stride::can {
namespace {

constexpr uint8_t kOn = 0x01;         ///< 60B8h and 60B9h.
constexpr unsigned kEdgesShift = 4;   ///< Of 60B8h.
constexpr unsigned kLatchedShift = 1; ///< Of 60B9h.
constexpr uint8_t kBoth = 0x03;

} // namespace

void TouchProbe::step(uint8_t wanted, uint8_t status) {
  const auto fresh = static_cast<uint8_t>(wanted & ~wanted_);
  wanted_ = wanted;
  captured_ = captured_ & wanted & static_cast<uint8_t>(~fresh);
  seen_ = seen_ & wanted & static_cast<uint8_t>(~fresh);
  if (wanted == 0) {
    step_ = Step::Off;
    return;
  }
  // What it has latched before must be forgotten first.
  if (fresh != 0)
    step_ = Step::Disarming;
  switch (step_) {
  case Step::Off:
    break;
  case Step::Disarming:
    if ((status & kOn) != 0 || fresh != 0)
      break;
    edges_ = wanted & static_cast<uint8_t>(~captured_);
    step_ = Step::Arming;
    break;
  case Step::Arming:
    if ((status & kOn) != 0)
      step_ = Step::Armed;
    break;
  case Step::Armed: {
    const auto latched = static_cast<uint8_t>(status >> kLatchedShift & kBoth);
    seen_ = seen_ | (latched & edges_ & wanted & static_cast<uint8_t>(~captured_));
    break;
  }
  }
}

uint8_t TouchProbe::function() const {
  if (step_ != Step::Arming && step_ != Step::Armed)
    return 0;
  return static_cast<uint8_t>(kOn | edges_ << kEdgesShift);
}

void TouchProbe::latched(size_t edge, uint32_t position) {
  const auto bit = static_cast<uint8_t>(1U << edge);
  if ((seen_ & bit) == 0)
    return;
  seen_ = seen_ & static_cast<uint8_t>(~bit);
  captured_ = captured_ | bit;
  positions_[edge] = position;
}

} // namespace stride::can
