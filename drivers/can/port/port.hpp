// Where a CANopen master meets its bus: a socket of the system, a simulated wire, a recording.
#ifndef STRIDE_DRIVERS_CAN_PORT_PORT_HPP
#define STRIDE_DRIVERS_CAN_PORT_PORT_HPP

#include "drivers/can/port/frame.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace stride::can {

/// What a frame is for: what the cycle needs overtakes the rest in the queue of the interface.
enum class SendClass : uint8_t {
  Process, ///< SYNC and process data.
  Service, ///< SDO, NMT, heartbeats: may wait.
};

enum class SendResult : uint8_t {
  Sent,      ///< It is in the queue of the interface.
  QueueFull, ///< There is no room; it has not been taken.
  Down,      ///< The interface is not there, not up, or the controller is off the bus.
};

/// A received frame, and when it was there.
struct Received {
  Frame frame;
  int64_t timeNs = 0; ///< By the port's clock; only differences mean something. [ns]
};

/// The state of the controller. [ISO 11898-1, fault confinement]
enum class ControllerState : uint8_t {
  Active,
  Warning,
  Passive,
  BusOff, ///< It takes no part any more until somebody starts it again.
  Down,   ///< The interface is not there, or not up.
};

/// What a port has seen since it was opened.
struct PortCounters {
  uint64_t dropped = 0;     ///< Frames that were received and lost, for want of room.
  uint64_t errorFrames = 0; ///< Error frames …
  uint64_t restarts = 0;    ///< … and restarts after BusOff.
  uint64_t unlogged = 0;    ///< Frames that a log of the port lacks.
};

/// One CAN interface. Nothing here allocates or throws, and nothing but wait() waits.
class Port {
public:
  Port() = default;
  Port(const Port &) = delete;
  Port &operator=(const Port &) = delete;
  virtual ~Port() = default;

  /// The master's next cycle begins: a simulated bus works off what has happened in a cycle's time
  /// since the last call; a real one looks after its interface.
  virtual void beginCycle() noexcept = 0;

  virtual SendResult send(const Frame &frame, SendClass sendClass) noexcept = 0;

  /// Takes up to `frames.size()` frames that have come, oldest first; returns how many.
  virtual size_t receive(std::span<Received> frames) noexcept = 0;

  /// Waits until there is something to receive, but not beyond that time of the system's monotonic
  /// clock; FALSE: nothing has come. For who has nothing else to do: all other calls do not wait.
  /// A port without a clock of its own does not wait either. [ns]
  virtual bool wait(int64_t /*monotonicNs*/) noexcept { return false; }
  /// Now, by the clock of wait(); negative: it has none. [ns]
  [[nodiscard]] virtual int64_t monotonicNs() const noexcept { return -1; }

  /// UTC since 1970; negative: it has no such clock. [ns]
  [[nodiscard]] virtual int64_t utcNs() const noexcept { return -1; }

  /// Process frames of cycles before this one that have not left the controller yet, as far as the
  /// port sees that. Known after receive().
  [[nodiscard]] virtual size_t unconfirmed() const noexcept { return 0; }

  [[nodiscard]] virtual ControllerState state() const noexcept = 0;
  /// Why the interface is down, for people; empty: it is not, or nobody knows.
  [[nodiscard]] virtual std::string_view problem() const noexcept { return {}; }
  [[nodiscard]] virtual PortCounters counters() const noexcept = 0;
};

} // namespace stride::can

#endif
