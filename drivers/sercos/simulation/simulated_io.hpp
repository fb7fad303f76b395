// A simulated I/O device on a Sercos ring.
#ifndef STRIDE_DRIVERS_SERCOS_SIMULATION_SIMULATED_IO_HPP
#define STRIDE_DRIVERS_SERCOS_SIMULATION_SIMULATED_IO_HPP

#include "drivers/sercos/simulation/device.hpp"

#include <cstdint>
#include <vector>

namespace stride::sercos::simulation {

struct IoSetup {
  DeviceSetup device{};
  std::vector<IdnRow> more{}; ///< IDNs that it has besides.
};

/// 16 digital outputs and 16 inputs. Where those of real devices are is for their makers to say;
/// here P-0-0016 and P-0-0017, in an application telegram.
class SimulatedIo final : public Device {
public:
  explicit SimulatedIo(const IoSetup &setup);

  [[nodiscard]] uint16_t outputs() const { return outputs_; }
  void setInputs(uint16_t bits) { inputs_ = bits; }

private:
  void onPhase(Phase before) noexcept override;
  void onCycle(int64_t periodNs) noexcept override;
  [[nodiscard]] uint16_t deviceStatus() const noexcept override;
  void checkPhase4(IdnEntry & /*invalid*/) noexcept override {}
  uint16_t checkData(const IdnEntry &entry, int64_t value) noexcept override;
  void onData(const IdnEntry & /*entry*/) noexcept override {}
  uint16_t onCommand(Idn /*idn*/) noexcept override;
  void onCommandEnd(Idn /*idn*/) noexcept override {}
  void onError() noexcept override {}
  void onReset() noexcept override {}

  uint16_t outputs_ = 0; ///< All off outside of phase 4.
  uint16_t inputs_ = 0;
};

} // namespace stride::sercos::simulation

#endif
