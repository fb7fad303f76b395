// What the controllers of a simulated drive do in one of their cycles.
#include "drivers/can/simulation/drive402.hpp"

#include "drivers/dummy/signals.hpp"
#include "runtime/iec/math.h"

#include <algorithm>
#include <limits>

namespace stride::can::simulation {
namespace {

using dummy::rounded;
using dummy::towards;

constexpr double kNanoseconds = 1e9;
constexpr double kPerMille = 1000;
constexpr int64_t kShortestPeriod = 50'000;        // ns
constexpr int64_t kLongestPeriod = 10'000'000'000; // ns

} // namespace

/// 60C2h.
int64_t DriveAxis::periodNs() const noexcept {
  int64_t period = static_cast<int64_t>(o_.interpolationTime.value) * 1'000'000'000;
  for (int64_t i = o_.interpolationExponent.asSigned(); i < 0; ++i)
    period /= 10;
  return std::clamp(period, kShortestPeriod, kLongestPeriod);
}

/// [inc/s²]
double DriveAxis::rampOf(const Entry &entry) const {
  return static_cast<double>(entry.value) * velocityScale_;
}

uint32_t DriveAxis::counter(int64_t increments) const {
  return static_cast<uint32_t>(increments + origin_);
}

double DriveAxis::exactPosition() const {
  return static_cast<double>(mechanics_.position()) + mechanics_.fraction();
}

/// The set position minus the actual one. [inc]
double DriveAxis::lag() const {
  if (!regulates() || !positions())
    return 0;
  return static_cast<double>(demanded_ - mechanics_.position()) - mechanics_.fraction();
}

/// The mechanics go on to `timeNs`. About a period is a whole one: the controllers are in step with
/// SYNC, however it trembles.
void DriveAxis::move(int64_t timeNs) noexcept {
  const int64_t elapsed = timeNs - cycleNs_;
  if (elapsed <= 0)
    return;
  const int64_t period = periodNs();
  const bool whole = elapsed > period - period / 4 && elapsed < period + period / 4;
  const int64_t span = whole ? period : elapsed;
  const double seconds = static_cast<double>(span) / kNanoseconds;
  cycleNs_ = timeNs;
  passedNs_ = std::min(passedNs_ + span, period);
  if (cycle_ != seconds) {
    cycle_ = seconds;
    parameters_.mechanics.cycle = seconds;
    mechanics_.configure(parameters_.mechanics);
  }
  finishSwitching();
  const double before = exactPosition();
  regulate(seconds);
  const double now = exactPosition();
  updateSwitches();
  lookForHome(before, now);
  passMarks(before, now);
  watchFollowingError();
  finishStop();
}

void DriveAxis::regulate(double seconds) noexcept {
  const bool braked = (o_.outputs.value & o_.outputMask.value & 1U) != 0;
  const double load = sim_ != nullptr ? sim_->fLoadTorque : 0.0;
  if (!regulates() || braked) {
    mechanics_.hold();
    demanded_ = target_ = from_ = mechanics_.position();
    velocityDemanded_ = 0;
    return;
  }
  const dummy::Demand demand = demandFor(seconds);
  mechanics_.regulate(demand, load);
  if (demand.mode != dummy::kPositionMode) {
    demanded_ = target_ = from_ = mechanics_.position();
    demandRest_ = 0;
  }
}

dummy::Demand DriveAxis::demandFor(double seconds) noexcept {
  if (stopping_)
    return stop(seconds);
  switch (mode_) {
  case kSyncPosition:
  case kInterpolatedPosition:
    return followPosition(seconds);
  case kSyncVelocity:
  case kProfileVelocity:
    return followVelocity(seconds);
  case kSyncTorque:
  case kProfileTorque: {
    dummy::Demand demand;
    demand.mode = dummy::kTorqueMode;
    demand.torque = torqueDemanded_ = torqueFor(seconds);
    velocityDemanded_ = mechanics_.velocity();
    return demand;
  }
  case kHomingMode:
    return homing_ == HomingState::Idle ? stop(seconds) : home();
  default:
    return hold();
  }
}

dummy::Demand DriveAxis::hold() const {
  dummy::Demand demand;
  demand.mode = dummy::kPositionMode;
  demand.from = demand.to = demanded_;
  return demand;
}

/// On the line from where the set position was to where it shall be after a period.
dummy::Demand DriveAxis::followPosition(double seconds) noexcept {
  dummy::Demand demand;
  demand.mode = dummy::kPositionMode;
  demand.from = demanded_;
  demand.velocityFrom = velocityDemanded_;
  const int64_t period = periodNs();
  const double share = static_cast<double>(passedNs_) / static_cast<double>(period);
  demand.to =
      passedNs_ >= period ? target_ : from_ + rounded(static_cast<double>(target_ - from_) * share);
  demand.velocity = static_cast<double>(demand.to - demand.from) / seconds;
  demanded_ = demand.to;
  velocityDemanded_ = demand.velocity;
  return demand;
}

dummy::Demand DriveAxis::followVelocity(double seconds) noexcept {
  dummy::Demand demand;
  demand.mode = dummy::kVelocityMode;
  demand.velocityFrom = velocityDemanded_;
  if (mode_ == kSyncVelocity) {
    velocityDemanded_ = velocity_;
  } else {
    const bool faster = (velocity_ < 0 ? -velocity_ : velocity_) >
                        (velocityDemanded_ < 0 ? -velocityDemanded_ : velocityDemanded_);
    const double ramp = rampOf(faster ? o_.acceleration : o_.deceleration);
    velocityDemanded_ = towards(velocityDemanded_, velocity_, ramp * seconds);
  }
  demand.velocity = velocityDemanded_;
  return demand;
}

/// With the ramp of the stop, until it stands; there it stays.
dummy::Demand DriveAxis::stop(double seconds) noexcept {
  const double ramp = stopping_ ? deceleration_ : rampOf(o_.deceleration);
  dummy::Demand demand;
  demand.from = demanded_;
  demand.velocityFrom = velocityDemanded_;
  const double speed = velocityDemanded_ < 0 ? -velocityDemanded_ : velocityDemanded_;
  const double time = std::min(seconds, speed / ramp);
  velocityDemanded_ = towards(velocityDemanded_, 0, ramp * seconds);
  demand.velocity = velocityDemanded_;
  if (!positions()) {
    demand.mode = dummy::kVelocityMode;
    return demand;
  }
  demand.mode = dummy::kPositionMode;
  demandRest_ += 0.5 * (demand.velocityFrom + demand.velocity) * time;
  const int64_t way = rounded(demandRest_);
  demandRest_ -= static_cast<double>(way);
  demand.to = demanded_ = target_ = from_ = demand.from + way;
  return demand;
}

/// [Nm]
double DriveAxis::torqueFor(double seconds) noexcept {
  const double slope = static_cast<double>(o_.torqueSlope.value) / kPerMille * ratedTorque_;
  if (mode_ == kSyncTorque || slope == 0)
    return torque_;
  return towards(torqueDemanded_, torque_, slope * seconds);
}

/// 607Ah, or the set position of interpolated mode, as the mechanics have it.
int64_t DriveAxis::targetPosition() noexcept {
  int64_t wanted = mode_ == kInterpolatedPosition
                       ? o_.interpolationData.asSigned()
                       : o_.targetPosition.asSigned() + o_.positionOffset.asSigned();
  const int64_t lowest = o_.lowestPosition.asSigned();
  const int64_t highest = o_.highestPosition.asSigned();
  targetLimited_ = false;
  if (lowest < highest) {
    targetLimited_ = wanted < lowest || wanted > highest;
    wanted = std::clamp(wanted, lowest, highest);
  }
  return demanded_ + static_cast<int32_t>(static_cast<uint32_t>(wanted) - counter(demanded_));
}

/// 6060h is taken over: everything goes on from where it is.
void DriveAxis::changeMode() noexcept {
  const auto wanted = static_cast<int8_t>(o_.mode.asSigned());
  if (wanted == mode_ || wanted == 0)
    return;
  const bool before = positions();
  mode_ = wanted;
  homing_ = HomingState::Idle;
  run_.clear();
  lagSeconds_ = 0;
  demandRest_ = 0;
  torqueDemanded_ = mechanics_.torque();
  if (!before || !regulates())
    demanded_ = mechanics_.position();
}

/// The set values for the cycle that begins.
void DriveAxis::latch() noexcept {
  changeMode();
  from_ = target_ = demanded_;
  passedNs_ = 0;
  velocity_ = torque_ = 0;
  if (power_ != PowerState::OperationEnabled || (stopping_ && afterStop_ != PowerState::NotReady))
    return;
  const bool halts = (control_ & kHalt) != 0 &&
                     (mode_ == kProfileVelocity || mode_ == kProfileTorque || mode_ == kHomingMode);
  if (halts && !stopping_)
    brakeTo(PowerState::NotReady,
            o_.haltOption.value == 1 ? o_.deceleration : o_.quickDeceleration);
  else if (!halts)
    stopping_ = false;
  const bool interpolates = mode_ == kInterpolatedPosition && (control_ & kModeBit) != 0;
  if (mode_ == kSyncPosition || interpolates)
    target_ = targetPosition();
  const int64_t offset = mode_ == kSyncVelocity ? o_.velocityOffset.asSigned() : 0;
  velocity_ = static_cast<double>(o_.targetVelocity.asSigned() + offset) * velocityScale_;
  const int64_t extra = mode_ == kSyncTorque ? o_.torqueOffset.asSigned() : 0;
  const auto most = static_cast<int64_t>(o_.mostTorque.value);
  torque_ = static_cast<double>(std::clamp(o_.targetTorque.asSigned() + extra, -most, most)) /
            kPerMille * ratedTorque_;
  if (mode_ != kHomingMode)
    return;
  if ((control_ & kModeBit) == 0) {
    if (homing_ == HomingState::Running || homing_ == HomingState::Found)
      homing_ = HomingState::Idle; // it brakes
    run_.clear();
  } else if (homing_ == HomingState::Idle && velocityDemanded_ == 0 && !halts) {
    startHoming();
  }
}

bool DriveAxis::onReferenceSwitch() const {
  switch (o_.homingMethod.asSigned()) {
  case 17:
    return limitNegative_;
  case 18:
    return limitPositive_;
  case 33: // as if it had to leave a switch
  case 34:
    return true;
  default:
    return homeSwitch_;
  }
}

void DriveAxis::startHoming() noexcept {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const int64_t method = o_.homingMethod.asSigned();
  if (method == 0 || method == 35 || method == 37) { // here
    origin_ = o_.homeOffset.asSigned() - mechanics_.position();
    homing_ = HomingState::Attained;
    return;
  }
  dummy::DriveParameters &p = homingParameters_;
  p = parameters_;
  p.mechanics.cycle = static_cast<double>(periodNs()) / kNanoseconds;
  // Without a switch to be found it goes as if it left one, against the direction of the search.
  p.homing = {method == 18 || method == 19 || method == 33, rampOf(o_.homingFast),
              rampOf(o_.homingSlow), rampOf(o_.homingAcceleration)};
  if (method == 17)
    p.home = {p.hasLimitNegative, -kFar, p.limitNegative};
  if (method == 18)
    p.home = {p.hasLimitPositive, p.limitPositive, kFar};
  run_.begin(p, demanded_, onReferenceSwitch());
  homing_ = HomingState::Running;
}

dummy::Demand DriveAxis::home() noexcept {
  if (homing_ == HomingState::Attained)
    return hold();
  if (sim_ != nullptr && sim_->bFailHoming != 0 && homing_ == HomingState::Running) {
    homing_ = HomingState::Failed;
    run_.fail();
  }
  const dummy::Demand demand = run_.next();
  demanded_ = target_ = from_ = demand.to;
  velocityDemanded_ = demand.velocity;
  if (homing_ == HomingState::Found && velocityDemanded_ == 0)
    homing_ = HomingState::Attained;
  return demand;
}

/// Whether the reference was between the two positions: there the position counter is 607Ch.
void DriveAxis::lookForHome(double before, double now) noexcept {
  if (homing_ != HomingState::Running || stopping_)
    return;
  const int64_t method = o_.homingMethod.asSigned();
  double reference = 0;
  bool found = false;
  if (method == 33 || method == 34) {
    found = parameters_.index.passed(before, now, reference);
  } else {
    run_.look(before, now, onReferenceSwitch(), limitPositive_, limitNegative_);
    found = run_.state() == bus::Homing::Found;
    reference = run_.reference();
  }
  if (found) {
    origin_ = o_.homeOffset.asSigned() - rounded(reference);
    homing_ = HomingState::Found;
    run_.fail(); // it brakes
  } else if (run_.state() == bus::Homing::Failed) {
    homing_ = HomingState::Failed;
  }
}

} // namespace stride::can::simulation
