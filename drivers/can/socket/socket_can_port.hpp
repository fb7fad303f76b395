// A CAN interface of the system, by SocketCAN.
#ifndef STRIDE_DRIVERS_CAN_SOCKET_SOCKET_CAN_PORT_HPP
#define STRIDE_DRIVERS_CAN_SOCKET_SOCKET_CAN_PORT_HPP

#include "drivers/can/port/port.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

struct can_frame; // of the system's headers

namespace stride::can {

/// Two raw sockets: process data goes out before the rest. Nothing is set at the interface, which
/// needs no privileges: it must be up with the right bit rate. While it is not, it is looked for
/// once in a second.
class SocketCanPort final : public Port {
public:
  /// `bitRate`: that the interface must have, if it has one; 0: any. [kBit/s]
  SocketCanPort(std::string interface, uint32_t bitRate);
  ~SocketCanPort() override;

  void beginCycle() noexcept override;
  SendResult send(const Frame &frame, SendClass sendClass) noexcept override;
  size_t receive(std::span<Received> frames) noexcept override;
  bool wait(int64_t monotonicNs) noexcept override;
  [[nodiscard]] int64_t monotonicNs() const noexcept override;
  [[nodiscard]] int64_t utcNs() const noexcept override;
  [[nodiscard]] size_t unconfirmed() const noexcept override;
  [[nodiscard]] ControllerState state() const noexcept override { return state_; }
  [[nodiscard]] std::string_view problem() const noexcept override {
    return {problem_.data(), problemLength_};
  }
  [[nodiscard]] PortCounters counters() const noexcept override { return counters_; }

private:
  static constexpr size_t kInFlight = 256;

  /// A process frame that may still wait in the interface.
  struct Sent {
    uint32_t cycle = 0;
    uint16_t id = 0;
  };

  void open() noexcept;
  [[nodiscard]] bool usable(unsigned index) noexcept;
  [[nodiscard]] int openSocket(unsigned index, SendClass sendClass) noexcept;
  void close() noexcept;
  void goDown(int error) noexcept;
  [[gnu::format(printf, 2, 3)]] void setProblem(const char *format, ...) noexcept;
  bool take(const can_frame &frame, bool confirms, Received &received) noexcept;
  void takeError(const can_frame &frame) noexcept;
  void confirm(uint16_t id) noexcept;

  std::string interface_;
  uint32_t bitRate_;
  int process_ = -1;
  int service_ = -1;
  ControllerState state_ = ControllerState::Down;
  PortCounters counters_;
  uint32_t droppedBySocket_ = 0; ///< As this socket counts.
  int64_t nextTryNs_ = 0;
  std::array<Sent, kInFlight> inFlight_{}; ///< A ring.
  size_t oldest_ = 0;
  size_t flying_ = 0;
  uint32_t cycle_ = 0;
  std::array<char, 240> problem_{};
  size_t problemLength_ = 0;
};

} // namespace stride::can

#endif
