#include "drivers/sercos/master/power.hpp"

namespace stride::sercos {
namespace {

/// Cycles after which what a drive says knows what it was told: there and back, and one of its own.
constexpr uint32_t kSettles = 4;

} // namespace

void PowerControl::seen(uint16_t statusWord) {
  const bool had = torque();
  ready_ = readyOf(statusWord);
  if (had && !torque() && (control_ & control::kOn) != 0)
    left_ = kSettles;
  present_ = (statusWord & status::kClass1) != 0;
  follows_ = (statusWord & status::kFollows) != 0;
  fault_ = fault_ || present_;
}

void PowerControl::demand(PowerTarget target, bool acknowledge) {
  if (!acknowledge)
    tried_ = false;
  if (fault_ && !present_ && (acknowledge || acknowledged_))
    fault_ = reset_ = false;
  if (fault_ && acknowledge && !tried_)
    reset_ = tried_ = acknowledged_ = true;
  acknowledged_ = acknowledged_ && fault_;
  stuck_ = stuck_ && !acknowledge;
  // Who has lost its torque by itself, or has only said so, is told to lose it: set values are
  // where it was when it said that, and would lead it back.
  if (fault_ || stuck_ || left_ > 0)
    target = PowerTarget::Off;
  if (left_ > 0)
    left_ = torque() ? kSettles : left_ - 1;
  const bool wantsTorque = target != PowerTarget::Off;
  // Main power first: what is told before that the drive would not take.
  const bool able = ready_ == Ready::Power || ready_ == Ready::Operational;
  control_ = wantsTorque && able ? control::kOn | control::kEnable : 0U;
  if (control_ != 0 && target == PowerTarget::Follow)
    control_ = control::kFollow;
  started_ = torque() && target == PowerTarget::Follow && (started_ || follows_);
  if (wantsTorque == torque() && (target != PowerTarget::Follow || started_)) {
    waited_ = 0;
  } else if (++waited_ >= timeout_ && !fault_) {
    waited_ = 0;
    stuck_ = true;
  }
}

} // namespace stride::sercos
