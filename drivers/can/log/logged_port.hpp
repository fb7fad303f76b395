// A port whose frames go into a file, in candump's format.
#ifndef STRIDE_DRIVERS_CAN_LOG_LOGGED_PORT_HPP
#define STRIDE_DRIVERS_CAN_LOG_LOGGED_PORT_HPP

#include "drivers/can/log/recorder.hpp"

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>

namespace stride::can::log {

struct LogSetup {
  std::string file;
  std::string interface; ///< As the lines name it.
  int64_t cycleNs = 1'000'000;
  int64_t startNs = 0; ///< Now, by the clock of the port. [ns]
  /// A thread of its own writes; else each cycle writes what the one before had: where cycles go by
  /// virtual time, and may wait.
  bool ownThread = true;
};

/// In the cyclic thread nothing is allocated or waited for while another one writes.
class LoggedPort final : public Port {
public:
  /// Throws std::runtime_error for a file that cannot be written.
  LoggedPort(std::unique_ptr<Port> port, const LogSetup &setup);
  ~LoggedPort() override;

  void beginCycle() noexcept override;
  SendResult send(const Frame &frame, SendClass sendClass) noexcept override {
    return recorded_.send(frame, sendClass);
  }
  size_t receive(std::span<Received> frames) noexcept override { return recorded_.receive(frames); }
  bool wait(int64_t monotonicNs) noexcept override { return recorded_.wait(monotonicNs); }
  [[nodiscard]] int64_t monotonicNs() const noexcept override { return recorded_.monotonicNs(); }
  [[nodiscard]] int64_t utcNs() const noexcept override { return recorded_.utcNs(); }
  [[nodiscard]] size_t unconfirmed() const noexcept override { return recorded_.unconfirmed(); }
  [[nodiscard]] ControllerState state() const noexcept override { return recorded_.state(); }
  [[nodiscard]] std::string_view problem() const noexcept override { return recorded_.problem(); }
  [[nodiscard]] PortCounters counters() const noexcept override {
    PortCounters counters = recorded_.counters();
    counters.unlogged += recorder_.lost() + unwritten_.load(std::memory_order_relaxed);
    return counters;
  }

private:
  struct Closing {
    void operator()(std::FILE *file) const { (void)std::fclose(file); }
  };

  void write() noexcept;

  std::unique_ptr<Port> port_;
  std::string interface_;
  Recorder recorder_;
  RecordedPort recorded_;
  std::unique_ptr<std::FILE, Closing> file_;
  std::atomic<uint64_t> unwritten_{0}; ///< Frames that the file has not taken.
  std::atomic<bool> ends_{false};
  std::thread writer_; ///< Without it the cycles write.
};

} // namespace stride::can::log

#endif
