// A port whose bus is a recording: what was received then is received again, and what is sent is
// compared with what was sent then.
#ifndef STRIDE_DRIVERS_CAN_LOG_REPLAY_PORT_HPP
#define STRIDE_DRIVERS_CAN_LOG_REPLAY_PORT_HPP

#include "drivers/can/log/candump.hpp"
#include "drivers/can/port/port.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stride::can::log {

/// Where what was sent is not what the recording has.
struct Difference {
  size_t line = 0;    ///< Of the recording: the frame that should have been sent; 0: there is none.
  Frame expected;     ///< That frame.
  Frame sent;         ///< What was sent.
  uint64_t cycle = 0; ///< Of the port, from 1.
};

struct ReplayResult {
  uint64_t cycles = 0;
  uint64_t matched = 0;   ///< Frames that were sent as recorded.
  uint64_t different = 0; ///< Frames that were not; of recorded ones those that were passed over.
  size_t left = 0;        ///< Recorded ones that have not been sent yet.
  Difference first;       ///< If any is different.
};

/// In lines without a direction, the frames of a master are known by their identifiers.
struct ReplaySetup {
  int64_t cycleNs = 1'000'000; ///< Of the port's cycles. [ns]
  uint8_t masterId = 126;      ///< Whose heartbeats are the master's.
  uint16_t syncId = 0x80;
};

/// A cycle begins where the recording has the master's SYNC, so that frames are received in the
/// cycles in which they were; without one, `cycleNs` after the one before.
class ReplayPort final : public Port {
public:
  ReplayPort(const Recording &recording, const ReplaySetup &setup);

  void beginCycle() noexcept override;
  SendResult send(const Frame &frame, SendClass sendClass) noexcept override;
  size_t receive(std::span<Received> frames) noexcept override;
  [[nodiscard]] ControllerState state() const noexcept override { return ControllerState::Active; }
  [[nodiscard]] PortCounters counters() const noexcept override { return {}; }

  /// Everything recorded has been received, and the time is beyond the last frame.
  [[nodiscard]] bool done() const noexcept;
  [[nodiscard]] ReplayResult result() const noexcept;

private:
  std::vector<Entry> received_;
  std::vector<Entry> sent_;
  ReplaySetup setup_;
  size_t nextReceived_ = 0;
  size_t nextSent_ = 0;
  int64_t nowNs_ = 0;
  int64_t endNs_ = 0;
  ReplayResult result_;
};

/// Whether a master sends frames with that identifier, by the predefined connection set.
bool sentByMaster(const Frame &frame, const ReplaySetup &setup);

} // namespace stride::can::log

#endif
