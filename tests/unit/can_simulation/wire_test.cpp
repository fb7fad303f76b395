// Bits of frames against a computation of its own: strings of '0' and '1', as a person would write
// them down.
#include "drivers/can/simulation/wire.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace stride::can::simulation {
namespace {

std::string binary(unsigned value, unsigned digits) {
  std::string text;
  for (unsigned i = digits; i-- > 0;)
    text += (value >> i & 1U) != 0 ? '1' : '0';
  return text;
}

std::string unstuffed(const Frame &frame) {
  std::string bits =
      "0" + binary(frame.id, 11) + (frame.remote ? "1" : "0") + "00" + binary(frame.length, 4);
  if (!frame.remote)
    for (const uint8_t byte : frame.bytes())
      bits += binary(byte, 8);
  return bits;
}

/// The remainder of a division of polynomials over GF(2), on paper.
std::string remainder(std::string bits) {
  const std::string divisor = "1100010110011001"; // x^15+x^14+x^10+x^8+x^7+x^4+x^3+1
  const size_t size = bits.size();
  bits += std::string(15, '0');
  for (size_t i = 0; i < size; ++i)
    if (bits[i] == '1')
      for (size_t k = 0; k < divisor.size(); ++k)
        bits[i + k] = bits[i + k] == divisor[k] ? '0' : '1';
  return bits.substr(size);
}

std::string stuffed(const std::string &bits) {
  std::string out;
  for (const char bit : bits) {
    out += bit;
    if (out.size() >= 5 && out.substr(out.size() - 5) == std::string(5, bit))
      out += bit == '0' ? '1' : '0';
  }
  return out;
}

std::string text(const StuffedBits &bits) {
  std::string out;
  for (size_t i = 0; i < bits.size(); ++i)
    out += bits[i] ? '1' : '0';
  return out;
}

Frame frameOf(uint16_t id, std::initializer_list<uint8_t> bytes) {
  Frame frame;
  frame.id = id;
  for (const uint8_t byte : bytes)
    frame.data[frame.length++] = byte;
  return frame;
}

TEST(CanWire, TheOracleKnowsTheChecksumOfTheCatalogue) {
  std::string bits;
  for (const char digit : std::string("123456789"))
    bits += binary(static_cast<unsigned char>(digit), 8);
  EXPECT_EQ(std::stoul(remainder(bits), nullptr, 2), 0x059EU); // CRC-15/CAN
}

TEST(CanWire, StuffingAndChecksumOfRandomFrames) {
  std::mt19937 random(7); // NOLINT: the same frames each time
  size_t longest = 0;
  for (int round = 0; round < 4000; ++round) {
    Frame frame;
    frame.id = static_cast<uint16_t>(random() % 2048);
    frame.length = static_cast<uint8_t>(random() % 9);
    frame.remote = random() % 8 == 0;
    // Long runs, where stuffing matters.
    for (uint8_t i = 0; i < frame.length && !frame.remote; ++i)
      frame.data[i] = static_cast<uint8_t>(random() % 2 == 0 ? random() : random() % 2 * 255);
    const StuffedBits bits(frame);
    const std::string plain = unstuffed(frame) + remainder(unstuffed(frame));
    ASSERT_EQ(bits.crc(), std::stoul(remainder(unstuffed(frame)), nullptr, 2));
    ASSERT_EQ(text(bits), stuffed(plain)) << frame.id;
    const uint32_t exact = exactBits(frame);
    ASSERT_EQ(exact, stuffed(plain).size() + 13);
    ASSERT_LE(exact, worstBits(frame.remote ? 0 : frame.length));
    longest = std::max<size_t>(longest, exact);
    // No run of six in what is on the wire.
    ASSERT_EQ(text(bits).find("000000"), std::string::npos);
    ASSERT_EQ(text(bits).find("111111"), std::string::npos);
  }
  EXPECT_GE(longest, 120U);
}

TEST(CanWire, ArbitrationIsByIdentifierAndThenDataBeforeRemote) {
  Frame remote = frameOf(0x181, {});
  remote.remote = true;
  EXPECT_LT(arbitration(frameOf(0x180, {1})), arbitration(frameOf(0x181, {1})));
  EXPECT_LT(arbitration(frameOf(0x181, {1})), arbitration(remote));
  EXPECT_LT(arbitration(remote), arbitration(frameOf(0x182, {1})));
  // As bits: where they differ first, the winner is dominant.
  const StuffedBits a(frameOf(0x2A5, {1, 2}));
  const StuffedBits b(frameOf(0x2A7, {1, 2}));
  EXPECT_FALSE(a[firstDifference(a, b)]);
}

} // namespace
} // namespace stride::can::simulation
