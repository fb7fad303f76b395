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
    return elementaryType(TypeKind::Error);
  const bool isPlace = place->kind == ExprKind::Name || place->kind == ExprKind::Member ||
                       place->kind == ExprKind::Index || place->kind == ExprKind::Deref ||
                       place->kind == ExprKind::Direct;
  if (isPlace && isBitPlace(place)) {
    c.report(Code::WrongArgumentType, place->span, "a single bit has no address", "this is a bit")
        .help("take the address of the variable that holds it");
    return elementaryType(TypeKind::Error);
  }
  const Symbol *symbol = place->kind == ExprKind::Name     ? as<NameExpr>(place)->symbol
                         : place->kind == ExprKind::Member ? as<MemberExpr>(place)->symbol
                                                           : nullptr;
  const bool isEnumerator = symbol != nullptr && symbol->kind == SymbolKind::Enumerator;
  if (place->kind == ExprKind::Literal) {
    c.report(Code::WrongArgumentType, place->span,
             "`" + calleeName(expr) + "` needs a variable here, not a literal",
             "it has no place in memory")
        .help("declare `text : " + typeName(place->type) + " := …;` in VAR, and take its address");
    return elementaryType(TypeKind::Error);
  }
  if (!isPlace || isEnumerator)
    return argumentError(c, expr, 0, "a variable");
  if (place->type->kind == TypeKind::OpenArray)
    return c.types.pointer(typeAs<OpenArrayType>(place->type)->element);
  // What is misaligned can be copied byte by byte only.
  return c.types.pointer(isMisaligned(place) ? elementaryType(TypeKind::Byte) : place->type);
}

} // namespace stc::sema
