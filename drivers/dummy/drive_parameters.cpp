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

namespace {

/// The rows of the table `physics`; lengths come in increments.
struct Physics {
  const bus::SetupParameters &given;
  double perUnit; ///< increments

  [[nodiscard]] bool has(const char *name) const {
    return given.given(std::string("physics.") + name);
  }
  [[nodiscard]] double number(const char *name) const {
    return given.number(std::string("physics.") + name);
  }
  [[nodiscard]] double length(const char *name) const { return number(name) * perUnit; }
  [[nodiscard]] uint32_t whole(const char *name) const {
    return static_cast<uint32_t>(number(name));
  }
};

MechanicsParameters mechanicsOf(const Physics &physics, double unitsPerIncrement) {
  MechanicsParameters m;
  m.model = static_cast<Model>(physics.whole("model"));
  m.cycle = physics.given.cycleSeconds();
  m.timeConstant = physics.number("time_constant");
  m.inertia = physics.number("inertia") * unitsPerIncrement;
  m.viscousFriction = physics.number("viscous_friction") * unitsPerIncrement;
  m.coulombFriction = physics.number("coulomb_friction");
  m.torqueLimit = physics.number("torque_limit");
  m.positionGain = physics.number("position_gain");
  m.velocityGain = physics.number("velocity_gain") * unitsPerIncrement;
  m.integralTime = physics.number("velocity_integral_time");
  m.velocityFeedforward = physics.number("velocity_feedforward");
  m.substeps = physics.whole("substeps");
  return m;
}

/// The controller modes that can be chosen with what the bus sends.
uint8_t modesOf(const CyclicMasks &masks, Model model) {
  uint8_t modes = 0;
  if ((masks.sent & bus::kPosition) != 0)
    modes |= 1U << kPositionMode;
  if ((masks.sent & bus::kVelocity) != 0)
    modes |= 1U << kVelocityMode;
  if ((masks.sent & bus::kTorque) != 0 && model == Model::SecondOrder)
    modes |= 1U << kTorqueMode;
  if (modes != 0)
    return modes;
  // A drive that is sent nothing else regulates that, although nothing moves the other models.
  if ((masks.sent & bus::kTorque) != 0)
    return 1U << kTorqueMode;
  return (masks.sent & bus::kCurrent) != 0 ? 1U << kCurrentMode : 0;
}

} // namespace

DriveParameters driveParameters(const bus::SetupParameters &given) {
  DriveParameters result;
  const double increments = given.number("dwRatioTechUnitsDenom");
  const double units = given.number("iRatioTechUnitsNum");
  const Physics physics{given, increments / units};
  result.unitsPerIncrement = units / increments;
  const bool rotary = given.number("iMovementType") == bus::plc::kRotary;
  if (rotary)
    result.period = given.number("fPositionPeriod") * physics.perUnit;
  result.mechanics = mechanicsOf(physics, result.unitsPerIncrement);

  result.startPosition = wholeIncrements(physics.length("start_position"));
  result.startUpCycles = physics.whole("start_up_cycles");
  result.switchCycles = physics.whole("switch_cycles");
  result.deadTime = physics.whole("dead_time");
  result.parameterCycles = physics.whole("parameter_cycles");

  result.homing = {physics.number("homing_direction") > 0, physics.length("homing_velocity"),
                   physics.length("homing_velocity_slow"), physics.length("homing_acceleration")};

  result.hasLimitPositive = !rotary && physics.has("limit_positive");
  result.hasLimitNegative = !rotary && physics.has("limit_negative");
  result.limitPositive = physics.length("limit_positive");
  result.limitNegative = physics.length("limit_negative");
  result.home = {physics.has("home_switch_from"), physics.length("home_switch_from"),
                 physics.length("home_switch_to")};
  result.index = {physics.has("index_position"), physics.length("index_position"),
                  physics.length("index_distance")};
  result.probe = {physics.has("probe_position"), physics.length("probe_position"),
                  physics.length("probe_distance")};

  result.probeInputs = static_cast<uint8_t>(physics.whole("probe_inputs"));
  result.quickStop = physics.length("quick_stop");

  const CyclicMasks masks = cyclicMasks(given);
  result.modes = modesOf(masks, result.mechanics.model);
  // Torque and current cost nothing on this bus, so they always come.
  result.received = static_cast<uint8_t>(masks.received | bus::kTorque | bus::kCurrent);
  return result;
}

} // namespace stride::dummy
