// ADR, and what takes an address

#include "compiler/semantics/builtins/internal.hpp"

#include "compiler/semantics/alignment.hpp"
#include "compiler/semantics/builtins/builtin_calls.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/locations.hpp"

#include <algorithm>
#include <array>

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
        .help("declare `value : " +
              (place->type->kind == TypeKind::AnyInteger ? "DINT"
               : place->type->kind == TypeKind::AnyReal  ? "LREAL"
                                                         : typeName(place->type)) +
              " := …` in VAR, and take its address");
    return elementaryType(TypeKind::Error);
  }
  if (!isPlace || isEnumerator)
    return argumentError(c, expr, 0, "a variable");
  if (place->type->kind == TypeKind::OpenArray)
    return c.types.pointer(typeAs<OpenArrayType>(place->type)->element);
  // What is misaligned can be copied byte by byte only.
  return c.types.pointer(isMisaligned(place) ? elementaryType(TypeKind::Byte) : place->type);
}

const Type *checkAtomicAdd(Context &c, CallExpr *expr) {
  const Type *dint = elementaryType(TypeKind::Dint);
  const Type *pointer = underlying(valueOf(expr, 0)->type);
  if (pointer->kind != TypeKind::Pointer || typeAs<PointerType>(pointer)->pointee != dint)
    return argumentError(c, expr, 0, "a POINTER TO DINT");
  Expr *value = valueOf(expr, 1);
  constexpr std::array<TypeKind, 6> kWidened = {TypeKind::AnyInteger, TypeKind::Sint,
                                                TypeKind::Int,        TypeKind::Dint,
                                                TypeKind::Usint,      TypeKind::Uint};
  if (std::ranges::find(kWidened, underlying(value->type)->kind) == kWidened.end())
    return argumentError(c, expr, 1, "a DINT");
  setTarget(value, dint);
  return dint;
}

} // namespace stc::sema
