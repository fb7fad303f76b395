// A simulated optical ring with devices on it, in virtual time.
#ifndef STRIDE_DRIVERS_SERCOS_SIMULATION_SIMULATED_RING_HPP
#define STRIDE_DRIVERS_SERCOS_SIMULATION_SIMULATED_RING_HPP

#include "drivers/sercos/ring/ring.hpp"
#include "drivers/sercos/simulation/device.hpp"
#include "drivers/sercos/simulation/faults.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stride::sercos::simulation {

/// Telegrams take the time that they take (protocol/timing.hpp): two that are on the ring at once,
/// because somebody was given a wrong time, spoil each other.
class SimulatedRing final : public Ring {
public:
  /// The next one of the ring, after all others; kMostDrives at most. It must outlive the ring.
  void attach(Device &device);

  void cycle(const MasterTelegrams &sent, RingAnswers &answers) noexcept override;
  void setLight(uint8_t percent) noexcept override { light_ = percent; }
  void setBaudRate(uint8_t megabits) noexcept override { baudRate_ = megabits; }

  [[nodiscard]] RingFaults &faults() { return faults_; }
  [[nodiscard]] size_t size() const { return devices_.size(); }
  [[nodiscard]] Device &device(size_t index) { return *devices_[index]; }
  [[nodiscard]] uint8_t light() const { return light_; }
  [[nodiscard]] uint8_t baudRate() const { return baudRate_; }

private:
  [[nodiscard]] size_t firstDark() const noexcept;
  void sendMst(const MasterTelegrams &sent, size_t lit, bool lost, bool distorted) noexcept;
  void collectAts(const MasterTelegrams &sent, size_t lit, RingAnswers &answers) noexcept;
  void sendMdt(const MasterTelegrams &sent, size_t lit) noexcept;

  /// When a telegram is on the ring, from the end of the MST on. [µs]
  struct Span {
    int64_t from = 0;
    int64_t to = 0;
  };

  std::vector<Device *> devices_;
  std::vector<Span> spans_; ///< Of the ATs of this cycle.
  RingFaults faults_;
  uint8_t light_ = 100;
  uint8_t baudRate_ = 2;
};

} // namespace stride::sercos::simulation

#endif
