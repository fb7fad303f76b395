// What the controllers of a simulated drive do in a cycle.
#include "drivers/sercos/simulation/simulated_drive.hpp"

#include "drivers/dummy/signals.hpp"
#include "runtime/iec/math.h"

#include <algorithm>
#include <limits>

namespace stride::sercos::simulation {
namespace {

using dummy::rounded;
using dummy::towards;

using namespace idns;

// Bits of S-0-0147. [IEC 61491; public manuals of drives]
constexpr int64_t kNegative = 0x0001;
constexpr int64_t kNoSwitch = 0x0020;
constexpr int64_t kNoMark = 0x0040;
// Bits of S-0-0055, S-0-0043 and S-0-0085: of the command value; that of the feedback is 0x04.
constexpr int64_t kInvertCommand = 0x0001;

double signOf(const IdnList &list, Idn polarity) {
  return (list.value(polarity) & kInvertCommand) != 0 ? -1 : 1;
}

} // namespace

double SimulatedDrive::exactPosition() const {
  return static_cast<double>(mechanics_.position()) + mechanics_.fraction();
}

/// The set position minus the actual one. [inc]
double SimulatedDrive::lag() const {
  if (!hasTorque() || !positions())
    return 0;
  return static_cast<double>(demanded_ - mechanics_.position()) - mechanics_.fraction();
}

int64_t SimulatedDrive::ringPosition(double increments) const {
  return scaling_.toRing(increments) + origin_;
}

/// Set values are where the axis is.
void SimulatedDrive::rest() noexcept {
  demanded_ = target_ = mechanics_.position();
  demandRest_ = 0;
  velocityDemanded_ = 0;
  way_ = 0;
  cyclesLeft_ = 0;
  commanded_ = scaling_.toRing(demanded_) + origin_;
}

/// The cycle that is over, with what was valid in it.
void SimulatedDrive::move(double seconds) noexcept {
  const auto percent = std::min({list().value(kTorqueLimit), list().value(kTorqueLimitPositive),
                                 -list().value(kTorqueLimitNegative)});
  const double limit =
      std::min(parameters_.mechanics.torqueLimit,
               static_cast<double>(std::max<int64_t>(percent, 0)) * kTorqueUnit * ratedTorque_);
  const bool lagless = (static_cast<unsigned>(operation()) & 8U) != 0;
  if (cycle_ != seconds || torqueLimit_ != limit || lagless_ != lagless) {
    dummy::MechanicsParameters now = parameters_.mechanics;
    now.cycle = cycle_ = seconds;
    now.torqueLimit = torqueLimit_ = limit;
    if (lagless)
      now.velocityFeedforward = 1;
    lagless_ = lagless;
    mechanics_.configure(now);
  }
  const double before = exactPosition();
  regulate(seconds);
  const double now = exactPosition();
  updateSwitches();
  lookForHome(before, now);
  passMarks(before, now);
  watchPosition();
  if (power_ == Power::Stopping && velocityDemanded_ == 0)
    switchOff();
}

void SimulatedDrive::regulate(double seconds) noexcept {
  if (!hasTorque()) {
    mechanics_.hold();
    rest();
    return;
  }
  const dummy::Demand demand = demandFor(seconds);
  mechanics_.regulate(demand, sim_ != nullptr ? sim_->fLoadTorque : 0.0);
  if (demand.mode != dummy::kPositionMode) {
    demanded_ = target_ = mechanics_.position();
    demandRest_ = 0;
    commanded_ = scaling_.toRing(demanded_) + origin_;
  }
}

dummy::Demand SimulatedDrive::demandFor(double seconds) noexcept {
  if (homing_ != Homing::Idle)
    return home();
  if (!follows_)
    return brake(seconds);
  switch (operation()) {
  case OperationMode::Torque: {
    dummy::Demand demand;
    demand.mode = dummy::kTorqueMode;
    demand.torque = torque_;
    velocityDemanded_ = mechanics_.velocity();
    return demand;
  }
  case OperationMode::Velocity:
    return followVelocity();
  default:
    return followPosition(seconds);
  }
}

/// On the line to where the set position shall be.
dummy::Demand SimulatedDrive::followPosition(double seconds) noexcept {
  dummy::Demand demand;
  demand.mode = dummy::kPositionMode;
  demand.from = demanded_;
  demand.velocityFrom = velocityDemanded_;
  demand.to = cyclesLeft_ > 1 ? demanded_ + (target_ - demanded_) / cyclesLeft_ : target_;
  cyclesLeft_ = std::max<int64_t>(cyclesLeft_ - 1, 0);
  way_ = demand.to - demand.from;
  demand.velocity = static_cast<double>(demand.to - demand.from) / seconds;
  demanded_ = demand.to;
  velocityDemanded_ = demand.velocity;
  return demand;
}

dummy::Demand SimulatedDrive::followVelocity() noexcept {
  dummy::Demand demand;
  demand.mode = dummy::kVelocityMode;
  demand.velocityFrom = velocityDemanded_;
  velocityDemanded_ = demand.velocity = velocity_;
  return demand;
}

/// With S-0-0138 until it stands; there it stays.
dummy::Demand SimulatedDrive::brake(double seconds) noexcept {
  const double ramp = static_cast<double>(list().value(kAcceleration)) * scaling_.acceleration();
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
  demand.to = demanded_ = target_ = demand.from + way;
  commanded_ = scaling_.toRing(demanded_) + origin_;
  return demand;
}

/// The command values for the cycle that begins.
void SimulatedDrive::latch() noexcept {
  velocity_ = torque_ = 0;
  follows_ = phase() == Phase::Four && mayFollow();
  if (!follows_)
    return;
  const IdnList &data = list();
  switch (operation()) {
  case OperationMode::Torque: {
    const int64_t sum = data.value(kTorqueCommand) + data.value(kAdditiveTorque);
    torque_ = static_cast<double>(sum) * kTorqueUnit * ratedTorque_ * signOf(data, kTorquePolarity);
    return;
  }
  case OperationMode::Velocity: {
    const int64_t most = std::max<int64_t>(data.value(kVelocityLimit), 0);
    const int64_t highest = std::min(most, data.value(kVelocityLimitPositive));
    const int64_t lowest = std::max(-most, data.value(kVelocityLimitNegative));
    const int64_t sum = data.value(kVelocityCommand) + data.value(kAdditiveVelocity);
    const int64_t limited = std::max(lowest, std::min(highest, sum));
    velocity_ =
        static_cast<double>(limited) * scaling_.velocity() * signOf(data, kVelocityPolarity);
    return;
  }
  default:
    break;
  }
  const int64_t cycle = std::max<int64_t>(data.value(kCommunicationCycle), 1);
  const int64_t cycles = std::max<int64_t>(data.value(kControlUnitCycle) / cycle, 1);
  const bool sync = (controlWord() & control::kIpoSync) != 0;
  if (cycles > 1 && sync == ipoSync_ && cyclesLeft_ > 0)
    return; // on the way to the last one
  ipoSync_ = sync;
  cyclesLeft_ = cycles;
  if (!hadMdt() && cycles == 1) {
    target_ = demanded_ + way_;
    commanded_ = scaling_.toRing(target_) + origin_;
    return;
  }
  const bool inverted = (data.value(kPositionPolarity) & kInvertCommand) != 0;
  const int64_t wanted = inverted ? -data.value(kPositionCommand) : data.value(kPositionCommand);
  commanded_ += scaling_.way(commanded_, wanted);
  target_ = scaling_.toIncrements(commanded_ - origin_);
}

// ---- homing

uint16_t SimulatedDrive::startHoming() noexcept {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  if (power_ != Power::On || velocityDemanded_ != 0)
    return data_state::kFailed;
  const int64_t how = list().value(kHomingParameter);
  needsSwitch_ = (how & kNoSwitch) == 0;
  needsMark_ = (how & kNoMark) == 0;
  list().at(kPositionFeedbackStatus).value = 0;
  if (!needsSwitch_ && !needsMark_) { // here
    setReference(exactPosition());
    return data_state::kDone;
  }
  const double fast = static_cast<double>(list().value(kHomingVelocity)) * scaling_.velocity();
  const double share = parameters_.homing.fast > 0 && parameters_.homing.slow > 0
                           ? parameters_.homing.slow / parameters_.homing.fast
                           : 0.1;
  const bool negative = (how & kNegative) != 0;
  dummy::DriveParameters &p = homingParameters_;
  p = parameters_;
  p.mechanics.cycle = cycle_;
  // Without a switch to be found it goes as if it left one, against the direction of the search.
  p.homing = {negative != needsSwitch_, fast, fast * share,
              static_cast<double>(list().value(kHomingAcceleration)) * scaling_.acceleration()};
  if (!needsSwitch_)
    p.home = {false, -kFar, kFar};
  run_.begin(p, demanded_, needsSwitch_ ? homeSwitch_ : true);
  homing_ = Homing::Running;
  return data_state::kRunning;
}

dummy::Demand SimulatedDrive::home() noexcept {
  if (sim_ != nullptr && sim_->bFailHoming != 0 && run_.state() != bus::Homing::Failed)
    run_.fail();
  const dummy::Demand demand = run_.next();
  demanded_ = target_ = demand.to;
  velocityDemanded_ = demand.velocity;
  commanded_ = scaling_.toRing(demanded_) + origin_;
  if (run_.state() == bus::Homing::Failed && velocityDemanded_ == 0) {
    endCommand(kDriveHoming, homing_ == Homing::Found ? data_state::kDone : data_state::kFailed);
    homing_ = Homing::Idle;
    run_.clear();
  }
  return demand;
}

/// Whether the reference was between the two positions.
void SimulatedDrive::lookForHome(double before, double now) noexcept {
  if (homing_ != Homing::Running || run_.state() == bus::Homing::Failed)
    return;
  double reference = 0;
  bool found = false;
  if (needsSwitch_) {
    run_.look(before, now, homeSwitch_, limitPositive_, limitNegative_);
    found = run_.state() == bus::Homing::Found;
    reference = run_.reference();
    if (found && needsMark_) { // it goes on to the next index pulse
      needsSwitch_ = false;
      found = parameters_.index.passed(reference, now, reference);
    }
  } else {
    found = parameters_.index.passed(before, now, reference);
  }
  if (!found)
    return;
  setReference(reference);
  homing_ = Homing::Found;
  run_.fail(); // it brakes
}

/// There the position is S-0-0052.
void SimulatedDrive::setReference(double increments) noexcept {
  origin_ = list().value(kReferenceDistance1) - scaling_.toRing(increments);
  commanded_ = scaling_.toRing(demanded_) + origin_;
  list().at(kPositionFeedbackStatus).value = 1;
}

} // namespace stride::sercos::simulation
