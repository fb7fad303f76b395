// Lets simulated nodes take part in a bus that is none of ours: a socket and the clock of the
// system, for `stride can simulate`.
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_NODE_HOST_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_NODE_HOST_HPP

#include "drivers/can/port/port.hpp"
#include "drivers/can/simulation/node.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace stride::can::simulation {

/// Serves nodes behind one port. They hear each other as well, although a port does not hear
/// itself. From one thread.
class NodeHost {
public:
  /// The port must live as long as this.
  explicit NodeHost(Port &port) : port_(port) {}

  /// One more node, whose supply is switched on now. It must live as long as this.
  void add(Node &node, int64_t nowNs);

  /// Takes what has come, does what is due, and sends. Of several SYNCs that have come meanwhile
  /// only the last one is answered, as a device does that works off its queue late. Times are those
  /// of the host's clock and never go back. [ns]
  void step(int64_t nowNs) noexcept;

  /// When step has something to do, unless a frame comes before that. [ns]
  [[nodiscard]] int64_t nextNs() const noexcept;

private:
  struct Member {
    Node *node = nullptr;
    Frame mailbox;
    bool full = false; ///< The port has not taken what is in the mailbox.
  };

  void tell(const Frame &frame, const Node *sender, int64_t nowNs) noexcept;
  void tellReceived(size_t place, int64_t nowNs) noexcept;
  void send(int64_t nowNs) noexcept;

  /// Frames in one step at most: a bus that never rests does not keep it from what is due.
  static constexpr size_t kMostFrames = 256;

  Port &port_;
  std::vector<Member> members_;
  std::array<Received, kMostFrames> frames_{}; ///< Of this step …
  size_t count_ = 0;                           ///< … and their number.
  bool off_ = false;                           ///< The port was off the bus.
  int64_t lastNs_ = 0;
};

} // namespace stride::can::simulation

#endif
