// What the standard telegrams carry. [IEC 61491, S-0-0015]
#ifndef STRIDE_DRIVERS_SERCOS_PROTOCOL_TELEGRAMS_HPP
#define STRIDE_DRIVERS_SERCOS_PROTOCOL_TELEGRAMS_HPP

#include "drivers/sercos/protocol/idn.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace stride::sercos {

/// Of a drive, each way.
inline constexpr size_t kMostCyclicObjects = 8;
/// Status or control word and the word of the service channel, before the cyclic data.
inline constexpr size_t kHeadBytes = 4;
inline constexpr size_t kMostObjectBytes = 4;
inline constexpr size_t kMostRecordBytes = kHeadBytes + kMostCyclicObjects * kMostObjectBytes;

/// S-0-0015: bits 2 … 0 the type, bit 3 position feedback 2 instead of 1.
inline constexpr uint16_t kTelegramMask = 0x0007;
inline constexpr uint16_t kExternalFeedback = 0x0008;
inline constexpr uint16_t kApplicationTelegram = 7; ///< As S-0-0016 and S-0-0024 say.

/// Cyclic data of a standard telegram, in its order; both are empty for type 0 and kApplication-
/// Telegram.
struct TelegramContents {
  std::span<const Idn> at;
  std::span<const Idn> mdt;
};
TelegramContents standardTelegram(uint16_t telegramType);

} // namespace stride::sercos

#endif
