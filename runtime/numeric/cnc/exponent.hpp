// What is an exponent, as other programs write small numbers, where G-code has none: 1e-05 and
// 1.2246467991473532e-16 would be two words, the second one an acceleration. The same for G-code
// (gcode_scanner) and for SoftMotion 3's language (nc/token). Free of the C++ standard library.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_EXPONENT_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_EXPONENT_HPP

#include <stdint.h>

namespace stride::cnc {

/// Whether a letter E right behind the last digit of a number may begin an exponent.
enum class Exponent : uint8_t {
  No,
  Zeros,  ///< With a sign and zeros before its digits it is one.
  Digits, ///< So it is with a sign and two digits: a small e after a capital, or after many digits.
};

/// What the number before an E says of it: how many characters it has without its sign, and whether
/// the e is small and the letter of the number's word a capital.
inline Exponent exponentBehind(int32_t characters, bool isSmallAfterCapital) noexcept {
  constexpr int32_t kManyDigits = 12; // nobody writes so many by hand
  return isSmallAfterCapital || characters >= kManyDigits ? Exponent::Digits : Exponent::Zeros;
}

/// Whether what follows the E, a sign and so many digits, is an exponent; `first` is the first of
/// them. An E without a sign is a word, and so is one with a fraction.
inline bool isExponent(Exponent kind, int32_t digits, char first) noexcept {
  return kind != Exponent::No && (digits == 2 || digits == 3) &&
         (kind == Exponent::Digits || first == '0');
}

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_EXPONENT_HPP
