#include "drivers/dummy/drive_parameters.hpp"

#include "runtime/bus/axis_driver.hpp"
#include "runtime/iec/math.h"

#include <string>

namespace stride::dummy {
namespace {

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
  switch (static_cast<int>(parameters.number("wControlType"))) {
  case 0: {
    CyclicMasks masks;
    for (const char place : {'1', '2', '3'}) {
      const auto number = [&](const char *direction) {
        return static_cast<int>(parameters.number(std::string(direction) + place));
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

DriveParameters driveParameters(const bus::SetupParameters &given) {
  DriveParameters result;
  const double increments = given.number("dwRatioTechUnitsDenom");
  const double units = given.number("iRatioTechUnitsNum");
  const double perUnit = increments / units;
  result.unitsPerIncrement = units / increments;
  const bool rotary = given.number("iMovementType") == bus::plc::kRotary;
  if (rotary)
    result.period = given.number("fPositionPeriod") * perUnit;

  const auto number = [&](const char *name) {
    return given.number(std::string("physics.") + name);
  };
  const auto length = [&](const char *name) { return number(name) * perUnit; };
  const auto whole = [&](const char *name) { return static_cast<uint32_t>(number(name)); };
  const auto has = [&](const char *name) { return given.given(std::string("physics.") + name); };

  MechanicsParameters &m = result.mechanics;
  m.model = static_cast<Model>(whole("model"));
  m.cycle = given.cycleSeconds();
  m.timeConstant = number("time_constant");
  m.inertia = number("inertia") * result.unitsPerIncrement;
  m.viscousFriction = number("viscous_friction") * result.unitsPerIncrement;
  m.coulombFriction = number("coulomb_friction");
  m.torqueLimit = number("torque_limit");
  m.positionGain = number("position_gain");
  m.velocityGain = number("velocity_gain") * result.unitsPerIncrement;
  m.integralTime = number("velocity_integral_time");
  m.velocityFeedforward = number("velocity_feedforward");
  m.substeps = whole("substeps");

  result.startPosition = wholeIncrements(length("start_position"));
  result.startUpCycles = whole("start_up_cycles");
  result.switchCycles = whole("switch_cycles");
  result.deadTime = whole("dead_time");
  result.parameterCycles = whole("parameter_cycles");

  result.homing = {number("homing_direction") > 0, length("homing_velocity"),
                   length("homing_velocity_slow"), length("homing_acceleration")};

  result.hasLimitPositive = !rotary && has("limit_positive");
  result.hasLimitNegative = !rotary && has("limit_negative");
  result.limitPositive = length("limit_positive");
  result.limitNegative = length("limit_negative");
  result.home = {has("home_switch_from"), length("home_switch_from"), length("home_switch_to")};
  result.index = {has("index_position"), length("index_position"), length("index_distance")};
  result.probe = {has("probe_position"), length("probe_position"), length("probe_distance")};

  result.probeInputs = static_cast<uint8_t>(whole("probe_inputs"));
  result.quickStop = length("quick_stop");

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
