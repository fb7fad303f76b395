// What a node tells of its errors. [CiA 301, 7.2.7]
#ifndef STRIDE_DRIVERS_CAN_MASTER_EMCY_HPP
#define STRIDE_DRIVERS_CAN_MASTER_EMCY_HPP

#include "drivers/can/port/frame.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace stride::can {

/// One EMCY message.
struct Emcy {
  uint16_t code = 0;         ///< 0: an error has gone.
  uint8_t errorRegister = 0; ///< 1001h.
  std::array<uint8_t, 5> detail{};
};

/// The last messages of a node.
class EmcyRing {
public:
  static constexpr size_t kKept = 8;

  /// A frame with the identifier of the node's EMCY. One without a whole code is left aside.
  void received(const Frame &frame);
  /// The node starts anew.
  void clear() { *this = EmcyRing(); }

  /// How many there have been.
  [[nodiscard]] uint32_t count() const { return count_; }
  /// The newest is number 0; `age` is less than kKept and count().
  [[nodiscard]] const Emcy &message(size_t age) const { return ring_[(count_ - 1 - age) % kKept]; }
  /// One of them has that code.
  [[nodiscard]] bool has(uint16_t code) const;
  /// The error that the node has now; 0: none.
  [[nodiscard]] uint16_t code() const { return code_; }

private:
  std::array<Emcy, kKept> ring_{};
  uint32_t count_ = 0;
  uint16_t code_ = 0;
};

/// What a code is about: "voltage", "temperature of the drive". [CiA 402-2, table of error codes]
std::string_view errorText(uint16_t code);

/// A trouble of communication that is no error of the drive.
constexpr bool isCommunicationWarning(uint16_t code) {
  return (code >= 0x8110 && code <= 0x8150) || code >> 8U == 0x82;
}

} // namespace stride::can

#endif
