#include "drivers/dummy/reference_run.hpp"

#include "runtime/iec/math.h"

#include <algorithm>

namespace stride::dummy {

void ReferenceRun::begin(const DriveParameters &parameters, int64_t position, bool onSwitch) {
  p_ = parameters.homing;
  home_ = parameters.home;
  period_ = parameters.period;
  cycle_ = parameters.mechanics.cycle;
  state_ = bus::Homing::Running;
  leaving_ = onSwitch_ = onSwitch;
  whole_ = position;
  rest_ = 0;
  velocity_ = 0;
  way_ = 0;
}

double ReferenceRun::wantedVelocity() const {
  if (state_ == bus::Homing::Failed)
    return 0;
  const double velocity = leaving_ ? -p_.slow : p_.fast;
  return p_.positive ? velocity : -velocity;
}

Demand ReferenceRun::next() {
  Demand demand;
  demand.mode = kPositionMode;
  demand.from = whole_;
  demand.velocityFrom = velocity_;
  const double change = p_.acceleration * cycle_;
  velocity_ += std::clamp(wantedVelocity() - velocity_, -change, change);
  rest_ += 0.5 * (demand.velocityFrom + velocity_) * cycle_;
  const double turns = stride::floor(rest_ + 0.5);
  whole_ += static_cast<int64_t>(turns);
  rest_ -= turns;
  demand.to = whole_;
  demand.velocity = velocity_;
  return demand;
}

/// Where the switch opened on the way; without a place of its own (it was forced) at the end.
double ReferenceRun::edge(double before, double after) const {
  double place = p_.positive ? home_.from : home_.to;
  if (!home_.any)
    return after;
  if (period_ > 0)
    place += stride::floor((after - place) / period_ + 0.5) * period_;
  const bool between = place >= std::min(before, after) && place <= std::max(before, after);
  return between ? place : after;
}

void ReferenceRun::look(double before, double after, bool onSwitch, bool limitPositive,
                        bool limitNegative) {
  const bool was = onSwitch_;
  onSwitch_ = onSwitch;
  if (state_ != bus::Homing::Running)
    return;
  if (!leaving_) {
    way_ += after > before ? after - before : before - after;
    if (onSwitch)
      leaving_ = true;
    else if ((p_.positive ? limitPositive : limitNegative) || (period_ > 0 && way_ > 2 * period_))
      state_ = bus::Homing::Failed;
    return;
  }
  const bool backwards = p_.positive ? after < before : after > before;
  if (!was || onSwitch || !backwards)
    return;
  reference_ = edge(before, after);
  state_ = bus::Homing::Found;
}

} // namespace stride::dummy
