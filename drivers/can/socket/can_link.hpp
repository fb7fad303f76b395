// What the system says of a CAN interface.
#ifndef STRIDE_DRIVERS_CAN_SOCKET_CAN_LINK_HPP
#define STRIDE_DRIVERS_CAN_SOCKET_CAN_LINK_HPP

#include "drivers/can/port/port.hpp"

#include <cstdint>

namespace stride::can {

struct CanLink {
  bool known = false;    ///< The system has answered.
  bool isUp = false;     ///< …
  uint32_t bitRate = 0;  ///< 0: it has none, as a virtual one. [bit/s]
  bool hasState = false; ///< The driver tells the state of its controller.
  ControllerState state = ControllerState::Active;
};

/// Asks by netlink; `index` of the interface. Takes as long as the system takes.
CanLink readLink(unsigned index) noexcept;

/// The same from the bytes of an answer; exposed for tests. Whatever they are, nothing is read
/// beyond them.
CanLink parseLink(const void *answer, size_t size) noexcept;

} // namespace stride::can

#endif
