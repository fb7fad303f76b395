// Simulated nodes at a bus of the system, by its clock: for other masters, or for a test of `stride
// run`.
#ifndef STRIDE_DRIVERS_CAN_TOOL_NODE_SERVER_HPP
#define STRIDE_DRIVERS_CAN_TOOL_NODE_SERVER_HPP

#include "drivers/can/port/port.hpp"
#include "drivers/can/simulation/node.hpp"

#include <cstdint>
#include <vector>

namespace stride::can::tool {

class NodeServer {
public:
  /// Port and nodes must live as long as this.
  NodeServer(Port &port, std::vector<simulation::Node *> nodes);

  /// Switches the nodes on.
  void powerOn(int64_t nowNs);
  /// Carries out what is due, and waits for what comes, but not beyond that time. [ns]
  void serve(int64_t untilNs);

  /// Frames that the interface had no room for.
  [[nodiscard]] uint64_t lost() const { return lost_; }

private:
  void send(simulation::Node &from, const Frame &frame, int64_t nowNs);
  void flush(int64_t nowNs);

  Port &port_;
  std::vector<simulation::Node *> nodes_;
  uint64_t lost_ = 0;
};

} // namespace stride::can::tool

#endif
