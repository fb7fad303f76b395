#include "drivers/dummy/dummy_drive.hpp"

namespace stride::dummy {
namespace {

/// A switch that follows its demand after kSwitchCycles cycles on, at once off.
bool follow(bool demand, bool real, uint8_t &delay) {
  if (!demand) {
    delay = 0;
    return false;
  }
  if (real)
    return true;
  return ++delay >= DummyDriver::kSwitchCycles;
}

} // namespace

axis::StartUp DummyDriver::init(std::size_t drive, uint16_t &progress, std::string & /*message*/) {
  Drive &d = drives_[drive];
  ++d.started;
  progress = static_cast<uint16_t>(99 * d.started / kStartUpCycles);
  if (d.started < kStartUpCycles)
    return axis::StartUp::Busy;
  d.status.communication = true;
  return axis::StartUp::Started;
}

axis::DriveStatus DummyDriver::status(std::size_t drive) const { return drives_[drive].status; }

void DummyDriver::command(std::size_t drive, const axis::DriveCommand &command) {
  drives_[drive].command = command;
}

void DummyDriver::executeEnd() {
  for (Drive &d : drives_) {
    if (!d.status.communication)
      continue;
    if (d.command.errorAckn) {
      d.status.error = false;
      d.status.errorId = 0;
    }
    const bool healthy = !d.status.error;
    d.status.regulatorOn =
        follow(d.command.regulatorOn && healthy, d.status.regulatorOn, d.regulatorDelay);
    d.status.driveStarted =
        follow(d.command.driveStart && healthy, d.status.driveStarted, d.brakeDelay);
    d.status.controllerMode = d.command.controllerMode;
    if (d.status.regulatorOn && d.status.driveStarted) {
      d.status.position = d.command.position;
      d.status.velocity = d.command.velocity;
      d.status.torque = d.command.torque;
    } else {
      d.status.velocity = 0;
      d.status.torque = 0;
    }
  }
}

void DummyDriver::raiseError(std::size_t drive, uint16_t errorId) {
  drives_[drive].status.error = true;
  drives_[drive].status.errorId = errorId;
}

void DummyDriver::setCommunication(std::size_t drive, bool answers) {
  drives_[drive].status.communication = answers;
}

void DummyDriver::setPosition(std::size_t drive, uint32_t position) {
  drives_[drive].status.position = position;
}

std::unique_ptr<axis::AxisDriver> makeDummyDriver(std::size_t drives) {
  return std::make_unique<DummyDriver>(drives);
}

} // namespace stride::dummy
