// What sits at a bus besides the master: frames in, frames out, and a time in nanoseconds. It
// knows neither who carries its frames nor whose time that is: SimulatedBus in virtual time, or a
// socket and the clock of the system.
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_NODE_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_NODE_HPP

#include "drivers/can/port/frame.hpp"

#include <cstdint>
#include <limits>

namespace stride::can::simulation {

/// A time that does not come. [ns]
inline constexpr int64_t kNever = std::numeric_limits<int64_t>::max();

inline constexpr int64_t kMicrosecond = 1'000;     ///< [ns]
inline constexpr int64_t kMillisecond = 1'000'000; ///< [ns]

/// Nothing here waits, allocates or throws after powerOn. The times of all calls never go back.
class Node {
public:
  Node() = default;
  Node(const Node &) = delete;
  Node &operator=(const Node &) = delete;
  virtual ~Node() = default;

  /// The supply is switched on: everything is forgotten that is not stored for good.
  virtual void powerOn(int64_t nowNs) noexcept = 0;

  /// A frame of somebody else has come, whole and without an error. FALSE: it is not for this node,
  /// and has changed nothing.
  virtual bool receive(const Frame &frame, int64_t nowNs) noexcept = 0;

  /// The frame is SYNC for this node: of several that are waiting only the last one counts.
  [[nodiscard]] virtual bool synchronizedBy(const Frame & /*frame*/) const noexcept {
    return false;
  }

  /// Does what is due until `nowNs`.
  virtual void advance(int64_t nowNs) noexcept = 0;

  /// When advance has something to do next. [ns]
  [[nodiscard]] virtual int64_t nextNs() const noexcept = 0;

  /// The mailbox of the controller is free: takes the frame that is to be sent next. False: there
  /// is none.
  virtual bool transmit(Frame &frame) noexcept = 0;

  /// The controller takes part again after a bus-off.
  virtual void recovered(int64_t /*nowNs*/) noexcept {}
};

} // namespace stride::can::simulation

#endif
