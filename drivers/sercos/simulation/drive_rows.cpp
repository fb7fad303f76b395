// The data blocks of a simulated drive, besides those of communication. Names and units are those
// of the standard.
#include "drivers/sercos/simulation/drive_setup.hpp"
#include "drivers/sercos/simulation/rows.hpp"

#include "runtime/iec/math.h"

#include <algorithm>
#include <limits>

namespace stride::sercos::simulation {
namespace {

using namespace idns;
using namespace rows;

constexpr uint8_t kBoth = kInAt | kInMdt;
constexpr int64_t kMostLong = std::numeric_limits<int32_t>::max();
constexpr int64_t kMostUnsigned = std::numeric_limits<uint32_t>::max();
constexpr int64_t kPercentMost = 10000; // 1000.0 %

int64_t whole(double value, double least) {
  return static_cast<int64_t>(
      stride::floor(std::clamp(value, least, static_cast<double>(kMostLong)) + 0.5));
}

void addModes(std::vector<IdnRow> &all) {
  const auto mode = [&all](Idn idn, std::string_view name, int64_t value, Given given) {
    all.push_back(
        {.idn = idn, .name = name, .attribute = bits(kIn23), .value = value, .given = given});
  };
  mode(kPrimaryMode, "Primary operation mode", 3, Given::Phase3);
  mode(kSecondaryMode1, "Secondary operation mode 1", 2, Given::Never);
  mode(kSecondaryMode2, "Secondary operation mode 2", 0, Given::Never);
  mode(kSecondaryMode3, "Secondary operation mode 3", 0, Given::Never);
}

void addVelocity(std::vector<IdnRow> &all) {
  const auto row = [&all](Idn idn, std::string_view name, Attribute attribute, int64_t value,
                          uint8_t cyclic) {
    all.push_back({.idn = idn,
                   .name = name,
                   .unit = "rpm",
                   .attribute = attribute,
                   .value = value,
                   .cyclic = cyclic});
  };
  constexpr uint8_t kDecimals = 4;
  row(kVelocityCommand, "Velocity command value", longInteger(kIn234, kDecimals), 0, kBoth);
  row(kAdditiveVelocity, "Additive velocity command value", longInteger(kIn234, kDecimals), 0,
      kInMdt);
  row(kVelocityLimitPositive, "Positive velocity limit value", longInteger(kIn234, kDecimals),
      kMostLong, kInMdt);
  row(kVelocityLimitNegative, "Negative velocity limit value", longInteger(kIn234, kDecimals),
      -kMostLong, kInMdt);
  row(kVelocityFeedback, "Velocity feedback value", longInteger(kNever, kDecimals), 0, kInAt);
  row(kVelocityLimit, "Bipolar velocity limit value", longInteger(kIn234, kDecimals), kMostLong,
      kInMdt);
  all.push_back(
      {.idn = kVelocityPolarity, .name = "Velocity polarity parameter", .attribute = bits(kIn23)});
  all.push_back({.idn = kVelocityScaling,
                 .name = "Velocity data scaling type",
                 .attribute = bits(kIn23),
                 .value = 0x0002});
  all.push_back({.idn = kVelocityFactor,
                 .name = "Velocity data scaling factor",
                 .attribute = number(kIn23),
                 .value = 1,
                 .low = 1,
                 .high = 65535});
  all.push_back({.idn = kVelocityExponent,
                 .name = "Velocity data scaling exponent",
                 .attribute = integer(kIn23),
                 .value = -4,
                 .low = -9,
                 .high = 0});
}

void addPosition(std::vector<IdnRow> &all) {
  const auto row = [&all](Idn idn, std::string_view name, Attribute attribute, uint8_t cyclic,
                          int64_t value = 0) {
    all.push_back({.idn = idn,
                   .name = name,
                   .unit = "incr",
                   .attribute = attribute,
                   .value = value,
                   .cyclic = cyclic});
  };
  row(kPositionCommand, "Position command value", longInteger(kIn234), kBoth);
  row(kPositionLimitPositive, "Positive position limit value", longInteger(kIn234), 0, kMostLong);
  row(kPositionLimitNegative, "Negative position limit value", longInteger(kIn234), 0, -kMostLong);
  row(kPositionFeedback1, "Position feedback value 1 (motor feedback)", longInteger(kNever), kInAt);
  row(kReferenceDistance1, "Reference distance 1", longInteger(kIn234), 0);
  row(kPositionFeedback2, "Position feedback value 2 (external feedback)", longInteger(kNever),
      kInAt);
  row(kReferenceDistance2, "Reference distance 2", longInteger(kIn234), 0);
  row(kPositionWindow, "Position window", longNumber(kIn234), 0, 100);
  row(kMonitoringWindow, "Monitoring window", longNumber(kIn234), 0, 0);
  row(kFollowingDistance, "Following distance", longInteger(kNever), kInAt);
  for (const Idn idn : {kProbe1Positive, kProbe1Negative, kProbe2Positive, kProbe2Negative}) {
    constexpr std::string_view kNames[] = {
        "Probe value 1 positive edge", "Probe value 1 negative edge", "Probe value 2 positive edge",
        "Probe value 2 negative edge"};
    row(idn, kNames[idn - kProbe1Positive], longInteger(kNever), kInAt);
  }
}

void addPositionScaling(std::vector<IdnRow> &all, const DriveSetup &setup) {
  all.push_back(
      {.idn = kPositionPolarity, .name = "Position polarity parameter", .attribute = bits(kIn23)});
  all.push_back({.idn = kPositionScaling,
                 .name = "Position data scaling type",
                 .attribute = bits(kIn23),
                 .value = 0x000A});
  all.push_back({.idn = kLinearFactor,
                 .name = "Linear position data scaling factor",
                 .attribute = number(kIn23),
                 .value = 1,
                 .low = 1,
                 .high = 65535});
  all.push_back({.idn = kLinearExponent,
                 .name = "Linear position data scaling exponent",
                 .attribute = integer(kIn23),
                 .value = -7,
                 .low = -9,
                 .high = 0});
  all.push_back({.idn = kRotationalResolution,
                 .name = "Rotational position resolution",
                 .unit = "incr/rev",
                 .attribute = longNumber(kIn23),
                 .value = whole(setup.incrementsPerTurn, 1),
                 .low = 1,
                 .high = kMostLong});
  all.push_back({.idn = kModulo,
                 .name = "Modulo value",
                 .unit = "incr",
                 .attribute = longNumber(kIn23),
                 .value = whole(setup.incrementsPerTurn, 1),
                 .low = 1,
                 .high = kMostLong});
}

void addTorque(std::vector<IdnRow> &all) {
  const auto row = [&all](Idn idn, std::string_view name, Attribute attribute, int64_t value,
                          uint8_t cyclic) {
    all.push_back({.idn = idn,
                   .name = name,
                   .unit = "%",
                   .attribute = attribute,
                   .value = value,
                   .cyclic = cyclic});
  };
  row(kTorqueCommand, "Torque command value", integer(kIn234, 1), 0, kBoth);
  row(kAdditiveTorque, "Additive torque command value", integer(kIn234, 1), 0, kInMdt);
  row(kTorqueLimitPositive, "Positive torque limit value", integer(kIn234, 1), kPercentMost,
      kInMdt);
  row(kTorqueLimitNegative, "Negative torque limit value", integer(kIn234, 1), -kPercentMost,
      kInMdt);
  row(kTorqueFeedback, "Torque feedback value", integer(kNever, 1), 0, kInAt);
  row(kTorqueLimit, "Bipolar torque limit value", number(kIn234, 1), kPercentMost, kInMdt);
  row(kTorqueThreshold, "Torque threshold Tx", number(kIn234, 1), 1000, 0);
  all.push_back(
      {.idn = kTorquePolarity, .name = "Torque polarity parameter", .attribute = bits(kIn23)});
  all.push_back(
      {.idn = kTorqueScaling, .name = "Torque/force data scaling type", .attribute = bits(kIn23)});
  all.push_back({.idn = kRatedCurrent,
                 .name = "Motor continuous stall current",
                 .unit = "A",
                 .attribute = longNumber(kNever, 3),
                 .value = 1000});
}

void addRamps(std::vector<IdnRow> &all, const DriveSetup &setup) {
  const dummy::HomingParameters &homing = setup.drive.homing;
  const double stop = setup.drive.quickStop;
  constexpr double kDefaultRamp = 10'000'000; // [inc/s²]
  all.push_back({.idn = kAcceleration,
                 .name = "Bipolar acceleration limit value",
                 .unit = "incr/s^2",
                 .attribute = longNumber(kIn234),
                 .value = whole(stop > 0 ? stop : kDefaultRamp, 1),
                 .low = 1,
                 .high = kMostUnsigned});
  all.push_back({.idn = kHomingAcceleration,
                 .name = "Homing acceleration",
                 .unit = "incr/s^2",
                 .attribute = longNumber(kIn234),
                 .value = whole(homing.acceleration, 1),
                 .low = 1,
                 .high = kMostUnsigned});
  constexpr double kUnit = 60e4; // of S-0-0044 as it is first: 0.0001 rpm
  all.push_back({.idn = kHomingVelocity,
                 .name = "Homing velocity",
                 .unit = "rpm",
                 .attribute = longInteger(kIn234, 4),
                 .value = whole(homing.fast / setup.incrementsPerTurn * kUnit, 1),
                 .low = 1,
                 .high = kMostLong});
  all.push_back({.idn = kAccelerationScaling,
                 .name = "Acceleration data scaling type",
                 .attribute = bits(kIn23)});
  constexpr int64_t kNegativeWithSwitch = 0x0041;
  constexpr int64_t kPositiveWithSwitch = 0x0040;
  all.push_back({.idn = kHomingParameter,
                 .name = "Homing parameter",
                 .attribute = bits(kIn234),
                 .value = homing.positive ? kPositiveWithSwitch : kNegativeWithSwitch});
}

void addProcedures(std::vector<IdnRow> &all) {
  all.push_back({.idn = kDriveHoming,
                 .name = "Drive controlled homing procedure command",
                 .attribute = command(kIn4)});
  all.push_back(
      {.idn = kProbing, .name = "Probing cycle procedure command", .attribute = command(kIn34)});
  all.push_back({.idn = kProbeControl,
                 .name = "Probe control parameter",
                 .attribute = bits(kIn234),
                 .low = 0,
                 .high = 15});
}

void addSignals(std::vector<IdnRow> &all) {
  const auto seen = [&all](Idn idn, std::string_view name) {
    all.push_back({.idn = idn, .name = name, .attribute = bits(kNever), .cyclic = kInAt});
  };
  const auto enable = [&all](Idn idn, std::string_view name) {
    all.push_back({.idn = idn,
                   .name = name,
                   .attribute = bits(kIn234),
                   .low = 0,
                   .high = 1,
                   .cyclic = kInMdt});
  };
  seen(kProbeStatus, "Probe status");
  seen(kInPosition, "In position");
  seen(kHomeSwitch, "Home switch");
  seen(kProbe1, "Probe 1");
  seen(kProbe2, "Probe 2");
  seen(kPositionFeedbackStatus, "Position feedback value status");
  enable(kProbe1Enable, "Probe 1 enable");
  enable(kProbe2Enable, "Probe 2 enable");
  seen(kProbe1PositiveLatched, "Probe 1 positive latched");
  seen(kProbe1NegativeLatched, "Probe 1 negative latched");
  seen(kProbe2PositiveLatched, "Probe 2 positive latched");
  seen(kProbe2NegativeLatched, "Probe 2 negative latched");
  seen(kSwitches, "Switches: negative, positive limit, home");
  all.push_back({.idn = kIndexPosition,
                 .name = "Position of the last index pulse",
                 .unit = "incr",
                 .attribute = longInteger(kNever),
                 .cyclic = kInAt});
  all.push_back({.idn = kIndexCount,
                 .name = "Number of index pulses",
                 .attribute = number(kNever),
                 .cyclic = kInAt});
}

void addDevice(std::vector<IdnRow> &all) {
  all.push_back({.idn = kPositionGain,
                 .name = "Position loop KV-factor",
                 .unit = "(m/min)/mm",
                 .attribute = number(kIn234, 2),
                 .value = 100,
                 .low = 1,
                 .high = 65535});
  all.push_back({.idn = kControllerType,
                 .name = "Controller type",
                 .attribute = text(kNever),
                 .text = "Stride simulated drive"});
  all.push_back({.idn = kMotorType,
                 .name = "Motor type",
                 .attribute = text(kNever),
                 .text = "Stride simulated motor"});
  all.push_back({.idn = kApplicationType,
                 .name = "Application type",
                 .attribute = text(kIn234),
                 .text = "DRIVE",
                 .room = 40});
}

} // namespace

std::vector<IdnRow> driveRows(const DriveSetup &setup) {
  std::vector<IdnRow> all = setup.more; // the last one of several for the same IDN counts
  for (const IdnRow &row : communicationRows())
    all.push_back(row);
  addModes(all);
  addVelocity(all);
  addPosition(all);
  addPositionScaling(all, setup);
  addTorque(all);
  addRamps(all, setup);
  addProcedures(all);
  addSignals(all);
  addDevice(all);
  return all;
}

} // namespace stride::sercos::simulation
