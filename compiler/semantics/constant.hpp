#pragma once
// Values known at compile time.

#include <cstdint>
#include <string_view>

namespace stc {

enum class ConstKind : std::uint8_t { integer, real, string };

/// A constant of elementary type. BOOL, integers, bit strings, times, dates and enumerations are
/// `integer` (the value as 64-bit pattern, sign-extended for signed types), REAL and LREAL are
/// `real` (REAL already rounded to 32 bits).
struct ConstValue {
  ConstKind kind = ConstKind::integer;
  std::int64_t integer = 0;
  double real = 0;
  std::string_view text; ///< string, UTF-8
};
constexpr ConstValue integerValue(std::int64_t v) { return {ConstKind::integer, v, 0, {}}; }

} // namespace stc
