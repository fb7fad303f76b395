// Calls of functions that the compiler implements itself.

#include "compiler/semantics/builtins/builtin_calls.hpp"

#include "compiler/semantics/alignment.hpp"
#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/builtins/internal.hpp"
#include "compiler/semantics/config/config.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/locations.hpp"
#include "compiler/semantics/types/resolve.hpp"

namespace stc::sema {

using namespace ast;

const Type *checkBuiltin(Context &c, CallExpr *expr, const Type *expected) {
  const Type *bad = elementaryType(TypeKind::error);
  bool failed = !placeArguments(c, expr);
  if (expr->builtin == Builtin::sizeofT) // its argument may be a type
    return failed ? bad : checkSizeof(c, expr);
  if (expr->builtin == Builtin::newT)
    return failed ? bad : checkNew(c, expr);
  if (expr->builtin == Builtin::indexOf)
    return failed ? bad : checkIndexOf(c, expr);
  if (expr->builtin >= Builtin::add && expr->builtin <= Builtin::modulo)
    return failed ? bad : checkOperatorCall(c, expr);
  for (Argument &a : expr->arguments) {
    if (a.value != nullptr && isError(check(c, a.value, expected)))
      failed = true;
  }
  if (failed)
    return bad;
  for (const Argument &a : expr->arguments) {
    const bool asked = expr->builtin == Builtin::lowerBound ||
                       expr->builtin == Builtin::upperBound || expr->builtin == Builtin::adr;
    if (!asked && refuseOpenArray(c, a.value, "use"))
      return bad;
  }
  const auto value = [&](std::size_t i) { return expr->arguments[i].value; };
  const auto type = [&](std::size_t i) { return underlying(value(i)->type); };
  const auto own = [&](std::size_t i) {
    return isUntyped(value(i)->type) ? settle(value(i)) : type(i);
  };
  if (isAssertion(expr->builtin)) {
    const Type *boolean = elementaryType(TypeKind::boolean);
    const std::size_t values = assertedValues(expr->builtin);
    if (!requireCount(c, expr, values == 0 ? 1 : values, values + 1))
      return bad;
    const std::span<Argument> all = expr->arguments;
    if (all.size() > values && type(values)->kind != TypeKind::string)
      return argumentError(c, expr, values, "a STRING");
    if (values == 1) {
      coerce(c, value(0), boolean, "the condition of an assertion");
      return boolean;
    }
    for (std::size_t i = 0; i < values; ++i) {
      if (values == 3) {
        if (!isNumber(type(i)))
          return argumentError(c, expr, i, "a number");
        setTarget(value(i), elementaryType(TypeKind::lreal));
      } else if (!isNumber(type(i)) && !isElementary(type(i)) &&
                 type(i)->kind != TypeKind::enumeration) {
        return argumentError(c, expr, i, "a value of an elementary type or an enumeration");
      }
    }
    if (values == 2) {
      expr->arguments = all.first(2);
      const Type *common = commonOfArguments(c, expr, 0);
      expr->arguments = all;
      expr->common = nullptr;
      if (isError(common))
        return bad;
    }
    return boolean;
  }
  using enum Builtin;
  switch (expr->builtin) {
  case abs: {
    if (!requireCount(c, expr, 1, 1))
      return bad;
    if (!isNumber(type(0)) && type(0)->kind != TypeKind::ltime)
      return argumentError(c, expr, 0, "a number");
    const Type *t = own(0);
    setTarget(value(0), t);
    return t;
  }
  case sqrt:
  case ln:
  case log:
  case exp:
  case sin:
  case cos:
  case tan:
  case asin:
  case acos:
  case atan: {
    if (!requireCount(c, expr, 1, 1))
      return bad;
    if (!isNumber(type(0)))
      return argumentError(c, expr, 0, "a number");
    const Type *result =
        type(0)->kind == TypeKind::real ? type(0) : elementaryType(TypeKind::lreal);
    if (isUntyped(type(0))) // `r := SQRT(2.0)` is silent, as `r := 2.0` is
      expr->common = elementaryType(TypeKind::real);
    setTarget(value(0), result);
    return result;
  }
  case atan2:
  case expt: {
    if (!requireCount(c, expr, 2, 2))
      return bad;
    for (std::size_t i = 0; i < 2; ++i) {
      if (!isNumber(type(i)))
        return argumentError(c, expr, i, "a number");
    }
    const bool real =
        type(0)->kind == TypeKind::real && (type(1)->kind == TypeKind::real || isUntyped(type(1)));
    const Type *result = elementaryType(real ? TypeKind::real : TypeKind::lreal);
    if (isUntyped(type(0)) && isUntyped(type(1)))
      expr->common = elementaryType(TypeKind::real);
    setTarget(value(0), result);
    setTarget(value(1), result);
    return result;
  }
  case trunc: {
    if (!requireCount(c, expr, 1, 1))
      return bad;
    if (!isReal(type(0)) && type(0)->kind != TypeKind::anyReal)
      return argumentError(c, expr, 0, "REAL or LREAL");
    own(0);
    return elementaryType(TypeKind::dint);
  }
  case min:
  case max:
    if (!requireCount(c, expr, 2, SIZE_MAX))
      return bad;
    for (std::size_t i = 0; i < expr->arguments.size(); ++i) {
      if (!isElementary(type(i)))
        return argumentError(c, expr, i, "a value that can be compared");
    }
    return commonOfArguments(c, expr, 0);
  case limit:
    if (!requireCount(c, expr, 3, 3))
      return bad;
    for (std::size_t i = 0; i < expr->arguments.size(); ++i) {
      if (!isElementary(type(i)))
        return argumentError(c, expr, i, "a value that can be compared");
    }
    return commonOfArguments(c, expr, 0);
  case sel:
    if (!requireCount(c, expr, 3, 3))
      return bad;
    coerce(c, value(0), elementaryType(TypeKind::boolean), "the selector of SEL");
    return commonOfArguments(c, expr, 1);
  case mux:
    if (!requireCount(c, expr, 2, SIZE_MAX))
      return bad;
    if (!isInteger(type(0)) && type(0)->kind != TypeKind::anyInteger)
      return argumentError(c, expr, 0, "an integer");
    own(0);
    return commonOfArguments(c, expr, 1);
  case move: {
    if (!requireCount(c, expr, 1, 1))
      return bad;
    const Type *t = isUntyped(value(0)->type) ? settle(value(0)) : value(0)->type;
    return t;
  }
  case shl:
  case shr:
  case rol:
  case ror: {
    if (!requireCount(c, expr, 2, 2))
      return bad;
    if (!isInteger(type(0)) && type(0)->kind != TypeKind::anyInteger)
      return argumentError(c, expr, 0, "a bit string or an integer");
    if (!isInteger(type(1)) && type(1)->kind != TypeKind::anyInteger)
      return argumentError(c, expr, 1, "an integer");
    const Type *t = own(0);
    if (value(0)->type->kind == TypeKind::anyInteger) // a pattern, not a number
      t = elementaryType(value(0)->constant->integer < 0 ||
                                 value(0)->constant->integer > 0xFFFFFFFFLL
                             ? TypeKind::lword
                             : TypeKind::dword);
    value(0)->target = nullptr;
    setTarget(value(0), t);
    own(1);
    return t;
  }
  case len:
  case left:
  case right:
  case mid:
  case concat:
  case insert:
  case deleteS:
  case replace:
  case find:
    return checkStringBuiltin(c, expr);
  case isValid:
  case isValidBcd:
  case bigEndian:
  case littleEndian:
    return checkPatternCall(c, expr);
  case time:
  case ltime:
    if (!requireCount(c, expr, 0, 0))
      return bad;
    return elementaryType(expr->builtin == time ? TypeKind::time : TypeKind::ltime);
  case adr: {
    if (!requireCount(c, expr, 1, 1))
      return bad;
    Expr *place = value(0);
    if (rejectProperty(c, place, "take the address of"))
      return bad;
    const bool isPlace = place->kind == ExprKind::name || place->kind == ExprKind::member ||
                         place->kind == ExprKind::index || place->kind == ExprKind::deref ||
                         place->kind == ExprKind::direct;
    if (isPlace && isBitPlace(place)) {
      c.report(Code::wrongArgumentType, place->span, "a single bit has no address", "this is a bit")
          .help("take the address of the variable that holds it");
      return bad;
    }
    if (!isPlace || (place->constant != nullptr && isElementary(place->type)))
      return argumentError(c, expr, 0, "a variable");
    if (place->type->kind == TypeKind::openArray)
      return c.types.pointer(typeAs<OpenArrayType>(place->type)->element);
    // What is misaligned can be copied byte by byte only.
    return c.types.pointer(isMisaligned(place) ? elementaryType(TypeKind::byte) : place->type);
  }
  case bitadr:
    return checkBitAddress(c, expr);
  case queryInterface:
  case queryPointer:
    return checkQuery(c, expr);
  case deleteT:
    return checkDelete(c, expr);
  case ini:
    return checkIni(c, expr);
  case newT:
  case indexOf:
    break;
  case isValidRef:
    return checkIsValidRef(c, expr);
  case lowerBound:
  case upperBound:
    return checkBound(c, expr);
  default: // operators and conversions have been dealt with
    break;
  }
  return bad;
}

} // namespace stc::sema
