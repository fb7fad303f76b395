// Keeps what passes a port, for somebody who writes it into a file from another thread.
#ifndef STRIDE_DRIVERS_CAN_LOG_RECORDER_HPP
#define STRIDE_DRIVERS_CAN_LOG_RECORDER_HPP

#include "drivers/can/log/candump.hpp"
#include "drivers/can/port/port.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace stride::can::log {

/// A queue of frames between the cyclic thread, which puts, and one other, which takes. Neither
/// waits for the other: what finds no room is lost and counted.
class Recorder {
public:
  /// Room for so many frames, made now. [frames]
  explicit Recorder(size_t room);

  /// From the cyclic thread.
  void put(const Entry &entry) noexcept;

  /// From the other thread: the oldest frame. FALSE: there is none.
  bool take(Entry &entry) noexcept;

  /// Frames that found no room.
  [[nodiscard]] uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

private:
  std::vector<Entry> entries_; ///< One place is always free.
  std::atomic<size_t> first_{0};
  std::atomic<size_t> end_{0};
  std::atomic<uint64_t> lost_{0};
};

/// A port that tells a recorder of everything that passes it. What is sent has the time at which
/// the cycle has begun, and what is received in a cycle none that is later, so that a replay sees
/// it in the same cycle.
class RecordedPort final : public Port {
public:
  /// Both must live as long as this. `startNs`: now, by the port's clock.
  RecordedPort(Port &port, Recorder &recorder, int64_t cycleNs, int64_t startNs = 0)
      : port_(port), recorder_(recorder), cycleNs_(cycleNs), timeNs_(startNs) {}

  void beginCycle() noexcept override;
  SendResult send(const Frame &frame, SendClass sendClass) noexcept override;
  size_t receive(std::span<Received> frames) noexcept override;
  bool wait(int64_t monotonicNs) noexcept override { return port_.wait(monotonicNs); }
  [[nodiscard]] int64_t monotonicNs() const noexcept override { return port_.monotonicNs(); }
  [[nodiscard]] int64_t utcNs() const noexcept override { return port_.utcNs(); }
  [[nodiscard]] size_t unconfirmed() const noexcept override { return port_.unconfirmed(); }
  [[nodiscard]] ControllerState state() const noexcept override { return port_.state(); }
  [[nodiscard]] std::string_view problem() const noexcept override { return port_.problem(); }
  [[nodiscard]] PortCounters counters() const noexcept override { return port_.counters(); }

private:
  Port &port_;
  Recorder &recorder_;
  int64_t cycleNs_;
  int64_t timeNs_;
};

} // namespace stride::can::log

#endif
