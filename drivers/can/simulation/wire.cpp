#include "drivers/can/simulation/wire.hpp"

#include <algorithm>

namespace stride::can::simulation {
namespace {

constexpr uint16_t kPolynomial = 0x4599;
constexpr uint16_t kCrcMask = 0x7FFF;
constexpr unsigned kCrcBits = 15;
constexpr unsigned kLongestRun = 5;

uint16_t nextCrc(uint16_t crc, bool bit) {
  const bool invert = bit != ((crc >> (kCrcBits - 1) & 1U) != 0);
  const unsigned shifted = static_cast<unsigned>(crc) << 1U;
  return static_cast<uint16_t>((invert ? shifted ^ kPolynomial : shifted) & kCrcMask);
}

} // namespace

void StuffedBits::add(bool bit) {
  run_ = bit == last_ ? run_ + 1 : 1;
  last_ = bit;
  bits_[size_++] = bit;
  if (run_ < kLongestRun)
    return;
  last_ = !bit;
  run_ = 1;
  bits_[size_++] = last_;
}

StuffedBits::StuffedBits(const Frame &frame) {
  const auto put = [this](unsigned value, unsigned count) {
    while (count-- > 0) {
      const bool bit = (value >> count & 1U) != 0;
      crc_ = nextCrc(crc_, bit);
      add(bit);
    }
  };
  constexpr unsigned kIdBits = 11;
  const unsigned length = std::min<unsigned>(frame.length, Frame::kMostBytes);
  run_ = 0;
  put(0, 1); // start of frame
  put(frame.id, kIdBits);
  put(frame.remote ? 1 : 0, 1);
  put(0, 2); // standard format, reserved
  put(length, 4);
  for (unsigned i = 0; i < length && !frame.remote; ++i)
    put(frame.data[i], 8);
  for (unsigned i = kCrcBits; i-- > 0;)
    add((crc_ >> i & 1U) != 0);
}

uint32_t exactBits(const Frame &frame) {
  return static_cast<uint32_t>(StuffedBits(frame).size()) + kTailBits + kGapBits;
}

size_t firstDifference(const StuffedBits &a, const StuffedBits &b) {
  const size_t size = std::min(a.size(), b.size());
  size_t place = 0;
  while (place < size && a[place] == b[place])
    ++place;
  return place;
}

} // namespace stride::can::simulation
