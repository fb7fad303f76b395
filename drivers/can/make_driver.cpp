// CAN drives at the bus that a run has: simulated in the process, or an interface of the system.

#include "drivers/can/can_driver.hpp"
#include "drivers/can/simulated_network.hpp"
#include "drivers/can/socket/socket_can_port.hpp"
#include "drivers/dummy/dummy_drive.hpp"

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

} // namespace

std::unique_ptr<bus::AxisDriver> makeDriver(const bus::GroupSetup &setup) {
  if (setup.kind == bus::BusKind::Real) {
    const CanSetup can = canSetup(setup);
    return std::make_unique<CanDriver>(setup,
                                       std::make_unique<SocketCanPort>(can.interface, can.bitRate));
  }
  auto port = std::make_unique<SimulatedNetwork>(setup);
  SimulatedNetwork &network = *port;
  return std::make_unique<SimulatedCanDriver>(setup, network, std::move(port));
}

uint64_t driveDataLayout() { return dummy::driveDataLayout(); }

} // namespace stride::can
