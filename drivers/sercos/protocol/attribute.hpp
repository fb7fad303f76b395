// The attribute of an IDN: element 3. [IEC 61491]
#ifndef STRIDE_DRIVERS_SERCOS_PROTOCOL_ATTRIBUTE_HPP
#define STRIDE_DRIVERS_SERCOS_PROTOCOL_ATTRIBUTE_HPP

#include "drivers/sercos/protocol/words.hpp"

#include <cstddef>
#include <cstdint>

namespace stride::sercos {

/// How the data is to be shown.
enum class Display : uint8_t {
  Binary = 0,
  Unsigned = 1,
  Signed = 2,
  Hexadecimal = 3,
  Text = 4,
  Idn = 5, ///< "S-0-0000"
  Float = 6,
};

/// When the data cannot be written.
namespace protect {
inline constexpr uint8_t kPhase2 = 1;
inline constexpr uint8_t kPhase3 = 2;
inline constexpr uint8_t kPhase4 = 4;
inline constexpr uint8_t kAlways = kPhase2 | kPhase3 | kPhase4;
} // namespace protect

struct Attribute {
  uint16_t factor = 1;  ///< Bits 0 … 15: what the last digit is worth.
  uint8_t bytes = 2;    ///< Of a value: 2, 4, 8; of an element of a list: 1, 2, 4, 8.
  bool list = false;    ///< Of variable length, with its two words before it.
  bool command = false; ///< Bit 19: a procedure command.
  Display display = Display::Unsigned; ///< Bits 20 … 22.
  uint8_t decimals = 0;                ///< Bits 24 … 27: digits after the point.
  uint8_t protection = 0;              ///< Bits 28, 29, 30: protect::kPhase2, …

  [[nodiscard]] bool writableIn(Phase phase) const;
  friend bool operator==(const Attribute &, const Attribute &) = default;
};

/// As it travels.
uint32_t encode(const Attribute &attribute);
/// Of whatever bits have come; a length that the standard does not have is one of 2 bytes.
Attribute decodeAttribute(uint32_t bits);

} // namespace stride::sercos

#endif
