// CAN drives at the bus that a run has: simulated in the process, or an interface of the system.

#include "drivers/can/can_driver.hpp"
#include "drivers/can/log/logged_port.hpp"
#include "drivers/can/log/replay_port.hpp"
#include "drivers/can/simulated_network.hpp"
#include "drivers/can/socket/interface_lock.hpp"
#include "drivers/can/socket/socket_can_port.hpp"
#include "drivers/dummy/dummy_drive.hpp"

#include <net/if.h>

#include <ctime>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace stride::can {
namespace {

/// Its drives share with programs what simulated ones of the driver "Dummy" do.
class SimulatedCanDriver final : public CanDriver {
public:
  SimulatedCanDriver(const bus::GroupSetup &setup, SimulatedNetwork &network,
                     std::unique_ptr<Port> port)
      : CanDriver(setup, std::move(port)), network_(network) {}

  void bindData(size_t drive, void *data) override { network_.bindData(drive, data); }

private:
  SimulatedNetwork &network_; ///< The driver's port.
};

/// At an interface of the system, as its only master; one that is not there yet has no drives.
class RealCanDriver final : public CanDriver {
public:
  RealCanDriver(const bus::GroupSetup &setup, const CanSetup &can, std::unique_ptr<Port> port)
      : CanDriver(setup, std::move(port)) {
    if (::if_nametoindex(can.interface.c_str()) != 0)
      lock_.emplace(can.interface);
  }

private:
  std::optional<InterfaceLock> lock_;
};

/// On a recorded bus: says where it goes another way than then.
class ReplayedCanDriver final : public CanDriver {
public:
  ReplayedCanDriver(const bus::GroupSetup &setup, log::ReplayPort &replay,
                    std::unique_ptr<Port> port)
      : CanDriver(setup, std::move(port)), replay_(replay) {}

  void executeEnd() override {
    CanDriver::executeEnd();
    const log::ReplayResult result = replay_.result();
    if (said_ || result.different == 0)
      return;
    said_ = true;
    bus::Message text;
    text.set("the replay differs from the recording at its line ",
             static_cast<uint32_t>(result.first.line), ", in cycle ",
             static_cast<uint32_t>(result.first.cycle));
    say(text);
  }

private:
  log::ReplayPort &replay_; ///< The driver's port.
  bool said_ = false;
};

int64_t cycleNs(const bus::GroupSetup &setup) {
  return static_cast<int64_t>(setup.cycleSeconds * 1e9 + 0.5);
}

/// By the clock that the system stamps frames with.
int64_t systemNs() {
  constexpr int64_t kSecondNs = 1'000'000'000;
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return now.tv_sec * kSecondNs + now.tv_nsec;
}

std::unique_ptr<Port> logged(const bus::GroupSetup &setup, const CanSetup &can,
                             std::unique_ptr<Port> port) {
  if (setup.recording.log.empty())
    return port;
  const bool real = setup.kind == bus::BusKind::Real;
  log::LogSetup given;
  given.file = setup.recording.log;
  given.interface = can.interface;
  given.cycleNs = cycleNs(setup);
  given.startNs = real ? systemNs() : 0;
  given.ownThread = real;
  return std::make_unique<log::LoggedPort>(std::move(port), given);
}

log::Recording readFile(const std::string &path, const std::string &interface) {
  const std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file)
    throw std::runtime_error("the recording '" + path + "' of a CAN bus cannot be read");
  log::Recording recording = log::readRecording(text.str(), interface);
  if (recording.entries.empty())
    throw std::runtime_error("the recording '" + path + "' has no frame of interface " + interface);
  return recording;
}

std::unique_ptr<bus::AxisDriver> replayed(const bus::GroupSetup &setup, const CanSetup &can) {
  log::ReplaySetup replay;
  replay.cycleNs = cycleNs(setup);
  replay.masterId = can.master.node;
  auto port =
      std::make_unique<log::ReplayPort>(readFile(setup.recording.replay, can.interface), replay);
  log::ReplayPort &ref = *port;
  return std::make_unique<ReplayedCanDriver>(setup, ref, logged(setup, can, std::move(port)));
}

} // namespace

std::unique_ptr<bus::AxisDriver> makeDriver(const bus::GroupSetup &setup) {
  const CanSetup can = canSetup(setup);
  if (setup.kind == bus::BusKind::Real)
    return std::make_unique<RealCanDriver>(
        setup, can,
        logged(setup, can, std::make_unique<SocketCanPort>(can.interface, can.bitRate)));
  if (!setup.recording.replay.empty())
    return replayed(setup, can);
  auto port = std::make_unique<SimulatedNetwork>(setup);
  SimulatedNetwork &network = *port;
  return std::make_unique<SimulatedCanDriver>(setup, network, logged(setup, can, std::move(port)));
}

uint64_t driveDataLayout() { return dummy::driveDataLayout(); }

} // namespace stride::can
