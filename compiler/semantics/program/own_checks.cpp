// Functions of the project that replace run-time checks.

#include "compiler/semantics/program/own_checks.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/implicit_checks.hpp"

namespace stc::sema {

using namespace ast;

static bool implicitCheckFits(Context &c, PouSymbol *pou, size_t check);

void findImplicitChecks(Context &c, Module &module) {
  const auto names = implicitCheckNames();
  for (PouSymbol *pou : module.library->pous) {
    if (!pou->isFunction())
      continue;
    for (size_t i = 0; i < names.size(); ++i) {
      if (pou->name.id->lower == names[i].lowerName && implicitCheckFits(c, pou, i))
        c.program.implicitChecks[i] = pou;
    }
  }
}

static bool implicitCheckFits(Context &c, PouSymbol *pou, size_t check) {
  const ImplicitCheckName &wanted = implicitCheckNames()[check];
  const std::vector<VarSymbol *> parameters = pou->parameters();
  const bool isPointer = wanted.value == TypeKind::None;
  const auto fits = [&](const Type *type, size_t at) { // 0: the result, then the inputs
    if (!isPointer)
      return type->kind == wanted.value;
    if (at < 2)
      return type->kind == TypeKind::Pointer && isByteView(typeAs<PointerType>(type)->pointee);
    return type->kind == (at == 4 ? TypeKind::Boolean : TypeKind::Dint);
  };
  bool good =
      pou->result != nullptr && fits(pou->result->type, 0) && parameters.size() == wanted.inputs;
  for (size_t i = 0; good && i < parameters.size(); ++i)
    good = parameters[i]->section == Section::Input && fits(parameters[i]->type, i + 1);
  if (!good)
    c.report(Code::ImplicitCheckSignature, pou->name.span,
             "`" + std::string(pou->name.text) +
                 "` replaces a run-time check, but has another signature",
             "its inputs or its result do not fit")
        .help("declare it as FUNCTION " + std::string(wanted.signature))
        .note(
            "functions of this name are called by the program itself wherever the check is needed");
  return good;
}

} // namespace stc::sema
