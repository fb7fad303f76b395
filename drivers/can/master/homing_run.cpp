#include "drivers/can/master/homing_run.hpp"

#include "drivers/can/master/power.hpp"

#include <algorithm>

namespace stride::can {
namespace {

/// Cycles until the drive's word can speak of this run: there and back, and one of its own.
constexpr uint32_t kDeadTime = 4;

} // namespace

void HomingRun::go(Step step) {
  step_ = step;
  cycles_ = 0;
}

void HomingRun::step(const Facts &facts) {
  if (!facts.wanted || step_ == Step::Cancelling || step_ == Step::Returning) {
    cancel(facts);
    return;
  }
  cycles_ = std::min(cycles_ + 1, timeout_);
  const bool late = cycles_ >= timeout_;
  switch (step_) {
  case Step::Idle:
    moved_ = false;
    go(facts.possible && facts.enabled ? Step::Entering : Step::Failed);
    break;
  case Step::Entering:
    if (facts.modeLate || !facts.enabled)
      go(Step::Failed);
    else if (facts.inMode)
      go(Step::Starting);
    break;
  case Step::Starting:
    if (!facts.enabled)
      go(Step::Failed);
    else if (cycles_ >= kDeadTime)
      go(Step::Running);
    break;
  case Step::Running:
    if (!facts.enabled)
      go(Step::Failed);
    else
      watch(facts.statusword);
    break;
  case Step::Braking:
    if (!facts.enabled || facts.rests || (facts.statusword & kTargetReached) != 0 || late)
      go(Step::Failed);
    break;
  case Step::Leaving:
    if (facts.inOther)
      go(Step::Found);
    else if (facts.modeLate || late)
      go(Step::Failed);
    break;
  default:
    break;
  }
}

/// Whoever moves by itself stops by itself: a set value would lead it back to where it was when it
/// said so.
void HomingRun::cancel(const Facts &facts) {
  const bool moves = start() && facts.enabled;
  cycles_ = std::min(cycles_ + 1, timeout_);
  const bool late = cycles_ >= timeout_;
  if (step_ == Step::Cancelling) {
    if (!facts.enabled)
      go(Step::Idle);
    else if ((facts.rests && cycles_ >= kDeadTime) || late)
      go(Step::Returning);
  } else if (step_ == Step::Returning) {
    if (!facts.enabled || facts.inOther || facts.modeLate || late)
      go(Step::Idle);
  } else {
    go(moves ? Step::Cancelling : Step::Idle);
  }
}

/// Bit 12: attained; 13: error; 10: at rest. 10 alone: interrupted, or not started yet. In another
/// mode a drive that still brakes would be led back to where it was when it said so.
void HomingRun::watch(uint16_t statusword) {
  const bool attained = (statusword & kHomingAttained) != 0;
  const bool atRest = (statusword & kTargetReached) != 0;
  const bool late = cycles_ >= timeout_;
  if ((statusword & kHomingError) != 0)
    go(atRest ? Step::Failed : Step::Braking);
  else if (attained && (atRest || late))
    go(Step::Leaving);
  else if (!attained && atRest && (moved_ || late))
    go(Step::Failed);
  else if (!attained && !atRest) {
    moved_ = true;
    cycles_ = 0; // it may look for its reference as long as it likes
  }
}

} // namespace stride::can
