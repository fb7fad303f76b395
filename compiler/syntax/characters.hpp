#pragma once
// Kinds of characters, for the scanner.

#include <array>
#include <cstdint>

namespace stc {

enum CharClass : std::uint8_t { other, blank, letter, digit };

inline constexpr std::array<std::uint8_t, 256> kClasses = [] {
  std::array<std::uint8_t, 256> classes{};
  for (int c = 'a'; c <= 'z'; ++c)
    classes[static_cast<std::size_t>(c)] = classes[static_cast<std::size_t>(c - 32)] = letter;
  for (int c = '0'; c <= '9'; ++c)
    classes[static_cast<std::size_t>(c)] = digit;
  classes['_'] = letter;
  for (const char c : {' ', '\t', '\r', '\n', '\f', '\v', '\x1A'})
    classes[static_cast<unsigned char>(c)] = blank;
  return classes;
}();

constexpr std::uint8_t classOf(char c) { return kClasses[static_cast<unsigned char>(c)]; }
constexpr bool isDigit(char c) { return classOf(c) == digit; }
constexpr bool isLetter(char c) { return classOf(c) == letter; }
constexpr bool isWordChar(char c) { return classOf(c) >= letter; }
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
