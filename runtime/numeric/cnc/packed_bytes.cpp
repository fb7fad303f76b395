#include "runtime/numeric/cnc/packed_bytes.hpp"

namespace stride::cnc {
namespace {

constexpr uint32_t kBitsOfLetter = 6;
constexpr uint32_t kBitsOfByte = 8;

/// The value of a character; 64 if it has none.
uint32_t valueOfLetter(uint8_t letter) noexcept {
  constexpr uint32_t kDigits = 26 + 26;
  constexpr uint32_t kNone = 64;
  if (letter >= 'A' && letter <= 'Z')
    return letter - 'A';
  if (letter >= 'a' && letter <= 'z')
    return letter - 'a' + 26U;
  if (letter >= '0' && letter <= '9')
    return letter - '0' + kDigits;
  return letter == '+' ? 62U : letter == '/' ? 63U : kNone;
}

/// The next byte as it was packed. False at the end.
bool nextByte(Unpacker &u, uint8_t &byte) noexcept {
  while (u.count < kBitsOfByte) {
    if (u.at == u.piece) { // the 0 after a whole piece
      u.text += u.piece + 1;
      u.at = 0;
    }
    const uint32_t value = valueOfLetter(u.text[u.at]);
    if (value > 63)
      return false;
    ++u.at;
    u.bits = (u.bits << kBitsOfLetter | value) & 0xFFFFU;
    u.count += kBitsOfLetter;
  }
  u.count -= kBitsOfByte;
  byte = static_cast<uint8_t>(u.bits >> u.count);
  return true;
}

} // namespace

Unpacker startUnpacking(const void *text, uint32_t piece) noexcept {
  return {static_cast<const uint8_t *>(text), piece, 0, 0, 0, 0};
}

bool unpack(Unpacker &u, void *bytes, int64_t count) noexcept {
  auto *to = static_cast<uint8_t *>(bytes);
  for (int64_t i = 0; i < count; ++i) {
    uint8_t byte = 0;
    if (u.zeros == 0 && !nextByte(u, byte))
      return false;
    if (u.zeros == 0 && byte == 0) {
      uint8_t length = 0;
      if (!nextByte(u, length) || length == 0)
        return false;
      u.zeros = length;
    }
    u.zeros -= byte == 0 ? 1 : 0;
    to[i] = byte;
  }
  return true;
}

} // namespace stride::cnc
