#include "compiler/semantics/fold_texts.hpp"

#include <algorithm>
#include <limits>

namespace stc {

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

namespace {

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

} // namespace

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

int compareTexts(std::string_view a, std::string_view b, bool wide) {
  return decode(a, wide).compare(decode(b, wide));
}

size_t textLength(std::string_view text, bool wide) { return decode(text, wide).size(); }

uint16_t firstUnit(std::string_view text, bool wide) {
  const Units units = decode(text, wide);
  return units.empty() ? uint16_t{0} : static_cast<uint16_t>(units.front());
}

namespace {

size_t count(int64_t n) { return n < 0 ? 0 : static_cast<size_t>(std::min<int64_t>(n, 0x10000)); }

/// The part [from, from + n) as far as there is one.
Units part(const Units &s, size_t from, size_t n = Units::npos) {
  return from >= s.size() ? Units() : s.substr(from, n);
}

/// The number of characters before the place that an argument gives: the first one is 1.
size_t before(int64_t place) { return count(place - (place > 0 ? 1 : 0)); }

Units textAt(const FoldCall &call, size_t i) {
  return decode(call.arguments[i].value.text, call.arguments[0].type->kind == TypeKind::Wstring);
}

/// A number of characters or a place; as in the runtime, an ULINT beyond LINT is LINT's largest
/// value.
int64_t numberAt(const FoldCall &call, size_t i) {
  const int64_t n = call.arguments[i].value.integer;
  return n < 0 && isUnsigned64(call.arguments[i].type) ? std::numeric_limits<int64_t>::max() : n;
}

/// The result, as long as its type allows.
ConstValue cutToResult(const FoldCall &call, Units units) {
  if (isString(call.result) && units.size() > typeAs<StringType>(call.result)->length)
    units.resize(typeAs<StringType>(call.result)->length);
  return encode(units, call.arena);
}

} // namespace

std::optional<ConstValue> foldLen(const FoldCall &call) {
  return integerValue(static_cast<int64_t>(textAt(call, 0).size()));
}

std::optional<ConstValue> foldLeft(const FoldCall &call) {
  return cutToResult(call, part(textAt(call, 0), 0, count(numberAt(call, 1))));
}

std::optional<ConstValue> foldRight(const FoldCall &call) {
  const Units text = textAt(call, 0);
  const size_t length = std::min(text.size(), count(numberAt(call, 1)));
  return cutToResult(call, part(text, text.size() - length));
}

std::optional<ConstValue> foldMid(const FoldCall &call) {
  const size_t from = before(numberAt(call, 2));
  return cutToResult(call, part(textAt(call, 0), from, count(numberAt(call, 1))));
}

std::optional<ConstValue> foldConcat(const FoldCall &call) {
  return cutToResult(call, textAt(call, 0) + textAt(call, 1));
}

std::optional<ConstValue> foldInsert(const FoldCall &call) {
  const Units text = textAt(call, 0);
  const size_t at = count(numberAt(call, 2));
  return cutToResult(call, part(text, 0, at) + textAt(call, 1) + part(text, at));
}

std::optional<ConstValue> foldDelete(const FoldCall &call) {
  const Units text = textAt(call, 0);
  const size_t from = before(numberAt(call, 2));
  return cutToResult(call, part(text, 0, from) + part(text, from + count(numberAt(call, 1))));
}

std::optional<ConstValue> foldReplace(const FoldCall &call) {
  const Units text = textAt(call, 0);
  const size_t from = before(numberAt(call, 3));
  return cutToResult(call, part(text, 0, from) + textAt(call, 1) +
                               part(text, from + count(numberAt(call, 2))));
}

std::optional<ConstValue> foldFind(const FoldCall &call) {
  const Units wanted = textAt(call, 1);
  const size_t at = wanted.empty() ? Units::npos : textAt(call, 0).find(wanted);
  return integerValue(at == Units::npos ? 0 : static_cast<int64_t>(at + 1));
}

} // namespace stc
