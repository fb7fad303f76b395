// EN and ENO in the calls of functions, as IEC 61131-3 describes them.

#include "compiler/semantics/calls/calls.hpp"

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/calls/internal.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/names/names.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;

namespace {

bool isEnable(const Argument &a) { return a.name && !a.output && a.name.id->lower == "en"; }
bool isEnabled(const Argument &a) { return a.name && a.output && a.name.id->lower == "eno"; }

/// What a name or `Space.Name` stands for; null: neither.
Symbol *calledSymbol(Context &c, Expr *callee) {
  if (callee->kind == ExprKind::Name) {
    Symbol *symbol = lookup(c, as<NameExpr>(callee)->name);
    const bool isResult = symbol != nullptr && symbol->kind == SymbolKind::Variable &&
                          static_cast<VarSymbol *>(symbol)->isResult;
    return isResult ? static_cast<VarSymbol *>(symbol)->owner : symbol;
  }
  if (callee->kind != ExprKind::Member || as<MemberExpr>(callee)->bit >= 0)
    return nullptr;
  auto *member = as<MemberExpr>(callee);
  Symbol *space = resolveNamespace(c, member->base);
  if (space == nullptr)
    return nullptr;
  if (c.names.isBuiltin(member->name.id) &&
      c.names.memberOfSpace(space, member->name.id) == nullptr)
    return c.names.standardFunction(space, member->name.id);
  return nameInSpace(c, space, member->name);
}

/// A function that has no EN or ENO of its own.
bool takesEnable(Context &c, const CallExpr *expr) {
  Symbol *symbol = calledSymbol(c, expr->callee);
  if (symbol == nullptr)
    return expr->callee->kind == ExprKind::Name &&
           findConversion(as<NameExpr>(expr->callee)->name.id).has_value();
  if (symbol->kind == SymbolKind::Builtin)
    return true;
  if (symbol->kind != SymbolKind::Pou || !static_cast<PouSymbol *>(symbol)->isFunction())
    return false;
  auto *pou = static_cast<PouSymbol *>(symbol);
  declare(c, pou);
  return std::none_of(expr->arguments.begin(), expr->arguments.end(), [&](const Argument &a) {
    return (isEnable(a) || isEnabled(a)) && findVariable(pou, a.name.id) != nullptr;
  });
}

/// The arguments that only the call takes; EN and ENO go to `enable` and `enabled`.
std::vector<Argument> withoutEnable(Context &c, const CallExpr *expr, Argument &enable,
                                    Argument &enabled) {
  std::vector<Argument> rest;
  for (const Argument &a : expr->arguments) {
    if (!isEnable(a) && !isEnabled(a)) {
      rest.push_back(a);
      continue;
    }
    Argument &own = a.output ? enabled : enable;
    if (own.name)
      c.report(Code::DuplicateArgument, a.span, "`" + std::string(a.name.text) + "` is given twice",
               "given again here");
    own = a;
  }
  return rest;
}

void checkEnabledOutput(Context &c, Expr *target) {
  const Type *type = checkTarget(c, target);
  if (isError(type) || !requireVariable(c, target, "assign to"))
    return;
  if (type->kind != TypeKind::Boolean)
    c.report(Code::TypeMismatch, target->span,
             "the output `ENO` is BOOL, this variable is " + typeName(type), "expected BOOL");
}

} // namespace

const Type *checkEnabledCall(Context &c, CallExpr *expr, bool asStatement) {
  const bool named = std::any_of(expr->arguments.begin(), expr->arguments.end(),
                                 [](const Argument &a) { return isEnable(a) || isEnabled(a); });
  if (!named || !takesEnable(c, expr))
    return nullptr;
  Argument enable;
  Argument enabled;
  auto *call = c.arena.make<CallExpr>();
  call->span = expr->span;
  call->callee = expr->callee;
  call->arguments = c.arena.copy(withoutEnable(c, expr, enable, enabled));
  if (enable.value == nullptr) { // `EN :=` keeps what it is, which is TRUE
    auto *always = c.arena.make<Literal>();
    always->literal = LiteralKind::Boolean;
    always->integer = 1;
    always->text = "TRUE";
    always->span = expr->span;
    enable.value = always;
  }
  checkAs(c, enable.value, elementaryType(TypeKind::Boolean), "argument `EN`");
  // Edition 3 lets a call that names its arguments leave inputs out. Elsewhere that is taken for a
  // slip, as CODESYS does; EN says which language it is.
  c.inputsOptional = std::all_of(call->arguments.begin(), call->arguments.end(),
                                 [](const Argument &a) { return bool(a.name); });
  const Type *result = call->type = checkCall(c, call, asStatement);
  c.inputsOptional = false;
  if (enabled.value != nullptr)
    checkEnabledOutput(c, enabled.value);
  if (isUntyped(result)) {
    result = elementaryType(result->kind == TypeKind::AnyReal ? TypeKind::Lreal : TypeKind::Dint);
    setTarget(call, result);
  }
  std::vector<Argument> arguments(2);
  arguments[0] = enable;
  arguments[1].value = call;
  arguments[1].span = call->span;
  if (enabled.value != nullptr)
    arguments.push_back(enabled);
  expr->arguments = c.arena.copy(arguments);
  expr->resolved = Callee::Builtin;
  expr->builtin = Builtin::Enabled;
  expr->common = call->common;
  return result;
}

} // namespace stc::sema
