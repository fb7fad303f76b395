#include "drivers/sercos/sercos_driver.hpp"

#include <algorithm>

namespace stride::sercos {
namespace {

static_assert(cyclic::kPosition == bus::kPosition && cyclic::kVelocity == bus::kVelocity &&
              cyclic::kTorque == bus::kTorque && cyclic::kCurrent == bus::kCurrent);

/// So long set values may brake an axis after the application has stopped.
constexpr double kStopPatience = 1; // s
/// And so long until all drives are off.
constexpr double kOffPatience = 3; // s
/// A drive that is not told to move for so many cycles stands.
constexpr uint32_t kStandingCycles = 10;

} // namespace

SercosDriver::SercosDriver(const bus::GroupSetup &setup, std::unique_ptr<Ring> ring)
    : SercosDriver(sercosSetup(setup), std::move(ring)) {}

SercosDriver::SercosDriver(const SercosSetup &setup, std::unique_ptr<Ring> ring)
    : master_(setup.master, std::move(ring)), faults_(setup.faults), encoders_(setup.encoders),
      standing_(setup.faults.size()), stopPatience_(cyclesOf(kStopPatience, setup.master.cycle)),
      offPatience_(cyclesOf(kOffPatience, setup.master.cycle)) {}

void SercosDriver::attach(bus::DriverHost &host) { master_.attach(host); }

void SercosDriver::executeStart() { master_.executeStart(); }

void SercosDriver::executeEnd() {
  if (stopped_)
    stop();
  master_.executeEnd();
}

/// Set values brake the axes; who does not stand then stops by himself. Who stands goes off.
void SercosDriver::stop() {
  stopCycles_ = std::min(stopCycles_ + 1, offPatience_);
  for (size_t i = 0; i < standing_.size(); ++i) {
    DriveAxis &axis = master_.drive(i).axis();
    standing_[i] = axis.commandedToMove() ? 0 : std::min(standing_[i] + 1, kStandingCycles);
    if (standing_[i] == kStandingCycles || stopCycles_ >= stopPatience_)
      axis.shutDown();
  }
}

bus::StartUp SercosDriver::init(size_t drive, uint16_t &progress, bus::Message &message) {
  progress = 0;
  if (!faults_[drive].empty()) {
    message.set(std::string_view(faults_[drive]));
    return bus::StartUp::Failed;
  }
  return master_.init(drive, progress, message);
}

void SercosDriver::reset(size_t drive) { master_.reset(drive); }

bus::DriveStatus SercosDriver::status(size_t drive) const { return master_.drive(drive).status(); }

void SercosDriver::command(size_t drive, const bus::DriveCommand &command) {
  master_.drive(drive).axis().command(command);
}

uint8_t SercosDriver::controllerModes(size_t drive) const {
  return master_.drive(drive).axis().controllerModes();
}

uint8_t SercosDriver::captureInputs(size_t drive) const {
  return master_.drive(drive).config().probeInputs;
}

bool SercosDriver::startParameter(size_t drive, const bus::ParameterRequest &request) {
  if (!master_.drive(drive).started())
    return false;
  master_.drive(drive).ask(request);
  return true;
}

bool SercosDriver::pollParameter(size_t drive, bus::ParameterAnswer &answer) {
  return master_.drive(drive).poll(answer);
}

void SercosDriver::cancelParameter(size_t drive) { master_.drive(drive).cancelQuestion(); }

uint32_t SercosDriver::encoder(size_t encoder) const {
  const size_t drive = encoders_[encoder];
  return drive == SercosSetup::kNoDrive ? 0 : master_.drive(drive).axis().secondPosition();
}

bool SercosDriver::encoderWorks(size_t encoder) const {
  const size_t drive = encoders_[encoder];
  return drive != SercosSetup::kNoDrive && master_.drive(drive).status().communication;
}

void SercosDriver::applicationStopped() { stopped_ = true; }

bool SercosDriver::atRest() const {
  if (!stopped_ || stopCycles_ >= offPatience_)
    return true;
  for (size_t i = 0; i < master_.driveCount(); ++i) {
    const Slave &slave = master_.drive(i);
    if (slave.started() && (slave.status().regulatorOn || !slave.axis().atRest()))
      return false;
  }
  return true;
}

void SercosDriver::problem(bus::Message &text) const { master_.problem(text); }

} // namespace stride::sercos
