#include "compiler/project/content_hash.hpp"

#include <array>
#include <cstring>

namespace stc {

namespace {

// The 128-bit product, folded.
std::uint64_t multiplyFold(std::uint64_t x, std::uint64_t y) {
  __extension__ using Wide = unsigned __int128;
  const Wide product = static_cast<Wide>(x) * y;
  return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
}

} // namespace

void ContentHash::mix(std::uint64_t word) {
  const std::uint64_t a = multiplyFold(a_ ^ word, 0xA0761D6478BD642FU);
  const std::uint64_t b = multiplyFold(b_ + word, 0xE7037ED1A0B428DBU);
  a_ = a + (b_ << 23 | b_ >> 41);
  b_ = b ^ (a_ << 17 | a_ >> 47);
}

ContentHash &ContentHash::add(std::uint64_t value) {
  mix(value);
  return *this;
}

ContentHash &ContentHash::add(std::string_view text) {
  mix(text.size());
  while (!text.empty()) {
    std::uint64_t word = 0;
    const std::size_t count = text.size() < sizeof(word) ? text.size() : sizeof(word);
    std::memcpy(&word, text.data(), count);
    mix(word);
    text.remove_prefix(count);
  }
  return *this;
}

std::string ContentHash::hex() const {
  ContentHash last = *this;
  last.mix(0);
  last.mix(1);
  std::array<char, 33> digits{};
  constexpr std::string_view kDigits = "0123456789abcdef";
  for (std::size_t i = 0; i < 16; ++i) {
    digits[i] = kDigits[last.a_ >> (60 - 4 * i) & 15];
    digits[16 + i] = kDigits[last.b_ >> (60 - 4 * i) & 15];
  }
  return {digits.data(), 32};
}

} // namespace stc
