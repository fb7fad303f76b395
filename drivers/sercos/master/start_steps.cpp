#include "drivers/sercos/master/start_steps.hpp"

#include "drivers/sercos/master/scaling.hpp"
#include "runtime/iec/math.h"

#include <algorithm>
#include <array>

namespace stride::sercos {
namespace {

/// In the order in which it is read. Drives may lack the last one.
constexpr std::array kCapabilities = {idns::kShortestAtStart,   idns::kAtToMdt,
                                      idns::kShortestFeedback,  idns::kMdtToMst,
                                      idns::kCommandProcessing, idns::kAtToAt};
constexpr std::array kTimes = {
    idns::kControlUnitCycle, idns::kCommunicationCycle, idns::kMdtStart,   idns::kAtStart,
    idns::kFeedbackSampling, idns::kCommandValid,       idns::kPlaceInMdt, idns::kMdtLength};
constexpr std::array kScalings = {
    idns::kPositionScaling,      idns::kLinearFactor,     idns::kLinearExponent,
    idns::kRotationalResolution, idns::kModulo,           idns::kVelocityScaling,
    idns::kVelocityFactor,       idns::kVelocityExponent, idns::kTorqueScaling,
    idns::kTorqueFactor,         idns::kTorqueExponent};

/// Values of S-0-0032 … S-0-0034 for controller modes.
uint16_t operationMode(uint8_t controllerMode) {
  switch (controllerMode) {
  case kTorqueControl:
    return static_cast<uint16_t>(OperationMode::Torque);
  case kVelocityControl:
    return static_cast<uint16_t>(OperationMode::Velocity);
  default:
    return static_cast<uint16_t>(OperationMode::Position1Lagless);
  }
}

class Steps {
public:
  explicit Steps(const DriveConfig &config) : config_(config) {}

