// What goes into a simulated drive and out of it besides its motion: switches, probes, the values
// on the ring, and what programs see and disturb.
#include "drivers/sercos/simulation/simulated_drive.hpp"

#include "drivers/dummy/signals.hpp"
#include "runtime/iec/math.h"

#include <algorithm>
#include <limits>

namespace stride::sercos::simulation {
namespace {

using dummy::rising;
using dummy::rounded;
using dummy::rounded16;
using dummy::rounded32;

using namespace idns;

constexpr int64_t kInvertFeedback = 0x0004;  // of S-0-0043, S-0-0055, S-0-0085
constexpr int64_t kInvertFeedback2 = 0x0008; // of S-0-0055
constexpr int64_t kLimits = 0x0010;          // of S-0-0055: the position limits count
constexpr uint16_t kTargetOutside = 0x2000;  // of S-0-0012
// Of S-0-0013; S-0-0331, S-0-0334 and S-0-0336 say the same.
constexpr uint16_t kStandstill = 0x0002;
constexpr uint16_t kTorqueLimited = 0x0010;
constexpr uint16_t kInPositionBit = 0x0040;

constexpr std::array<Idn, 4> kValues = {kProbe1Positive, kProbe1Negative, kProbe2Positive,
                                        kProbe2Negative};
constexpr std::array<Idn, 4> kLatched = {kProbe1PositiveLatched, kProbe1NegativeLatched,
                                         kProbe2PositiveLatched, kProbe2NegativeLatched};
constexpr std::array<Idn, 2> kEnables = {kProbe1Enable, kProbe2Enable};

} // namespace

void SimulatedDrive::updateSwitches() noexcept {
  const dummy::DriveParameters &p = parameters_;
  const double place = exactPosition();
  limitPositive_ = (p.hasLimitPositive && place >= p.limitPositive) ||
                   (sim_ != nullptr && sim_->bForceLimitPositive != 0);
  limitNegative_ = (p.hasLimitNegative && place <= p.limitNegative) ||
                   (sim_ != nullptr && sim_->bForceLimitNegative != 0);
  homeSwitch_ =
      p.home.actuated(place, p.period) || (sim_ != nullptr && sim_->bForceHomeSwitch != 0);
}

/// The monitoring window, and the position limits of an axis that has its reference.
void SimulatedDrive::watchPosition() noexcept {
  const double error = lag();
  const int64_t window = list().value(kMonitoringWindow);
  const int64_t size = scaling_.toRing(error < 0 ? -error : error);
  if (window != 0 && homing_ == Homing::Idle && size > window)
    raiseError(class1::kPositionDeviation, 0, "excessive position deviation");
  const bool limited = (list().value(kPositionPolarity) & kLimits) != 0 &&
                       list().value(kPositionFeedbackStatus) != 0 && hasTorque();
  const int64_t highest = list().value(kPositionLimitPositive);
  const int64_t lowest = list().value(kPositionLimitNegative);
  const int64_t place = ringPosition(exactPosition());
  if (limited && (place > highest || place < lowest))
    raiseError(class1::kOvertravel, 0, "position limit exceeded");
  const bool outside = limited && positions() && (commanded_ > highest || commanded_ < lowest);
  setClass2(outside ? kTargetOutside : 0);
}

void SimulatedDrive::updateClasses() noexcept {
  const double error = lag();
  const bool inside = hasTorque() && positions() &&
                      scaling_.toRing(error < 0 ? -error : error) <= list().value(kPositionWindow);
  list().at(kInPosition).value = inside ? 1 : 0;
  setClass3(static_cast<uint16_t>((mechanics_.velocity() == 0 ? kStandstill : 0) |
                                  (mechanics_.saturated() ? kTorqueLimited : 0) |
                                  (inside ? kInPositionBit : 0)));
}

void SimulatedDrive::updateData() noexcept {
  IdnList &data = list();
  const int64_t polarity = data.value(kPositionPolarity);
  const double exact = exactPosition();
  const int64_t place = mechanics_.fraction() == 0
                            ? scaling_.toRing(mechanics_.position()) + origin_
                            : ringPosition(exact);
  data.at(kPositionFeedback1).value =
      scaling_.wrapped((polarity & kInvertFeedback) != 0 ? -place : place);
  data.at(kPositionFeedback2).value =
      scaling_.wrapped((polarity & kInvertFeedback2) != 0 ? -place : place);
  data.at(kFollowingDistance).value = rounded32(static_cast<double>(scaling_.toRing(lag())));
  const double speed = mechanics_.velocity() / scaling_.velocity();
  const double back = (data.value(kVelocityPolarity) & kInvertFeedback) != 0 ? -1 : 1;
  data.at(kVelocityFeedback).value = rounded32(speed * back);
  const double torque = mechanics_.torque() / ratedTorque_ / kTorqueUnit;
  const double turned = (data.value(kTorquePolarity) & kInvertFeedback) != 0 ? -1 : 1;
  data.at(kTorqueFeedback).value = rounded16(torque * turned);
  data.at(kHomeSwitch).value = homeSwitch_ ? 1 : 0;
  data.at(kSwitches).value =
      (limitNegative_ ? 1 : 0) | (limitPositive_ ? 2 : 0) | (homeSwitch_ ? 4 : 0);
  updateClasses();
  if (sim_ != nullptr)
    publish();
  index_ = false;
}

/// What programs have written into the structure that they share with the drive.
void SimulatedDrive::disturb() noexcept {
  if (sim_ == nullptr)
    return;
  DriveSim &sim = *sim_;
  setDisturbed(sim.bLoseCommunication != 0, sim.bHoldParameters != 0, sim.bFailStartUp != 0);
  persistent_ = sim.bErrorPersistent != 0;
  fail(sim.wDriveError);
  if (rising(sim.bMoveByHand, sim.bOldHand))
    place(rounded(sim.fHandPosition / parameters_.unitsPerIncrement, 1e15));
  if (rising(sim.bForceIndex, sim.bOldIndex)) {
    index_ = true;
    indexMark_ = exactPosition();
  }
  for (size_t i = 0; i < kValues.size(); ++i)
    if (rising(sim.abProbe.v[i], sim.abOldProbe.v[i]))
      probe(i);
}

/// What programs may read there.
void SimulatedDrive::publish() noexcept {
  DriveSim &sim = *sim_;
  const double units = parameters_.unitsPerIncrement;
  sim.fPosition = exactPosition() * units;
  sim.fVelocity = mechanics_.velocity() * units;
  sim.fLag = lag() * units;
  sim.fTorque = mechanics_.torque();
  sim.bSaturated = mechanics_.saturated();
  sim.bLimitPositive = limitPositive_;
  sim.bLimitNegative = limitNegative_;
  sim.bHomeSwitch = homeSwitch_;
  sim.bHoming = homing_ != Homing::Idle;
  sim.bIndex = index_;
  if (index_) {
    sim.fIndexPosition = indexMark_ * units;
    ++sim.udiIndexCount;
  }
}

void SimulatedDrive::passMarks(double before, double now) noexcept {
  double mark = 0;
  if (parameters_.index.passed(before, now, mark)) {
    index_ = true;
    indexMark_ = mark;
  }
  if (index_) {
    list().at(kIndexPosition).value = scaling_.wrapped(ringPosition(indexMark_));
    IdnEntry &count = list().at(kIndexCount);
    count.value = static_cast<uint16_t>(count.value + 1);
  }
  if (parameters_.probe.passed(before, now, mark))
    capture(0, mark);
}

void SimulatedDrive::probe(size_t input) noexcept {
  if (input < kValues.size())
    capture(input, exactPosition());
}

/// The next edge is taken again.
void SimulatedDrive::clearProbe(size_t probe) noexcept {
  for (size_t i = 2 * probe; i < 2 * probe + 2; ++i) {
    list().at(kLatched[i]).value = 0;
    list().at(kProbeStatus).value &= ~(int64_t{1} << i);
  }
}

/// An edge at an input: taken once, if S-0-0169 and S-0-0405 or S-0-0406 want it.
void SimulatedDrive::capture(size_t input, double increments) noexcept {
  const bool present = (parameters_.probeInputs >> input & 1U) != 0;
  const bool wanted = probing_ && (list().value(kProbeControl) >> input & 1) != 0 &&
                      list().value(kEnables[input / 2]) != 0;
  if (!present || !wanted || list().value(kLatched[input]) != 0)
    return;
  list().at(kLatched[input]).value = 1;
  list().at(kProbeStatus).value |= int64_t{1} << input;
  list().at(kValues[input]).value = scaling_.wrapped(ringPosition(increments));
}

} // namespace stride::sercos::simulation
