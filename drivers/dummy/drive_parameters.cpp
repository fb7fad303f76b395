#include "drivers/dummy/drive_parameters.hpp"

#include "runtime/bus/axis_driver.hpp"
#include "runtime/iec/math.h"

#include <algorithm>
#include <string>

namespace stride::dummy {
namespace {

// Controllers of the second-order model, unless configured.
constexpr double kPositionGain = 50.0;     // 1/s
constexpr double kVelocityBandwidth = 500; // 1/s: velocity_gain = inertia * this
constexpr double kIntegralTime = 0.02;     // s
constexpr double kSubstep = 50e-6;         // s

constexpr double kHomingVelocity = 10; // u/s, unless configured

/// What a drive takes and gives in every cycle.
struct CyclicMasks {
  uint8_t sent = 0;
  uint8_t received = 0;
};

CyclicMasks cyclicMasks(const bus::SetupParameters &parameters) {
  using bus::kCurrent;
  using bus::kPosition;
  using bus::kTorque;
  using bus::kVelocity;
  const auto mask = [](int number) -> uint8_t {
    switch (number) {
    case 1100:
    case 1101:
      return kPosition;
    case 1110:
    case 1111:
      return kVelocity;
    case 1160:
    case 1161:
      return kTorque;
    case 1150:
    case 1151:
      return kCurrent;
    default:
      return 0;
    }
  };
  switch (static_cast<int>(parameters.number("wControlType", 5))) {
  case 0: {
    CyclicMasks masks;
    for (const char place : {'1', '2', '3'}) {
      const auto number = [&](const char *direction) {
        return static_cast<int>(parameters.number(std::string(direction) + place, 0));
      };
      masks.sent |= mask(number("wCyclicDataS"));
      masks.received |= mask(number("wCyclicDataR"));
    }
    return masks;
  }
  case 1:
    return {kTorque, 0};
  case 2:
    return {kVelocity, kVelocity};
  case 3:
    return {kVelocity, kPosition};
  case 4:
    return {kPosition, kPosition};
  case 6:
    return {kVelocity, 0};
  default:
    return {kPosition | kVelocity, kPosition | kVelocity};
  }
}

int64_t wholeIncrements(double increments) {
  return static_cast<int64_t>(stride::floor(increments + 0.5));
}

} // namespace

bool Marks::passed(double from, double to, double &mark) const {
  if (!any || from == to)
    return false;
  if (distance <= 0) {
    mark = position;
    return (from >= position) != (to >= position);
  }
  // Number of the last mark at or before a position.
  const double before = stride::floor((from - position) / distance);
  const double after = stride::floor((to - position) / distance);
  if (before == after)
    return false;
  mark = position + (after > before ? before + 1 : before) * distance;
  return true;
}

bool SwitchRange::actuated(double place, double period) const {
  if (!any)
    return false;
  if (period <= 0)
    return place >= from && place <= to;
  const auto inTurn = [period](double x) { return x - stride::floor(x / period) * period; };
  return inTurn(place - from) <= inTurn(to - from);
}

DriveParameters driveParameters(const bus::SetupParameters &given, double cycle) {
  DriveParameters result;
  const double increments = given.number("dwRatioTechUnitsDenom", 1);
  const double units = given.number("iRatioTechUnitsNum", 1);
  const double perUnit = increments / units;
  result.unitsPerIncrement = units / increments;
  const bool rotary = given.number("iMovementType", 1) == 0;
  if (rotary)
    result.period = given.number("fPositionPeriod", 0) * perUnit;

  const auto number = [&](const char *name, double otherwise) {
    return given.number(std::string("physics.") + name, otherwise);
  };
  const auto has = [&](const char *name) {
    return given.find(std::string("physics.") + name) != nullptr;
  };

  MechanicsParameters &m = result.mechanics;
  m.model = static_cast<Model>(static_cast<uint8_t>(number("model", 0)));
  m.cycle = cycle;
  m.timeConstant = number("time_constant", 0);
  const double inertia = number("inertia", 1);
  m.inertia = inertia * result.unitsPerIncrement;
  m.viscousFriction = number("viscous_friction", 0) * result.unitsPerIncrement;
  m.coulombFriction = number("coulomb_friction", 0);
  m.torqueLimit = number("torque_limit", 0);
  m.positionGain = number("position_gain", kPositionGain);
  m.velocityGain = number("velocity_gain", inertia * kVelocityBandwidth) * result.unitsPerIncrement;
  m.integralTime = number("velocity_integral_time", kIntegralTime);
  m.velocityFeedforward = number("velocity_feedforward", 0);
  m.substeps = static_cast<uint32_t>(
      number("substeps", std::clamp(stride::ceil(cycle / kSubstep), 1.0, 1000.0)));

  result.startPosition = wholeIncrements(number("start_position", 0) * perUnit);
  result.startUpCycles = static_cast<uint32_t>(number("start_up_cycles", result.startUpCycles));
  result.switchCycles = static_cast<uint32_t>(number("switch_cycles", result.switchCycles));
  result.deadTime = static_cast<uint32_t>(number("dead_time", 0));

  result.parameterCycles =
      static_cast<uint32_t>(number("parameter_cycles", result.parameterCycles));

  const double fast = number("homing_velocity", kHomingVelocity);
  result.homing.positive = number("homing_direction", -1) > 0;
  result.homing.fast = fast * perUnit;
  result.homing.slow = number("homing_velocity_slow", fast / 10.0) * perUnit;
  result.homing.acceleration = number("homing_acceleration", fast * 10.0) * perUnit;

  result.hasLimitPositive = !rotary && has("limit_positive");
  result.hasLimitNegative = !rotary && has("limit_negative");
  result.limitPositive = number("limit_positive", 0) * perUnit;
  result.limitNegative = number("limit_negative", 0) * perUnit;
  result.home = {has("home_switch_from"), number("home_switch_from", 0) * perUnit,
                 number("home_switch_to", 0) * perUnit};
  const double turn = result.period * result.unitsPerIncrement;
  result.index = {has("index_position"), number("index_position", 0) * perUnit,
                  number("index_distance", turn) * perUnit};
  result.probe = {has("probe_position"), number("probe_position", 0) * perUnit,
                  number("probe_distance", turn) * perUnit};

  const CyclicMasks masks = cyclicMasks(given);
  result.modes = 0;
  if ((masks.sent & bus::kPosition) != 0)
    result.modes |= 1U << kPositionMode;
  if ((masks.sent & bus::kVelocity) != 0)
    result.modes |= 1U << kVelocityMode;
  if ((masks.sent & bus::kTorque) != 0 && m.model == Model::SecondOrder)
    result.modes |= 1U << kTorqueMode;
  // Torque and current cost nothing on this bus, so they always come.
  result.received = static_cast<uint8_t>(masks.received | bus::kTorque | bus::kCurrent);
  return result;
}

} // namespace stride::dummy
