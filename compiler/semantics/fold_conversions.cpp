// X_TO_Y of constants.

#include "compiler/semantics/fold.hpp"
#include "compiler/semantics/fold_texts.hpp"
#include "compiler/semantics/symbols.hpp"
#include "runtime/iec/ops.h"

#include <algorithm>
#include <bit>

namespace stc {

namespace {

/// The run time's name of an elementary kind; both lists have the same order.
stride::Kind runtimeKind(const Type *type) {
  static_assert(
      static_cast<unsigned>(TypeKind::Wstring) - static_cast<unsigned>(TypeKind::Boolean) ==
      static_cast<unsigned>(stride::Kind::WSTRING) - static_cast<unsigned>(stride::Kind::BOOL));
  return static_cast<stride::Kind>(static_cast<unsigned>(underlying(type)->kind) -
                                   static_cast<unsigned>(TypeKind::Boolean) +
                                   static_cast<unsigned>(stride::Kind::BOOL));
}

std::optional<ConstValue> toText(const ConstValue &value, const Type *from, const Type *to,
                                 Arena &arena) {
  char buffer[stride::text::kBufferSize];
  const auto single = static_cast<float>(value.real);
  const Type *u = underlying(from);
  const void *memory = u->kind == TypeKind::Lreal  ? static_cast<const void *>(&value.real)
                       : u->kind == TypeKind::Real ? static_cast<const void *>(&single)
                                                   : static_cast<const void *>(&value.integer);
  const uint32_t length = stride::text::formatValue(buffer, runtimeKind(from), memory);
  const uint32_t room = typeAs<StringType>(to)->length;
  return ConstValue{ConstKind::String, 0, 0,
                    arena.copy(std::string_view(buffer, std::min(length, room)))};
}

std::optional<ConstValue> fromText(const ConstValue &value, const Type *from, const Type *to) {
  std::string text;
  for (const char16_t unit : decode(value.text, from->kind == TypeKind::Wstring))
    text += unit < 256 ? static_cast<char>(unit) : '?';
  uint64_t memory = 0;
  const Type *u = underlying(to);
  stride::text::parseValue(runtimeKind(to), text.c_str(), static_cast<uint32_t>(text.size()),
                           &memory);
  if (u->kind == TypeKind::Lreal)
    return realValue(std::bit_cast<double>(memory));
  if (u->kind == TypeKind::Real)
    return realValue(static_cast<double>(std::bit_cast<float>(static_cast<uint32_t>(memory))));
  return integerValue(wrapTo(u, static_cast<int64_t>(memory)));
}

} // namespace

std::optional<ConstValue> foldConversion(const ConstValue &value, const Type *from, const Type *to,
                                         Arena &arena) {
  const Type *f = underlying(from);
  const Type *t = underlying(to);
  if (isString(f) && isString(t)) {
    Units units = decode(value.text, f->kind == TypeKind::Wstring);
    if (t->kind == TypeKind::String)
      std::replace_if(
          units.begin(), units.end(), [](char16_t c) { return c > 0xFF; }, u'?');
    if (units.size() > typeAs<StringType>(t)->length)
      units.resize(typeAs<StringType>(t)->length);
    return encode(units, arena);
  }
  if (from->kind == TypeKind::Enumeration && typeAs<EnumType>(from)->named &&
      t->kind == TypeKind::String) {
    for (const EnumeratorSymbol *e : typeAs<EnumType>(from)->enumerators) {
      if (e->value == value.integer)
        return ConstValue{ConstKind::String, 0, 0,
                          e->name.text.substr(0, typeAs<StringType>(t)->length)};
    }
  }
  if (isCharacter(f) && isString(t)) {
    Units one;
    const auto unit = static_cast<char16_t>(value.integer);
    if (unit != 0)
      one += unit > 0xFF && t->kind == TypeKind::String ? u'?' : unit;
    return encode(one, arena);
  }
  if (f->kind == TypeKind::Wchar && t->kind == TypeKind::Char)
    return integerValue(value.integer > 0xFF ? '?' : value.integer);
  if (isString(t))
    return toText(value, from, to, arena);
  if (isString(f) && isCharacter(t)) {
    const uint16_t unit = firstUnit(value.text, f->kind == TypeKind::Wstring);
    return integerValue(unit > 0xFF && t->kind == TypeKind::Char ? '?' : unit);
  }
  if (isString(f))
    return fromText(value, from, to);
  if (isTimeOrDate(f) && isTimeOrDate(t))
    return f == t ? value
                  : integerValue(
                        stride::detail::timeToTime(runtimeKind(t), runtimeKind(f), value.integer));
  if (isTimeOrDate(f) && isReal(t)) {
    const auto wide = static_cast<double>(value.integer);
    return realValue(
        t->kind == TypeKind::Real ? static_cast<double>(static_cast<float>(value.integer)) : wide);
  }
  if (isTimeOrDate(f) && isInteger(t))
    return integerValue(wrapTo(t, value.integer));
  if (isTimeOrDate(t) && value.kind == ConstKind::Real)
    return integerValue(stride::detail::realToTime(runtimeKind(t), value.real));
  if (isTimeOrDate(t))
    return integerValue(
        stride::detail::integerToTime(runtimeKind(t), value.integer, isUnsigned64(f)));
  return convertConstant(value, from, to);
}

} // namespace stc
