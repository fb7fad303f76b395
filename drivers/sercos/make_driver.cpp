// Sercos drives on the ring that a run has: always a simulated one, there is no other.

#include "drivers/dummy/simulated_sync.hpp"
#include "drivers/sercos/sercos_driver.hpp"
#include "drivers/sercos/simulated_network.hpp"

namespace stride::sercos {
namespace {

class SimulatedSercosDriver final : public SercosDriver {
public:
  SimulatedSercosDriver(const bus::GroupSetup &setup, SimulatedNetwork &network,
                        std::unique_ptr<Ring> ring)
      : SercosDriver(setup, std::move(ring)), network_(network), sync_(setup),
        isReal_(setup.kind == bus::BusKind::Real) {}

  /// Nobody shall wait for a motor to turn.
  void attach(bus::DriverHost &host) override {
    SercosDriver::attach(host);
    host_ = &host;
    if (!isReal_)
      return;
    bus::Message text;
    text.set("its Sercos ring is simulated, there is no interface to a real one");
    host.say(text);
  }

  void executeStart() override {
    network_.lead(ringControl());
    SercosDriver::executeStart();
    network_.publish(master());
    if (host_ != nullptr && !stopped_)
      host_->raise(bus::BusEvent::Sync);
  }
  /// The MST with which a cycle of the ring begins is its SYNC, whatever the phase.
  bus::SyncWake waitSync(int64_t afterNs, int64_t deadlineNs, bus::BusClock &clock) override {
    return sync_.wait(afterNs, deadlineNs, clock);
  }
  void applicationStopped() override {
    SercosDriver::applicationStopped();
    stopped_ = true;
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
  dummy::SimulatedSync sync_;
  bus::DriverHost *host_ = nullptr;
  bool isReal_; ///< The run is; the ring never.
  bool stopped_ = false;
};

} // namespace

std::unique_ptr<bus::AxisDriver> makeDriver(const bus::GroupSetup &setup) {
  auto ring = std::make_unique<SimulatedNetwork>(setup);
  SimulatedNetwork &network = *ring;
  return std::make_unique<SimulatedSercosDriver>(setup, network, std::move(ring));
}

uint64_t driveDataLayout() { return ::st::SercosDrive::SERCOS_DRIVE_SIM__layout__; }

} // namespace stride::sercos
