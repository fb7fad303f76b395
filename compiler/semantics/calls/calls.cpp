// Calls: what is called.

#include "compiler/semantics/calls/calls.hpp"

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/builtins/builtin_calls.hpp"
#include "compiler/semantics/calls/internal.hpp"
#include "compiler/semantics/config/config.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/names/names.hpp"

namespace stc::sema {

using namespace ast;

/// Checks the arguments of a call that is wrong for itself.
static const Type *checkArguments(Context &c, CallExpr *expr) {
  for (Argument &a : expr->arguments) {
    if (a.value != nullptr)
      check(c, a.value);
  }
  return elementaryType(TypeKind::Error);
}

static const Type *notCallable(Context &c, CallExpr *expr, std::string message) {
  auto &d = c.report(Code::NotCallable, expr->callee->span, std::move(message), "cannot be called");
  if (expr->callee->kind == ExprKind::Name) {
    const auto *name = as<NameExpr>(expr->callee);
    if (name->symbol != nullptr)
      noteDeclaration(d, name->symbol);
    if (c.names.isBuiltin(name->name.id))
      d.help("this variable hides the standard function; give it another name");
    else if (name->symbol != nullptr && expr->callee->type != nullptr &&
             underlying(expr->callee->type)->kind == TypeKind::Array)
      d.help("an element is chosen in brackets: `" + std::string(name->name.text) + "[…]`");
  }
  return checkArguments(c, expr);
}

/// A call whose callee is the name of a function of the compiler.
static const Type *callBuiltin(Context &c, CallExpr *expr, BuiltinSymbol *symbol) {
  as<NameExpr>(expr->callee)->symbol = symbol;
  expr->resolved = Callee::Builtin;
  expr->builtin = symbol->id;
  const Type *result = checkBuiltin(c, expr, nullptr);
  foldCall(c, expr, result);
  return result;
}

/// `Standard.LEN(…)` is `LEN(…)`; null: it is something else.
static const Type *calledInStandard(Context &c, CallExpr *expr) {
  const auto *member = as<MemberExpr>(expr->callee);
  if (!c.names.isBuiltin(member->name.id))
    return nullptr;
  Symbol *space = resolveNamespace(c, member->base);
  if (space == nullptr || c.names.memberOfSpace(space, member->name.id) != nullptr)
    return nullptr;
  BuiltinSymbol *function = c.names.standardFunction(space, member->name.id);
  if (function == nullptr)
    return nullptr;
  auto *name = c.arena.make<NameExpr>();
  name->name = member->name;
  name->span = member->span;
  expr->callee = name;
  return callBuiltin(c, expr, function);
}

/// What a plain name calls; null: a value, or a built-in function, whose call then has the type
/// `result`.
static PouSymbol *calledByName(Context &c, CallExpr *expr, const Type *&result) {
  auto *name = as<NameExpr>(expr->callee);
  Symbol *symbol = lookup(c, name->name);
  if (symbol != nullptr && symbol->kind == SymbolKind::Variable &&
      static_cast<VarSymbol *>(symbol)->isResult)
    symbol = static_cast<VarSymbol *>(symbol)->owner; // recursion
  if (symbol == nullptr) {
    if (const auto conversion = findConversion(name->name.id)) {
      result = checkConversionCall(c, expr, *conversion);
    } else if (c.names.enumerator(c.scope, name->name.id, nullptr).enumerator == nullptr) {
      reportUnknown(c, name->name, Sought::Callee);
      checkArguments(c, expr);
      result = name->type = elementaryType(TypeKind::Error);
    }
    return nullptr;
  }
  if (symbol->kind == SymbolKind::Builtin) {
    result = callBuiltin(c, expr, static_cast<BuiltinSymbol *>(symbol));
    return nullptr;
  }
  if (symbol->kind != SymbolKind::Pou)
    return nullptr;
  name->symbol = symbol;
  return static_cast<PouSymbol *>(symbol);
}

/// What `Library.Name` or `Space.Name` calls; null: nothing that belongs to a namespace.
static PouSymbol *calledInNamespace(Context &c, MemberExpr *member) {
  Symbol *space = resolveNamespace(c, member->base);
  Symbol *symbol = space == nullptr ? nullptr : nameInSpace(c, space, member->name);
  if (symbol == nullptr || symbol->kind != SymbolKind::Pou)
    return nullptr;
  member->symbol = symbol;
  return static_cast<PouSymbol *>(symbol);
}

static const Type *reportTypeCalled(Context &c, CallExpr *expr, const PouSymbol *pou) {
  auto &d = c.report(Code::NotCallable, expr->callee->span,
                     "`" + std::string(pou->name.text) + "` is " + describe(pou) +
                         ", not an instance of one",
                     pou->isBlock() ? "a block is called through a variable"
                                    : "only methods of an interface can be called");
  if (pou->decl->kind == DeclKind::FunctionBlock)
    d.help("declare an instance, `x : " + std::string(pou->name.text) + ";`, and call `x(…)`");
  for (Argument &a : expr->arguments) {
    if (a.value != nullptr && !a.output)
      check(c, a.value);
  }
  return elementaryType(TypeKind::Error);
}

/// The block of the instance that is called; null: a method or something wrong, and the call has
/// the type `result`.
static PouSymbol *calledInstance(Context &c, CallExpr *expr, const Type *&result) {
  Expr *callee = expr->callee;
  const Type *base = nullptr;
  if (PouSymbol *method = methodOf(c, callee, base)) {
    result = checkMethodCall(c, expr, method);
    return nullptr;
  }
  const Type *type =
      base != nullptr ? checkMemberOf(c, as<MemberExpr>(callee), base) : check(c, callee);
  callee->type = type;
  if (isError(type)) {
    checkArguments(c, expr);
    result = type;
    return nullptr;
  }
  if (!isInstance(type)) {
    const bool isPointer =
        type->kind == TypeKind::Pointer && isInstance(typeAs<PointerType>(type)->pointee);
    result = notCallable(c, expr,
                         isPointer ? "a pointer must be followed before the call: `…^(…)`"
                                   : typeName(type) + " cannot be called");
    return nullptr;
  }
  PouSymbol *pou = typeAs<PouType>(type)->symbol;
  if (pou->decl->kind != DeclKind::Class)
    return pou;
  c.report(Code::ClassCalled, callee->span,
           "`" + std::string(pou->name.text) + "` is a CLASS: its instances cannot be called",
           "a class has no body")
      .help("call one of its methods, or make it a FUNCTION_BLOCK");
  result = checkArguments(c, expr);
  return nullptr;
}

/// A VAR_IN_OUT CONSTANT of the code itself.
static bool isConstantInOut(const Expr *expr) {
  const Symbol *symbol = expr->kind == ExprKind::Name ? as<NameExpr>(expr)->symbol : nullptr;
  if (symbol == nullptr || symbol->kind != SymbolKind::Variable)
    return false;
  const auto *variable = static_cast<const VarSymbol *>(symbol);
  return variable->section == Section::InOut && variable->isConstant;
}

/// Notes what kind of call it is. `named`: the callee is the POU's own name.
static void resolveCall(Context &c, CallExpr *expr, const PouSymbol *pou, bool named) {
  Expr *callee = expr->callee;
  switch (pou->decl->kind) {
  case DeclKind::Function:
    expr->resolved = Callee::Function;
    break;
  case DeclKind::Program:
    expr->resolved = named ? Callee::Program : Callee::FunctionBlock; // or an instance of it
    if (named)
      callee->type = pou->type;
    break;
  default:
    expr->resolved = Callee::FunctionBlock;
    if (isConstantInOut(callee))
      break; // CODESYS lets blocks be called that may not be replaced
    if (callee->kind != ExprKind::Deref)
      requireVariable(c, callee, "call");
    requireAligned(c, callee, "call");
    break;
  }
}

static const Type *resultOf(Context &c, const CallExpr *expr, bool asStatement) {
  const PouSymbol *pou = expr->pou;
  if (expr->resolved != Callee::Function) {
    if (asStatement)
      return elementaryType(TypeKind::None);
    auto &d = c.report(Code::BlockCallAsValue, expr->span,
                       "the call of `" + std::string(pou->name.text) + "` has no value",
                       "used as a value here");
    d.help("call it in a statement of its own, then read one of its outputs");
    return elementaryType(TypeKind::Error);
  }
  if (pou->result == nullptr)
    return elementaryType(TypeKind::None);
  const Type *result = pou->result->type;
  return result->kind == TypeKind::Reference ? typeAs<PointerType>(result)->pointee : result;
}

const Type *checkCall(Context &c, CallExpr *expr, bool asStatement) {
  followSelf(c, expr->callee);
  if (const Type *enabled = checkEnabledCall(c, expr, asStatement))
    return enabled;
  Expr *callee = expr->callee;
  const Type *result = nullptr;
  PouSymbol *pou = nullptr;
  if (callee->kind == ExprKind::Name)
    pou = calledByName(c, expr, result);
  else if (callee->kind == ExprKind::Member && as<MemberExpr>(callee)->bit < 0 &&
           (result = calledInStandard(c, expr)) == nullptr)
    pou = calledInNamespace(c, as<MemberExpr>(callee));
  if (pou != nullptr && (pou->isBlock() || pou->isInterface()))
    return reportTypeCalled(c, expr, pou);
  if (pou != nullptr && pou->isMethod()) {
    as<NameExpr>(callee)->symbol = pou;
    return checkMethodCall(c, expr, pou);
  }
  if (pou == nullptr && result == nullptr)
    pou = calledInstance(c, expr, result);
  if (pou == nullptr)
    return result;
  declare(c, pou);
  expr->pou = pou;
  const bool named = callee->kind == ExprKind::Name && as<NameExpr>(callee)->symbol == pou;
  if (named && pou->isTemplate) {
    reportTemplate(c, as<NameExpr>(callee)->name, pou);
    return elementaryType(TypeKind::Error);
  }
  resolveCall(c, expr, pou, named);
  bindArguments(c, expr, pou);
  return resultOf(c, expr, asStatement);
}

} // namespace stc::sema
