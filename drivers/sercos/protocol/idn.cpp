#include "drivers/sercos/protocol/idn.hpp"

namespace stride::sercos {
namespace {

constexpr size_t kMostDigits = 4;

constexpr bool isDigit(char c) { return c >= '0' && c <= '9'; }

} // namespace

IdnText idnText(Idn idn) {
  IdnText text = {(idn & kProductBit) != 0 ? 'P' : 'S', '-', '0', '-', '0', '0', '0', '0'};
  text[2] = static_cast<char>('0' + ((idn >> 12U) & kLastSet));
  unsigned rest = idn & kLastBlock;
  for (size_t i = text.size() - 1; rest != 0; --i, rest /= 10)
    text[i] = static_cast<char>('0' + rest % 10);
  return text;
}

std::optional<Idn> parseIdn(std::string_view text) {
  constexpr size_t kHead = 4; // "S-0-"
  if (text.size() <= kHead || text.size() > kHead + kMostDigits || text[1] != '-' || text[3] != '-')
    return {};
  const bool product = text[0] == 'P' || text[0] == 'p';
  if (!product && text[0] != 'S' && text[0] != 's')
    return {};
  if (!isDigit(text[2]) || text[2] > '0' + kLastSet)
    return {};
  unsigned block = 0;
  for (const char c : text.substr(kHead)) {
    if (!isDigit(c))
      return {};
    block = block * 10 + static_cast<unsigned>(c - '0');
  }
  if (block > kLastBlock)
    return {};
  return idn(product, static_cast<uint8_t>(text[2] - '0'), static_cast<uint16_t>(block));
}

} // namespace stride::sercos