  StartStep &add(StartOp op, Idn idn) {
    StartStep &step = steps_.emplace_back();
    step.op = op;
    step.value.idn = idn;
    step.value.numbers.resize(1);
    return step;
  }
  /// Not what is locked.
  void write(Idn idn, int64_t value, bool optional = false) {
    if (isLocked(idn))
      return;
    StartStep &step = add(StartOp::Write, idn);
    step.value.numbers[0] = value;
    step.optional = optional;
  }
  void writeList(Idn idn, std::span<const CyclicObject> objects) {
    if (isLocked(idn))
      return;
    StartStep &step = add(StartOp::Write, idn);
    step.value.numbers.clear();
    for (const CyclicObject &object : objects)
      step.value.numbers.push_back(object.idn);
  }
  void writeListed(Phase phase) {
    for (const IdnValue &value : config_.settings.lists[static_cast<size_t>(phase) - 2]) {
      StartStep &step = steps_.emplace_back();
      step.value = value;
      step.listed = true;
    }
    if (!config_.file.empty())
      add(StartOp::WriteFile, 0);
  }
  [[nodiscard]] bool isLocked(Idn idn) const {
    const std::vector<Idn> &locked = config_.settings.locked;
    return std::find(locked.begin(), locked.end(), idn) != locked.end();
  }
  std::vector<StartStep> take() { return std::move(steps_); }

private:
  const DriveConfig &config_;
  std::vector<StartStep> steps_;
};

void phaseTwo(const DriveConfig &config, Steps &steps) {
  const CyclicPlan &cyclic = config.settings.cyclic;
  for (const Idn idn : kCapabilities)
    steps.add(StartOp::ReadTime, idn).optional = true;
  for (const CyclicRecord *record : {&cyclic.mdt, &cyclic.at})
    for (const CyclicObject &object : record->objects())
      steps.add(StartOp::CheckLength, object.idn).bytes = object.bytes;
  steps.write(idns::kTelegramType, cyclic.telegramType);
  if (cyclic.telegramType == kApplicationTelegram) {
    steps.writeList(idns::kAtList, cyclic.at.objects());
    steps.writeList(idns::kMdtList, cyclic.mdt.objects());
  }
  steps.add(StartOp::AwaitPlan, 0);
  for (const Idn idn : kTimes)
    if (!steps.isLocked(idn))
      steps.add(StartOp::WriteTime, idn);
  steps.writeListed(Phase::Two);
  steps.add(StartOp::Command, idns::kCheckPhase3);
}

/// Whole increments of a turn, if there are.
int64_t wholeTurn(const DriveConfig &config) {
  constexpr double kMost = 2147483647.0;
  const double turn = stride::floor(config.period + 0.5);
  const double off = config.period - turn;
  const bool whole = turn >= 1 && turn <= kMost && off < 1e-9 * turn && off > -1e-9 * turn;
  return whole ? static_cast<int64_t>(turn) : 0;
}

/// Increments as they are: a linear drive has some of 10^-7 m, a rotary one as many in a turn as
/// its period has, and goes round there.
void writeScaling(const DriveConfig &config, Steps &steps) {
  if (config.rotary) {
    const int64_t turn = wholeTurn(config);
    uint16_t positions = scaling::kRotational;
    if (turn != 0)
      positions |= scaling::kModulo;
    if (turn != static_cast<int64_t>(kPreferredTurn))
      positions |= scaling::kParameters;
    steps.write(idns::kPositionScaling, positions);
    if (turn != 0) {
      steps.write(idns::kRotationalResolution, turn);
      steps.write(idns::kModulo, turn);
    }
    steps.write(idns::kVelocityScaling, scaling::kRotational);
  } else {
    steps.write(idns::kPositionScaling, scaling::kLinear);
    steps.write(idns::kVelocityScaling,
                scaling::kLinear | scaling::kParameters | scaling::kSeconds);
    steps.write(idns::kVelocityFactor, 1);
    steps.write(idns::kVelocityExponent, -7);
  }
  steps.write(idns::kTorqueScaling, 0);
}

void phaseThree(const DriveConfig &config, Steps &steps) {
  if (!config.settings.io) {
    writeScaling(config, steps);
    const ModeList modes = modeListOf(config.settings.cyclic.controllerModes);
    for (size_t i = 0; i < modes.modes.size(); ++i) {
      const Idn idn = static_cast<Idn>(idns::kPrimaryMode + i);
      const uint8_t mode = modes.modes[i];
      if (mode == 0 || steps.isLocked(idn))
        continue;
      StartStep &step = steps.add(StartOp::WriteMode, idn);
      step.value.numbers[0] = operationMode(mode);
      step.optional = i > 0;
    }
    // The first bit for real-time status shows the home switch.
    steps.write(idns::kRealTimeStatus1, idns::kHomeSwitch, true);
  }
  steps.writeListed(Phase::Three);
  if (!config.settings.io)
    for (const Idn idn : kScalings)
      steps.add(StartOp::ReadScaling, idn).optional = true;
  steps.add(StartOp::Command, idns::kCheckPhase4);
}

void phaseFour(const DriveConfig &config, Steps &steps) {
  // Who has lost the ring before says so until then; what is still there is an error of the axis.
  steps.add(StartOp::Command, idns::kResetClass1).optional = true;
  steps.writeListed(Phase::Four);
  const PackProfile profile = config.settings.profile;
  for (const Idn idn : packProfileIdns(profile))
    steps.add(StartOp::ProfileIdn, idn);
  for (const ProfileDemand &demand : profileDemands()) {
    if (!isOf(demand, profile))
      continue;
    StartStep &step = steps.add(StartOp::ProfileBits, demand.idn);
    step.mask = demand.mask;
    step.value.numbers[0] = demand.value;
    step.text = demand.text;
  }
}

} // namespace

std::vector<StartStep> startSteps(const DriveConfig &config, Phase phase) {
  Steps steps(config);
  switch (phase) {
  case Phase::Two:
    phaseTwo(config, steps);
    break;
  case Phase::Three:
    phaseThree(config, steps);
    break;
  case Phase::Four:
    phaseFour(config, steps);
    break;
  default:
    break;
  }
  return steps.take();
}

} // namespace stride::sercos
