#include "drivers/dummy/dummy_drive.hpp"

#include "drivers/dummy/parameter_list.hpp"

#include "runtime/iec/math.h"

#include <strings.h>

namespace stride::dummy {
namespace {

/// A switch that follows its demand after some cycles on, at once off.
bool follow(bool demand, bool real, uint32_t &delay, uint32_t cycles) {
  if (!demand) {
    delay = 0;
    return false;
  }
  if (real)
    return true;
  return ++delay >= cycles;
}

/// Whether `now` has changed from FALSE to TRUE; `old` follows.
bool rising(BOOL now, BOOL &old) {
  const bool edge = now != 0 && old == 0;
  old = now;
  return edge;
}

double exactPosition(const Mechanics &mechanics) {
  return static_cast<double>(mechanics.position()) + mechanics.fraction();
}

double lag(int64_t reached, const Mechanics &mechanics) {
  return static_cast<double>(reached - mechanics.position()) - mechanics.fraction();
}

uint32_t counter(int64_t increments) { return static_cast<uint32_t>(increments); }

} // namespace

DummyDriver::Drive::Drive(const DriveParameters &given)
    : parameters(given), mechanics(given.mechanics, given.startPosition),
      demanded(given.startPosition), reached(given.startPosition) {
  Demand rest;
  rest.from = rest.to = given.startPosition;
  delayed.assign(given.deadTime, rest);
  status.position = counter(given.startPosition);
  status.received = given.received;
}

DummyDriver::DummyDriver(const bus::GroupSetup &setup) : sync_(setup) {
  drives_.reserve(setup.drives.size());
  for (const bus::DriveSetup &drive : setup.drives)
    drives_.emplace_back(driveParameters(drive.parameters));
  for (const bus::EncoderSetup &encoder : setup.encoders)
    encoders_.push_back(makeEncoder(encoder, setup));
}

DummyDriver::Encoder DummyDriver::makeEncoder(const bus::EncoderSetup &encoder,
                                              const bus::GroupSetup &setup) {
  const bus::SetupParameters &given = encoder.parameters;
  Encoder result;
  result.perUnit = given.number("dwRatioTechUnitsDenom") / given.number("iRatioTechUnitsNum");
  const auto modulo = static_cast<int64_t>(given.number("dwEncoderModulo"));
  result.modulo = modulo == 0 ? int64_t{1} << 32 : modulo;
  result.way = given.number("physics.own_velocity") * result.perUnit * setup.cycleSeconds;
  const std::string follows = given.text("physics.follows");
  for (size_t i = 0; !follows.empty() && i < setup.drives.size(); ++i) {
    const std::string &name = setup.drives[i].name;
    if (::strcasecmp(name.c_str(), follows.c_str()) == 0) {
      result.drive = i;
      result.follows = true;
    }
  }
  return result;
}

uint32_t DummyDriver::encoder(size_t encoder) const { return encoders_[encoder].count; }

void DummyDriver::show(Encoder &encoder) {
  int64_t increments = encoder.whole;
  if (encoder.follows) {
    const Drive &d = drives_[encoder.drive];
    increments = static_cast<int64_t>(stride::floor(
        exactPosition(d.mechanics) * d.parameters.unitsPerIncrement * encoder.perUnit + 0.5));
  }
  const int64_t count = increments % encoder.modulo;
  encoder.count = static_cast<uint32_t>(count < 0 ? count + encoder.modulo : count);
}

bus::StartUp DummyDriver::init(size_t drive, uint16_t &progress, bus::Message &message) {
  Drive &d = drives_[drive];
  if (d.sim != nullptr && d.sim->bFailStartUp != 0) {
    message.set(std::string_view("the simulation lets it fail (bFailStartUp)"));
    return bus::StartUp::Failed;
  }
  const uint32_t cycles = d.parameters.startUpCycles;
  ++d.started;
  progress = static_cast<uint16_t>(uint64_t{99} * d.started / cycles);
  if (d.started < cycles)
    return bus::StartUp::Busy;
  d.status.communication = !d.lost;
  return bus::StartUp::Started;
}

void DummyDriver::reset(size_t drive) {
  Drive &d = drives_[drive];
  d.started = 0;
  d.regulatorDelay = 0;
  d.brakeDelay = 0;
  d.command = {};
  d.command.position = d.status.position;
  d.status.communication = false;
  d.status.regulatorOn = false;
  d.status.driveStarted = false;
  d.status.captured = 0;
  d.status.error = false;
  d.status.errorId = 0;
  if (d.sim != nullptr && d.sim->bErrorPersistent == 0)
    d.sim->wDriveError = 0;
  d.mechanics.hold();
}

bus::DriveStatus DummyDriver::status(size_t drive) const { return drives_[drive].status; }

void DummyDriver::command(size_t drive, const bus::DriveCommand &command) {
  drives_[drive].command = command;
}

uint8_t DummyDriver::controllerModes(size_t drive) const { return drives_[drive].parameters.modes; }

void DummyDriver::bindData(size_t drive, void *data) {
  drives_[drive].sim = static_cast<DriveSim *>(data);
}

bool DummyDriver::startParameter(size_t drive, const bus::ParameterRequest &request) {
  Drive &d = drives_[drive];
  d.asked = request;
  d.askedCycles = d.parameters.parameterCycles;
  return true;
}

bool DummyDriver::pollParameter(size_t drive, bus::ParameterAnswer &answer) {
  Drive &d = drives_[drive];
  if (d.askedCycles > 0)
    return false;
  ParameterTarget target{d.parameters, d.mechanics, d.status, lag(d.reached, d.mechanics)};
  answer = answerParameter(target, d.asked);
  return true;
}

void DummyDriver::cancelParameter(size_t drive) { drives_[drive].askedCycles = 0; }

bus::SyncWake DummyDriver::waitSync(int64_t afterNs, int64_t deadlineNs, bus::BusClock &clock) {
  return sync_.wait(afterNs, deadlineNs, clock);
}

/// The SYNC with which a cycle begins, and what there is to say when it has not come.
void DummyDriver::giveSync() {
  if (host_ == nullptr || stopped_)
    return;
  missingUs_ = sync_.missingUs();
  if (missingUs_ == 0) {
    host_->raise(bus::BusEvent::Sync);
    return;
  }
  bus::Message news;
  problem(news);
  host_->say(news);
}

void DummyDriver::problem(bus::Message &text) const {
  if (missingUs_ != 0)
    text.set(std::string_view("no SYNC for "), missingUs_,
             std::string_view(" us: the task has run without it"));
}

void DummyDriver::applicationStopped() {
  stopped_ = true;
  for (Drive &d : drives_)
    d.stops = d.parameters.quickStop > 0 && d.status.regulatorOn && d.status.driveStarted &&
              d.homing.state() == bus::Homing::None && d.status.controllerMode != kTorqueMode;
}

bool DummyDriver::atRest() const {
  for (const Drive &d : drives_)
    if (d.stops && d.velocityDemanded != 0)
      return false;
  return true;
}

/// Set values of a drive that brakes by itself.
Demand DummyDriver::quickStop(Drive &d) {
  const double cycle = d.parameters.mechanics.cycle;
  const double deceleration = d.parameters.quickStop;
  const double before = d.velocityDemanded;
  const double speed = before < 0 ? -before : before;
  const double time = speed > deceleration * cycle ? cycle : speed / deceleration;
  const double left = speed > deceleration * cycle ? speed - deceleration * cycle : 0;
  Demand own;
  own.mode = d.status.controllerMode;
  own.from = d.demanded;
  own.velocityFrom = before;
  own.velocity = d.velocityDemanded = before < 0 ? -left : left;
  d.stopRest += 0.5 * (before + own.velocity) * time;
  const double whole = stride::floor(d.stopRest + 0.5);
  d.stopRest -= whole;
  own.to = d.demanded = d.reached = own.from + static_cast<int64_t>(whole);
  return own;
}

void DummyDriver::executeStart() {
  giveSync();
  for (Drive &d : drives_) {
    if (d.sim != nullptr)
      disturb(d);
    const bool held = d.sim != nullptr && d.sim->bHoldParameters != 0;
    if (d.askedCycles > 0 && d.status.communication && !held)
      --d.askedCycles;
    updateSwitches(d);
    if (d.sim != nullptr)
      publish(d);
  }
  for (Encoder &encoder : encoders_)
    show(encoder);
}

/// What programs have written into the drive's DUMMY_DRIVE_SIM.
void DummyDriver::disturb(Drive &d) {
  DriveSim &sim = *d.sim;
  const bool running = d.started >= d.parameters.startUpCycles;
  d.status.communication = running && !d.lost && sim.bLoseCommunication == 0;
  if (running && sim.wDriveError != 0) {
    d.status.error = true;
    d.status.errorId = sim.wDriveError;
  }
  if (rising(sim.bMoveByHand, sim.bOldHand) && !(d.status.regulatorOn && d.status.driveStarted)) {
    const double place = sim.fHandPosition / d.parameters.unitsPerIncrement;
    d.mechanics.place(static_cast<int64_t>(stride::floor(place + 0.5)));
    d.status.position = counter(d.mechanics.position());
  }
  if (rising(sim.bForceIndex, sim.bOldIndex)) {
    d.index = true;
    d.indexMark = exactPosition(d.mechanics);
  }
  for (size_t i = 0; i < bus::DriveStatus::kCaptureInputs; ++i)
    if (rising(sim.abProbe.v[i], sim.abOldProbe.v[i]))
      latch(d, i, exactPosition(d.mechanics));
}

void DummyDriver::updateSwitches(Drive &d) {
  const DriveParameters &p = d.parameters;
  const double place = exactPosition(d.mechanics);
  d.status.limitPositive = (p.hasLimitPositive && place >= p.limitPositive) ||
                           (d.sim != nullptr && d.sim->bForceLimitPositive != 0);
  d.status.limitNegative = (p.hasLimitNegative && place <= p.limitNegative) ||
                           (d.sim != nullptr && d.sim->bForceLimitNegative != 0);
  d.status.homeSwitch =
      p.home.actuated(place, p.period) || (d.sim != nullptr && d.sim->bForceHomeSwitch != 0);
}

/// What programs may read in DUMMY_DRIVE_SIM.
void DummyDriver::publish(Drive &d) {
  DriveSim &sim = *d.sim;
  const double units = d.parameters.unitsPerIncrement;
  sim.fPosition = exactPosition(d.mechanics) * units;
  sim.fVelocity = d.mechanics.velocity() * units;
  sim.fLag = lag(d.reached, d.mechanics) * units;
  sim.fTorque = d.mechanics.torque();
  sim.bSaturated = d.mechanics.saturated();
  sim.bLimitPositive = d.status.limitPositive;
  sim.bLimitNegative = d.status.limitNegative;
  sim.bHomeSwitch = d.status.homeSwitch;
  sim.bHoming = d.status.homing != bus::Homing::None;
  sim.bIndex = d.index;
  if (d.index) {
    sim.fIndexPosition = d.indexMark * units;
    ++sim.udiIndexCount;
  }
  d.index = false;
}

void DummyDriver::latch(Drive &d, size_t input, double increments) {
  const auto bit = static_cast<uint8_t>(1U << input);
  if ((d.command.capture & d.parameters.probeInputs & bit) == 0 || (d.status.captured & bit) != 0)
    return;
  d.status.captured = d.status.captured | bit;
  d.status.capturedPosition[input] = counter(static_cast<int64_t>(stride::floor(increments + 0.5)));
}

void DummyDriver::executeEnd() {
  for (Drive &d : drives_) {
    d.status.captured = d.status.captured & d.command.capture;
    switchPower(d);
    move(d);
  }
  for (Encoder &encoder : encoders_) {
    encoder.rest += encoder.way;
    const double whole = stride::floor(encoder.rest);
    encoder.whole += static_cast<int64_t>(whole);
    encoder.rest -= whole;
  }
}

void DummyDriver::switchPower(Drive &d) {
  if (d.command.errorAckn && d.status.communication &&
      (d.sim == nullptr || d.sim->bErrorPersistent == 0)) {
    d.status.error = false;
    d.status.errorId = 0;
    if (d.sim != nullptr)
      d.sim->wDriveError = 0;
  }
  const bool healthy = d.status.communication && !d.status.error;
  const bool stuck = d.sim != nullptr && d.sim->bRegulatorStuck != 0;
  const bool jammed = d.sim != nullptr && d.sim->bBrakeStuck != 0;
  d.status.regulatorOn = follow(d.command.regulatorOn && healthy && !stuck, d.status.regulatorOn,
                                d.regulatorDelay, d.parameters.switchCycles);
  d.status.driveStarted = follow(d.command.driveStart && healthy && !jammed, d.status.driveStarted,
                                 d.brakeDelay, d.parameters.switchCycles);
  if (((d.parameters.modes >> d.command.controllerMode) & 1U) != 0)
    d.status.controllerMode = d.command.controllerMode;
}

/// The set values that reach the drive in this cycle.
Demand DummyDriver::nextDemand(Drive &d) {
  Demand demand;
  demand.from = d.demanded;
  d.demanded += static_cast<int32_t>(d.command.position - counter(d.demanded));
  demand.to = d.demanded;
  demand.velocityFrom = d.velocityDemanded;
  demand.velocity = d.velocityDemanded = d.command.velocity;
  demand.torque = d.command.torque;
  demand.homing = d.command.homing && d.sim != nullptr; // an ideal drive has none
  if (!d.delayed.empty()) {
    std::swap(demand, d.delayed[d.oldest]);
    d.oldest = (d.oldest + 1) % d.delayed.size();
  }
  demand.mode = d.status.controllerMode;
  d.reached = demand.to;
  return demand;
}

/// The set values that the drive makes itself while it looks for its reference; others stay.
Demand DummyDriver::home(Drive &d, const Demand &demand) {
  if (!demand.homing) {
    d.homing.clear();
    return demand;
  }
  const bool powered = d.status.regulatorOn && d.status.driveStarted;
  if (d.homing.state() == bus::Homing::None)
    d.homing.begin(d.parameters,
                   demand.mode == kPositionMode ? demand.from : d.mechanics.position(),
                   d.status.homeSwitch);
  if (!powered || (d.sim != nullptr && d.sim->bFailHoming != 0))
    d.homing.fail();
  const Demand own = d.homing.next();
  d.demanded = d.reached = own.to;
  d.velocityDemanded = own.velocity;
  return own;
}

void DummyDriver::move(Drive &d) {
  if (d.started < d.parameters.startUpCycles) {
    d.demanded = d.reached = d.mechanics.position(); // nobody has told it where to be
    d.command.position = counter(d.demanded);
  }
  const double before = exactPosition(d.mechanics);
  const Demand demand = d.stops ? quickStop(d) : home(d, nextDemand(d));
  const double load = d.sim != nullptr ? d.sim->fLoadTorque : 0.0;
  if (!d.status.driveStarted)
    d.mechanics.hold();
  else if (d.status.regulatorOn)
    d.mechanics.regulate(demand, load);
  else
    d.mechanics.coast(load);
  const double after = exactPosition(d.mechanics);
  d.status.position = counter(d.mechanics.position());
  d.status.velocity = d.mechanics.velocity();
  d.status.torque = d.mechanics.torque();
  updateSwitches(d);
  d.homing.look(before, after, d.status.homeSwitch, d.status.limitPositive, d.status.limitNegative);
  d.status.homing = d.homing.state();
  d.status.homePosition = counter(static_cast<int64_t>(stride::floor(d.homing.reference() + 0.5)));
  double mark = 0;
  if (d.parameters.index.passed(before, after, mark)) {
    d.index = true;
    d.indexMark = mark;
  }
  if (d.parameters.probe.passed(before, after, mark))
    latch(d, 0, mark);
}

void DummyDriver::raiseError(size_t drive, uint16_t errorId) {
  drives_[drive].status.error = true;
  drives_[drive].status.errorId = errorId;
}

void DummyDriver::setCommunication(size_t drive, bool answers) {
  Drive &d = drives_[drive];
  d.lost = !answers;
  d.status.communication = answers && d.started >= d.parameters.startUpCycles;
}

void DummyDriver::setPosition(size_t drive, uint32_t position) {
  Drive &d = drives_[drive];
  d.mechanics.place(d.mechanics.position() +
                    static_cast<int32_t>(position - counter(d.mechanics.position())));
  d.status.position = position;
}

std::unique_ptr<bus::AxisDriver> makeDriver(const bus::GroupSetup &setup) {
  return std::make_unique<DummyDriver>(setup);
}

uint64_t driveDataLayout() { return ::st::DummyDrive::DUMMY_DRIVE_SIM__layout__; }

bus::GroupSetup plainSetup(size_t drives, double cycleSeconds) {
  bus::GroupSetup setup(kSchema, cycleSeconds);
  for (size_t i = 0; i < drives; ++i)
    setup.addDrive({}, static_cast<uint32_t>(i));
  return setup;
}

} // namespace stride::dummy
