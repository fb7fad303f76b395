// Sercos drives on the ring that a run has: always a simulated one, there is no other.

#include "drivers/sercos/sercos_driver.hpp"
#include "drivers/sercos/simulated_network.hpp"

namespace stride::sercos {
namespace {

class SimulatedSercosDriver final : public SercosDriver {
public:
  SimulatedSercosDriver(const bus::GroupSetup &setup, SimulatedNetwork &network,
                        std::unique_ptr<Ring> ring)
      : SercosDriver(setup, std::move(ring)), network_(network) {}

  void executeStart() override {
    SercosDriver::executeStart();
    network_.publish(master());
  }
  void bindData(size_t drive, void *data) override { network_.bindDrive(drive, data); }
  void bindGroupData(void *data) override { network_.bindRing(data); }

private:
  SimulatedNetwork &network_; ///< The driver's ring.
};

} // namespace

std::unique_ptr<bus::AxisDriver> makeDriver(const bus::GroupSetup &setup) {
  auto ring = std::make_unique<SimulatedNetwork>(setup);
  SimulatedNetwork &network = *ring;
  return std::make_unique<SimulatedSercosDriver>(setup, network, std::move(ring));
}

uint64_t driveDataLayout() { return ::st::SercosDrive::SERCOS_DRIVE_SIM__layout__; }
uint64_t groupDataLayout() { return ::st::SercosDrive::SERCOS_RING_SIM__layout__; }

} // namespace stride::sercos
