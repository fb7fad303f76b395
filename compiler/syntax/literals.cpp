#include "compiler/syntax/literals.hpp"

#include "compiler/syntax/literal_text.hpp"
#include "compiler/syntax/token.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

namespace stc {

namespace {

using ast::LiteralKind;

void appendUtf8(std::string &out, uint32_t c) {
  const auto put = [&](uint32_t byte) { out += static_cast<char>(byte); };
  if (c < 0x80) {
    put(c);
  } else if (c < 0x800) {
    put(0xC0 | (c >> 6));
    put(0x80 | (c & 0x3F));
  } else {
    put(0xE0 | (c >> 12));
    put(0x80 | ((c >> 6) & 0x3F));
    put(0x80 | (c & 0x3F));
  }
}

bool isHighSurrogate(uint32_t unit) { return unit >= 0xD800 && unit < 0xDC00; }
bool isLowSurrogate(uint32_t unit) { return unit >= 0xDC00 && unit < 0xE000; }

/// Appends a UTF-16 code unit. Half of a surrogate pair takes three bytes, as if it was a
/// character; where the other half follows, both are the character that they mean.
void appendUnit(std::string &out, uint32_t unit, bool joins) {
  if (joins && isLowSurrogate(unit)) {
    const auto byte = [&](size_t fromEnd) {
      return static_cast<unsigned char>(out[out.size() - fromEnd]);
    };
    const uint32_t high = (byte(3) & 0x0FU) << 12 | (byte(2) & 0x3FU) << 6 | (byte(1) & 0x3FU);
    out.resize(out.size() - 3);
    const uint32_t point = 0x10000 + ((high - 0xD800) << 10) + (unit - 0xDC00);
    out += static_cast<char>(0xF0 | (point >> 18));
    out += static_cast<char>(0x80 | ((point >> 12) & 0x3F));
    out += static_cast<char>(0x80 | ((point >> 6) & 0x3F));
    out += static_cast<char>(0x80 | (point & 0x3F));
    return;
  }
  appendUtf8(out, unit);
}

} // namespace

/// The unit of a duration, in any case.
static bool isUnitOfTime(std::string_view text) {
  constexpr std::string_view kUnits[] = {"d", "h", "m", "s", "ms", "us", "ns"};
  return std::any_of(std::begin(kUnits), std::end(kUnits),
                     [&](std::string_view unit) { return isWord(text, unit); });
}

bool LiteralReader::fail(Code code, Span span, std::string message, std::string label) {
  diagnostics_.report(code, span, std::move(message), std::move(label));
  return false;
}

bool LiteralReader::integer(std::string_view text, Span span, ast::Literal &out) {
  out.literal = LiteralKind::Integer;
  out.text = text;
  unsigned base = 10;
  std::string_view digits = text;
  uint32_t offset = 0;
  if (const auto hash = text.find('#'); hash != std::string_view::npos) {
    base = 0;
    for (const char c : text.substr(0, hash))
      base = isDigit(c) && base < 100 ? base * 10 + static_cast<unsigned>(c - '0') : 100;
    if (base != 2 && base != 8 && base != 10 && base != 16)
      return fail(Code::InvalidNumber,
                  {span.file, span.begin, span.begin + static_cast<uint32_t>(hash)},
                  "a number cannot have this base", "the base is 2, 8 or 16");
    digits = text.substr(hash + 1);
    offset = static_cast<uint32_t>(hash + 1);
  }
  uint64_t value = 0;
  bool tooLarge = false;
  bool lastUnderscore = true;
  for (size_t i = 0; i < digits.size(); ++i) {
    const char c = digits[i];
    const auto at = span.begin + offset + static_cast<uint32_t>(i);
    if (c == '_') {
      if (lastUnderscore)
        return fail(Code::InvalidNumber, {span.file, at, at + 1},
                    "misplaced underscore in a number", "underscores stand between digits");
      lastUnderscore = true;
      continue;
    }
    lastUnderscore = false;
    const int digit = digitValue(c);
    if (digit >= static_cast<int>(base)) {
      auto &d = diagnostics_.report(Code::InvalidNumber, {span.file, at, at + 1},
                                    "the number " + quoteLiteral(text) + " is malformed",
                                    base == 10 ? "not a digit"
                                               : "not a digit to the base " + std::to_string(base));
      const bool prefixed = base == 10 && i == 1 && digits[0] == '0' && digits.size() > 2;
      if (prefixed && (c == 'x' || c == 'X' || c == 'b' || c == 'B')) {
        const std::string right =
            (c == 'x' || c == 'X' ? "16#" : "2#") + std::string(digits.substr(2));
        d.suggest("write `" + right + "`", span, right);
      } else if (base == 10 && i > 0 && isUnitOfTime(digits.substr(i))) {
        const std::string right = "T#" + std::string(digits);
        d.suggest("a duration is written `" + right + "`", span, right);
      }
      return false;
    }
    if (value > (kMax64 - static_cast<uint64_t>(digit)) / base)
      tooLarge = true;
    value = value * base + static_cast<uint64_t>(digit);
  }
  if (lastUnderscore)
    return fail(Code::InvalidNumber, span, "the number " + quoteLiteral(text) + " is incomplete");
  if (tooLarge)
    return fail(Code::LiteralOutOfRange, span,
                "the number " + quoteLiteral(text) + " does not fit into 64 bits");
  out.integer = value;
  return true;
}

bool LiteralReader::real(std::string_view text, Span span, ast::Literal &out) {
  out.literal = LiteralKind::Real;
  out.text = text;
  std::string clean;
  for (const char c : text)
    if (c != '_')
      clean += c;
  const auto [end, error] = std::from_chars(clean.data(), clean.data() + clean.size(), out.real);
  if (error == std::errc::result_out_of_range) {
    // Too small is zero; too large is an error.
    if (clean.find("e-") != std::string::npos || clean.find("E-") != std::string::npos) {
      out.real = 0;
      return true;
    }
    return fail(Code::LiteralOutOfRange, span,
                "the number " + quoteLiteral(text) + " does not fit into an LREAL");
  }
  if (error != std::errc{} || end != clean.data() + clean.size())
    return fail(Code::InvalidNumber, span, "the number " + quoteLiteral(text) + " is malformed");
  return true;
}

namespace {

/// The character that `c` means after a dollar sign; nullopt: none.
std::optional<char> escaped(char c) {
  switch (lowerCase(c)) {
  case '$':
  case '\'':
  case '"':
    return c;
  case 'l':
  case 'n':
    return '\n';
  case 'p':
    return '\f';
  case 'r':
    return '\r';
  case 't':
    return '\t';
  default:
    return std::nullopt;
  }
}

/// The number whose `digits` hexadecimal digits `text` begins with; nullopt: it has not as many.
std::optional<uint32_t> hexadecimal(std::string_view text, size_t digits) {
  if (text.size() < digits)
    return std::nullopt;
  uint32_t code = 0;
  for (const char c : text.substr(0, digits)) {
    const int digit = digitValue(c);
    if (digit >= 16)
      return std::nullopt;
    code = code * 16 + static_cast<uint32_t>(digit);
  }
  return code;
}

} // namespace

bool LiteralReader::string(std::string_view text, Span span, ast::Literal &out, bool asBytes) {
  const bool wide = text[0] == '"';
  out.literal = wide ? LiteralKind::Wstring : LiteralKind::String;
  const std::string_view content = text.substr(1, text.size() - 2);
  const auto isForeign = [](char c) { return static_cast<unsigned char>(c) >= 0x80; };
  if (content.find_first_of("$\r") == std::string_view::npos &&
      !(asBytes && std::ranges::any_of(content, isForeign))) {
    out.text = content;
    return true;
  }
  const size_t digits = wide ? 4 : 2;
  std::string value;
  size_t behindHigh = std::string::npos; // where the other half of a surrogate pair may follow
  for (size_t i = 0; i < content.size(); ++i) {
    if (content[i] == '\r' && i + 1 < content.size() && content[i + 1] == '\n')
      continue; // the end of a line is one character, whatever the file has
    if (asBytes && isForeign(content[i])) {
      appendUnit(value, static_cast<unsigned char>(content[i]), false);
      continue;
    }
    if (content[i] != '$') {
      value += content[i];
      continue;
    }
    const char c = i + 1 < content.size() ? content[i + 1] : '\0';
    if (const std::optional<char> character = escaped(c)) {
      value += *character;
      ++i;
      continue;
    }
    const std::optional<uint32_t> code = hexadecimal(content.substr(i + 1), digits);
    if (!code) {
      const auto at = span.begin + 1 + static_cast<uint32_t>(i);
      const uint32_t end = at + (c != '\0' && static_cast<unsigned char>(c) < 0x80 ? 2U : 1U);
      diagnostics_.report(Code::InvalidEscape, {span.file, at, end}, "unknown escape in a string")
          .help("a dollar sign is written `$$`; known escapes are $$ $' $\" $L $N $P $R $T and " +
                std::string(wide ? "$hhhh" : "$hh"));
      return false;
    }
    appendUnit(value, *code, behindHigh == value.size());
    behindHigh = isHighSurrogate(*code) ? value.size() : std::string::npos;
    i += digits;
  }
  out.text = arena_.copy(std::string_view(value));
  return true;
}

} // namespace stc
