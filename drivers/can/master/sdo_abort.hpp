// Abort codes of SDO transfers. [CiA 301, 7.2.4.3.17]
#ifndef STRIDE_DRIVERS_CAN_MASTER_SDO_ABORT_HPP
#define STRIDE_DRIVERS_CAN_MASTER_SDO_ABORT_HPP

#include <cstdint>
#include <span>
#include <string_view>

namespace stride::can {

namespace abort_code {
inline constexpr uint32_t kNone = 0;
inline constexpr uint32_t kToggle = 0x05030000;
inline constexpr uint32_t kTimedOut = 0x05040000;
inline constexpr uint32_t kCommand = 0x05040001;
inline constexpr uint32_t kBlockSize = 0x05040002;
inline constexpr uint32_t kSequence = 0x05040003;
inline constexpr uint32_t kCrc = 0x05040004;
inline constexpr uint32_t kMemory = 0x05040005;
inline constexpr uint32_t kUnsupported = 0x06010000;
inline constexpr uint32_t kWriteOnly = 0x06010001;
inline constexpr uint32_t kReadOnly = 0x06010002;
inline constexpr uint32_t kNoObject = 0x06020000;
inline constexpr uint32_t kCannotBeMapped = 0x06040041;
inline constexpr uint32_t kLength = 0x06070010;
inline constexpr uint32_t kTooLong = 0x06070012;
inline constexpr uint32_t kTooShort = 0x06070013;
inline constexpr uint32_t kNoSubindex = 0x06090011;
inline constexpr uint32_t kValueRange = 0x06090030;
inline constexpr uint32_t kValueHigh = 0x06090031;
inline constexpr uint32_t kValueLow = 0x06090032;
inline constexpr uint32_t kGeneral = 0x08000000;
inline constexpr uint32_t kNotStored = 0x08000020;
inline constexpr uint32_t kLocalControl = 0x08000021;
inline constexpr uint32_t kDeviceState = 0x08000022;
} // namespace abort_code

/// How a parameter's question ends with it.
enum class AbortMeaning : uint8_t {
  Failed,   ///< The transfer.
  Unknown,  ///< There is no such object.
  ReadOnly, ///< It is not to be written.
  Refused,  ///< Not this value, or not now.
};

struct AbortRow {
  uint32_t code;
  AbortMeaning meaning;
  std::string_view text;
};

/// All codes of the standard, ascending.
std::span<const AbortRow> abortCodes();

/// The row of a code; of one that the standard does not have: a row that says so.
const AbortRow &abortRow(uint32_t code);

/// The object, or the subindex, is not in the dictionary.
constexpr bool isMissing(uint32_t code) {
  return code == abort_code::kNoObject || code == abort_code::kNoSubindex;
}

} // namespace stride::can

#endif
