#ifndef STRIDE_COMPILER_SYNTAX_CHARACTERS_HPP
#define STRIDE_COMPILER_SYNTAX_CHARACTERS_HPP
// Kinds of characters, for the scanner, and where comments end.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace stc {

enum CharClass : uint8_t { kOther, kBlank, kLetter, kDigit };

inline constexpr std::array<uint8_t, 256> kClasses = [] {
  std::array<uint8_t, 256> classes{};
  for (int c = 'a'; c <= 'z'; ++c)
    classes[static_cast<size_t>(c)] = classes[static_cast<size_t>(c - 32)] = kLetter;
  for (int c = '0'; c <= '9'; ++c)
    classes[static_cast<size_t>(c)] = kDigit;
  classes['_'] = kLetter;
  for (const char c : {' ', '\t', '\r', '\n', '\f', '\v', '\x1A'})
    classes[static_cast<unsigned char>(c)] = kBlank;
  return classes;
}();

constexpr uint8_t classOf(char c) { return kClasses[static_cast<unsigned char>(c)]; }
constexpr bool isDigit(char c) { return classOf(c) == kDigit; }
constexpr bool isLetter(char c) { return classOf(c) == kLetter; }
constexpr bool isWordChar(char c) { return classOf(c) >= kLetter; }
/// After the comment that begins at `place`; `place` when none does. `(*` nests in `(*` only; one
/// without its end reaches to the end of the text.
[[nodiscard]] size_t commentEnd(std::string_view text, size_t place);

constexpr bool isForeign(char c) { return static_cast<unsigned char>(c) >= 0x80; }

/// A letter of another alphabet in UTF-8 begins so, rather than a sign (`§`, `×`, `≤`, `„`).
constexpr bool isForeignLetter(char first, char second) {
  const auto a = static_cast<unsigned char>(first);
  const auto b = static_cast<unsigned char>(second);
  if (a == 0xC2)
    return b == 0xB5; // the micro sign
  if (a == 0xC3)
    return b != 0x97 && b != 0xB7;
  return (a >= 0xC4 && a <= 0xE1) || (a == 0xE3 && b >= 0x81) || (a >= 0xE4 && a <= 0xED);
}

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_CHARACTERS_HPP
