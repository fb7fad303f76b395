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

const Type *checkQueryFor(Context &c, CallExpr *expr, TypeKind wanted) {
  const Type *boolean = elementaryType(TypeKind::Boolean);
  const bool toPointer = wanted == TypeKind::Pointer;
  Expr *source = expr->arguments[0].value;
  Expr *target = expr->arguments[1].value;
  const Type *from = source->type;
  const Type *to = target->type;
  if (isError(from) || isError(to))
    return boolean;
  if (from->kind != TypeKind::Interface && !isInstance(from))
    return argumentError(c, expr, 0, "an interface variable or an instance");
  if (isInstance(from) && !hasTypeId(typeAs<PouType>(from)->symbol))
    return argumentError(c, expr, 0, "an instance of a block with interfaces or bases");
  if (toPointer ? to->kind != TypeKind::Pointer ||
                      typeAs<PointerType>(to)->pointee->kind != TypeKind::FunctionBlock
                : to->kind != TypeKind::Interface)
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
  Expr *value = expr->arguments[0].value;
  if (isError(value->type) || isReference(value))
    return elementaryType(TypeKind::Boolean);
  const Symbol *symbol = value->kind == ExprKind::Name     ? as<NameExpr>(value)->symbol
                         : value->kind == ExprKind::Member ? as<MemberExpr>(value)->symbol
                                                           : nullptr;
  const auto *variable = symbol != nullptr && symbol->kind == SymbolKind::Variable
                             ? static_cast<const VarSymbol *>(symbol)
                             : nullptr;
  if (variable == nullptr || variable->section != Section::InOut ||
      variable->type->kind == TypeKind::OpenArray)
    return argumentError(c, expr, 0, "a REFERENCE TO variable");
  return elementaryType(TypeKind::Boolean);
}

} // namespace stc::sema
