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
    return Conversion::Free;
  return bitWidth(to) >= bitWidth(from) ? Conversion::Lossy : Conversion::Narrowing;
}

Conversion classifyTime(TypeKind from, TypeKind to) {
  using enum TypeKind;
  const bool widens = (from == Time && to == Ltime) || (from == Date && to == Ldate) ||
                      (from == Tod && to == Ltod) || (from == Dt && to == Ldt);
  return widens ? Conversion::Free : Conversion::Narrowing;
}

} // namespace

bool sameShape(const Type *a, const Type *b) {
  while (a != b && a->kind == TypeKind::Array && b->kind == TypeKind::Array &&
         typeAs<ArrayType>(a)->count() == typeAs<ArrayType>(b)->count()) {
    a = typeAs<ArrayType>(a)->element;
    b = typeAs<ArrayType>(b)->element;
  }
  return a == b;
}

namespace {

/// Of an integer into what is neither an enumeration nor a subrange.
Conversion fromInteger(const Type *from, const Type *to) {
  if (isInteger(to))
    return classifyInteger(from, to);
  if (to->kind == TypeKind::Real)
    return bitWidth(from) <= 16 ? Conversion::Free : Conversion::Lossy;
  if (to->kind == TypeKind::Lreal)
    return bitWidth(from) <= 32 ? Conversion::Free : Conversion::Lossy;
  return isElementary(to) ? Conversion::Narrowing : Conversion::Forbidden;
}

Conversion fromReal(const Type *to) {
  if (isReal(to))
    return to->kind == TypeKind::Lreal ? Conversion::Free : Conversion::Lossy;
  return isElementary(to) ? Conversion::Narrowing : Conversion::Forbidden;
}

Conversion fromEnumeration(const Type *from, const Type *to) {
  if (to->kind == TypeKind::Enumeration)
    return Conversion::Forbidden;
  const Type *base = typeAs<EnumType>(from)->base;
  if (isInteger(to) && bitWidth(to) == bitWidth(base))
    return Conversion::Free;
  return classify(base, to);
}

Conversion classifyPointers(const Type *from, const Type *to) {
  const Type *f = typeAs<PointerType>(from)->pointee;
  const Type *t = typeAs<PointerType>(to)->pointee;
  if (isInstance(f) && isInstance(t) &&
      derivesFrom(typeAs<PouType>(f)->symbol, typeAs<PouType>(t)->symbol))
    return Conversion::Free; // a derived instance begins with its base
  return isByteView(t) || isByteView(f) ? Conversion::Free : Conversion::Lossy;
}

/// Into a STRING or WSTRING, of a text or (edition 3) of a character, a text of one.
Conversion classifyText(const Type *from, const Type *to) {
  const bool wide = from->kind == TypeKind::Wstring || from->kind == TypeKind::Wchar;
  return wide == (to->kind == TypeKind::Wstring) ? Conversion::Free : Conversion::Narrowing;
}

} // namespace

Conversion classify(const Type *from, const Type *to) {
  if (from == to || isError(from) || isError(to))
    return Conversion::Identity;
  const auto isPou = [](const Type *t) { return isInstance(t) || t->kind == TypeKind::Interface; };
  if (isPou(from) && isPou(to))
    return convertsTo(typeAs<PouType>(from)->symbol, typeAs<PouType>(to)->symbol)
               ? Conversion::Free
               : Conversion::Forbidden;
  if (to->kind == TypeKind::Subrange) {
    const Type *base = typeAs<SubrangeType>(to)->base;
    return from == base ? Conversion::Free : classify(underlying(from), base);
  }
  if (from->kind == TypeKind::Subrange)
    return classify(typeAs<SubrangeType>(from)->base, to);
  if (from->kind == TypeKind::Enumeration)
    return fromEnumeration(from, to);
  if (to->kind == TypeKind::Enumeration)
    return isInteger(from) ? Conversion::Lossy : Conversion::Forbidden;
  if (isInteger(from))
    return fromInteger(from, to);
  if (isReal(from))
    return fromReal(to);
  if ((isString(from) || isCharacter(from)) && isString(to))
    return classifyText(from, to);
  if (isTimeOrDate(from) && isTimeOrDate(to))
    return classifyTime(from->kind, to->kind);
  if (from->kind == TypeKind::Pointer && to->kind == TypeKind::Pointer)
    return classifyPointers(from, to);
  if (from->kind == TypeKind::Pointer && isInteger(to) && bitWidth(to) >= 32)
    return bitWidth(to) == 64 ? Conversion::Free : Conversion::Lossy;
  if (isElementary(from) && isElementary(to))
    return Conversion::Narrowing;
  return sameShape(from, to) ? Conversion::Free : Conversion::Forbidden;
}

