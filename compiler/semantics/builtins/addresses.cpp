// ADR

#include "compiler/semantics/builtins/internal.hpp"

#include "compiler/semantics/alignment.hpp"
#include "compiler/semantics/builtins/builtin_calls.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/locations.hpp"

namespace stc::sema {

using namespace ast;

const Type *checkAdr(Context &c, CallExpr *expr) {
  const Expr *place = valueOf(expr, 0);
  if (rejectProperty(c, place, "take the address of"))
    return elementaryType(TypeKind::error);
  const bool isPlace = place->kind == ExprKind::name || place->kind == ExprKind::member ||
                       place->kind == ExprKind::index || place->kind == ExprKind::deref ||
                       place->kind == ExprKind::direct;
  if (isPlace && isBitPlace(place)) {
    c.report(Code::wrongArgumentType, place->span, "a single bit has no address", "this is a bit")
        .help("take the address of the variable that holds it");
    return elementaryType(TypeKind::error);
  }
  if (!isPlace || (place->constant != nullptr && isElementary(place->type)))
    return argumentError(c, expr, 0, "a variable");
  if (place->type->kind == TypeKind::openArray)
    return c.types.pointer(typeAs<OpenArrayType>(place->type)->element);
  // What is misaligned can be copied byte by byte only.
  return c.types.pointer(isMisaligned(place) ? elementaryType(TypeKind::byte) : place->type);
}

} // namespace stc::sema
