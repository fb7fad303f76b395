// Values of interface type.

#include "compiler/semantics/expressions/internal.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/hierarchy.hpp"

namespace stc::sema {

using namespace ast;

/// Words for an instance, interface or pointer that does not convert to the interface `to`.
static void reportNoInterface(Context &c, Expr *expr, const Type *from, const Type *to) {
  const std::string name = typeName(to);
  const PouSymbol *wanted = typeAs<PouType>(to)->symbol;
  const std::string text(c.program.sources.text(expr->span));
  if (from->kind == TypeKind::interface) {
    auto &d = c.report(Code::needsQuery, expr->span,
                       "not every `" + typeName(from) + "` is also `" + name + "`",
                       "this is `" + typeName(from) + "`");
    noteDeclaration(d, wanted);
    d.help("ask at run time: `__QUERYINTERFACE(" + text +
           ", target)` gives TRUE and sets the "
           "target when the instance has it");
    return;
  }
  auto &d = c.report(Code::noSuchInterface, expr->span,
                     isInstance(from) ? "`" + typeName(from) + "` does not implement `" + name + "`"
                                      : "expected an instance that implements `" + name +
                                            "`, found " + typeName(from),
                     "this is " + typeName(from));
  if (isInstance(from)) {
    const PouSymbol *pou = typeAs<PouType>(from)->symbol;
    noteDeclaration(d, pou);
    if (pou->isBlock() && pou->library->isUser)
      d.help("declare it: `FUNCTION_BLOCK " + std::string(pou->name.text) + " IMPLEMENTS " + name +
             "`");
  } else if (from->kind == TypeKind::pointer && isInstance(typeAs<PointerType>(from)->pointee)) {
    d.help("follow the pointer: `" + text + "^`");
  }
}

bool coerceToInterface(Context &c, Expr *expr, const Type *type) {
  const Type *from = expr->type;
  if (type->kind != TypeKind::interface)
    return false;
  if (expr->constant != nullptr && from->kind == TypeKind::anyInteger &&
      expr->constant->integer == 0) {
    setTarget(expr, type);
    return true;
  }
  const bool convertible = (isInstance(from) || from->kind == TypeKind::interface) &&
                           convertsTo(typeAs<PouType>(from)->symbol, typeAs<PouType>(type)->symbol);
  if (!convertible) {
    reportNoInterface(c, expr, from, type);
    return true;
  }
  const bool isReference = expr->kind == ExprKind::call &&
                           as<CallExpr>(expr)->resolved == Callee::method &&
                           as<CallExpr>(expr)->pou->result->type->kind == TypeKind::reference;
  if (isInstance(from) && !isReference && expr->kind != ExprKind::name &&
      expr->kind != ExprKind::member && expr->kind != ExprKind::index &&
      expr->kind != ExprKind::deref) {
    c.report(Code::notAssignable, expr->span, "an interface needs an instance that stays",
             "this is a copy that goes away")
        .help("store it in a variable first");
    return true;
  }
  if (isInstance(from) && rejectProperty(c, expr, "refer to"))
    return true;
  setTarget(expr, type);
  return true;
}

} // namespace stc::sema
