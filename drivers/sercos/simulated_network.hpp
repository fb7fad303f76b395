// A simulated ring with the devices that stride.toml expects on it.
#ifndef STRIDE_DRIVERS_SERCOS_SIMULATED_NETWORK_HPP
#define STRIDE_DRIVERS_SERCOS_SIMULATED_NETWORK_HPP

#include "drivers/sercos/master/master.hpp"
#include "drivers/sercos/simulation/simulated_drive.hpp"
#include "drivers/sercos/simulation/simulated_io.hpp"
#include "drivers/sercos/simulation/simulated_ring.hpp"
#include "runtime/bus/group_setup.hpp"

#include "st/SercosDrive/SERCOS_DRIVE_SIM.h"
#include "st/SercosDrive/SERCOS_RING_SIM.h"

#include <memory>
#include <vector>

namespace stride::sercos {

/// Programs share with it what they disturb and watch.
class SimulatedNetwork final : public Ring {
public:
  using DriveSim = ::st::SercosDrive::SERCOS_DRIVE_SIM;
  using RingSim = ::st::SercosDrive::SERCOS_RING_SIM;

  explicit SimulatedNetwork(const bus::GroupSetup &setup);

  void cycle(const MasterTelegrams &sent, RingAnswers &answers) noexcept override;
  void setLight(uint8_t percent) noexcept override { ring_.setLight(percent); }
  void setBaudRate(uint8_t megabits) noexcept override { ring_.setBaudRate(megabits); }

  /// What is on the ring, for whoever disturbs it from outside of a program. `drive`: one that is
  /// no I/O device.
  [[nodiscard]] simulation::SimulatedRing &ring() { return ring_; }
  [[nodiscard]] simulation::SimulatedDrive &drive(size_t drive) { return *places_[drive].drive; }

  /// Where the structures are now; null: there are none.
  void bindDrive(size_t drive, void *data);
  void bindRing(void *data) { sim_ = static_cast<RingSim *>(data); }
  /// What programs ask of the master.
  void lead(RingControl &ring) const;
  /// What the master knows, for programs.
  void publish(const Master &master) const noexcept;

private:
  struct Place {
    std::unique_ptr<simulation::SimulatedDrive> drive; ///< Null: it is an I/O device.
    std::unique_ptr<simulation::SimulatedIo> io;
    DriveSim *sim = nullptr;

    [[nodiscard]] simulation::Device &device() const {
      return drive != nullptr ? static_cast<simulation::Device &>(*drive) : *io;
    }
  };

  void disturb() noexcept;
  void countDown() noexcept;

  simulation::SimulatedRing ring_;
  std::vector<Place> places_;
  RingSim *sim_ = nullptr;
};

} // namespace stride::sercos

#endif
