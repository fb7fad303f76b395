#pragma once
// Functions of the project that replace the built-in run-time checks, by their names as CODESYS has
// them.

#include "compiler/semantics/symbols.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace stc {

enum class ImplicitCheck : std::uint8_t {
  bounds,  ///< CheckBounds(index, lower, upper : DINT) : DINT
  divByte, ///< CheckDivByte … CheckDivLReal(divisor) : type of the divisor
  divWord,
  divDword,
  divInt,
  divDint,
  divLint,
  divReal,
  divLreal,
  rangeSigned,     ///< CheckRangeSigned(value, lower, upper : DINT) : DINT
  rangeUnsigned,   ///< … UDINT
  rangeLongSigned, ///< CheckLRangeSigned … LINT
  rangeLongUnsigned,
  pointer, ///< CheckPointer(p : POINTER TO BYTE, size, gran : DINT, write : BOOL) : POINTER TO BYTE
};

inline constexpr std::size_t kImplicitChecks = static_cast<std::size_t>(ImplicitCheck::pointer) + 1;

/// The functions of the project; null where it has none.
using ImplicitChecks = std::array<PouSymbol *, kImplicitChecks>;

struct ImplicitCheckName {
  std::string_view lowerName;
  std::string_view signature; ///< as diagnostics show it
  TypeKind value;             ///< of the result and of the inputs; none: CheckPointer
  std::size_t inputs;
};
/// By ImplicitCheck.
[[nodiscard]] std::span<const ImplicitCheckName, kImplicitChecks> implicitCheckNames();

} // namespace stc
