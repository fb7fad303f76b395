// The error counters of a CAN controller. [ISO 11898-1, fault confinement]
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_CONTROLLER_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_CONTROLLER_HPP

#include "drivers/can/port/port.hpp"

#include <algorithm>
#include <cstdint>

namespace stride::can::simulation {

/// Counts what went well and what did not; from that follows how far it takes part.
class Controller {
public:
  [[nodiscard]] ControllerState state() const {
    if (transmit_ > kMost)
      return ControllerState::BusOff;
    const uint32_t worse = std::max(transmit_, receive_);
    if (worse > kLastActive)
      return ControllerState::Passive;
    return worse >= kWarning ? ControllerState::Warning : ControllerState::Active;
  }
  [[nodiscard]] bool off() const { return state() == ControllerState::BusOff; }
  [[nodiscard]] bool passive() const { return state() >= ControllerState::Passive; }

  void sent() { transmit_ -= transmit_ > 0 ? 1 : 0; }
  void received() {
    if (receive_ > kLastActive)
      receive_ = kLastActive - kBack;
    else
      receive_ -= receive_ > 0 ? 1 : 0;
  }
  /// A frame of its own was disturbed.
  void sendFailed() { transmit_ += kStep; }
  /// Nobody acknowledged it: a passive controller goes on trying for ever.
  void notAcknowledged() {
    if (!passive())
      sendFailed();
  }
  /// A frame of somebody else was disturbed.
  void receiveFailed() { receive_ = std::min(receive_ + 1, kMost); }
  void switchOff() { transmit_ = kMost + 1; }
  void restart() { transmit_ = receive_ = 0; }

private:
  static constexpr uint32_t kWarning = 96;
  static constexpr uint32_t kLastActive = 127;
  static constexpr uint32_t kMost = 255;
  static constexpr uint32_t kStep = 8;
  static constexpr uint32_t kBack = 4;

  uint32_t transmit_ = 0;
  uint32_t receive_ = 0;
};

} // namespace stride::can::simulation

#endif
