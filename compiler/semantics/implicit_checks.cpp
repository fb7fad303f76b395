#include "compiler/semantics/implicit_checks.hpp"

#include "compiler/semantics/checker.hpp"

namespace stc {

using namespace ast;

std::span<const ImplicitCheckName, kImplicitChecks> implicitCheckNames() {
  using enum TypeKind;
  static constexpr std::array<ImplicitCheckName, kImplicitChecks> kNames = {{
      {"checkbounds", "CheckBounds : DINT with VAR_INPUT index, lower, upper : DINT", dint, 3},
      {"checkdivbyte", "CheckDivByte : BYTE with VAR_INPUT divisor : BYTE", byte, 1},
      {"checkdivword", "CheckDivWord : WORD with VAR_INPUT divisor : WORD", word, 1},
      {"checkdivdword", "CheckDivDWord : DWORD with VAR_INPUT divisor : DWORD", dword, 1},
      {"checkdivint", "CheckDivInt : INT with VAR_INPUT divisor : INT", intT, 1},
      {"checkdivdint", "CheckDivDInt : DINT with VAR_INPUT divisor : DINT", dint, 1},
      {"checkdivlint", "CheckDivLInt : LINT with VAR_INPUT divisor : LINT", lint, 1},
      {"checkdivreal", "CheckDivReal : REAL with VAR_INPUT divisor : REAL", real, 1},
      {"checkdivlreal", "CheckDivLReal : LREAL with VAR_INPUT divisor : LREAL", lreal, 1},
      {"checkrangesigned", "CheckRangeSigned : DINT with VAR_INPUT value, lower, upper : DINT",
       dint, 3},
      {"checkrangeunsigned",
       "CheckRangeUnsigned : UDINT with VAR_INPUT value, lower, upper : UDINT", udint, 3},
      {"checklrangesigned", "CheckLRangeSigned : LINT with VAR_INPUT value, lower, upper : LINT",
       lint, 3},
      {"checklrangeunsigned",
       "CheckLRangeUnsigned : ULINT with VAR_INPUT value, lower, upper : ULINT", ulint, 3},
      {"checkpointer",
       "CheckPointer : POINTER TO BYTE with VAR_INPUT p : POINTER TO BYTE, size : DINT, "
       "granularity : DINT, write : BOOL",
       none, 4},
  }};
  return kNames;
}

void Checker::findImplicitChecks(Module &module) {
  const auto names = implicitCheckNames();
  for (PouSymbol *pou : module.library->pous) {
    if (!pou->isFunction())
      continue;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (pou->name.id->lower == names[i].lowerName && implicitCheckFits(pou, i))
        program_.implicitChecks[i] = pou;
    }
  }
}

bool Checker::implicitCheckFits(PouSymbol *pou, std::size_t check) {
  const ImplicitCheckName &wanted = implicitCheckNames()[check];
  const std::vector<VarSymbol *> parameters = pou->parameters();
  const bool isPointer = wanted.value == TypeKind::none;
  const auto fits = [&](const Type *type, std::size_t at) { // 0: the result, then the inputs
    if (!isPointer)
      return type->kind == wanted.value;
    if (at < 2)
      return type->kind == TypeKind::pointer && isByteView(typeAs<PointerType>(type)->pointee);
    return type->kind == (at == 4 ? TypeKind::boolean : TypeKind::dint);
  };
  bool good =
      pou->result != nullptr && fits(pou->result->type, 0) && parameters.size() == wanted.inputs;
  for (std::size_t i = 0; good && i < parameters.size(); ++i)
    good = parameters[i]->section == Section::input && fits(parameters[i]->type, i + 1);
  if (!good)
    report(Code::implicitCheckSignature, pou->name.span,
           "`" + std::string(pou->name.text) +
               "` replaces a run-time check, but has another signature",
           "its inputs or its result do not fit")
        .help("declare it as FUNCTION " + std::string(wanted.signature))
        .note(
            "functions of this name are called by the program itself wherever the check is needed");
  return good;
}

} // namespace stc
