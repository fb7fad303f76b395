// A simulated absolute encoder. [CiA 406]
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_ENCODER406_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_ENCODER406_HPP

#include "drivers/can/simulation/canopen_node.hpp"
#include "drivers/can/simulation/drive402.hpp"

#include <cstdint>

namespace stride::can::simulation {

struct Encoder406Setup {
  NodeSetup node{};
  uint32_t perTurn = 4096;       ///< Steps of a turn, as the disc has them.
  uint16_t turns = 4096;         ///< That it tells apart.
  double velocity = 0;           ///< At which it turns by itself. [steps/s]
  double stepsPerIncrement = 1;  ///< Of a drive that it sits on.
  std::vector<ObjectRow> more{}; ///< Objects of its maker; those of the profile stay as they are.
};

/// It turns by itself, or sits on a drive's mechanics: that drive has to be attached to the bus
/// before it, so that both show the same instant.
class SimulatedEncoder406 final : public CanopenNode {
public:
  explicit SimulatedEncoder406(const Encoder406Setup &setup);

  /// It sits on that drive, which must live as long; null: on none.
  void follow(const DriveAxis *drive) { drive_ = drive; }
  void follow(const SimulatedDrive402 *drive) {
    drive_ = drive == nullptr ? nullptr : &drive->axis(0);
  }

private:
  void onReset() noexcept override;
  Abort onWrite(const Entry &entry, uint64_t value) noexcept override;
  void onWritten(Entry &entry) noexcept override;
  void onRead(Entry &entry) noexcept override;
  void onSync() noexcept override { show(); }
  void onTime() noexcept override;
  [[nodiscard]] int64_t nextDeviceNs() const noexcept override { return lookNs_; }

  /// Only the timer is an event.
  [[nodiscard]] bool triggers(const Entry & /*entry*/) const noexcept override { return false; }

  [[nodiscard]] int64_t steps() const noexcept;
  [[nodiscard]] uint32_t scaled() const noexcept;
  void show() noexcept;

  Encoder406Setup setup_;
  const DriveAxis *drive_ = nullptr;
  uint32_t shift_ = 0; ///< By the preset.
  int64_t lookNs_ = 0; ///< 6200h, or 1 ms: it looks at its disc then.
};

} // namespace stride::can::simulation

#endif
