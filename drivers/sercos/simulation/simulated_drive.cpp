#include "drivers/sercos/simulation/simulated_drive.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace stride::sercos::simulation {
namespace {

using namespace idns;

constexpr std::array<Idn, 4> kModes = {kPrimaryMode, kSecondaryMode1, kSecondaryMode2,
                                       kSecondaryMode3};
constexpr double kNanoseconds = 1e9;

bool isOneOf(int64_t value, std::initializer_list<int64_t> allowed) {
  return std::find(allowed.begin(), allowed.end(), value) != allowed.end();
}

/// The command value that a mode follows.
Idn commandOf(OperationMode mode) {
  switch (mode) {
  case OperationMode::Torque:
    return kTorqueCommand;
  case OperationMode::Velocity:
    return kVelocityCommand;
  default:
    return kPositionCommand;
  }
}

uint16_t allowed(bool good) { return good ? service_error::kNone : service_error::kInvalidData; }

} // namespace

SimulatedDrive::SimulatedDrive(const DriveSetup &setup)
    : Device(setup.device, driveRows(setup)), parameters_(setup.drive),
      homingParameters_(setup.drive), ratedTorque_(setup.ratedTorque),
      scaling_(setup.incrementsPerTurn, setup.incrementsPerMetre),
      mechanics_(setup.drive.mechanics, setup.drive.startPosition),
      cycle_(setup.drive.mechanics.cycle), torqueLimit_(setup.drive.mechanics.torqueLimit) {
  scaling_.configure(list());
  rest();
  updateSwitches();
  updateData();
}

bool SimulatedDrive::supports(int64_t operationMode) const {
  const bool torque = parameters_.mechanics.model == dummy::Model::SecondOrder;
  return isOneOf(operationMode, {2, 3, 4, 11, 12}) || (operationMode == 1 && torque);
}

OperationMode SimulatedDrive::operation() const {
  return static_cast<OperationMode>(list().value(kModes[mode_]));
}

bool SimulatedDrive::positions() const {
  return operation() != OperationMode::Torque && operation() != OperationMode::Velocity;
}

bool SimulatedDrive::mayFollow() const {
  return power_ == Power::On && (controlWord() & control::kGo) != 0 && homing_ == Homing::Idle &&
         list().find(kDriveHoming)->state == data_state::kIdle;
}

// ---- power

void SimulatedDrive::switchOff() noexcept {
  power_ = Power::Off;
  if (homing_ != Homing::Idle) {
    homing_ = Homing::Idle;
    run_.clear();
    endCommand(kDriveHoming, data_state::kFailed);
  }
  rest();
}

void SimulatedDrive::stop() noexcept {
  if (power_ == Power::SwitchingOn)
    power_ = Power::Off;
  if (power_ != Power::On)
    return;
  if (!positions())
    velocityDemanded_ = mechanics_.velocity();
  if (homing_ != Homing::Idle) {
    homing_ = Homing::Idle;
    run_.clear();
    endCommand(kDriveHoming, data_state::kFailed);
  }
  power_ = Power::Stopping;
}

void SimulatedDrive::switchOn() noexcept {
  const bool stuck = sim_ != nullptr && (sim_->bRegulatorStuck != 0 || sim_->bBrakeStuck != 0);
  if (switchCycles_ > 0)
    --switchCycles_;
  if (switchCycles_ > 0 || stuck)
    return;
  power_ = Power::On;
  rest();
}

/// What bits 15 and 14 of the control word say.
void SimulatedDrive::control() noexcept {
  const uint16_t word = phase() == Phase::Four ? controlWord() : 0;
  const bool on = (word & control::kOn) != 0;
  const bool enable = (word & control::kEnable) != 0;
  armed_ = phase() == Phase::Four && (armed_ || !on);
  switch (power_) {
  case Power::Off:
    if (!on || !enable || !armed_ || hasError() || !mainPower_)
      return;
    armed_ = false;
    power_ = Power::SwitchingOn;
    switchCycles_ = parameters_.switchCycles;
    switchOn();
    return;
  case Power::SwitchingOn:
    if (!on || !enable || !mainPower_)
      power_ = Power::Off;
    else
      switchOn();
    return;
  case Power::On:
    if (!mainPower_)
      raiseError(class1::kUndervoltage, 0, "main power is missing");
    else if (phase() == Phase::Four && !enable)
      switchOff();
    else if (!on)
      stop();
    return;
  case Power::Stopping:
    if ((phase() == Phase::Four && !enable) || !mainPower_)
      switchOff();
    return;
  }
}

uint16_t SimulatedDrive::deviceStatus() const noexcept {
  Ready ready = Ready::Logic;
  if (hasTorque())
    ready = Ready::Operational;
  else if (hasError())
    ready = Ready::Not;
  else if (mainPower_ && phase() == Phase::Four)
    ready = Ready::Power;
  return static_cast<uint16_t>((static_cast<unsigned>(ready) << status::kReadyShift) |
                               (static_cast<unsigned>(mode_) << status::kModeShift) |
                               (follows_ ? status::kFollows : 0U));
}

void SimulatedDrive::onPhase(Phase before) noexcept {
  if (before == Phase::Four) {
    armed_ = false;
    stop(); // as well as it can without the master
  }
  if (phase() == Phase::Zero)
    probing_ = false;
  if (phase() == Phase::Three || phase() == Phase::Four)
    scaling_.configure(list());
  if (phase() == Phase::Four) {
    mode_ = 0;
    for (const Idn idn : {kProbe1Enable, kProbe2Enable})
      list().at(idn).value = 0;
    clearProbe(0);
    clearProbe(1);
  }
}

