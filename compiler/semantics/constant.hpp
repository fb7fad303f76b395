#ifndef STRIDE_COMPILER_SEMANTICS_CONSTANT_HPP
#define STRIDE_COMPILER_SEMANTICS_CONSTANT_HPP
// Values known at compile time.

#include <cstdint>
#include <string_view>

namespace stc {

enum class ConstKind : uint8_t { Integer, Real, String };

/// A constant of elementary type. BOOL, integers, bit strings, times, dates and enumerations are
/// `integer` (the value as 64-bit pattern, sign-extended for signed types), REAL and LREAL are
/// `real` (REAL already rounded to 32 bits).
struct ConstValue {
  ConstKind kind = ConstKind::Integer;
  int64_t integer = 0;
  double real = 0;
  std::string_view text; ///< string, UTF-8
};
constexpr ConstValue integerValue(int64_t v) { return {ConstKind::Integer, v, 0, {}}; }
constexpr ConstValue realValue(double v) { return {ConstKind::Real, 0, v, {}}; }

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_CONSTANT_HPP
