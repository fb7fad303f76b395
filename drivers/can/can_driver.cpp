#include "drivers/can/can_driver.hpp"

#include "drivers/can/master/frames.hpp"

#include "st/SM_CAN/SMC_CAN_COUNTERS.h"

#include <algorithm>
#include <limits>

namespace stride::can {
namespace {

static_assert(cyclic::kPosition == bus::kPosition && cyclic::kVelocity == bus::kVelocity &&
              cyclic::kTorque == bus::kTorque && cyclic::kCurrent == bus::kCurrent);

/// So long set values may brake an axis after the application has stopped.
constexpr double kStopPatience = 1; // s
/// And so long until all drives are off.
constexpr double kOffPatience = 3; // s
/// I/O devices are told their safe values, and have them from the SYNC after that on.
constexpr uint32_t kIoCycles = 3;
/// A drive that is not told to move for so many cycles stands.
constexpr uint32_t kStandingCycles = 10;

std::string_view nameOf(NodeConfig::Kind kind) {
  switch (kind) {
  case NodeConfig::Kind::Encoder:
    return "encoder: ";
  case NodeConfig::Kind::Io:
    return "I/O device: ";
  case NodeConfig::Kind::SyncDevice:
    return "SYNC device: ";
  case NodeConfig::Kind::Drive:
    break;
  }
  return "";
}

} // namespace

CanDriver::CanDriver(const bus::GroupSetup &setup, std::unique_ptr<Port> port)
    : CanDriver(canSetup(setup), std::move(port)) {
  if (ParameterLoader::isNeeded(setup))
    loader_ = std::make_unique<ParameterLoader>(setup);
}

CanDriver::CanDriver(const CanSetup &setup, std::unique_ptr<Port> port)
    : master_(setup.master, std::move(port)), load_(setup.load), faults_(setup.faults),
      notes_(setup.notes),
      periodNs_(std::max<int64_t>(static_cast<int64_t>(setup.master.cycle * 1e9 + 0.5), 1)),
      stopPatience_(cyclesOf(kStopPatience, setup.master.cycle)),
      offPatience_(cyclesOf(kOffPatience, setup.master.cycle)), standing_(setup.faults.size()),
      encoders_(setup.encoders), places_(setup.drives), driveNodes_(setup.driveNodes),
      hasIos_(setup.hasIos), othersFailed_(setup.master.nodes.size() - setup.driveNodes) {}

void CanDriver::attach(bus::DriverHost &host) {
  host_ = &host;
  master_.attach(host);
  for (const std::string &note : notes_)
    master_.news().say(std::string_view(note));
  if (!load_.fits())
    master_.news().say("SYNC and PDOs need ", static_cast<uint32_t>(load_.share * 100 + 0.5),
                       " % of the cycle: it must have ", load_.shortestCycle, " us");
}

bool CanDriver::bindGroupData(void *data, uint64_t layout) {
  if (layout != ::st::SM_CAN::SMC_CAN_COUNTERS__layout__)
    return false;
  counters_ = data;
  return true;
}

void CanDriver::showCounters() {
  const auto wrapped = [](uint64_t count) { return static_cast<uint32_t>(count); };
  auto &shown = *static_cast<::st::SM_CAN::SMC_CAN_COUNTERS *>(counters_);
  const MasterCounters &own = master_.counters();
  const PortCounters port = master_.port().counters();
  shown.byBusState = static_cast<uint8_t>(master_.busState());
  shown.udiSyncMissed = wrapped(own.syncMissed);
  shown.udiSyncTwice = wrapped(own.syncTwice);
  shown.udiForeignSyncs = wrapped(own.foreignSyncs);
  shown.udiSendQueueFull = wrapped(own.sendQueueFull);
  shown.udiSetValuesLate = wrapped(own.setValuesLate);
  shown.udiReadsLate = wrapped(own.readsLate);
  shown.udiOverloads = wrapped(own.overloads);
  shown.udiFramesSent = wrapped(own.framesSent);
  shown.udiFramesReceived = wrapped(own.framesReceived);
  shown.udiFramesLost = wrapped(port.dropped);
  shown.udiErrorFrames = wrapped(port.errorFrames);
  shown.udiRestarts = wrapped(port.restarts);
}

void CanDriver::executeStart() {
  master_.executeStart();
  if (counters_ != nullptr)
    showCounters();
  startOthers();
  if (hasIos_)
    for (size_t i = 0; i < master_.nodeCount(); ++i)
      master_.node(i).showIo();
  if (host_ != nullptr && !stopped_ && master_.syncRuns())
    host_->raise(bus::BusEvent::Sync);
}

/// Encoders, I/O devices and the SYNC device belong to no axis: nobody else asks for their
/// start-up.
void CanDriver::startOthers() {
  for (size_t i = 0; i < othersFailed_.size(); ++i) {
    Node &node = master_.node(driveNodes_ + i);
    if (othersFailed_[i] || node.started() || master_.busLost())
      continue;
    uint16_t progress = 0;
    bus::Message message;
    if (node.init(progress, message, master_.news()) != bus::StartUp::Failed)
      continue;
    othersFailed_[i] = true;
    master_.news().say(nameOf(node.config().kind), message.text());
  }
}

/// Those that have failed or are lost begin anew.
void CanDriver::resetOthers() {
  for (size_t i = 0; i < othersFailed_.size(); ++i) {
    if (!othersFailed_[i] && master_.node(driveNodes_ + i).loss() == NodeLoss::None)
      continue;
    master_.node(driveNodes_ + i).reset();
    othersFailed_[i] = false;
  }
}

uint32_t CanDriver::encoder(size_t encoder) const {
  const CanSetup::EncoderSource &source = encoders_[encoder];
  return source.fault.empty() ? master_.node(source.node).signal(source.signal, source.device) : 0;
}

bool CanDriver::encoderWorks(size_t encoder) const {
  const CanSetup::EncoderSource &source = encoders_[encoder];
  return source.fault.empty() && master_.node(source.node).communication();
}

void CanDriver::executeEnd() {
  if (stopped_)
    stop();
  master_.executeEnd();
}

/// Set values brake the axes; who does not stand then stops by himself. Who stands goes off.
void CanDriver::stop() {
  stopCycles_ = std::min(stopCycles_ + 1, offPatience_);
  for (size_t i = 0; i < places_.size(); ++i) {
    Drive402 &drive = driveAt(i);
    standing_[i] = drive.commandedToMove() ? 0 : std::min(standing_[i] + 1, kStandingCycles);
    if (standing_[i] == kStandingCycles)
      drive.shutDown();
    else if (stopCycles_ >= stopPatience_)
      drive.quickStop();
  }
}

bus::StartUp CanDriver::init(size_t drive, uint16_t &progress, bus::Message &message) {
  progress = 0;
  if (awaits_ && !takeParameters())
    return bus::StartUp::Busy;
  if (!faults_[drive].empty()) {
    message.set(std::string_view(faults_[drive]));
    return bus::StartUp::Failed;
  }
  if (master_.busLost() && !nodeOf(drive).started()) {
    master_.problem(message);
    return bus::StartUp::Failed;
  }
  return nodeOf(drive).init(progress, message, master_.news(), places_[drive].device);
}

void CanDriver::reset(size_t drive) {
  nodeOf(drive).reset(places_[drive].device);
  if (loader_ != nullptr) {
    loader_->request();
    awaits_ = true;
  }
  resetOthers();
}

/// What the files of drives say now is for those whose start-up has not begun; others keep what
/// they have been given. FALSE: they are still being read.
bool CanDriver::takeParameters() {
  if (!loader_->poll())
    return false;
  awaits_ = false;
  LoadedParameters &loaded = loader_->loaded();
  for (size_t i = 0; i < std::min(loaded.steps.size(), driveNodes_); ++i)
    if (master_.node(i).idle())
      master_.node(i).exchangeSteps(loaded.steps[i]);
  for (size_t i = 0; i < faults_.size(); ++i)
    if (nodeOf(i).idle())
      faults_[i].swap(loaded.faults[i]);
  for (const std::string &note : loaded.notes)
    master_.news().say(std::string_view(note));
  return true;
}

bus::DriveStatus CanDriver::status(size_t drive) const {
  return nodeOf(drive).status(places_[drive].device);
}

void CanDriver::command(size_t drive, const bus::DriveCommand &command) {
  driveAt(drive).command(command);
}

uint8_t CanDriver::controllerModes(size_t drive) const { return driveAt(drive).controllerModes(); }

uint8_t CanDriver::captureInputs(size_t drive) const {
  return nodeOf(drive).config().device(places_[drive].device).drive.probeInputs;
}

bool CanDriver::startParameter(size_t drive, const bus::ParameterRequest &request) {
  if (!nodeOf(drive).started())
    return false;
  nodeOf(drive).parameters(places_[drive].device).start(request);
  return true;
}

bool CanDriver::pollParameter(size_t drive, bus::ParameterAnswer &answer) {
  return nodeOf(drive).parameters(places_[drive].device).poll(answer);
}

void CanDriver::cancelParameter(size_t drive) {
  nodeOf(drive).cancelParameter(places_[drive].device);
}

bus::SyncWake CanDriver::waitSync(int64_t afterNs, int64_t deadlineNs, bus::BusClock &clock) {
  const int64_t monotonic = clock.monotonicNs(deadlineNs);
  const bool isVirtual = monotonic == std::numeric_limits<int64_t>::max();
  if (!isVirtual && master_.nodeGivesSync()) {
    const uint32_t syncs = master_.awaitSync(monotonic);
    if (syncs == 0) {
      clock.sleepUntil(deadlineNs); // a port that cannot wait
      return {deadlineNs};
    }
    return {clock.nowNs(), true, syncs - 1};
  }
  // SYNC is where the cycle begins: the master's, or that of a bus that goes with virtual time.
  const int64_t now = clock.nowNs();
  int64_t next = afterNs < 0 ? now : afterNs + periodNs_;
  uint64_t missed = 0;
  if (next < now) {
    missed = static_cast<uint64_t>((now - next) / periodNs_);
    next += static_cast<int64_t>(missed) * periodNs_;
  }
  if (next <= now)
    return {next, master_.syncRuns(), missed};
  const bool arrives = next <= deadlineNs;
  clock.sleepUntil(arrives ? next : deadlineNs);
  return {arrives ? next : deadlineNs, arrives && master_.syncRuns(), missed};
}

void CanDriver::applicationStopped() { stopped_ = true; }

bool CanDriver::atRest() const {
  if (!stopped_ || stopCycles_ >= offPatience_)
    return true;
  if (hasIos_ && stopCycles_ < kIoCycles)
    return false;
  for (size_t i = 0; i < places_.size(); ++i) {
    if (!nodeOf(i).communication())
      continue;
    if (driveAt(i).powerState() == PowerState::Enabled || !driveAt(i).atRest())
      return false;
  }
  return true;
}

void CanDriver::problem(bus::Message &text) const { master_.problem(text); }

} // namespace stride::can
