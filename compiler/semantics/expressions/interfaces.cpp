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
  if ((isInstance(from) || from->kind == TypeKind::Interface) &&
      isIncomplete(typeAs<PouType>(from)->symbol))
    return; // what it lacks may be the interface
  const std::string name = typeName(to);
  const PouSymbol *wanted = typeAs<PouType>(to)->symbol;
  const std::string text(c.program.sources.text(expr->span));
  if (from->kind == TypeKind::Interface) {
    auto &d = c.report(Code::NeedsQuery, expr->span,
                       "not every `" + typeName(from) + "` is also `" + name + "`",
                       "this is `" + typeName(from) + "`");
    noteDeclaration(d, wanted);
    d.help("ask at run time: `__QUERYINTERFACE(" + text +
           ", target)` gives TRUE and sets the "
           "target when the instance has it");
    return;
  }
  auto &d = c.report(Code::NoSuchInterface, expr->span,
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
  } else if (from->kind == TypeKind::Pointer && isInstance(typeAs<PointerType>(from)->pointee)) {
    d.help("follow the pointer: `" + text + "^`");
  }
}

bool coerceToInterface(Context &c, Expr *expr, const Type *type) {
  const Type *from = expr->type;
  if (type->kind != TypeKind::Interface)
    return false;
  if (expr->constant != nullptr && from->kind == TypeKind::AnyInteger &&
      expr->constant->integer == 0) {
    setTarget(expr, type);
    return true;
  }
  const bool convertible = (isInstance(from) || from->kind == TypeKind::Interface) &&
                           convertsTo(typeAs<PouType>(from)->symbol, typeAs<PouType>(type)->symbol);
  if (!convertible) {
    reportNoInterface(c, expr, from, type);
    return true;
  }
  const bool isReference = expr->kind == ExprKind::Call &&
                           as<CallExpr>(expr)->resolved == Callee::Method &&
                           as<CallExpr>(expr)->pou->result->type->kind == TypeKind::Reference;
  if (isInstance(from) && !isReference && expr->kind != ExprKind::Name &&
      expr->kind != ExprKind::Member && expr->kind != ExprKind::Index &&
      expr->kind != ExprKind::Deref) {
    c.report(Code::NotAssignable, expr->span, "an interface needs an instance that stays",
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
