// The parameters of simulated mechanics, `[….drive.physics]` and `[….encoder.physics]`. They belong
// to the mechanics and not to the interface type "Dummy": another driver that simulates its drives
// puts the same mechanics behind them, and takes these rows into its own schema.
#ifndef STRIDE_DRIVERS_DUMMY_PHYSICS_SCHEMA_HPP
#define STRIDE_DRIVERS_DUMMY_PHYSICS_SCHEMA_HPP

#include "runtime/common/parameter.hpp"

#include <array>
#include <cstdint>

namespace stride::dummy {

/// How the mechanics follow the set values: `model`.
enum class Model : uint8_t {
  Ideal = 0,       ///< At the end of each cycle exactly where they should be.
  Lag = 1,         ///< First-order lag.
  SecondOrder = 2, ///< Mass with friction, driven by a cascade of controllers with limited torque.
};

namespace physics {

using common::anyReal;
using common::choice;
using common::Choice;
using common::duration;
using common::Parameter;
using common::ParameterValues;
using common::positive;
using common::real;
using common::whole;

inline constexpr int64_t kLag = static_cast<int64_t>(Model::Lag);
inline constexpr int64_t kSecondOrder = static_cast<int64_t>(Model::SecondOrder);
inline constexpr std::array<Choice, 3> kModels = {
    {{"ideal", static_cast<int64_t>(Model::Ideal)}, {"lag", kLag}, {"second_order", kSecondOrder}}};
inline constexpr std::array<Choice, 2> kDirections = {{{"negative", -1}, {"positive", 1}}};

/// One turn of a rotary drive by its increments; 0: it is linear. [u]
constexpr double turn(const ParameterValues &values) {
  if (values.number("iMovementType") != 0)
    return 0;
  const double increments = values.number("dwRatioTechUnitsDenom");
  const double units = values.number("iRatioTechUnitsNum");
  return values.number("fPositionPeriod") * (increments / units) * (units / increments);
}

/// Of 50 µs at most.
constexpr double substeps(const ParameterValues &values) {
  constexpr double kLongest = 50e-6; // s
  constexpr double kMost = 1000;
  const double exact = values.cycleSeconds() / kLongest;
  if (!(exact > 1))
    return 1;
  if (exact >= kMost)
    return kMost;
  const auto below = static_cast<double>(static_cast<int64_t>(exact));
  return below < exact ? below + 1 : below;
}

constexpr Parameter ofSecondOrder(const Parameter &parameter) {
  return parameter.onlyWith("model", kSecondOrder);
}

inline constexpr std::array kDrive = {
    choice("model", kModels).defaultsTo(0).says("how the axis follows its set values"),
    duration("time_constant")
        .neededWith("model", kLag, "\"T#5ms\"")
        .says("time constant of the first-order lag"),
    positive("inertia", "Nm/(u/s²)")
        .neededWith("model", kSecondOrder, "0.01")
        .says("torque that accelerates the axis by 1 u/s²"),
    positive("torque_limit", "Nm")
        .neededWith("model", kSecondOrder, "10.0")
        .says("the largest torque of the motor"),
    ofSecondOrder(common::notNegative("viscous_friction", "Nm/(u/s)"))
        .defaultsTo(0)
        .says("friction that grows with the velocity"),
    ofSecondOrder(common::notNegative("coulomb_friction", "Nm"))
        .defaultsTo(0)
        .says("dry friction, at rest as in motion"),
    ofSecondOrder(positive("position_gain", "1/s"))
        .defaultsTo(50)
        .says("velocity per position error"),
    ofSecondOrder(positive("velocity_gain", "Nm/(u/s)"))
        .defaultsTo([](const ParameterValues &v) { return v.number("physics.inertia") * 500; },
                    "500 1/s times `inertia`")
        .says("torque per velocity error"),
    ofSecondOrder(duration("velocity_integral_time"))
        .defaultsTo(0.02)
        .says("integral part of the velocity controller"),
    ofSecondOrder(real("velocity_feedforward", 0, 1))
        .defaultsTo(0)
        .says("share of the set velocity that bypasses the position controller"),
    ofSecondOrder(whole("substeps", 1, 1000))
        .defaultsTo(substeps, "of 50 µs at most")
        .says("steps of the controllers per cycle"),
    whole("dead_time", 0, 64, "cycles")
        .defaultsTo(0)
        .says("set values reach the drive this much later"),
    whole("start_up_cycles", 1, 100000, "cycles")
        .defaultsTo(3)
        .says("until the drive has started up"),
    whole("switch_cycles", 1, 100000, "cycles")
        .defaultsTo(2)
        .says("until regulator or brake have switched on"),
    anyReal("start_position", "u").defaultsTo(0).says("position when the simulation begins"),
    anyReal("limit_negative", "u")
        .ofLinearAxes()
        .below("limit_positive", false)
        .says("the negative limit switch: actuated there and beyond"),
    anyReal("limit_positive", "u").ofLinearAxes().says("the positive one"),
    anyReal("home_switch_from", "u")
        .together("home_switch_to")
        .below("home_switch_to", true) // on a turning axis it may lie across the start of the turn
        .says("the home switch is actuated from here; on a rotary drive in every turn …"),
    anyReal("home_switch_to", "u").together("home_switch_from").says("… to here"),
    anyReal("index_position", "u")
        .says("index pulses: here and every `index_distance` further; without it once"),
    positive("index_distance", "u")
        .together("index_position")
        .defaultsTo(turn, "a turn of a rotary drive")
        .says("from one index pulse to the next"),
    anyReal("probe_position", "u")
        .says("marks that the first touch probe sees: here and every `probe_distance` further"),
    positive("probe_distance", "u")
        .together("probe_position")
        .defaultsTo(turn, "a turn of a rotary drive")
        .says("from one mark to the next"),
    whole("probe_inputs", 0, 15)
        .defaultsTo(15)
        .says("the touch probe inputs that the drive has, 1 + 2 + 4 + 8 for all four"),
    whole("parameter_cycles", 1, 100000, "cycles")
        .defaultsTo(3)
        .says("until the drive answers a question for one of its parameters"),
    positive("homing_velocity", "u/s")
        .defaultsTo(10)
        .says("the drive's reference run (`MC_Home`): velocity towards the home switch"),
    positive("homing_velocity_slow", "u/s")
        .defaultsTo(
            [](const ParameterValues &v) { return v.number("physics.homing_velocity") / 10.0; },
            "a tenth of `homing_velocity`")
        .says("velocity off the home switch"),
    positive("homing_acceleration", "u/s²")
        .defaultsTo(
            [](const ParameterValues &v) { return v.number("physics.homing_velocity") * 10.0; },
            "`homing_velocity` in 0.1 s")
        .says("acceleration and deceleration meanwhile"),
    choice("homing_direction", kDirections)
        .defaultsTo(-1)
        .says("where the home switch is looked for"),
    positive("quick_stop", "u/s²")
        .says("when the application stops, the drive brakes by itself with this deceleration; "
              "without it, "
              "it follows its set values to the end"),
};

inline constexpr std::array kEncoder = {
    Parameter{"follows", common::ParameterType::DriveName}.says(
        "the encoder sits on this drive's mechanics: it shows the drive's position, in its own "
        "resolution"),
    anyReal("own_velocity", "u/s").onlyWithout("follows").says("otherwise: it turns by itself"),
};

} // namespace physics
} // namespace stride::dummy

#endif