void SimulatedDrive::onCycle(int64_t periodNs) noexcept {
  disturb();
  move(static_cast<double>(periodNs) / kNanoseconds);
  control();
  changeMode();
  latch();
  updateData();
}

// ---- modes

void SimulatedDrive::changeMode() noexcept {
  const uint8_t wanted = modeOf(controlWord());
  if (phase() != Phase::Four || wanted == mode_)
    return;
  const bool defined =
      wanted < kModes.size() && supports(list().value(kModes[wanted])) &&
      isCyclicCommand(commandOf(static_cast<OperationMode>(list().value(kModes[wanted]))));
  if (!defined) {
    if (!hasError())
      raiseInterfaceError(interface_status::kMode);
    return;
  }
  const bool before = positions();
  mode_ = wanted;
  if (!before || !hasTorque())
    rest();
}

void SimulatedDrive::checkPhase4(IdnEntry &invalid) noexcept {
  const IdnEntry &primary = list().at(kPrimaryMode);
  if (!primary.given || !supports(primary.value) ||
      !isCyclicCommand(commandOf(static_cast<OperationMode>(primary.value))))
    invalid.add(kPrimaryMode);
  const int64_t type = list().value(kPositionScaling);
  if ((type & scaling::kMethod) == scaling::kLinear && (type & scaling::kModulo) != 0)
    invalid.add(kPositionScaling);
  constexpr int64_t kLimits = 0x0010; // of S-0-0055: the position limits count
  if ((list().value(kPositionPolarity) & kLimits) != 0 &&
      list().value(kPositionLimitPositive) <= list().value(kPositionLimitNegative)) {
    invalid.add(kPositionLimitPositive);
    invalid.add(kPositionLimitNegative);
  }
}

uint16_t SimulatedDrive::checkData(const IdnEntry &entry, int64_t value) noexcept {
  using namespace scaling;
  const int64_t method = value & kMethod;
  switch (entry.row.idn) {
  case kPrimaryMode:
    return allowed(supports(value));
  case kSecondaryMode1:
  case kSecondaryMode2:
  case kSecondaryMode3:
    return allowed(value == 0 || supports(value));
  case kPositionScaling:
    return allowed(method <= kRotational &&
                   (value & ~(kMethod | kParameter | kLoad | scaling::kModulo)) == 0);
  case kVelocityScaling:
    return allowed(method <= kRotational &&
                   (value & ~(kMethod | kParameter | kSeconds | kLoad)) == 0);
  case kTorqueScaling:
    return allowed(value == 0);
  case kAccelerationScaling:
    return allowed(isOneOf(value, {0, kLinear, kRotational}));
  case kHomingParameter: {
    constexpr int64_t kKnown = 0x0065; // direction, switch at the drive, no switch, no mark
    return homing_ != Homing::Idle ? service_error::kProtectedNow : allowed((value & ~kKnown) == 0);
  }
  case kRealTimeControl1:
  case kRealTimeControl2:
    return allowed(isOneOf(value, {0, kProbe1Enable, kProbe2Enable}));
  case kRealTimeStatus1:
  case kRealTimeStatus2:
    return allowed(
        isOneOf(value, {0, kInPosition, kHomeSwitch, kProbe1, kProbe2, kPositionFeedbackStatus,
                        kProbe1PositiveLatched, kProbe1NegativeLatched, kProbe2PositiveLatched,
                        kProbe2NegativeLatched}));
  default:
    return service_error::kNone;
  }
}

void SimulatedDrive::onData(const IdnEntry &entry) noexcept {
  switch (entry.row.idn) {
  case kProbe1Enable:
    clearProbe(0);
    break;
  case kProbe2Enable:
    clearProbe(1);
    break;
  default:
    break;
  }
}

// ---- commands and errors

uint16_t SimulatedDrive::onCommand(Idn idn) noexcept {
  if (idn == kDriveHoming)
    return startHoming();
  if (idn == kProbing) {
    probing_ = true;
    return data_state::kRunning;
  }
  return data_state::kFailed;
}

void SimulatedDrive::onCommandEnd(Idn idn) noexcept {
  if (idn == kProbing) {
    probing_ = false;
    clearProbe(0);
    clearProbe(1);
  }
  if (idn == kDriveHoming && homing_ != Homing::Idle) { // it brakes
    homing_ = Homing::Idle;
    run_.clear();
  }
}

void SimulatedDrive::onError() noexcept {
  if (power_ == Power::SwitchingOn)
    power_ = Power::Off;
  stop();
}

void SimulatedDrive::onReset() noexcept {
  failed_ = 0;
  armed_ = false;
  if (sim_ != nullptr)
    sim_->wDriveError = 0;
}

void SimulatedDrive::fail(uint16_t number) noexcept {
  if (number == 0 || number == failed_)
    return;
  failed_ = number;
  std::array<char, 32> text = {'e', 'r', 'r', 'o', 'r', ' '};
  constexpr size_t kHead = 6;
  const auto end = std::to_chars(text.data() + kHead, text.data() + text.size(), number);
  raiseError(class1::kManufacturer, number,
             {text.data(), static_cast<size_t>(end.ptr - text.data())});
}

void SimulatedDrive::place(int64_t position) noexcept {
  if (hasTorque())
    return;
  mechanics_.place(position);
  rest();
  updateData();
}

} // namespace stride::sercos::simulation
