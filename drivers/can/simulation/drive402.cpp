#include "drivers/can/simulation/drive402.hpp"

#include <algorithm>
#include <array>

namespace stride::can::simulation {
namespace {

/// 6098h: what the reference run can do.
constexpr std::array<int64_t, 9> kMethods = {0, 17, 18, 19, 21, 33, 34, 35, 37};

struct ErrorClass {
  uint16_t first;
  uint8_t registerBits;
};

/// Bits of the error register, by the class of an error code. [CiA 301, 1001h; CiA 402]
constexpr ErrorClass kClasses[] = {{0xFF00, 0x80}, {0x8400, 0x20}, {0x8100, 0x10}, {0x5000, 0x20},
                                   {0x4000, 0x08}, {0x3000, 0x04}, {0x2000, 0x02}, {0, 0x01}};

uint8_t registerBits(uint16_t code) {
  const auto *const found =
      std::find_if(std::begin(kClasses), std::end(kClasses),
                   [code](const ErrorClass &one) { return code >= one.first; });
  return found->registerBits;
}

} // namespace

DriveAxis::DriveAxis(const Drive402Setup &setup, SimulatedDrive402 &node)
    : node_(node), shift_(static_cast<uint16_t>(kAxisObjects * setup.axis)),
      parameters_(setup.drive), homingParameters_(setup.drive), ratedTorque_(setup.ratedTorque),
      velocityScale_(setup.velocityScale), secondEncoder_(setup.secondEncoder),
      o_(AxisObjects{node.objects(), shift_}),
      mechanics_(setup.drive.mechanics, setup.drive.startPosition),
      cycle_(setup.drive.mechanics.cycle) {}

bool DriveAxis::powered() const { return regulates() || power_ == PowerState::SwitchedOn; }

/// Power stage on and brake open.
bool DriveAxis::regulates() const {
  return power_ == PowerState::OperationEnabled || power_ == PowerState::QuickStopActive ||
         power_ == PowerState::FaultReaction;
}

bool DriveAxis::positions() const {
  return mode_ != kProfileVelocity && mode_ != kProfileTorque && mode_ != kSyncVelocity &&
         mode_ != kSyncTorque;
}

/// Positions are those that the mechanics have; references are forgotten.
void DriveAxis::reset() noexcept {
  power_ = PowerState::SwitchOnDisabled;
  switching_ = afterStop_ = PowerState::NotReady;
  stopping_ = false;
  fault_ = 0;
  control_ = probes_ = 0;
  mode_ = 0;
  homing_ = HomingState::Idle;
  run_.clear();
  mechanics_.hold();
  origin_ = 0;
  demanded_ = target_ = from_ = mechanics_.position();
  velocityDemanded_ = torqueDemanded_ = demandRest_ = lagSeconds_ = 0;
  following_ = false;
  cycleNs_ = node_.nowNs();
  freely_ = true;
  updateSwitches();
  updateObjects();
}

void DriveAxis::change(PowerState state) noexcept {
  const bool before = regulates();
  power_ = state;
  switching_ = afterStop_ = PowerState::NotReady;
  stopping_ = false;
  if (regulates() && before)
    return;
  homing_ = HomingState::Idle;
  demanded_ = target_ = from_ = mechanics_.position();
  demandRest_ = lagSeconds_ = 0;
  velocityDemanded_ = torqueDemanded_ = 0;
}

/// The drive comes to rest by itself, and is in that state then; NotReady: it holds there.
void DriveAxis::brakeTo(PowerState target, const Entry &ramp) noexcept {
  if (!positions())
    velocityDemanded_ = mechanics_.velocity();
  run_.clear();
  homing_ = homing_ == HomingState::Attained ? homing_ : HomingState::Idle;
  stopping_ = true;
  afterStop_ = target;
  deceleration_ = rampOf(ramp);
}

void DriveAxis::leaveOperation(PowerState target) noexcept {
  constexpr int64_t kStays = 5; ///< 605Ah from here on: the drive stays in quick stop active.
  if (target == PowerState::QuickStopActive) {
    const int64_t option = o_.quickStopOption.asSigned();
    if (option == 0) {
      change(PowerState::SwitchOnDisabled);
      return;
    }
    power_ = target;
    brakeTo(option < kStays ? PowerState::SwitchOnDisabled : PowerState::NotReady,
            option == 1 || option == kStays ? o_.deceleration : o_.quickDeceleration);
    return;
  }
  const bool ramps = (target == PowerState::SwitchedOn && o_.disableOption.value == 1) ||
                     (target == PowerState::ReadyToSwitchOn && o_.shutdownOption.value == 1);
  if (ramps)
    brakeTo(target, o_.deceleration);
  else
    change(target);
}

/// One transition for a controlword.
void DriveAxis::control(uint16_t before, uint16_t word) noexcept {
  if (power_ == PowerState::Fault) {
    if ((word & ~before & kFaultReset) == 0 || persistent_)
      return;
    const uint16_t code = fault_;
    fault_ = 0;
    node_.settle(code);
    if (sim_ != nullptr)
      sim_->wDriveError = 0;
    change(PowerState::SwitchOnDisabled);
    return;
  }
  const PowerState next = after(power_, commandOf(word));
  if (switching_ == next && next != power_)
    return;
  switching_ = PowerState::NotReady;
  if (next == power_)
    return;
  if (power_ == PowerState::OperationEnabled) {
    // On its way out already: only what is quicker counts.
    const bool leaves = stopping_ && afterStop_ != PowerState::NotReady;
    if (!leaves || next == PowerState::SwitchOnDisabled || next == PowerState::QuickStopActive)
      leaveOperation(next);
    return;
  }
  if (power_ == PowerState::QuickStopActive) {
    if (next == PowerState::SwitchOnDisabled || afterStop_ == PowerState::NotReady)
      change(next);
    return;
  }
  if (next != PowerState::SwitchedOn && next != PowerState::OperationEnabled) {
    change(next);
    return;
  }
  switching_ = next;
  const auto cycles = static_cast<int64_t>(std::max(parameters_.switchCycles, 1U) - 1);
  switchedNs_ = node_.nowNs() + cycles * periodNs();
  finishSwitching();
}

void DriveAxis::finishSwitching() noexcept {
  if (switching_ == PowerState::NotReady || node_.nowNs() < switchedNs_)
    return;
  const bool on = switching_ == PowerState::SwitchedOn;
  if (sim_ != nullptr && (on ? sim_->bRegulatorStuck : sim_->bBrakeStuck) != 0)
    return;
  change(switching_);
}

void DriveAxis::finishStop() noexcept {
  if (!stopping_ || velocityDemanded_ != 0 || afterStop_ == PowerState::NotReady)
    return;
  change(afterStop_);
}

void DriveAxis::raiseError(uint16_t code) noexcept {
  if (power_ == PowerState::Fault || power_ == PowerState::FaultReaction || code == 0)
    return;
  fault_ = code;
  node_.raise(code, registerBits(code));
  switching_ = PowerState::NotReady;
  if (!regulates() || o_.faultOption.value == 0) {
    change(PowerState::Fault);
  } else {
    power_ = PowerState::FaultReaction;
    brakeTo(PowerState::Fault, o_.faultOption.value == 1 ? o_.deceleration : o_.quickDeceleration);
  }
  updateObjects();
}

/// What 6007h says. `always`: also without power.
void DriveAxis::abortConnection(bool always) noexcept {
  switch (o_.abortOption.value) {
  case 1:
    if (always || powered())
      raiseError(kErrorLifeGuard);
    break;
  case 2:
    if (powered())
      change(PowerState::SwitchOnDisabled);
    break;
  case 3:
    if (power_ == PowerState::OperationEnabled)
      leaveOperation(PowerState::QuickStopActive);
    break;
  default:
    break;
  }
  updateObjects();
}

void DriveAxis::connectionLost() noexcept { abortConnection(true); }

void DriveAxis::entered(NmtState state) noexcept {
  if (state == NmtState::Stopped || state == NmtState::Initialising)
    abortConnection(false);
  updateObjects();
}

/// Whoever configures the drive is told that somebody else has it.
bool DriveAxis::isElsewhere() const {
  return sim_ != nullptr && sim_->bFailStartUp != 0 && node_.state() == NmtState::PreOperational;
}

Abort DriveAxis::check(const Entry &entry, uint64_t value) const noexcept {
  const auto number = static_cast<int64_t>(value);
  switch (entry.row.index - shift_) {
  case 0x6060: {
    const uint64_t modes = o_.supportedModes.value;
    const bool known = number > 0 && number <= 32 && (modes >> (number - 1) & 1U) != 0;
    return known || number == 0 ? Abort::None : Abort::Value;
  }
  case 0x605A:
    return number == 4 ? Abort::Value : Abort::None;
  case 0x6098:
    return std::find(kMethods.begin(), kMethods.end(), number) != kMethods.end() ? Abort::None
                                                                                 : Abort::Value;
  default:
    return Abort::None;
  }
}

void DriveAxis::written(Entry &entry) noexcept {
  if (&entry == &o_.controlword) {
    const uint16_t before = control_;
    control_ = static_cast<uint16_t>(entry.value);
    control(before, control_);
    updateObjects();
  } else if (&entry == &o_.probeFunction) {
    const uint64_t before = probes_;
    probes_ = static_cast<uint16_t>(entry.value);
    configureProbes(before);
  }
}

void DriveAxis::sync() noexcept {
  disturb();
  move(node_.nowNs());
  freely_ = false;
}

void DriveAxis::synchronized() noexcept {
  latch();
  updateObjects();
}

/// No SYNC has come: the controllers go on by themselves.
void DriveAxis::time() noexcept {
  disturb();
  move(cycleNs_ + periodNs());
  freely_ = true;
  latch();
  updateObjects();
}

int64_t DriveAxis::nextNs() const noexcept {
  const int64_t period = periodNs();
  return cycleNs_ + (freely_ ? period : period + period / 2);
}

void DriveAxis::place(int64_t position) noexcept {
  if (regulates())
    return;
  mechanics_.place(position);
  demanded_ = target_ = from_ = position;
  updateObjects();
}

int32_t DriveAxis::position() const { return static_cast<int32_t>(counter(mechanics_.position())); }

SimulatedDrive402::SimulatedDrive402(const Drive402Setup &setup)
    : CanopenNode(setup.node, driveRows(setup)) {
  axes_.reserve(1 + setup.further.size());
  axes_.emplace_back(setup, *this);
  for (const Drive402Setup &other : setup.further)
    axes_.emplace_back(other, *this);
}

void SimulatedDrive402::raise(uint16_t code, uint8_t registerBits) noexcept {
  emergency().raise(code, registerBits);
}

/// Unless another axis has the same error.
void SimulatedDrive402::settle(uint16_t code) noexcept {
  if (std::none_of(axes_.begin(), axes_.end(),
                   [code](const DriveAxis &axis) { return axis.fault() == code; }))
    emergency().clear(code);
}

void SimulatedDrive402::onReset() noexcept {
  for (DriveAxis &axis : axes_)
    axis.reset();
}

void SimulatedDrive402::onState(NmtState state) noexcept {
  for (DriveAxis &axis : axes_)
    axis.entered(state);
}

Abort SimulatedDrive402::onWrite(const Entry &entry, uint64_t value) noexcept {
  const bool profile = entry.row.index >= kProfileObjects;
  const int owner = profile ? (entry.row.index - kProfileObjects) / kAxisObjects : -1;
  for (const DriveAxis &axis : axes_) {
    const bool own = axis.number() == owner;
    if ((own || !profile) && axis.isElsewhere())
      return Abort::LocalControl;
    if (own)
      return axis.check(entry, value);
  }
  return Abort::None;
}

void SimulatedDrive402::onWritten(Entry &entry) noexcept {
  for (DriveAxis &axis : axes_)
    axis.written(entry);
}

/// What programs do to one of the axes they do to the connector of all.
void SimulatedDrive402::disturb() noexcept {
  const auto any = [this](bool (DriveAxis::*wants)() const) {
    return std::any_of(axes_.begin(), axes_.end(),
                       [wants](const DriveAxis &axis) { return (axis.*wants)(); });
  };
  if (std::none_of(axes_.begin(), axes_.end(),
                   [](const DriveAxis &axis) { return axis.isWatched(); }))
    return;
  setSilent(any(&DriveAxis::isUnplugged));
  setDeaf(any(&DriveAxis::isDeaf));
}

void SimulatedDrive402::onSync() noexcept {
  disturb();
  for (DriveAxis &axis : axes_)
    axis.sync();
}

void SimulatedDrive402::onSynchronized() noexcept {
  for (DriveAxis &axis : axes_)
    axis.synchronized();
}

void SimulatedDrive402::onConnectionLost() noexcept {
  for (DriveAxis &axis : axes_)
    axis.connectionLost();
}

void SimulatedDrive402::onTime() noexcept {
  disturb();
  for (DriveAxis &axis : axes_)
    if (nowNs() >= axis.nextNs())
      axis.time();
}

int64_t SimulatedDrive402::nextDeviceNs() const noexcept {
  int64_t next = kNever;
  for (const DriveAxis &axis : axes_)
    next = std::min(next, axis.nextNs());
  return next;
}

} // namespace stride::can::simulation
