// Sercos drives on the ring that a run has: always a simulated one, there is no other.

#include "drivers/sercos/sercos_driver.hpp"
#include "drivers/sercos/simulated_network.hpp"

namespace stride::sercos {
namespace {

class SimulatedSercosDriver final : public SercosDriver {
public:
  SimulatedSercosDriver(const bus::GroupSetup &setup, SimulatedNetwork &network,
                        std::unique_ptr<Ring> ring)
      : SercosDriver(setup, std::move(ring)), network_(network),
        isReal_(setup.kind == bus::BusKind::Real) {}

  /// Nobody shall wait for a motor to turn.
  void attach(bus::DriverHost &host) override {
    SercosDriver::attach(host);
    if (!isReal_)
      return;
    bus::Message text;
    text.set("its Sercos ring is simulated, there is no interface to a real one");
    host.say(text);
  }

  void executeStart() override {
    SercosDriver::executeStart();
    network_.publish(master());
  }
  void bindData(size_t drive, void *data) override { network_.bindDrive(drive, data); }
  bool bindGroupData(void *data, uint64_t layout) override {
    if (layout != ::st::SercosDrive::SERCOS_RING_SIM__layout__)
      return false;
    network_.bindRing(data);
    return true;
  }

private:
  SimulatedNetwork &network_; ///< The driver's ring.
  bool isReal_;               ///< The run is; the ring never.
};

} // namespace

std::unique_ptr<bus::AxisDriver> makeDriver(const bus::GroupSetup &setup) {
  auto ring = std::make_unique<SimulatedNetwork>(setup);
  SimulatedNetwork &network = *ring;
  return std::make_unique<SimulatedSercosDriver>(setup, network, std::move(ring));
}

uint64_t driveDataLayout() { return ::st::SercosDrive::SERCOS_DRIVE_SIM__layout__; }

} // namespace stride::sercos
