// Emergency messages and the list of errors. [CiA 301, EMCY, 1001h, 1003h, 1014h, 1015h]
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_EMERGENCY_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_EMERGENCY_HPP

#include "drivers/can/port/frame.hpp"
#include "drivers/can/simulation/dictionary.hpp"
#include "drivers/can/simulation/node.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace stride::can::simulation {

// Error codes. [CiA 301, emergency error codes]
inline constexpr uint16_t kErrorLifeGuard = 0x8130;  ///< Life guard or heartbeat.
inline constexpr uint16_t kErrorBusOff = 0x8140;     ///< Has been off the bus.
inline constexpr uint16_t kErrorPdoLength = 0x8210;  ///< A PDO was too short.
inline constexpr uint16_t kErrorSyncLength = 0x8240; ///< SYNC with other bytes than expected.
inline constexpr uint16_t kErrorPdoTimeout = 0x8250; ///< An RPDO has not come in time.

// Bits of the error register.
inline constexpr uint8_t kGenericError = 0x01;
inline constexpr uint8_t kCommunicationError = 0x10;
inline constexpr uint8_t kProfileError = 0x20;

/// The unit of inhibit times. [ns]
inline constexpr int64_t kInhibitUnit = 100'000;

/// Places in the list of errors.
inline constexpr uint8_t kErrorHistory = 8;

class Emergency {
public:
  /// The rows must be in the dictionary.
  explicit Emergency(Dictionary &dictionary);

  /// An error has come up. Nothing happens while it is there already.
  void raise(uint16_t code, uint8_t registerBits) noexcept;
  /// An error is gone. Nothing happens if it was not there.
  void clear(uint16_t code) noexcept;
  [[nodiscard]] bool active(uint16_t code) const noexcept;

  /// All errors are gone, and nothing is said about it: a reset.
  void reset() noexcept;
  /// The list of errors is empty.
  void forget() noexcept;

  /// The next message, if the inhibit time has passed. FALSE: there is none.
  bool transmit(Frame &frame, int64_t nowNs) noexcept;
  /// When transmit has something after an inhibit time. [ns]
  [[nodiscard]] int64_t nextNs() const noexcept;

private:
  struct Error {
    uint16_t code = 0;
    uint8_t registerBits = 0;
  };

  void queue(uint16_t code) noexcept;
  void updateRegister() noexcept;

  static constexpr size_t kActive = 8;

  Entry &register_;
  std::array<Entry *, kErrorHistory + 1> history_{};
  Entry &cobId_;
  Entry &inhibit_;
  std::array<Error, kActive> errors_{};
  size_t active_ = 0;
  std::array<Frame, kActive> waiting_{};
  size_t queued_ = 0;
  int64_t allowedNs_ = 0; ///< The next one may be sent then.
};

} // namespace stride::can::simulation

#endif
