#include "drivers/sercos/simulation/drive_scaling.hpp"

#include "runtime/iec/math.h"

namespace stride::sercos::simulation {
namespace {

using namespace idns;

constexpr double kPreferredTurn = 3'600'000; ///< 0.0001 degrees
constexpr double kPreferredMetre = 1e7;      ///< 0.1 µm
constexpr double kSecondsPerMinute = 60;
constexpr double kTurn = 6.283185307179586; ///< [rad]
constexpr double kPreferredAngle = 1e-3;    ///< [rad/s²]
constexpr double kPreferredWay = 1e-6;      ///< [m/s²]

int64_t nearest(double value) {
  constexpr double kMost = 9e15;
  if (!(value > -kMost))
    return -static_cast<int64_t>(kMost);
  return value < kMost ? static_cast<int64_t>(stride::floor(value + 0.5))
                       : static_cast<int64_t>(kMost);
}

double powerOfTen(int64_t exponent) {
  double power = 1;
  for (; exponent < 0; ++exponent)
    power /= 10;
  for (; exponent > 0; --exponent)
    power *= 10;
  return power;
}

} // namespace

void DriveScaling::configure(const IdnList &list) {
  const int64_t type = list.value(kPositionScaling);
  const bool parameters = (type & scaling::kParameter) != 0;
  const int64_t method = type & scaling::kMethod;
  position_ = 1;
  if (method == scaling::kRotational) {
    const double turn =
        parameters ? static_cast<double>(list.value(kRotationalResolution)) : kPreferredTurn;
    position_ = turn / perTurn_;
  } else if (method == scaling::kLinear) {
    const double unit =
        static_cast<double>(list.value(kLinearFactor)) * powerOfTen(list.value(kLinearExponent));
    position_ = (parameters ? 1 / unit : kPreferredMetre) / perMetre_;
  }
  modulo_ = (type & scaling::kModulo) != 0 ? list.value(kModulo) : 0;

  const int64_t speed = list.value(kVelocityScaling);
  const double minute = (speed & scaling::kSeconds) != 0 ? 1 : kSecondsPerMinute;
  const bool given = (speed & scaling::kParameter) != 0;
  const double unit =
      static_cast<double>(list.value(kVelocityFactor)) * powerOfTen(list.value(kVelocityExponent));
  const double preferred = (speed & scaling::kSeconds) != 0 ? 1e-6 : 1e-4; // of turns
  velocity_ = 1;
  if ((speed & scaling::kMethod) == scaling::kRotational)
    velocity_ = (given ? unit : preferred) / minute * perTurn_;
  else if ((speed & scaling::kMethod) == scaling::kLinear)
    velocity_ = (given ? unit : 1e-6) / minute * perMetre_;

  const int64_t ramp = list.value(kAccelerationScaling) & scaling::kMethod;
  acceleration_ = 1;
  if (ramp == scaling::kRotational)
    acceleration_ = kPreferredAngle / kTurn * perTurn_;
  else if (ramp == scaling::kLinear)
    acceleration_ = kPreferredWay * perMetre_;
}

int64_t DriveScaling::toRing(double increments) const { return nearest(increments * position_); }

int64_t DriveScaling::toRing(int64_t increments) const {
  return position_ == 1 ? increments : nearest(static_cast<double>(increments) * position_);
}

int64_t DriveScaling::toIncrements(int64_t units) const {
  return position_ == 1 ? units : nearest(static_cast<double>(units) / position_);
}

int64_t DriveScaling::wrapped(int64_t units) const {
  if (modulo_ <= 0)
    return static_cast<int32_t>(static_cast<uint64_t>(units));
  const int64_t rest = units % modulo_;
  return rest < 0 ? rest + modulo_ : rest;
}

int64_t DriveScaling::way(int64_t from, int64_t wrappedTo) const {
  const int64_t difference = wrappedTo - wrapped(from);
  if (modulo_ <= 0)
    return static_cast<int32_t>(static_cast<uint64_t>(difference));
  int64_t way = difference % modulo_;
  if (2 * way >= modulo_)
    way -= modulo_;
  else if (2 * way < -modulo_)
    way += modulo_;
  return way;
}

} // namespace stride::sercos::simulation
