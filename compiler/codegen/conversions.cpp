// Constants as C++ text, and which conversions C++ makes by itself.

#include "compiler/codegen/emitter.hpp"
#include "compiler/semantics/fold.hpp"
#include "compiler/semantics/fold_builtins.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace stc::codegen {

using namespace ast;

void Emitter::number(std::int64_t value, const Type *type) {
  const Type *t = underlying(type);
  if (t->kind == TypeKind::boolean) {
    w_ << (value != 0 ? "true" : "false");
    return;
  }
  switch (t->kind) {
  case TypeKind::ulint:
  case TypeKind::lword:
    w_ << static_cast<std::uint64_t>(value) << "ULL";
    return;
  case TypeKind::udint:
  case TypeKind::dword:
  case TypeKind::time:
  case TypeKind::date:
  case TypeKind::tod:
  case TypeKind::dt:
    w_ << static_cast<std::uint32_t>(value) << 'U';
    return;
  default:
    break;
  }
  const bool wide = bitWidth(t) == 64 && t->kind != TypeKind::anyInteger;
  const bool large = value > std::numeric_limits<std::int32_t>::max() ||
                     value < std::numeric_limits<std::int32_t>::min();
  const std::string_view suffix = wide || large ? "LL" : "";
  // The smallest value has no literal of its own: its digits alone are too large for the type.
  if (value == std::numeric_limits<std::int64_t>::min() ||
      (value == std::numeric_limits<std::int32_t>::min() && !wide))
    w_ << '(' << value + 1 << suffix << " - 1)";
  else
    w_ << value << suffix;
}

void Emitter::real(double value, const Type *type) {
  const bool single = underlying(type)->kind == TypeKind::real;
  if (std::isnan(value)) {
    w_ << (single ? "__builtin_nanf(\"\")" : "__builtin_nan(\"\")");
    return;
  }
  if (std::isinf(value)) {
    w_ << (value < 0 ? "-" : "") << (single ? "__builtin_inff()" : "__builtin_inf()");
    return;
  }
  char digits[40];
  const auto end =
      single ? std::to_chars(digits, digits + sizeof digits, static_cast<float>(value)).ptr
             : std::to_chars(digits, digits + sizeof digits, value).ptr;
  const std::string_view text(digits, static_cast<std::size_t>(end - digits));
  w_ << text;
  if (text.find_first_of(".e") == std::string_view::npos)
    w_ << ".0";
  if (single)
    w_ << 'F';
}

namespace {

/// The next code point of UTF-8 text; wrong bytes stand for themselves.
std::uint32_t nextCodePoint(std::string_view text, std::size_t &at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::uint32_t first = byte(at++);
  const unsigned extra = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : first >= 0xC0 ? 1 : 0;
  if (extra == 0 || at + extra > text.size())
    return first;
  std::uint32_t point = first & (0x3FU >> extra);
  for (unsigned i = 0; i < extra; ++i)
    point = point << 6U | (byte(at++) & 0x3FU);
  return point;
}

/// Number of places the constant takes in a string of its kind.
std::uint32_t stringLength(std::string_view text, bool wide) {
  std::uint32_t length = 0;
  for (std::size_t at = 0; at < text.size();)
    length += nextCodePoint(text, at) > 0xFFFF && wide ? 2 : 1;
  return length;
}

} // namespace

