// Why the service channel refuses. [IEC 61491, service channel error messages]
#ifndef STRIDE_DRIVERS_SERCOS_PROTOCOL_SERVICE_ERROR_HPP
#define STRIDE_DRIVERS_SERCOS_PROTOCOL_SERVICE_ERROR_HPP

#include "drivers/sercos/protocol/words.hpp"

#include <cstdint>
#include <span>
#include <string_view>

namespace stride::sercos {

/// The first digit of a code is the element, the last ones the reason.
namespace service_error {
inline constexpr uint16_t kNone = 0x0000;
inline constexpr uint16_t kNotOpen = 0x0001;
inline constexpr uint16_t kClosing = 0x0009;
inline constexpr uint16_t kNoIdn = 0x1001;
inline constexpr uint16_t kIdnAccess = 0x1009;
inline constexpr uint16_t kNoName = 0x2001;
inline constexpr uint16_t kNoUnit = 0x4001;
inline constexpr uint16_t kNoMinimum = 0x5001;
inline constexpr uint16_t kNoMaximum = 0x6001;
inline constexpr uint16_t kTooShort = 0x7002;
inline constexpr uint16_t kTooLong = 0x7003;
inline constexpr uint16_t kReadOnly = 0x7004;
inline constexpr uint16_t kProtectedNow = 0x7005; ///< In this phase, for instance.
inline constexpr uint16_t kBelowMinimum = 0x7006;
inline constexpr uint16_t kAboveMaximum = 0x7007;
inline constexpr uint16_t kInvalidData = 0x7008;
inline constexpr uint16_t kPassword = 0x7009;
inline constexpr uint16_t kCyclic = 0x700A; ///< It comes with the MDT.
inline constexpr uint16_t kCommandActive = 0x7010;
inline constexpr uint16_t kNotInterruptible = 0x7011;
inline constexpr uint16_t kNotExecutable = 0x7012;
inline constexpr uint16_t kCommandData = 0x7013; ///< Parameters of the command are wrong.
} // namespace service_error

/// Reasons that every element has: 0x7002 … 0x7005 for the data, 0x2002 … for the name.
constexpr uint16_t errorOf(Element element, uint16_t codeOfData) {
  return static_cast<uint16_t>((codeOfData & 0x0FFFU) | (static_cast<unsigned>(element) << 12U));
}

struct ServiceErrorRow {
  uint16_t code;
  std::string_view text; ///< For people, without the IDN.
};

/// All codes, in their order.
std::span<const ServiceErrorRow> serviceErrors();
/// What a code means; a text that says so for one that the standard does not have.
std::string_view serviceErrorText(uint16_t code);

} // namespace stride::sercos

#endif
