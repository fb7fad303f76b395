#ifndef STRIDE_COMPILER_SEMANTICS_IMPLICIT_CHECKS_HPP
#define STRIDE_COMPILER_SEMANTICS_IMPLICIT_CHECKS_HPP
// Functions of the project that replace the built-in run-time checks, by their names as CODESYS has
// them.

#include "compiler/semantics/symbols.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace stc {

enum class ImplicitCheck : uint8_t {
  Bounds,  ///< CheckBounds(index, lower, upper : DINT) : DINT
  DivByte, ///< CheckDivByte … CheckDivLReal(divisor) : type of the divisor
  DivWord,
  DivDword,
  DivInt,
  DivDint,
  DivLint,
  DivReal,
  DivLreal,
  RangeSigned,     ///< CheckRangeSigned(value, lower, upper : DINT) : DINT
  RangeUnsigned,   ///< … UDINT
  RangeLongSigned, ///< CheckLRangeSigned … LINT
  RangeLongUnsigned,
  Pointer, ///< CheckPointer(p : POINTER TO BYTE, size, gran : DINT, write : BOOL) : POINTER TO BYTE
};

inline constexpr size_t kImplicitChecks = static_cast<size_t>(ImplicitCheck::Pointer) + 1;

/// The functions of the project; null where it has none.
using ImplicitChecks = std::array<PouSymbol *, kImplicitChecks>;

struct ImplicitCheckName {
  std::string_view lowerName;
  std::string_view signature; ///< as diagnostics show it
  TypeKind value;             ///< of the result and of the inputs; none: CheckPointer
  size_t inputs;
};
/// By ImplicitCheck.
[[nodiscard]] std::span<const ImplicitCheckName, kImplicitChecks> implicitCheckNames();

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_IMPLICIT_CHECKS_HPP