void Emitter::quoted(const ConstValue &constant, bool wide) {
  w_ << (wide ? "u\"" : "\"");
  for (std::size_t at = 0; at < constant.text.size();) {
    std::uint32_t c = nextCodePoint(constant.text, at);
    if (c == '"' || c == '\\') {
      w_ << '\\' << static_cast<char>(c);
    } else if (c >= 0x20 && c < 0x7F) {
      w_ << static_cast<char>(c);
    } else if (c < 0x100) { // three octal digits, whatever follows
      w_ << '\\' << static_cast<char>('0' + (c >> 6U)) << static_cast<char>('0' + (c >> 3U & 7U))
         << static_cast<char>('0' + (c & 7U));
    } else if (wide && c >= 0xD800 && c < 0xE000) { // half a pair: as a number, which ends here
      char digits[4];
      for (int i = 3; i >= 0; --i, c >>= 4U)
        digits[i] = "0123456789abcdef"[c & 15U];
      w_ << "\\x" << std::string_view(digits, 4) << "\" u\"";
    } else if (wide) {
      char digits[9];
      const bool pair = c > 0xFFFF;
      for (int i = pair ? 7 : 3; i >= 0; --i, c >>= 4U)
        digits[i] = "0123456789abcdef"[c & 15U];
      w_ << (pair ? "\\U" : "\\u") << std::string_view(digits, pair ? 8 : 4);
    } else {
      w_ << '?';
    }
  }
  w_ << '"';
}

void Emitter::exactString(const ConstValue &constant, const Type *type) {
  const auto *string = typeAs<StringType>(type);
  const bool wide = type->kind == TypeKind::wstring;
  const bool same = stringLength(constant.text, wide) == string->length;
  if (!same)
    w_ << "::stride::resize<" << string->length << ">(";
  w_ << "::stride::lit(";
  quoted(constant, wide);
  w_ << (same ? ")" : "))");
}

void Emitter::literal(const ConstValue &constant, const Type *from, const Type *to,
                      const Symbol *symbol) {
  if (constant.kind == ConstKind::string && isCharacter(to)) {
    number(firstUnit(constant.text, from->kind == TypeKind::wstring), to);
    return;
  }
  if (isString(to) && constant.kind == ConstKind::integer) { // a CHAR constant
    converted(from, to, {}, [&] { number(constant.integer, from); });
    return;
  }
  if (constant.kind == ConstKind::string) {
    exactString(constant, isString(to) ? to : from);
    return;
  }
  const Type *t = underlying(to);
  if (t->kind == TypeKind::pointer || t->kind == TypeKind::interface) {
    if (constant.integer == 0)
      w_ << "nullptr";
    else
      w_ << "reinterpret_cast<" << type(t) << ">(" << static_cast<std::uint64_t>(constant.integer)
         << "ULL)";
    return;
  }
  if (isReal(t) || t->kind == TypeKind::anyReal) {
    double value = constant.real;
    if (constant.kind == ConstKind::integer) {
      const Type *f = underlying(from);
      const bool huge = isUnsigned64(f);
      value = huge ? static_cast<double>(static_cast<std::uint64_t>(constant.integer))
                   : static_cast<double>(constant.integer);
    }
    real(value, t);
    return;
  }
  if (symbol != nullptr && symbol->kind == SymbolKind::enumerator && (isInteger(t) || from == to)) {
    const auto *e = static_cast<const EnumeratorSymbol *>(symbol);
    if (e->type == from) {
      includes_.complete(from);
      w_ << c_.names.qualified(e->type->symbol) << "__" << e->name.text;
      return;
    }
  }
  std::int64_t value = constant.integer;
  if (from != to) {
    if (const auto v = convertConstant(constant, from, to))
      value = v->integer;
  }
  number(value, t);
}

bool Emitter::implicitStore(const Type *from, const Type *to) const {
  if (from == to)
    return true;
  if (to->kind == TypeKind::subrange && checks())
    return false;
  const Type *f = underlying(from);
  const Type *t = underlying(to);
  if (f == t || (f->kind == TypeKind::interface && t->kind == TypeKind::interface))
    return true;
  if (isInteger(f) && (isInteger(t) || isReal(t)))
    return classify(f, t) == Conversion::free;
  return f->kind == TypeKind::real && t->kind == TypeKind::lreal;
}

void Emitter::convertedText(std::string_view code, const Type *from, const Type *to, Span span) {
  if (implicitStore(from, to)) {
    w_ << code;
    return;
  }
  converted(from, to, span, [&] { w_ << code; });
}

void Emitter::convertedExpr(const Expr *e, const Type *from, const Type *to) {
  converted(from, to, e->span, [&] { raw(e); });
}

} // namespace stc::codegen
