// Layer setting services: their frames, for whoever waits for answers and for whoever does not.
// [CiA 305]
#ifndef STRIDE_DRIVERS_CAN_MASTER_LSS_HPP
#define STRIDE_DRIVERS_CAN_MASTER_LSS_HPP

#include "drivers/can/master/frames.hpp"
#include "drivers/can/port/frame.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace stride::can {

/// How something has ended.
enum class LssResult : uint8_t {
  Done,
  NoAnswer,    ///< Nobody, or nobody in time.
  Refused,     ///< The node does not take it: the number, or it cannot keep it.
  WrongAnswer, ///< To another question.
};

namespace lss {

inline constexpr uint16_t kRequestId = 0x7E5;
inline constexpr uint16_t kAnswerId = 0x7E4;
/// The number of a node that has none.
inline constexpr uint8_t kNoNode = 255;

/// Vendor, product, revision, serial number. [1018h]
using Identity = std::array<uint32_t, 4>;

// The first byte of a request and, but for the last ones, of its answer.
inline constexpr uint8_t kSwitchGlobal = 0x04;
inline constexpr uint8_t kConfigureNode = 0x11;
inline constexpr uint8_t kConfigureBitRate = 0x13;
inline constexpr uint8_t kStore = 0x17;
inline constexpr uint8_t kSelectVendor =
    0x40;                                  ///< And three more: product, revision, serial number.
inline constexpr uint8_t kSelected = 0x44; ///< The answer to the last of them.
inline constexpr uint8_t kFastScan = 0x51;
inline constexpr uint8_t kIdentified = 0x4F; ///< The answer to it.
inline constexpr uint8_t kInquireNode = 0x5E;

/// A request with a number in the four bytes after its command.
inline Frame request(uint8_t command, uint32_t value) {
  Frame frame = makeFrame(kRequestId, Frame::kMostBytes);
  frame.data[0] = command;
  writeNumber(frame, 1, 4, value);
  return frame;
}

inline bool isAnswer(const Frame &frame) {
  return frame.id == kAnswerId && frame.length == Frame::kMostBytes && !frame.remote;
}

/// Of an answer to one of the services that configure.
inline LssResult resultOf(const Frame &answer, uint8_t command) {
  if (answer.data[0] != command)
    return LssResult::WrongAnswer;
  return answer.data[1] == 0 ? LssResult::Done : LssResult::Refused;
}

/// What stands for a bit rate in the table of the standard (number 0).
inline constexpr uint8_t kNoBitRate = 255; ///< It has none.
inline uint8_t bitRateIndex(uint32_t kilobits) {
  constexpr std::array<uint16_t, 9> kRates = {1000, 800, 500, 250, 125, 0 /* reserved */,
                                              50,   20,  10};
  const auto *const found = std::find(kRates.begin(), kRates.end(), kilobits);
  return found == kRates.end() || kilobits == 0 ? kNoBitRate
                                                : static_cast<uint8_t>(found - kRates.begin());
}

} // namespace lss
} // namespace stride::can

#endif
