#include "drivers/sercos/master/drive_axis.hpp"

#include "drivers/sercos/ring/ring.hpp"
#include "runtime/bus/drive_values.hpp"

#include <algorithm>
#include <utility>

namespace stride::sercos {
namespace {

/// S-0-0011: S-0-0129 says more.
constexpr uint16_t kManufacturer = 0x8000;
constexpr double kLargestVelocity = 2147483647.0;
constexpr double kLargestTorque = 32767;
/// Of a mode that nobody wants, until it counts.
constexpr uint32_t kUnexpectedCycles = 4;

int32_t longAt(std::span<const uint8_t> bytes, size_t place) {
  return static_cast<int32_t>(wordAt(bytes, place) | uint32_t{wordAt(bytes, place + 2)} << 16U);
}

void putLong(std::span<uint8_t> bytes, size_t place, int32_t value) {
  putWord(bytes, place, static_cast<uint16_t>(static_cast<uint32_t>(value)));
  putWord(bytes, place + 2, static_cast<uint16_t>(static_cast<uint32_t>(value) >> 16U));
}

} // namespace

DriveAxis::DriveAxis(DriveConfig config)
    : config_(std::move(config)), modes_(modeListOf(config_.settings.cyclic.controllerModes)),
      power_(config_.powerTimeout), homing_(config_.powerTimeout), probes_(config_.probeInputs) {
  status_.received = config_.settings.cyclic.received;
  if (modes_.modes[0] != 0)
    status_.controllerMode = command_.controllerMode = modes_.modes[0];
}

uint8_t DriveAxis::controllerModes() const {
  uint8_t modes = 0;
  for (const uint8_t mode : modes_.modes)
    modes = static_cast<uint8_t>(modes | (mode != 0 ? 1U << mode : 0U));
  return modes;
}

void DriveAxis::begin(const ScalingFacts &facts, uint8_t missing,
                      std::span<const uint8_t> telegram) {
  end();
  for (size_t i = 0; i < modes_.modes.size(); ++i)
    if ((missing >> i & 1U) != 0)
      modes_.modes[i] = 0;
  velocityUnit_ = velocityUnit(facts);
  torqueUnit_ = torqueUnit(facts, config_.torqueRated);
  const uint32_t place = config_.settings.cyclic.at.placeOf(idns::kPositionFeedback1);
  const bool has = place != 0 && telegram.size() >= place + 4U;
  positions_.begin(moduloOf(facts), has ? longAt(telegram, place) : 0);
  const uint32_t second = config_.settings.cyclic.at.placeOf(idns::kPositionFeedback2);
  const bool hasSecond = second != 0 && telegram.size() >= second + 4U;
  seconds_.begin(moduloOf(facts), hasSecond ? longAt(telegram, second) : 0);
  before_ = lastTarget_ = positions_.counter();
  command_.position = before_;
  read(telegram);
}

void DriveAxis::end() {
  const bus::DriveStatus old = status_;
  const bool shuts = shutDown_;
  const PositionCounter seconds = seconds_; // nobody jumps because a drive is gone
  *this = DriveAxis(std::move(config_));    // within a cycle: what lies on the heap stays there
  shutDown_ = shuts;
  seconds_ = seconds;
  status_.position = old.position;
  status_.controllerMode = old.controllerMode;
  command_.position = old.position;
  command_.controllerMode = old.controllerMode;
}

void DriveAxis::read(std::span<const uint8_t> telegram) {
  if (telegram.size() < config_.settings.cyclic.at.bytes())
    return;
  statusWord_ = wordAt(telegram, 0);
  power_.seen(statusWord_);
  readMode();
  status_.driveStarted = power_.started();
  // Both at once if both are wanted: programs that wait for MC_Power.Status only may move then.
  status_.regulatorOn = power_.torque() && (power_.started() || !command_.driveStart);
  status_.homeSwitch = (statusWord_ & status::kRealTime1) != 0;
  readActual(telegram);
  readErrors();
  readProbes();
  readHoming();
}

/// A mode that nobody wants must be shown for a while before it counts: an axis would lose its
/// motion for a single wrong word.
void DriveAxis::readMode() {
  const size_t mode = (statusWord_ & status::kModeMask) >> status::kModeShift;
  if (mode >= modes_.modes.size() || modes_.modes[mode] == 0)
    return;
  const bool expected = mode == wantedMode_ || modes_.modes[mode] == status_.controllerMode;
  unexpected_ = expected ? 0 : std::min(unexpected_ + 1, kUnexpectedCycles);
  if (expected || unexpected_ >= kUnexpectedCycles)
    status_.controllerMode = modes_.modes[mode];
}

void DriveAxis::readActual(std::span<const uint8_t> telegram) {
  const CyclicRecord &at = config_.settings.cyclic.at;
  if (const uint32_t place = at.placeOf(idns::kPositionFeedback1); place != 0)
    positions_.show(longAt(telegram, place));
  if (const uint32_t place = at.placeOf(idns::kPositionFeedback2); place != 0)
    seconds_.show(longAt(telegram, place));
  if (const uint32_t place = at.placeOf(idns::kVelocityFeedback); place != 0)
    status_.velocity = longAt(telegram, place) * velocityUnit_;
  if (const uint32_t place = at.placeOf(idns::kTorqueFeedback); place != 0)
    status_.torque = static_cast<int16_t>(wordAt(telegram, place)) * torqueUnit_;
  status_.position = positions_.counter();
  const auto way = static_cast<int32_t>(status_.position - before_);
  before_ = status_.position;
  const bool moves = (status_.received & cyclic::kPosition) != 0
                         ? way > bus::kRestIncrements || way < -bus::kRestIncrements
                         : status_.velocity != 0;
  resting_ = moves ? 0 : std::min(resting_ + 1, bus::kRestCycles);
}

void DriveAxis::readErrors() {
  if (!power_.fault()) {
    class1_ = 0;
    askedClass1_ = askedManufacturer_ = askedText_ = false;
  }
  status_.error = power_.fault() || power_.stuck();
  status_.errorId = class1_;
  if (!power_.fault())
    status_.errorId = power_.stuck() ? own_error::kPower : uint16_t{0};
}

void DriveAxis::readProbes() {
  status_.captured = probes_.captured() & command_.capture;
  for (size_t edge = 0; edge < Probes::kEdges; ++edge)
    if ((status_.captured >> edge & 1U) != 0)
      status_.capturedPosition[edge] = positions_.counterOf(probes_.position(edge));
}

void DriveAxis::readHoming() {
  switch (homing_.step()) {
  case HomingRun::Step::Idle:
    status_.homing = bus::Homing::None;
    break;
  case HomingRun::Step::Found:
    status_.homing = bus::Homing::Found;
    break;
  case HomingRun::Step::Failed:
    status_.homing = bus::Homing::Failed;
    break;
  default:
    status_.homing = bus::Homing::Running;
    break;
  }
  status_.homePosition = positions_.counterOf(homing_.reference());
}

PowerTarget DriveAxis::powerTarget() const {
  if (!command_.regulatorOn || shutDown_ || config_.settings.io)
    return PowerTarget::Off;
  return command_.driveStart ? PowerTarget::Follow : PowerTarget::Halt;
}

/// Set values are carried out.
bool DriveAxis::follows() const { return status_.driveStarted && !homing_.active(); }

void DriveAxis::write(std::span<uint8_t> record) {
  homing_.step(command_.homing, config_.homesItself && status_.driveStarted,
               resting_ >= bus::kRestCycles);
  probes_.step(command_.capture);
  power_.demand(powerTarget(), command_.errorAckn);
  if (power_.takeReset() && reset_ == Reset::None)
    reset_ = Reset::Start;
  chooseMode();
  writeTargets(record);
  ipoSync_ = !ipoSync_; // each cycle has new values
  const auto word = static_cast<uint16_t>(power_.control() | modeBits(wantedMode_) |
                                          (ipoSync_ ? control::kIpoSync : 0U));
  putWord(record, 0, word);
}

/// The mode for the controller mode that is wanted, as far as the drive has it and takes it.
void DriveAxis::chooseMode() {
  if (refused_ != 0 && command_.controllerMode != refused_)
    refused_ = 0;
  uint8_t wanted = command_.controllerMode;
  if (wanted == refused_ || modes_.placeOf(wanted) == modes_.modes.size())
    wanted = status_.controllerMode;
  const size_t place = modes_.placeOf(wanted);
  if (place == modes_.modes.size())
    return;
  wantedMode_ = static_cast<uint8_t>(place);
  // A drive may show the new mode under torque only.
  modeWaited_ = wanted == status_.controllerMode || !power_.torque() ? 0 : modeWaited_ + 1;
  if (modeWaited_ >= config_.modeTimeout)
    refused_ = wanted; // back to the one that it has
}

// What is regulated follows the command. What is not is where the axis is, so that nothing jumps
// when it begins to be; and what the drive regulates already, until it follows, stays.

uint32_t DriveAxis::targetPosition(bool regulated) const {
  if (regulated || (status_.received & cyclic::kPosition) == 0)
    return command_.position;
  const bool holding =
      power_.torque() && !homing_.active() && status_.controllerMode == kPositionControl;
  return holding ? lastTarget_ : status_.position;
}

double DriveAxis::targetVelocity() const {
  const bool alone = !config_.settings.cyclic.mdt.carries(idns::kPositionCommand);
  if (follows() && (status_.controllerMode == kVelocityControl ||
                    (!alone && status_.controllerMode == kPositionControl)))
    return command_.velocity;
  return 0;
}

double DriveAxis::targetTorque(uint8_t regulated) const {
  if (regulated == kTorqueControl)
    return command_.torque;
  if (!power_.torque() || status_.controllerMode == kTorqueControl ||
      (status_.received & cyclic::kTorque) == 0)
    return 0;
  return status_.torque;
}

void DriveAxis::writeTargets(std::span<uint8_t> record) {
  const CyclicRecord &mdt = config_.settings.cyclic.mdt;
  const uint8_t regulated = follows() ? status_.controllerMode : uint8_t{0};
  const uint32_t position = targetPosition(regulated == kPositionControl);
  const int32_t velocity = bus::saturated(targetVelocity() / velocityUnit_, kLargestVelocity);
  if (regulated == kVelocityControl)
    targetMoves_ = velocity != 0;
  else if (regulated == kTorqueControl)
    targetMoves_ = resting_ < bus::kRestCycles;
  else
    targetMoves_ = position != lastTarget_;
  lastTarget_ = position;
  if (const uint32_t place = mdt.placeOf(idns::kPositionCommand); place != 0)
    putLong(record, place, positions_.command(position));
  if (const uint32_t place = mdt.placeOf(idns::kVelocityCommand); place != 0)
    putLong(record, place, velocity);
  if (const uint32_t place = mdt.placeOf(idns::kTorqueCommand); place != 0)
    putWord(record, place,
            static_cast<uint16_t>(
                bus::saturated(targetTorque(regulated) / torqueUnit_, kLargestTorque)));
}

bool DriveAxis::atRest() const { return !power_.torque() || resting_ >= bus::kRestCycles; }

ServiceWish DriveAxis::wish() const {
  using Kind = ServiceWish::Kind;
  if (power_.fault() && !askedClass1_)
    return {Kind::Read, idns::kClass1};
  if (power_.fault() && (class1_ & kManufacturer) != 0 && !askedManufacturer_)
    return {Kind::Read, idns::kManufacturerClass1};
  if (power_.fault() && !askedText_)
    return {Kind::Text, idns::kDiagnosticMessage};
  if (reset_ == Reset::Start)
    return {Kind::Write, idns::kResetClass1, command::kStart};
  if (reset_ == Reset::Running)
    return {Kind::State, idns::kResetClass1};
  if (reset_ == Reset::Ending)
    return {Kind::Write, idns::kResetClass1, command::kCancel};
  if (const ServiceWish wish = homing_.wish(); wish.kind != Kind::None)
    return wish;
  return probes_.wish();
}

void DriveAxis::resetAnswered(const ServiceAnswer &answer) {
  switch (reset_) {
  case Reset::Start:
    reset_ = answer.done ? Reset::Running : Reset::None;
    break;
  case Reset::Running: {
    const auto state = static_cast<uint16_t>(answer.value & data_state::kCommandMask);
    if (!answer.done || state == data_state::kDone || state == data_state::kFailed)
      reset_ = Reset::Ending;
    break;
  }
  default:
    reset_ = Reset::None;
    break;
  }
}

void DriveAxis::answered(const ServiceWish &wish, const ServiceAnswer &answer) {
  switch (wish.idn) {
  case idns::kClass1:
    askedClass1_ = true;
    class1_ = answer.done ? static_cast<uint16_t>(answer.value) : uint16_t{0};
    break;
  case idns::kManufacturerClass1:
    askedManufacturer_ = true;
    // One that is only the manufacturer's has its number.
    if (answer.done && class1_ == kManufacturer && answer.value != 0)
      class1_ = static_cast<uint16_t>(answer.value);
    break;
  case idns::kDiagnosticMessage:
    askedText_ = true;
    break;
  case idns::kResetClass1:
    resetAnswered(answer);
    break;
  case idns::kDriveHoming:
  case idns::kReferenceDistance1:
  case idns::kReferenceOffset1:
    homing_.answered(wish, answer);
    break;
  default:
    probes_.answered(wish, answer);
    break;
  }
}

} // namespace stride::sercos
