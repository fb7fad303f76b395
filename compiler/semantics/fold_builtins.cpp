#include "compiler/semantics/fold_builtins.hpp"

#include "compiler/semantics/fold.hpp"
#include "compiler/semantics/symbols.hpp"
#include "runtime/iec/ops.h"

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

namespace stc {

namespace {

using ast::Builtin;

ConstValue realValue(double v) { return {ConstKind::Real, 0, v, {}}; }

// -------------------------------------------------------------------------------------------------
// texts: UTF-8 in the compiler (with halves of surrogate pairs), Latin-1 or UTF-16 at run time

using Units = std::u16string;

Units decode(std::string_view text, bool wide) {
  Units units;
  for (size_t at = 0; at < text.size();) {
    const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
    uint32_t point = byte(at++);
    const unsigned extra = point >= 0xF0 ? 3 : point >= 0xE0 ? 2 : point >= 0xC0 ? 1 : 0;
    if (extra != 0 && at + extra <= text.size()) {
      point &= 0x3FU >> extra;
      for (unsigned i = 0; i < extra; ++i)
        point = point << 6U | (byte(at++) & 0x3FU);
    }
    if (!wide && point > 0xFF) {
      units += u'?';
    } else if (point > 0xFFFF) {
      units += static_cast<char16_t>(0xD800 + ((point - 0x10000) >> 10U));
      units += static_cast<char16_t>(0xDC00 + ((point - 0x10000) & 0x3FFU));
    } else {
      units += static_cast<char16_t>(point);
    }
  }
  return units.substr(0, units.find(u'\0')); // a text ends at its first NUL
}

void appendUtf8(std::string &out, uint32_t point) {
  const auto tail = [&](unsigned shift) {
    out += static_cast<char>(0x80U | (point >> shift & 0x3FU));
  };
  if (point < 0x80) {
    out += static_cast<char>(point);
  } else if (point < 0x800) {
    out += static_cast<char>(0xC0U | point >> 6U);
    tail(0);
  } else if (point < 0x10000) {
    out += static_cast<char>(0xE0U | point >> 12U);
    tail(6);
    tail(0);
  } else {
    out += static_cast<char>(0xF0U | point >> 18U);
    tail(12);
    tail(6);
    tail(0);
  }
}

/// Half of a surrogate pair becomes three bytes, as if it was a character; decode() knows it.
ConstValue encode(const Units &units, Arena &arena) {
  std::string text;
  for (size_t i = 0; i < units.size(); ++i) {
    uint32_t point = units[i];
    if (point >= 0xD800 && point < 0xDC00 && i + 1 < units.size() && units[i + 1] >= 0xDC00 &&
        units[i + 1] < 0xE000)
      point = 0x10000 + ((point - 0xD800) << 10U) + (units[++i] - 0xDC00U);
    appendUtf8(text, point);
  }
  return ConstValue{ConstKind::String, 0, 0, arena.copy(std::string_view(text))};
}

size_t count(int64_t n) { return n < 0 ? 0 : static_cast<size_t>(std::min<int64_t>(n, 0x10000)); }

/// The part [from, from + n) as far as there is one.
Units part(const Units &s, size_t from, size_t n = Units::npos) {
  return from >= s.size() ? Units() : s.substr(from, n);
}

std::optional<ConstValue> foldText(Builtin function, std::span<const ConstArgument> arguments,
                                   const Type *result, Arena &arena) {
  const bool wide = arguments[0].type->kind == TypeKind::Wstring;
  const auto text = [&](size_t i) { return decode(arguments[i].value.text, wide); };
  const auto number = [&](size_t i) { return arguments[i].value.integer; };
  const Units a = text(0);
  Units out;
  switch (function) {
  case Builtin::Len:
    return integerValue(static_cast<int64_t>(a.size()));
  case Builtin::Find: {
    const Units b = text(1);
    const size_t at = b.empty() ? Units::npos : a.find(b);
    return integerValue(at == Units::npos ? 0 : static_cast<int64_t>(at + 1));
  }
  case Builtin::Left:
    out = part(a, 0, count(number(1)));
    break;
  case Builtin::Right:
    out = part(a, a.size() - std::min(a.size(), count(number(1))));
    break;
  case Builtin::Mid:
    out = part(a, count(number(2) - (number(2) > 0 ? 1 : 0)), count(number(1)));
    break;
  case Builtin::Concat:
    out = a + text(1);
    break;
  case Builtin::Insert: {
    const size_t at = count(number(2));
    out = part(a, 0, at) + text(1) + part(a, at);
    break;
  }
  case Builtin::Delete: {
    const size_t from = count(number(2) - (number(2) > 0 ? 1 : 0));
    out = part(a, 0, from) + part(a, from + count(number(1)));
    break;
  }
  case Builtin::Replace: {
    const size_t from = count(number(3) - (number(3) > 0 ? 1 : 0));
    out = part(a, 0, from) + text(1) + part(a, from + count(number(2)));
    break;
  }
  default:
    return std::nullopt;
  }
  if (isString(result) && out.size() > typeAs<StringType>(result)->length)
    out.resize(typeAs<StringType>(result)->length);
  return encode(out, arena);
}

// -------------------------------------------------------------------------------------------------
// numbers

template <class T> int64_t shifted(Builtin function, int64_t x, int64_t n) {
  const T value = static_cast<T>(x);
  switch (function) {
  case Builtin::Shl:
    return static_cast<int64_t>(stride::shl(value, n));
  case Builtin::Shr:
    return static_cast<int64_t>(stride::shr(value, n));
  case Builtin::Rol:
    return static_cast<int64_t>(stride::rol(value, n));
  default:
    return static_cast<int64_t>(stride::ror(value, n));
  }
}

std::optional<ConstValue> foldShift(Builtin function, int64_t x, int64_t n, const Type *type) {
  const bool isSigned = isSignedInteger(type);
  switch (bitWidth(type)) {
  case 8:
    return integerValue(isSigned ? shifted<int8_t>(function, x, n)
                                 : shifted<uint8_t>(function, x, n));
  case 16:
    return integerValue(isSigned ? shifted<int16_t>(function, x, n)
                                 : shifted<uint16_t>(function, x, n));
  case 32:
    return integerValue(isSigned ? shifted<int32_t>(function, x, n)
                                 : shifted<uint32_t>(function, x, n));
  default:
    return integerValue(isSigned ? shifted<int64_t>(function, x, n)
                                 : shifted<uint64_t>(function, x, n));
  }
}

template <class T> std::optional<ConstValue> foldMath(Builtin function, T x, T y) {
  switch (function) {
  case Builtin::Sqrt:
    return realValue(stride::sqrt(x));
  case Builtin::Ln:
    return realValue(stride::ln(x));
  case Builtin::Log:
    return realValue(stride::log10(x));
  case Builtin::Exp:
    return realValue(stride::exp(x));
  case Builtin::Sin:
    return realValue(stride::sin(x));
  case Builtin::Cos:
    return realValue(stride::cos(x));
  case Builtin::Tan:
    return realValue(stride::tan(x));
  case Builtin::Asin:
    return realValue(stride::asin(x));
  case Builtin::Acos:
    return realValue(stride::acos(x));
  case Builtin::Atan:
    return realValue(stride::atan(x));
  case Builtin::Atan2:
    return realValue(stride::atan2(x, y));
  case Builtin::Expt:
    return realValue(stride::pow(x, y));
  default:
    return std::nullopt;
  }
}

std::optional<ConstValue> foldTruncation(double value, const Type *to) {
  const Type *t = underlying(to);
  const auto cut = [&](auto narrow) {
    using T = decltype(narrow);
    return integerValue(static_cast<int64_t>(stride::truncate<T>(value)));
  };
  switch (bitWidth(t)) {
  case 8:
    return isSignedInteger(t) ? cut(int8_t{}) : cut(uint8_t{});
  case 16:
    return isSignedInteger(t) ? cut(int16_t{}) : cut(uint16_t{});
  case 32:
    return isSignedInteger(t) ? cut(int32_t{}) : cut(uint32_t{});
  default:
    return isSignedInteger(t) ? cut(int64_t{}) : cut(uint64_t{});
  }
}

bool less(const ConstArgument &a, const ConstArgument &b) {
  if (a.value.kind == ConstKind::String)
    return compareTexts(a.value.text, b.value.text, a.type->kind == TypeKind::Wstring) < 0;
  if (a.value.kind == ConstKind::Real)
    return a.value.real < b.value.real;
  if (isUnsigned64(a.type))
    return static_cast<uint64_t>(a.value.integer) < static_cast<uint64_t>(b.value.integer);
  return a.value.integer < b.value.integer;
}

/// GT(a, b, c …): each argument with the one behind it.
std::optional<ConstValue> foldOrder(Builtin function, std::span<const ConstArgument> arguments) {
  using enum ast::BinaryOp;
  const ast::BinaryOp op = function == Builtin::Greater        ? Greater
                           : function == Builtin::GreaterEqual ? GreaterEqual
                           : function == Builtin::Equal        ? Equal
                           : function == Builtin::LessEqual    ? LessEqual
                                                               : Less;
  bool all = true;
  for (size_t i = 1; i < arguments.size(); ++i) {
    const auto pair = foldBinary(op, arguments[i - 1].value, arguments[i].value, arguments[i].type);
    if (!pair)
      return std::nullopt;
    all = all && pair->integer != 0;
  }
  return integerValue(all ? 1 : 0);
}

int64_t swapped(const Type *type, int64_t value) {
  switch (bitWidth(underlying(type))) {
  case 64:
    return static_cast<int64_t>(stride::swapBytes(static_cast<uint64_t>(value)));
  case 32:
    return wrapTo(type, stride::swapBytes(static_cast<uint32_t>(value)));
  case 16:
    return wrapTo(type, stride::swapBytes(static_cast<uint16_t>(value)));
  default:
    return value;
  }
}

std::optional<ConstValue> foldAbs(const ConstArgument &x) {
  if (x.value.kind == ConstKind::Real)
    return realValue(stride::abs(x.value.real));
  const Type *u = underlying(x.type);
  if (x.value.integer < 0 && (isSignedInteger(u) || u->kind == TypeKind::Ltime))
    return integerValue(
        wrapTo(u, static_cast<int64_t>(0 - static_cast<uint64_t>(x.value.integer))));
  return x.value;
}

// -------------------------------------------------------------------------------------------------
// conversions

/// The run time's name of an elementary kind; both lists have the same order.
stride::Kind runtimeKind(const Type *type) {
  static_assert(
      static_cast<unsigned>(TypeKind::Wstring) - static_cast<unsigned>(TypeKind::Boolean) ==
      static_cast<unsigned>(stride::Kind::WSTRING) - static_cast<unsigned>(stride::Kind::BOOL));
  return static_cast<stride::Kind>(static_cast<unsigned>(underlying(type)->kind) -
                                   static_cast<unsigned>(TypeKind::Boolean) +
                                   static_cast<unsigned>(stride::Kind::BOOL));
}

int64_t betweenTimes(int64_t value, stride::Kind from, stride::Kind to) {
  using namespace stride::detail;
  using stride::floorDivide;
  auto ns =
      static_cast<int64_t>(static_cast<uint64_t>(value) * static_cast<uint64_t>(unitNs(from)));
  if (isDate(to) && (isDateAndTime(from) || isDate(from)))
    ns = floorDivide(ns, kDayNs) * kDayNs;
  else if (isTimeOfDay(to) && isDateAndTime(from))
    ns -= floorDivide(ns, kDayNs) * kDayNs;
  return floorDivide(ns, unitNs(to));
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

int compareTexts(std::string_view a, std::string_view b, bool wide) {
  return decode(a, wide).compare(decode(b, wide));
}

size_t textLength(std::string_view text, bool wide) { return decode(text, wide).size(); }

uint16_t firstUnit(std::string_view text, bool wide) {
  const Units units = decode(text, wide);
  return units.empty() ? uint16_t{0} : static_cast<uint16_t>(units.front());
}

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
                        wrapTo(t, betweenTimes(value.integer, runtimeKind(f), runtimeKind(t))));
  if (isTimeOrDate(f) && isReal(t)) {
    const auto wide = static_cast<double>(value.integer);
    return realValue(
        t->kind == TypeKind::Real ? static_cast<double>(static_cast<float>(value.integer)) : wide);
  }
  if (isTimeOrDate(f) && isInteger(t))
    return integerValue(wrapTo(t, value.integer));
  if (isTimeOrDate(t) && value.kind == ConstKind::Real)
    return bitWidth(t) == 32 ? integerValue(stride::convert<uint32_t>(value.real))
                             : integerValue(stride::convert<int64_t>(value.real));
  if (isTimeOrDate(t))
    return integerValue(wrapTo(t, value.integer));
  return convertConstant(value, from, to);
}

std::optional<ConstValue> foldBuiltin(Builtin function, std::span<const ConstArgument> arguments,
                                      const Type *result, Arena &arena) {
  if (arguments.empty())
    return std::nullopt;
  const ConstArgument &first = arguments.front();
  switch (function) {
  case Builtin::Abs:
    return foldAbs(first);
  case Builtin::Min:
  case Builtin::Max: {
    const ConstArgument *best = &first;
    for (const ConstArgument &a : arguments.subspan(1)) {
      if (function == Builtin::Min ? less(a, *best) : less(*best, a))
        best = &a;
    }
    return best->value;
  }
  case Builtin::Limit: {
    const ConstArgument &low = less(arguments[1], first) ? first : arguments[1];
    return (less(arguments[2], low) ? arguments[2] : low).value;
  }
  case Builtin::Sel:
    return arguments[first.value.integer != 0 ? 2 : 1].value;
  case Builtin::Mux: {
    const int64_t at = first.value.integer;
    if (at < 0 || static_cast<uint64_t>(at) + 1 >= arguments.size())
      return std::nullopt;
    return arguments[static_cast<size_t>(at) + 1].value;
  }
  case Builtin::Move:
    return first.value;
  case Builtin::Shl:
  case Builtin::Shr:
  case Builtin::Rol:
  case Builtin::Ror:
    return foldShift(function, first.value.integer, arguments[1].value.integer, result);
  case Builtin::Trunc:
    return foldTruncation(first.value.real, result);
  case Builtin::Greater:
  case Builtin::GreaterEqual:
  case Builtin::Equal:
  case Builtin::LessEqual:
  case Builtin::Less:
    return foldOrder(function, arguments);
  case Builtin::FromBcd:
    return integerValue(
        wrapTo(result, stride::fromBcd<int64_t>(static_cast<uint64_t>(first.value.integer))));
  case Builtin::ToBcd:
    return integerValue(
        wrapTo(result, stride::toBcd<int64_t>(static_cast<uint64_t>(first.value.integer))));
  case Builtin::IsValidBcd:
    return integerValue(stride::isValidBcd<uint8_t>(static_cast<uint64_t>(first.value.integer)));
  case Builtin::IsValid:
    return integerValue(stride::isValid<uint8_t>(first.value.real));
  case Builtin::BigEndian: // what a REAL's bytes mean backwards has bits that no constant keeps
    return first.value.kind == ConstKind::Real
               ? std::nullopt
               : std::optional(integerValue(swapped(result, first.value.integer)));
  case Builtin::LittleEndian:
    return first.value;
  default:
    break;
  }
  if (function >= Builtin::Len && function <= Builtin::Find)
    return foldText(function, arguments, result, arena);
  if (function < Builtin::Sqrt || function > Builtin::Expt)
    return std::nullopt;
  const double x = first.value.real;
  const double y = arguments.size() > 1 ? arguments[1].value.real : 0;
  if (underlying(result)->kind == TypeKind::Real)
    return foldMath(function, static_cast<float>(x), static_cast<float>(y));
  return foldMath(function, x, y);
}

} // namespace stc
