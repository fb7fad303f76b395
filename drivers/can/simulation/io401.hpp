// A simulated device with inputs and outputs. [CiA 401]
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_IO401_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_IO401_HPP

#include "drivers/can/simulation/canopen_node.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace stride::can::simulation {

struct Io401Setup {
  NodeSetup node{};
  uint8_t inputBytes = 1;        ///< 6000h, and 6100h for pairs of them; 0 … 8.
  uint8_t outputBytes = 1;       ///< 6200h, and 6300h for pairs of them; 0 … 8.
  uint8_t analogInputs = 0;      ///< 6401h, 16 bits each; 0 … kMostAnalog.
  uint8_t analogOutputs = 0;     ///< 6411h, 16 bits each; 0 … kMostAnalog.
  bool wired = false;            ///< Its inputs are connected with its outputs.
  std::vector<ObjectRow> more{}; ///< Objects of its maker; those of the profile stay as they are.

  static constexpr uint8_t kMostAnalog = 12;
};

/// Outputs keep what they have, or take what 6207h and 6444h say, when the master is lost or the
/// node is stopped. Analog inputs are events only while 6423h is TRUE.
class SimulatedIo401 final : public CanopenNode {
public:
  explicit SimulatedIo401(const Io401Setup &setup);

  /// The world: numbers from 0; what is not there is 0 and stays so.
  void setInput(size_t byte, uint8_t value) noexcept;
  void setAnalogInput(size_t channel, int16_t value) noexcept;
  [[nodiscard]] uint8_t output(size_t byte) const noexcept;
  [[nodiscard]] int16_t analogOutput(size_t channel) const noexcept;

private:
  void onReset() noexcept override;
  void onState(NmtState state) noexcept override;
  void onWritten(Entry &entry) noexcept override;
  void onConnectionLost() noexcept override;
  void onTime() noexcept override { changed_ = false; }
  [[nodiscard]] int64_t nextDeviceNs() const noexcept override {
    return changed_ ? nowNs() : kNever;
  }
  [[nodiscard]] bool triggers(const Entry &entry) const noexcept override;

  void put(uint16_t index, size_t place, uint64_t value) noexcept;
  [[nodiscard]] uint64_t get(uint16_t index, size_t place) const noexcept;
  void showInputs() noexcept;
  void makeSafe() noexcept;
  void follow() noexcept;

  uint64_t inputs_ = 0; ///< A byte for each.
  std::array<int16_t, Io401Setup::kMostAnalog> analog_{};
  uint8_t inputBytes_;
  uint8_t outputBytes_;
  uint8_t analogInputs_;
  uint8_t analogOutputs_;
  bool wired_;
  bool changed_ = false;
};

} // namespace stride::can::simulation

#endif
