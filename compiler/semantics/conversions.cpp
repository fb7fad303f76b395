#include "compiler/semantics/conversions.hpp"

#include "compiler/semantics/fold_builtins.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/symbols.hpp"
#include "compiler/semantics/type_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stc {

namespace {

bool unsignedKind(const Type *t) { return isUnsignedInteger(t) || isBitString(t); }

/// Every value of integer type `from` is a value of integer type `to`.
bool survives(const Type *from, const Type *to) {
  const unsigned wf = bitWidth(from);
  const unsigned wt = bitWidth(to);
  if (unsignedKind(from))
    return unsignedKind(to) ? wt >= wf : wt > wf;
  return !unsignedKind(to) && wt >= wf;
}

Conversion classifyInteger(const Type *from, const Type *to) {
  if (survives(from, to))
    return Conversion::free;
  return bitWidth(from) == bitWidth(to) ? Conversion::lossy : Conversion::narrowing;
}

Conversion classifyTime(TypeKind from, TypeKind to) {
  using enum TypeKind;
  const bool widens = (from == time && to == ltime) || (from == date && to == ldate) ||
                      (from == tod && to == ltod) || (from == dt && to == ldt);
  return widens ? Conversion::free : Conversion::narrowing;
}

} // namespace

bool sameShape(const Type *a, const Type *b) {
  while (a != b && a->kind == TypeKind::array && b->kind == TypeKind::array &&
         typeAs<ArrayType>(a)->count() == typeAs<ArrayType>(b)->count()) {
    a = typeAs<ArrayType>(a)->element;
    b = typeAs<ArrayType>(b)->element;
  }
  return a == b;
}

Conversion classify(const Type *from, const Type *to) {
  if (from == to || isError(from) || isError(to))
    return Conversion::identity;
  const auto isPou = [](const Type *t) { return isInstance(t) || t->kind == TypeKind::interface; };
  if (isPou(from) && isPou(to))
    return convertsTo(typeAs<PouType>(from)->symbol, typeAs<PouType>(to)->symbol)
               ? Conversion::free
               : Conversion::forbidden;
  if (to->kind == TypeKind::subrange) {
    const Type *base = typeAs<SubrangeType>(to)->base;
    return from == base ? Conversion::free : classify(underlying(from), base);
  }
  if (from->kind == TypeKind::subrange)
    return classify(typeAs<SubrangeType>(from)->base, to);
  if (from->kind == TypeKind::enumeration) {
    if (to->kind == TypeKind::enumeration)
      return Conversion::forbidden;
    const Type *base = typeAs<EnumType>(from)->base;
    if (isInteger(to) && bitWidth(to) == bitWidth(base))
      return Conversion::free;
    return classify(base, to);
  }
  if (to->kind == TypeKind::enumeration)
    return isInteger(from) ? Conversion::lossy : Conversion::forbidden;
  if (isInteger(from)) {
    if (isInteger(to))
      return classifyInteger(from, to);
    if (to->kind == TypeKind::real)
      return bitWidth(from) <= 16 ? Conversion::free : Conversion::narrowing;
    if (to->kind == TypeKind::lreal)
      return bitWidth(from) <= 32 ? Conversion::free : Conversion::narrowing;
    return isElementary(to) ? Conversion::narrowing : Conversion::forbidden;
  }
  if (isReal(from)) {
    if (isReal(to))
      return to->kind == TypeKind::lreal ? Conversion::free : Conversion::lossy;
    return isElementary(to) ? Conversion::narrowing : Conversion::forbidden;
  }
  if (isString(from) && isString(to))
    return from->kind == to->kind ? Conversion::free : Conversion::narrowing;
  if (isCharacter(from) && isString(to)) // edition 3: a text of one character
    return (from->kind == TypeKind::charT) == (to->kind == TypeKind::string)
               ? Conversion::free
               : Conversion::narrowing;
  if (isTimeOrDate(from) && isTimeOrDate(to))
    return classifyTime(from->kind, to->kind);
  if (from->kind == TypeKind::pointer && to->kind == TypeKind::pointer) {
    const Type *f = typeAs<PointerType>(from)->pointee;
    const Type *t = typeAs<PointerType>(to)->pointee;
    if (isInstance(f) && isInstance(t) &&
        derivesFrom(typeAs<PouType>(f)->symbol, typeAs<PouType>(t)->symbol))
      return Conversion::free; // a derived instance begins with its base
  }
  if (from->kind == TypeKind::pointer && to->kind == TypeKind::pointer)
    return isByteView(typeAs<PointerType>(to)->pointee) ||
                   isByteView(typeAs<PointerType>(from)->pointee)
               ? Conversion::free
               : Conversion::lossy;
  if (from->kind == TypeKind::pointer && isInteger(to) && bitWidth(to) >= 32)
    return bitWidth(to) == 64 ? Conversion::free : Conversion::lossy;
  if (isElementary(from) && isElementary(to))
    return Conversion::narrowing;
  return sameShape(from, to) ? Conversion::free : Conversion::forbidden;
}

