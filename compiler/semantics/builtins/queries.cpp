// __QUERYINTERFACE, __QUERYPOINTER, __ISVALIDREF.

#include "compiler/semantics/builtins/internal.hpp"

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/builtins/builtin_calls.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/hierarchy.hpp"

namespace stc::sema {

using namespace ast;

const Type *checkQuery(Context &c, CallExpr *expr) {
  const Type *boolean = elementaryType(TypeKind::boolean);
  const bool toPointer = expr->builtin == Builtin::queryPointer;
  if (!requireCount(c, expr, 2, 2))
    return elementaryType(TypeKind::error);
  Expr *source = expr->arguments[0].value;
  Expr *target = expr->arguments[1].value;
  const Type *from = source->type;
  const Type *to = target->type;
  if (isError(from) || isError(to))
    return boolean;
  if (from->kind != TypeKind::interface && !isInstance(from))
    return argumentError(c, expr, 0, "an interface variable or an instance");
  if (isInstance(from) && !hasTypeId(typeAs<PouType>(from)->symbol))
    return argumentError(c, expr, 0, "an instance of a block with interfaces or bases");
  if (toPointer ? to->kind != TypeKind::pointer ||
                      typeAs<PointerType>(to)->pointee->kind != TypeKind::functionBlock
                : to->kind != TypeKind::interface)
    return argumentError(c, expr, 1,
                         toPointer ? "a POINTER TO a function block" : "an interface variable");
  if (toPointer) {
    PouSymbol *pou = typeAs<PouType>(typeAs<PointerType>(to)->pointee)->symbol;
    declare(c, pou);
    if (!hasTypeId(pou))
      return argumentError(c, expr, 1, "a POINTER TO a block with interfaces or bases");
  }
  requireVariable(c, target, "assign to");
  return boolean;
}

const Type *checkIsValidRef(Context &c, CallExpr *expr) {
  if (!requireCount(c, expr, 1, 1))
    return elementaryType(TypeKind::error);
  Expr *value = expr->arguments[0].value;
  if (isError(value->type) || isReference(value))
    return elementaryType(TypeKind::boolean);
  const Symbol *symbol = value->kind == ExprKind::name     ? as<NameExpr>(value)->symbol
                         : value->kind == ExprKind::member ? as<MemberExpr>(value)->symbol
                                                           : nullptr;
  const auto *variable = symbol != nullptr && symbol->kind == SymbolKind::variable
                             ? static_cast<const VarSymbol *>(symbol)
                             : nullptr;
  if (variable == nullptr || variable->section != Section::inOut ||
      variable->type->kind == TypeKind::openArray)
    return argumentError(c, expr, 0, "a REFERENCE TO variable");
  return elementaryType(TypeKind::boolean);
}

} // namespace stc::sema