bool constantFits(const ConstValue &value, const Type *from, const Type *to) {
  if (to->kind == TypeKind::Enumeration) {
    if (value.kind != ConstKind::Integer ||
        !(from->kind == TypeKind::AnyInteger || isInteger(from)))
      return false;
    const auto &list = typeAs<EnumType>(to)->enumerators;
    return std::any_of(list.begin(), list.end(),
                       [&](const EnumeratorSymbol *e) { return e->value == value.integer; });
  }
  if (value.kind == ConstKind::String && isCharacter(to))
    return isString(from) && (from->kind == TypeKind::String) == (to->kind == TypeKind::Char) &&
           textLength(value.text, from->kind == TypeKind::Wstring) == 1;
  if (value.kind == ConstKind::String)
    return isString(from) && from->kind == to->kind;
  if (value.kind == ConstKind::Real)
    return isReal(to) &&
           (to->kind == TypeKind::Lreal || !std::isfinite(value.real) ||
            std::fabs(value.real) <= static_cast<double>(std::numeric_limits<float>::max()));
  const bool number = from->kind == TypeKind::AnyInteger || isInteger(underlying(from));
  if (!number)
    return false;
  if (isReal(to))
    return from->kind == TypeKind::AnyInteger || classify(from, to) == Conversion::Free ||
           std::abs(value.integer) <= (int64_t{1} << 24);
  if (to->kind == TypeKind::Boolean)
    return from->kind == TypeKind::AnyInteger && (value.integer == 0 || value.integer == 1);
  if (!isInteger(underlying(to)))
    return false;
  const bool hugeUnsigned =
      from->kind != TypeKind::AnyInteger && unsignedKind(underlying(from)) && value.integer < 0;
  const IntegerRange range = integerRange(to);
  if (unsignedKind(underlying(to)) && bitWidth(to) == 64 && to->kind != TypeKind::Subrange)
    return hugeUnsigned || value.integer >= 0;
  return !hugeUnsigned && value.integer >= range.low && value.integer <= range.high;
}

const Type *smallestInteger(int64_t value) {
  for (const TypeKind kind : {TypeKind::Sint, TypeKind::Usint, TypeKind::Int, TypeKind::Uint,
                              TypeKind::Dint, TypeKind::Udint, TypeKind::Lint}) {
    const Type *t = elementaryType(kind);
    const IntegerRange range = integerRange(t);
    if (value >= range.low && value <= range.high)
      return t;
  }
  return elementaryType(TypeKind::Lint);
}

const Type *commonNumber(const Type *a, const Type *b) {
  a = underlying(a);
  b = underlying(b);
  if (a == b)
    return a;
  if (isReal(a) || isReal(b)) {
    const auto needsLreal = [](const Type *t) {
      return t->kind == TypeKind::Lreal || (isInteger(t) && bitWidth(t) > 16);
    };
    return elementaryType(needsLreal(a) || needsLreal(b) ? TypeKind::Lreal : TypeKind::Real);
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
  for (const TypeKind kind : {TypeKind::Int, TypeKind::Dint, TypeKind::Lint}) {
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
  return elementaryType(isBitString(t) ? TypeKind::Dword : TypeKind::Dint);
}

} // namespace stc
