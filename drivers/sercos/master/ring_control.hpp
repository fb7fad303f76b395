// The ring as a whole, for whoever shows it or leads it through its phases.
#ifndef STRIDE_DRIVERS_SERCOS_MASTER_RING_CONTROL_HPP
#define STRIDE_DRIVERS_SERCOS_MASTER_RING_CONTROL_HPP

#include "drivers/sercos/protocol/words.hpp"

#include <cstdint>

namespace stride::sercos {

class RingControl {
public:
  RingControl() = default;
  RingControl(const RingControl &) = delete;
  RingControl &operator=(const RingControl &) = delete;
  virtual ~RingControl() = default;

  /// The phase that the MST carries.
  [[nodiscard]] virtual Phase actualPhase() const = 0;
  /// The phase that the ring shall come to: it goes up to it and no further; below it, it falls to
  /// phase 0 and comes up again.
  [[nodiscard]] virtual Phase commandedPhase() const = 0;
  virtual void commandPhase(Phase phase) = 0;
  /// [MBit/s]
  [[nodiscard]] virtual uint32_t baudRate() const = 0;
  /// 0 … 100, as wParam2 says.
  [[nodiscard]] virtual uint8_t opticalPower() const = 0;
  virtual void setOpticalPower(uint8_t percent) = 0;
  /// [µs]
  [[nodiscard]] virtual uint32_t cycleTime() const = 0;
};

} // namespace stride::sercos

#endif
