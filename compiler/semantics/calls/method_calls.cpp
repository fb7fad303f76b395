// Calls of methods and actions.

#include "compiler/semantics/calls/internal.hpp"

#include "compiler/semantics/classes/classes.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/hierarchy.hpp"

namespace stc::sema {

using namespace ast;

PouSymbol *methodOf(Context &c, Expr *callee, const Type *&base) {
  base = nullptr;
  if (callee->kind != ExprKind::Member || as<MemberExpr>(callee)->bit >= 0)
    return nullptr;
  auto *member = as<MemberExpr>(callee);
  followSelf(c, member->base);
  if (resolveNamespace(c, member->base) != nullptr)
    return nullptr;
  base = check(c, member->base);
  if (!isInstance(base) && base->kind != TypeKind::Interface)
    return nullptr;
  PouSymbol *pou = typeAs<PouType>(base)->symbol;
  declare(c, pou);
  Symbol *symbol = memberNamed(pou, member->name.id);
  if (symbol == nullptr || symbol->kind != SymbolKind::Pou)
    return nullptr;
  member->symbol = symbol;
  return static_cast<PouSymbol *>(symbol);
}

const Type *checkMethodCall(Context &c, CallExpr *expr, PouSymbol *method) {
  Expr *callee = expr->callee;
  const Name &name =
      callee->kind == ExprKind::Name ? as<NameExpr>(callee)->name : as<MemberExpr>(callee)->name;
  declare(c, method->owner);
  declare(c, method);
  callee->type = elementaryType(TypeKind::None);
  expr->pou = method;
  expr->resolved = Callee::Method;
  requireAccess(c, name.span, method, method->owner, memberAccess(method));
  if (callee->kind == ExprKind::Member)
    requireOwn(c, as<MemberExpr>(callee)->base);
  if (method->isAbstract() && callee->kind == ExprKind::Member) {
    const Expr *object = as<MemberExpr>(callee)->base;
    if (object->kind == ExprKind::Deref && as<DerefExpr>(object)->base->kind == ExprKind::Name) {
      const Symbol *self = as<NameExpr>(as<DerefExpr>(object)->base)->symbol;
      if (self != nullptr && self->kind == SymbolKind::Self &&
          static_cast<const SelfSymbol *>(self)->isSuper) {
        auto &d = c.report(Code::AbstractCall, name.span,
                           "`" + std::string(method->owner->name.text) + "." +
                               std::string(method->name.text) + "` is ABSTRACT",
                           "the base has no such method to run");
        noteDeclaration(d, method);
      }
    }
  }
  bindArguments(c, expr, method);
  if (method->result == nullptr)
    return elementaryType(TypeKind::None);
  const Type *type = method->result->type;
  return type->kind == TypeKind::Reference ? typeAs<PointerType>(type)->pointee : type;
}

} // namespace stc::sema
