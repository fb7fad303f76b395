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

} // namespace stc
