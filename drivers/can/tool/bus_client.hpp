// One who asks the nodes of a bus and waits for their answers, for tools.
#ifndef STRIDE_DRIVERS_CAN_TOOL_BUS_CLIENT_HPP
#define STRIDE_DRIVERS_CAN_TOOL_BUS_CLIENT_HPP

#include "drivers/can/plan/objects.hpp"
#include "drivers/can/port/port.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stride::can::tool {

/// What has become of a transfer.
struct Transfer {
  bool done = false;
  bool timedOut = false;      ///< No answer …
  uint32_t abort = 0;         ///< … or the node's or our own abort code.
  std::vector<uint8_t> bytes; ///< Read.
};

class BusClient {
public:
  /// The port has a clock (monotonicNs), and must live as long as this.
  explicit BusClient(Port &port) : port_(port) {}

  /// Reads an object; answers may take `timeoutNs` each.
  Transfer read(uint8_t node, Object object, int64_t timeoutNs);
  /// Writes it.
  Transfer write(uint8_t node, Object object, std::span<const uint8_t> bytes, int64_t timeoutNs);

private:
  static constexpr size_t kLongest = 65536; ///< Bytes of an object.

  template <class Start> Transfer transfer(uint8_t node, int64_t timeoutNs, const Start &start);

  Port &port_;
};

} // namespace stride::can::tool

#endif
