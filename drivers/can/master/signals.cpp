#include "drivers/can/master/signals.hpp"

#include "drivers/can/master/frames.hpp"

namespace stride::can {
namespace {

constexpr uint32_t kMostPdoBits = 8 * Frame::kMostBytes;
constexpr uint32_t kSignalBits = 32;

/// The frame as one number: bit n of byte m is its bit 8 m + n.
uint64_t wordOf(const Frame &frame) {
  return readNumber(frame, 0, 4) | uint64_t{readNumber(frame, 4, 4)} << 32U;
}

uint64_t mask(uint32_t bits) { return bits >= 64 ? ~uint64_t{0} : (uint64_t{1} << bits) - 1; }

/// By the drive: what it may show of set values is the master's own.
bool isTold(Signal signal) { return signal >= Signal::Statusword && signal != Signal::Other; }

bool fits(const PdoEntry &entry, uint32_t place) {
  return entry.bits > 0 && entry.bits <= kSignalBits && place + entry.bits <= kMostPdoBits;
}

} // namespace

Frame encode(const Pdo &pdo, const Signals &signals) {
  uint64_t word = 0;
  uint32_t place = 0;
  for (const PdoEntry &entry : pdo.mapped()) {
    const Signal signal = signalOf(entry.object);
    if (signal != Signal::Other && fits(entry, place))
      word |= (signals.get(signal) & mask(entry.bits)) << place;
    place += entry.bits;
  }
  Frame frame = makeFrame(pdo.cobId, pdo.length());
  for (size_t i = 0; i < Frame::kMostBytes; ++i)
    frame.data[i] = static_cast<uint8_t>(word >> 8U * i);
  return frame;
}

bool decode(const Pdo &pdo, const Frame &frame, Signals &signals) {
  if (frame.length != pdo.length())
    return false;
  const uint64_t word = wordOf(frame);
  uint32_t place = 0;
  for (const PdoEntry &entry : pdo.mapped()) {
    const Signal signal = signalOf(entry.object);
    if (isTold(signal) && fits(entry, place)) {
      uint64_t value = word >> place & mask(entry.bits);
      if (objectOf(signal).isSigned && (value >> (entry.bits - 1U) & 1U) != 0)
        value |= ~mask(entry.bits);
      signals.set(signal, static_cast<uint32_t>(value));
    }
    place += entry.bits;
  }
  return true;
}

} // namespace stride::can