bool constantFits(const ConstValue &value, const Type *from, const Type *to) {
  if (to->kind == TypeKind::enumeration) {
    if (value.kind != ConstKind::integer ||
        !(from->kind == TypeKind::anyInteger || isInteger(from)))
      return false;
    const auto &list = typeAs<EnumType>(to)->enumerators;
    return std::any_of(list.begin(), list.end(),
                       [&](const EnumeratorSymbol *e) { return e->value == value.integer; });
  }
  if (value.kind == ConstKind::string && isCharacter(to))
    return isString(from) && (from->kind == TypeKind::string) == (to->kind == TypeKind::charT) &&
           textLength(value.text, from->kind == TypeKind::wstring) == 1;
  if (value.kind == ConstKind::string)
    return isString(from) && from->kind == to->kind;
  if (value.kind == ConstKind::real)
    return isReal(to) &&
           (to->kind == TypeKind::lreal || !std::isfinite(value.real) ||
            std::fabs(value.real) <= static_cast<double>(std::numeric_limits<float>::max()));
  const bool number = from->kind == TypeKind::anyInteger || isInteger(underlying(from));
  if (!number)
    return false;
  if (isReal(to))
    return from->kind == TypeKind::anyInteger || classify(from, to) == Conversion::free ||
           std::abs(value.integer) <= (std::int64_t{1} << 24);
  if (to->kind == TypeKind::boolean)
    return from->kind == TypeKind::anyInteger && (value.integer == 0 || value.integer == 1);
  if (!isInteger(underlying(to)))
    return false;
  const bool hugeUnsigned =
      from->kind != TypeKind::anyInteger && unsignedKind(underlying(from)) && value.integer < 0;
  const IntegerRange range = integerRange(to);
  if (unsignedKind(underlying(to)) && bitWidth(to) == 64 && to->kind != TypeKind::subrange)
    return hugeUnsigned || value.integer >= 0;
  return !hugeUnsigned && value.integer >= range.low && value.integer <= range.high;
}

const Type *smallestInteger(std::int64_t value) {
  for (const TypeKind kind : {TypeKind::sint, TypeKind::usint, TypeKind::intT, TypeKind::uint,
                              TypeKind::dint, TypeKind::udint, TypeKind::lint}) {
    const Type *t = elementaryType(kind);
    const IntegerRange range = integerRange(t);
    if (value >= range.low && value <= range.high)
      return t;
  }
  return elementaryType(TypeKind::lint);
}

const Type *commonNumber(const Type *a, const Type *b) {
  a = underlying(a);
  b = underlying(b);
  if (a == b)
    return a;
  if (isReal(a) || isReal(b)) {
    const auto needsLreal = [](const Type *t) {
      return t->kind == TypeKind::lreal || (isInteger(t) && bitWidth(t) > 16);
    };
    return elementaryType(needsLreal(a) || needsLreal(b) ? TypeKind::lreal : TypeKind::real);
  }
  // Between a bit string and an unsigned integer of one width the integer is the common type.
  if (isBitString(a) && isUnsignedInteger(b) && survives(a, b))
    return b;
  if (isBitString(b) && isUnsignedInteger(a) && survives(b, a))
    return a;
  if (survives(a, b))
    return b;
  if (survives(b, a))
    return a;
  for (const TypeKind kind : {TypeKind::intT, TypeKind::dint, TypeKind::lint}) {
    const Type *t = elementaryType(kind);
    if (survives(a, t) && survives(b, t))
      return t;
  }
  return nullptr;
}

const Type *widened(const Type *t) {
  t = underlying(t);
  if (!isInteger(t) || bitWidth(t) >= 32)
    return t;
  return elementaryType(isBitString(t) ? TypeKind::dword : TypeKind::dint);
}

} // namespace stc
