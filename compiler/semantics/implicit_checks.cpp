#include "compiler/semantics/implicit_checks.hpp"

namespace stc {

std::span<const ImplicitCheckName, kImplicitChecks> implicitCheckNames() {
  using enum TypeKind;
  static constexpr std::array<ImplicitCheckName, kImplicitChecks> kNames = {{
      {"checkbounds", "CheckBounds : DINT with VAR_INPUT index, lower, upper : DINT", Dint, 3},
      {"checkdivbyte", "CheckDivByte : BYTE with VAR_INPUT divisor : BYTE", Byte, 1},
      {"checkdivword", "CheckDivWord : WORD with VAR_INPUT divisor : WORD", Word, 1},
      {"checkdivdword", "CheckDivDWord : DWORD with VAR_INPUT divisor : DWORD", Dword, 1},
      {"checkdivint", "CheckDivInt : INT with VAR_INPUT divisor : INT", Int, 1},
      {"checkdivdint", "CheckDivDInt : DINT with VAR_INPUT divisor : DINT", Dint, 1},
      {"checkdivlint", "CheckDivLInt : LINT with VAR_INPUT divisor : LINT", Lint, 1},
      {"checkdivreal", "CheckDivReal : REAL with VAR_INPUT divisor : REAL", Real, 1},
      {"checkdivlreal", "CheckDivLReal : LREAL with VAR_INPUT divisor : LREAL", Lreal, 1},
      {"checkrangesigned", "CheckRangeSigned : DINT with VAR_INPUT value, lower, upper : DINT",
       Dint, 3},
      {"checkrangeunsigned",
       "CheckRangeUnsigned : UDINT with VAR_INPUT value, lower, upper : UDINT", Udint, 3},
      {"checklrangesigned", "CheckLRangeSigned : LINT with VAR_INPUT value, lower, upper : LINT",
       Lint, 3},
      {"checklrangeunsigned",
       "CheckLRangeUnsigned : ULINT with VAR_INPUT value, lower, upper : ULINT", Ulint, 3},
      {"checkpointer",
       "CheckPointer : POINTER TO BYTE with VAR_INPUT p : POINTER TO BYTE, size : DINT, "
       "granularity : DINT, write : BOOL",
       None, 4},
  }};
  return kNames;
}

} // namespace stc
