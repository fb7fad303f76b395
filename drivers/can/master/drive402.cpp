#include "drivers/can/master/drive402.hpp"

#include "runtime/bus/drive_values.hpp"

#include <algorithm>

namespace stride::can {
namespace {

constexpr double kPerMille = 1000;
constexpr double kMilli = 1e-3;
constexpr uint8_t kNegativeLimit = 1;
constexpr uint8_t kPositiveLimit = 2;
constexpr uint8_t kHomeSwitch = 4;
constexpr uint8_t kEdgeBits = 3;
constexpr unsigned kProbeBits = 8; ///< Of 60B8h and 60B9h for each.

uint8_t modeMask(uint8_t controllerMode) { return static_cast<uint8_t>(1U << controllerMode); }

bool isRegulated(PowerState state) {
  return state == PowerState::SwitchedOn || state == PowerState::Enabled ||
         state == PowerState::QuickStop;
}

} // namespace

bool VelocityCheck::step(double way, double velocityWay) {
  constexpr double kMoving = 1; // inc per cycle
  constexpr uint32_t kCycles = 100;
  if (cycles_ >= kCycles || (way < kMoving && way > -kMoving))
    return false;
  way_ += way < 0 ? -way : way;
  velocityWay_ += velocityWay < 0 ? -velocityWay : velocityWay;
  // Acceleration and rounding make some difference, a wrong unit makes another.
  return ++cycles_ == kCycles && (velocityWay_ > 2 * way_ || velocityWay_ < 0.5 * way_);
}

Drive402::Drive402(const DriveConfig &config, const DrivePlan &plan)
    : config_(config), plan_(plan), power_(config.power),
      modes_(plan.carries(Signal::Mode) && plan.carries(Signal::ModeDisplay), config.modeTimeout),
      homing_(config.homingTimeout) {}

void Drive402::begin(const DriveFacts &facts, const Signals &signals) {
  end();
  facts_ = facts;
  for (const uint8_t one : {kPositionControl, kVelocityControl, kTorqueControl})
    if ((plan_.controllerModes & modeMask(one)) != 0 &&
        modeFor(one, facts.supportedModes) != mode::kNone &&
        (one != kTorqueControl || ratedTorque() > 0))
      controllerModes_ = controllerModes_ | modeMask(one);
  modes_.begin(facts.mode);
  status_.controllerMode = controllerModeOf(facts.mode);
  status_.received = plan_.received;
  if (!(ratedTorque() > 0))
    status_.received = static_cast<uint8_t>(status_.received & ~cyclic::kTorque);
  before_ = lastTarget_ = signals.get(Signal::Position);
  command_.position = before_;
  command_.controllerMode = status_.controllerMode;
  read(signals, 0);
}

void Drive402::end() {
  const bus::DriveStatus old = status_;
  const bool stops = quickStop_;
  const bool shuts = shutDown_;
  *this = Drive402(config_, plan_);
  quickStop_ = stops;
  shutDown_ = shuts;
  // Where the axis stands is known until somebody says something else.
  status_.position = old.position;
  status_.received = old.received;
  status_.controllerMode = old.controllerMode;
  command_.position = old.position;
}

double Drive402::ratedTorque() const {
  return config_.torqueRated > 0 ? config_.torqueRated : facts_.ratedTorque * kMilli;
}

void Drive402::read(const Signals &signals, uint16_t told) {
  statusword_ = static_cast<uint16_t>(signals.get(Signal::Statusword));
  power_.seen(statusword_);
  modes_.seen(static_cast<int8_t>(signals.number(Signal::ModeDisplay)));
  const bool enabled = power_.state() == PowerState::Enabled;
  released_ = enabled ? std::min(released_ + 1, config_.brakeRelease + 1) : 0;
  status_.driveStarted = enabled && released_ > config_.brakeRelease && !power_.blocked();
  // Both at once if both are wanted: programs that wait for MC_Power.Status only may move then.
  status_.regulatorOn = isRegulated(power_.state()) && !power_.blocked() &&
                        (status_.driveStarted || !command_.driveStart);
  if (const uint8_t now = controllerModeOf(modes_.current()); now != 0)
    status_.controllerMode = now;
  readActual(signals);
  readInputs(signals);
  readProbes(signals);
  readErrors(told);
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
  status_.homePosition = facts_.homeOffset;
}

void Drive402::readActual(const Signals &signals) {
  const int32_t rawVelocity = signals.number(Signal::Velocity);
  status_.position = signals.get(Signal::Position);
  status_.velocity = rawVelocity * config_.velocityScale;
  status_.torque = signals.number(Signal::Torque) / kPerMille * ratedTorque();
  const double ratedCurrent = facts_.ratedCurrent == 0 ? 1 : facts_.ratedCurrent * kMilli;
  status_.current = signals.number(Signal::Current) / kPerMille * ratedCurrent;
  const auto way = static_cast<int32_t>(status_.position - before_);
  before_ = status_.position;
  const bool moves = (plan_.received & cyclic::kPosition) != 0
                         ? way > bus::kRestIncrements || way < -bus::kRestIncrements
                         : rawVelocity != 0;
  resting_ = moves ? 0 : std::min(resting_ + 1, bus::kRestCycles);
  constexpr uint8_t kBoth = cyclic::kPosition | cyclic::kVelocity;
  if ((plan_.received & kBoth) == kBoth && follows())
    doubtful_ = check_.step(way, status_.velocity * config_.cycle) || doubtful_;
}

void Drive402::readInputs(const Signals &signals) {
  if (!plan_.carries(Signal::Inputs))
    return;
  const uint32_t inputs = signals.get(Signal::Inputs) ^ config_.inputsInverted;
  status_.limitNegative = (inputs & kNegativeLimit) != 0;
  status_.limitPositive = (inputs & kPositiveLimit) != 0;
  status_.homeSwitch = (inputs & kHomeSwitch) != 0;
}

void Drive402::readProbes(const Signals &signals) {
  if (config_.probeInputs == 0)
    return;
  status_.captured = 0;
  const uint8_t wanted = command_.capture & config_.probeInputs;
  const uint32_t status = signals.get(Signal::ProbeStatus);
  for (size_t probe = 0; probe < kProbes; ++probe) {
    TouchProbe &one = probes_[probe];
    const size_t first = probe * TouchProbe::kEdges;
    one.step(static_cast<uint8_t>(wanted >> first & kEdgeBits),
             static_cast<uint8_t>(status >> probe * kProbeBits));
    for (size_t edge = 0; edge < TouchProbe::kEdges; ++edge) {
      const auto signal =
          static_cast<Signal>(static_cast<size_t>(Signal::Probe1Rising) + first + edge);
      if ((one.seen() >> edge & 1U) != 0 && plan_.carries(signal))
        one.latched(edge, signals.get(signal));
      status_.capturedPosition[first + edge] = one.position(edge);
    }
    status_.captured = static_cast<uint8_t>(status_.captured | one.captured() << first);
  }
}

void Drive402::readErrors(uint16_t told) {
  if (!power_.fault()) {
    errorCode_ = 0;
    askedError_ = false;
  }
  status_.error = power_.fault() || power_.stuck();
  if (power_.fault())
    status_.errorId = errorCode_ != 0 ? errorCode_ : told;
  else
    status_.errorId = power_.stuck() ? own_error::kPower : uint16_t{0};
}

PowerTarget Drive402::powerTarget() const {
  if (quickStop_)
    return power_.state() == PowerState::Enabled || power_.state() == PowerState::QuickStop
               ? PowerTarget::QuickStop
               : PowerTarget::Off;
  if (!command_.regulatorOn || shutDown_)
    return PowerTarget::Off;
  return command_.driveStart ? PowerTarget::Enabled : PowerTarget::SwitchedOn;
}

/// Set values are carried out.
bool Drive402::follows() const { return status_.driveStarted && homing_.letsFollow(); }

void Drive402::write(Signals &signals) {
  power_.demand(powerTarget(), command_.errorAckn);
  stepHoming();
  chooseMode();
  writeTargets(signals);
  uint16_t word = power_.controlword();
  const bool enabled =
      power_.state() == PowerState::Enabled && powerTarget() == PowerTarget::Enabled;
  const bool interpolates = modes_.current() == mode::kInterpolatedPosition;
  if (enabled && ((homing_.start() && modes_.current() == mode::kHoming) || interpolates))
    word = word | kModeBit;
  signals.set(Signal::Controlword, word);
  signals.setNumber(Signal::Mode, modes_.wanted());
  uint32_t probes = 0;
  for (size_t i = 0; i < kProbes; ++i)
    probes |= uint32_t{probes_[i].function()} << i * kProbeBits;
  signals.set(Signal::ProbeFunction, probes);
}

void Drive402::stepHoming() {
  HomingRun::Facts facts;
  facts.wanted = command_.homing;
  facts.possible = config_.homesItself && isSupported(mode::kHoming, facts_.supportedModes);
  facts.enabled = status_.driveStarted && !quickStop_;
  facts.inMode = modes_.current() == mode::kHoming;
  facts.inOther = controllerModeOf(modes_.current()) != 0;
  facts.modeLate = modes_.late();
  facts.rests = resting_ >= bus::kRestCycles;
  facts.statusword = statusword_;
  homing_.step(facts);
  askedOffset_ = askedOffset_ && facts.wanted;
}

/// The mode for the controller mode that is wanted, as far as the drive has it and takes it.
void Drive402::chooseMode() {
  if (homing_.wantsMode()) {
    modes_.want(mode::kHoming);
    return;
  }
  uint8_t wanted = command_.controllerMode;
  if (refused_ != 0 && wanted != refused_)
    refused_ = 0;
  const bool possible = wanted < 8 && (controllerModes_ & modeMask(wanted)) != 0;
  if (!possible || wanted == refused_)
    wanted = status_.controllerMode;
  const int8_t mode = modeFor(wanted, facts_.supportedModes);
  if (mode == mode::kNone)
    return;
  modes_.want(mode);
  if (modes_.late() && wanted != status_.controllerMode)
    refused_ = wanted; // back to the one that it has
}

int32_t Drive402::driveVelocity(double velocity) const {
  constexpr double kMost = 2147483647.0;
  return bus::saturated(velocity / config_.velocityScale, kMost);
}

int32_t Drive402::driveTorque(double torque) const {
  constexpr double kMost = 32767;
  return ratedTorque() > 0 ? bus::saturated(torque / ratedTorque() * kPerMille, kMost) : 0;
}

// What is regulated follows the command. What is not is where the axis is, so that nothing jumps
// when it begins to be; and what the drive regulates already, while its brake opens, stays.

uint32_t Drive402::targetPosition(bool regulated) const {
  if (regulated || (plan_.received & cyclic::kPosition) == 0)
    return command_.position;
  const bool opening =
      power_.state() == PowerState::Enabled && !status_.driveStarted && !power_.blocked();
  return opening && controllerModeOf(modes_.current()) == kPositionControl ? lastTarget_
                                                                           : status_.position;
}

int32_t Drive402::targetVelocity(uint8_t regulated, const Signals &signals) const {
  const bool ahead = plan_.carries(Signal::VelocityOffset);
  if (regulated == kVelocityControl || (regulated == kPositionControl && ahead))
    return driveVelocity(command_.velocity);
  if (ahead || power_.state() != PowerState::Enabled ||
      controllerModeOf(modes_.current()) == kVelocityControl ||
      (plan_.received & cyclic::kVelocity) == 0)
    return 0;
  return signals.number(Signal::Velocity);
}

int32_t Drive402::targetTorque(uint8_t regulated, const Signals &signals) const {
  if (regulated == kTorqueControl)
    return driveTorque(command_.torque);
  if (power_.state() != PowerState::Enabled ||
      controllerModeOf(modes_.current()) == kTorqueControl ||
      (plan_.received & cyclic::kTorque) == 0)
    return 0;
  return signals.number(Signal::Torque);
}

void Drive402::writeTargets(Signals &signals) {
  // A drive that shows a mode of no meaning for a while goes on in the one that it has.
  const bool shown = controllerModeOf(modes_.current()) != 0 || modes_.current() == mode::kHoming;
  const uint8_t taken = shown ? controllerModeOf(modes_.current()) : status_.controllerMode;
  const uint8_t regulated = follows() ? taken : uint8_t{0};
  const uint32_t position = targetPosition(regulated == kPositionControl);
  const int32_t velocity = targetVelocity(regulated, signals);
  if (regulated == kVelocityControl)
    targetMoves_ = velocity != 0;
  else if (regulated == kTorqueControl)
    targetMoves_ = resting_ < bus::kRestCycles;
  else
    targetMoves_ = position != lastTarget_;
  lastTarget_ = position;
  signals.set(Signal::TargetPosition, position);
  signals.setNumber(plan_.carries(Signal::VelocityOffset) ? Signal::VelocityOffset
                                                          : Signal::TargetVelocity,
                    velocity);
  signals.setNumber(Signal::TargetTorque, targetTorque(regulated, signals));
}

bool Drive402::velocityDoubtful() {
  const bool doubtful = doubtful_;
  doubtful_ = false;
  return doubtful;
}

bool Drive402::atRest() const {
  return !isRegulated(power_.state()) || resting_ >= bus::kRestCycles;
}

bool Drive402::commandedToMove() const {
  return (follows() && targetMoves_) || homing_.step() == HomingRun::Step::Cancelling;
}

ObjectWish Drive402::probeWish() const {
  for (size_t probe = 0; probe < kProbes; ++probe)
    for (size_t edge = 0; edge < TouchProbe::kEdges; ++edge)
      if ((probes_[probe].seen() >> edge & 1U) != 0)
        return {
            ObjectWish::Kind::Read,
            {static_cast<uint16_t>(object::kProbeValues + probe * TouchProbe::kEdges + edge), 0}};
  return {};
}

ObjectWish Drive402::wish() const {
  if (const ObjectWish wish = modes_.wish(); wish.kind != ObjectWish::Kind::None)
    return wish;
  if (const ObjectWish wish = probeWish(); wish.kind != ObjectWish::Kind::None)
    return wish;
  if (power_.fault() && !askedError_)
    return {ObjectWish::Kind::Read, object::kErrorCode};
  if (homing_.start() && !askedOffset_) // programs may have changed it
    return {ObjectWish::Kind::Read, object::kHomeOffset};
  return {};
}

void Drive402::answered(const ObjectWish &wish, const ObjectAnswer &answer) {
  const uint16_t index = wish.object.index;
  if (wish.object == object::kMode || wish.object == object::kModeDisplay) {
    modes_.answered(wish, answer);
    if (wish.object == object::kModeDisplay && answer.done &&
        controllerModeOf(modes_.current()) != 0)
      status_.controllerMode = controllerModeOf(modes_.current());
  } else if (wish.object == object::kHomeOffset) {
    askedOffset_ = true;
    if (answer.done)
      facts_.homeOffset = answer.value;
  } else if (wish.object == object::kErrorCode) {
    askedError_ = true;
    errorCode_ = answer.done ? static_cast<uint16_t>(answer.value) : uint16_t{0};
  } else if (answer.done && index >= object::kProbeValues &&
             index < object::kProbeValues + kProbes * TouchProbe::kEdges) {
    const size_t place = index - object::kProbeValues;
    probes_[place / TouchProbe::kEdges].latched(place % TouchProbe::kEdges, answer.value);
  }
}

} // namespace stride::can
