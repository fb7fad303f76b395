// What goes into a simulated drive and out of it besides its motion: switches, touch probes, the
// values on the bus, and what programs see and disturb.
#include "drivers/can/simulation/drive402.hpp"

#include "drivers/dummy/signals.hpp"
#include "runtime/iec/math.h"

#include <algorithm>

namespace stride::can::simulation {
namespace {

using dummy::rising;
using dummy::rounded;
using dummy::rounded16;
using dummy::rounded32;

constexpr double kMilliseconds = 1000;

void put(Entry &entry, int64_t value) {
  entry.value = Dictionary::fitted(entry.row.type, static_cast<uint64_t>(value));
}

// 60B8h and 60B9h of the first probe; those of the second one are eight bits higher.
constexpr unsigned kSecondProbe = 8;
constexpr uint16_t kEnable = 0x01;
constexpr uint16_t kContinuous = 0x02;
constexpr uint16_t kSource = 0x0C;
constexpr uint16_t kIndexPulse = 0x04;
constexpr uint16_t kRisingEdge = 0x10; ///< The falling one is the next bit.
constexpr uint16_t kRisingStored = 0x02;
constexpr uint16_t kProbeBits = 0x3F;

} // namespace

void DriveAxis::updateSwitches() noexcept {
  const dummy::DriveParameters &p = parameters_;
  const double place = exactPosition();
  limitPositive_ = (p.hasLimitPositive && place >= p.limitPositive) ||
                   (sim_ != nullptr && sim_->bForceLimitPositive != 0);
  limitNegative_ = (p.hasLimitNegative && place <= p.limitNegative) ||
                   (sim_ != nullptr && sim_->bForceLimitNegative != 0);
  homeSwitch_ =
      p.home.actuated(place, p.period) || (sim_ != nullptr && sim_->bForceHomeSwitch != 0);
}

void DriveAxis::watchFollowingError() noexcept {
  const double error = lag();
  const double size = error < 0 ? -error : error;
  const uint64_t window = o_.followingWindow.value;
  following_ = window != kNoWindow && size > static_cast<double>(window);
  lagSeconds_ = following_ ? lagSeconds_ + cycle_ : 0;
  if (following_ && lagSeconds_ * kMilliseconds > static_cast<double>(o_.followingTime.value))
    raiseError(0x8611);
}

/// Bits 10, 12 and 13 of the statusword.
uint16_t DriveAxis::modeBits() const noexcept {
  const bool works = power_ == PowerState::OperationEnabled && !stopping_;
  const bool rests = velocityDemanded_ == 0;
  uint16_t bits = stopping_ && rests ? kTargetReached : 0;
  switch (mode_) {
  case kSyncPosition:
    bits |= following_ ? kModeError : 0;
    bits |= works ? kModeStatus : 0;
    break;
  case kSyncVelocity:
  case kSyncTorque:
    bits |= works ? kModeStatus : 0;
    break;
  case kInterpolatedPosition:
    bits |= works && (control_ & kModeBit) != 0 ? kModeStatus : 0;
    break;
  case kProfileVelocity:
    bits |= works && velocityDemanded_ == velocity_ ? kTargetReached : 0;
    bits |= rests ? kModeStatus : 0;
    break;
  case kProfileTorque:
    bits |= works && torqueDemanded_ == torque_ ? kTargetReached : 0;
    break;
  case kHomingMode:
    bits |= homing_ == HomingState::Found || homing_ == HomingState::Attained ? kModeStatus : 0;
    bits |= homing_ == HomingState::Failed ? kModeError : 0;
    bits |= rests && homing_ != HomingState::Running && homing_ != HomingState::Found
                ? kTargetReached
                : 0;
    break;
  default:
    break;
  }
  return bits;
}

void DriveAxis::updateObjects() noexcept {
  const bool operational = node_.state() == NmtState::Operational;
  const bool limited = targetLimited_ || mechanics_.saturated();
  o_.statusword.value =
      static_cast<uint16_t>(statusOf(power_) | modeBits() | kVoltageEnabled |
                            (operational ? kRemote : 0) | (limited ? kInternalLimit : 0));
  put(o_.modeDisplay, mode_);
  o_.errorCode.value = fault_;
  put(o_.position, position());
  put(o_.positionInternal, position());
  put(o_.positionDemand, static_cast<int32_t>(counter(demanded_)));
  put(o_.velocity, rounded32(mechanics_.velocity() / velocityScale_));
  put(o_.velocityDemand, rounded32(velocityDemanded_ / velocityScale_));
  put(o_.torque, rounded16(mechanics_.torque() / ratedTorque_ * 1000));
  put(o_.torqueDemand, rounded16(torqueDemanded_ / ratedTorque_ * 1000));
  put(o_.current, o_.torque.asSigned());
  put(o_.followingError, rounded32(lag()));
  put(o_.secondPosition, rounded(exactPosition() * secondEncoder_, 9e15));
  o_.inputs.value =
      (limitNegative_ ? 1U : 0U) | (limitPositive_ ? 2U : 0U) | (homeSwitch_ ? 4U : 0U);
  if (sim_ != nullptr)
    publish();
}

/// What programs have written into the structure that they share with the drive.
void DriveAxis::disturb() noexcept {
  if (sim_ == nullptr)
    return;
  DriveSim &sim = *sim_;
  persistent_ = sim.bErrorPersistent != 0;
  raiseError(sim.wDriveError);
  if (rising(sim.bMoveByHand, sim.bOldHand))
    place(rounded(sim.fHandPosition / parameters_.unitsPerIncrement, 1e15));
  if (rising(sim.bForceIndex, sim.bOldIndex)) {
    index_ = true;
    indexMark_ = exactPosition();
    capture(0, true, indexMark_);
    capture(2, true, indexMark_);
  }
  for (size_t i = 0; i < bus::DriveStatus::kCaptureInputs; ++i)
    if (rising(sim.abProbe.v[i], sim.abOldProbe.v[i]))
      probe(i);
}

/// What programs may read there.
void DriveAxis::publish() noexcept {
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
  sim.bHoming = homing_ == HomingState::Running || homing_ == HomingState::Found;
  sim.bIndex = index_;
  if (index_) {
    sim.fIndexPosition = indexMark_ * units;
    ++sim.udiIndexCount;
  }
  index_ = false;
}

void DriveAxis::passMarks(double before, double now) noexcept {
  double mark = 0;
  if (parameters_.index.passed(before, now, mark)) {
    index_ = true;
    indexMark_ = mark;
    capture(0, true, mark);
    capture(2, true, mark);
  }
  if (parameters_.probe.passed(before, now, mark))
    capture(0, false, mark);
}

void DriveAxis::probe(size_t input) noexcept {
  if (input < o_.probePosition.size())
    capture(input, false, exactPosition());
}

/// Switched off: nothing is stored any more.
void DriveAxis::configureProbes(uint64_t before) noexcept {
  for (const unsigned shift : {0U, kSecondProbe}) {
    const auto was = static_cast<uint16_t>(before >> shift);
    const auto is = static_cast<uint16_t>(probes_ >> shift);
    uint64_t &status = o_.probeStatus.value;
    if ((is & kEnable) == 0)
      status &= ~(uint64_t{kProbeBits} << shift);
    else if ((was & kEnable) == 0)
      status = (status & ~(uint64_t{kProbeBits} << shift)) | uint64_t{kEnable} << shift;
  }
}

/// An edge at an input, or an index pulse, at which a probe may latch.
void DriveAxis::capture(size_t input, bool index, double increments) noexcept {
  const unsigned shift = input < 2 ? 0 : kSecondProbe;
  const auto edge = static_cast<unsigned>(input % 2);
  const auto function = static_cast<uint16_t>(probes_ >> shift);
  const bool present = index || (parameters_.probeInputs >> input & 1U) != 0;
  const bool wanted = (function & kEnable) != 0 && (function & kRisingEdge << edge) != 0 &&
                      ((function & kSource) == kIndexPulse) == index;
  const uint64_t stored = uint64_t{kRisingStored} << edge << shift;
  const bool again = (function & kContinuous) != 0;
  if (!present || !wanted || ((o_.probeStatus.value & stored) != 0 && !again))
    return;
  o_.probeStatus.value |= stored;
  const auto place = static_cast<int64_t>(stride::floor(increments + 0.5));
  put(*o_.probePosition[input], static_cast<int32_t>(counter(place)));
}

} // namespace stride::can::simulation
