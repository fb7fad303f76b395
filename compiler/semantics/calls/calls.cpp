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

static const Type *notCallable(Context &c, CallExpr *expr, std::string message) {
  auto &d = c.report(Code::notCallable, expr->callee->span, std::move(message), "cannot be called");
  if (expr->callee->kind == ExprKind::name) {
    const auto *name = as<NameExpr>(expr->callee);
    if (name->symbol != nullptr)
      noteDeclaration(d, name->symbol);
    if (c.names.isBuiltin(name->name.id))
      d.help("this variable hides the standard function; give it another name");
  }
  for (Argument &a : expr->arguments) {
    if (a.value != nullptr)
      check(c, a.value);
  }
  return elementaryType(TypeKind::error);
}

const Type *checkCall(Context &c, CallExpr *expr, bool asStatement) {
  followSelf(c, expr->callee);
  Expr *callee = expr->callee;
  PouSymbol *pou = nullptr;
  // Functions, by plain or library-qualified name.
  if (callee->kind == ExprKind::name) {
    auto *name = as<NameExpr>(callee);
    Symbol *symbol = lookup(c, name->name);
    if (symbol != nullptr && symbol->kind == SymbolKind::variable &&
        static_cast<VarSymbol *>(symbol)->isResult)
      symbol = static_cast<VarSymbol *>(symbol)->owner; // recursion
    if (symbol == nullptr) {
      if (const auto conversion = findConversion(name->name.id))
        return checkConversionCall(c, expr, *conversion);
    } else if (symbol->kind == SymbolKind::builtin) {
      name->symbol = symbol;
      expr->resolved = Callee::builtin;
      expr->builtin = static_cast<BuiltinSymbol *>(symbol)->id;
      const Type *type = checkBuiltin(c, expr, nullptr);
      foldCall(c, expr, type);
      return type;
    } else if (symbol->kind == SymbolKind::pou) {
      pou = static_cast<PouSymbol *>(symbol);
      name->symbol = symbol;
    }
  } else if (callee->kind == ExprKind::member && as<MemberExpr>(callee)->bit < 0) {
    auto *member = as<MemberExpr>(callee);
    if (Symbol *space = resolveNamespace(c, member->base); space != nullptr) {
      Symbol *symbol = nameInSpace(c, space, member->name);
      if (symbol != nullptr && symbol->kind == SymbolKind::pou) {
        pou = static_cast<PouSymbol *>(symbol);
        member->symbol = symbol;
      }
    }
  }
  if (pou != nullptr && (pou->isBlock() || pou->isInterface())) {
    auto &d = c.report(Code::notCallable, callee->span,
                       "`" + std::string(pou->name.text) + "` is " + describe(pou) +
                           ", not an instance of one",
                       pou->isBlock() ? "a block is called through a variable"
                                      : "only methods of an interface can be called");
    if (pou->decl->kind == DeclKind::functionBlock)
      d.help("declare an instance, `x : " + std::string(pou->name.text) + ";`, and call `x(…)`");
    for (Argument &a : expr->arguments) {
      if (a.value != nullptr && !a.output)
        check(c, a.value);
    }
    return elementaryType(TypeKind::error);
  }
  if (pou != nullptr && pou->isMethod()) {
    as<NameExpr>(callee)->symbol = pou;
    return checkMethodCall(c, expr, pou);
  }
  if (pou == nullptr) {
    const Type *base = nullptr;
    if (PouSymbol *method = methodOf(c, callee, base))
      return checkMethodCall(c, expr, method);
    const Type *type =
        base != nullptr ? checkMemberOf(c, as<MemberExpr>(callee), base) : check(c, callee);
    callee->type = type;
    if (isError(type)) {
      for (Argument &a : expr->arguments) {
        if (a.value != nullptr)
          check(c, a.value);
      }
      return type;
    }
    if (type->kind == TypeKind::pointer && isInstance(typeAs<PointerType>(type)->pointee))
      return notCallable(c, expr, "a pointer must be followed before the call: `…^(…)`");
    if (!isInstance(type))
      return notCallable(c, expr, typeName(type) + " cannot be called");
    pou = typeAs<PouType>(type)->symbol;
    if (pou->decl->kind == DeclKind::classD) {
      c.report(Code::classCalled, callee->span,
               "`" + std::string(pou->name.text) + "` is a CLASS: its instances cannot be called",
               "a class has no body")
          .help("call one of its methods, or make it a FUNCTION_BLOCK");
      for (Argument &a : expr->arguments) {
        if (a.value != nullptr)
          check(c, a.value);
      }
      return elementaryType(TypeKind::error);
    }
  }
  declare(c, pou);
  expr->pou = pou;
  const bool named = callee->kind == ExprKind::name && as<NameExpr>(callee)->symbol == pou;
  if (named && pou->isTemplate) {
    reportTemplate(c, as<NameExpr>(callee)->name, pou);
    return elementaryType(TypeKind::error);
  }
  switch (pou->decl->kind) {
  case DeclKind::function:
    expr->resolved = Callee::function;
    break;
  case DeclKind::program:
    expr->resolved = named ? Callee::program : Callee::functionBlock; // or an instance of it
    if (named)
      callee->type = pou->type;
    break;
  default:
    expr->resolved = Callee::functionBlock;
    if (callee->kind != ExprKind::deref)
      requireVariable(c, callee, "call");
    requireAligned(c, callee, "call");
    break;
  }
  bindArguments(c, expr, pou);
  if (expr->resolved != Callee::function) {
    if (!asStatement) {
      auto &d = c.report(Code::blockCallAsValue, expr->span,
                         "the call of `" + std::string(pou->name.text) + "` has no value",
                         "used as a value here");
      d.help("call it in a statement of its own, then read one of its outputs");
      return elementaryType(TypeKind::error);
    }
    return elementaryType(TypeKind::none);
  }
  if (pou->result == nullptr)
    return elementaryType(TypeKind::none);
  const Type *result = pou->result->type;
  return result->kind == TypeKind::reference ? typeAs<PointerType>(result)->pointee : result;
}

} // namespace stc::sema
