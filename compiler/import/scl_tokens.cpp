#include "compiler/import/scl_tokens.hpp"

#include "compiler/source/st_scan.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <array>

namespace stc::import {

namespace scl_scan {
namespace {

/// Words that a constant may begin with, before its `#`.
constexpr std::array<std::string_view, 39> kPrefixes = {
    "t",    "time",  "lt",           "ltime", "s5t",   "s5time", "tod",   "time_of_day", "ltod",
    "d",    "date",  "dt",           "ldt",   "dtl",   "c",      "p",     "l",           "b",
    "w",    "dw",    "lw",           "byte",  "word",  "dword",  "lword", "sint",        "int",
    "dint", "lint",  "usint",        "uint",  "udint", "ulint",  "real",  "lreal",       "bool",
    "char", "wchar", "date_and_time"};

constexpr std::array<std::string_view, 11> kSigns = {":=", "+=", "-=", "*=", "/=", "=>",
                                                     "<>", "<=", ">=", "..", "**"};

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isBlank(char c) { return static_cast<unsigned char>(c) <= ' '; }

class Scanner {
public:
  explicit Scanner(std::string_view text) : text_(text) {}

  std::vector<SclToken> all() {
    while (at_ < text_.size())
      next();
    return std::move(tokens_);
  }

private:
  [[nodiscard]] char sign(size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }

  void add(SclKind kind, size_t end) {
    const std::string_view piece = text_.substr(at_, end - at_);
    tokens_.push_back({kind, piece, line_});
    line_ += static_cast<size_t>(std::ranges::count(piece, '\n'));
    at_ = end;
  }

  [[nodiscard]] size_t endOfComment() const {
    const std::string_view rest = text_.substr(at_);
    if (rest.starts_with("//"))
      return std::min(text_.find('\n', at_), text_.size());
    for (const auto &[open, close] : {std::pair{"(*", "*)"}, std::pair{"(/*", "*/)"}})
      if (rest.starts_with(open)) {
        const size_t end = text_.find(close, at_ + 2);
        return end == std::string_view::npos ? text_.size() : end + std::string_view(close).size();
      }
    return at_;
  }

  /// Where a name in quotes ends; SCL has no escapes in them.
  [[nodiscard]] size_t endOfQuoted(size_t from) const {
    const size_t end = text_.find_first_of("\"\n", from + 1);
    return end == std::string_view::npos ? text_.size() : end + 1;
  }

  /// After the part of a constant that follows its last `#`. Dates have `-` and `:` in them.
  [[nodiscard]] size_t endOfConstant(size_t from, bool date) const {
    size_t i = from;
    if (i < text_.size() && (text_[i] == '-' || text_[i] == '+'))
      ++i;
    for (; i < text_.size(); ++i) {
      const char c = text_[i];
      const bool more = !wordAt(text_, i).empty() || c == '#';
      const bool dot = c == '.' && i + 1 < text_.size() && isDigit(text_[i + 1]);
      const bool apart =
          date && (c == '-' || c == ':') && i + 1 < text_.size() && isDigit(text_[i + 1]);
      if (!more && !dot && !apart)
        break;
    }
    return i;
  }

  void word() {
    const std::string_view name = wordAt(text_, at_);
    const std::string lower = stride::common::lowerCase(name);
    const size_t end = at_ + name.size();
    if (end < text_.size() && text_[end] == '#' &&
        std::ranges::find(kPrefixes, lower) != kPrefixes.end()) {
      const bool date = lower.find('d') == 0 || lower.starts_with("ld") ||
                        lower.starts_with("tod") || lower.starts_with("ltod") ||
                        lower == "time_of_day";
      return add(SclKind::Literal, endOfConstant(end + 1, date));
    }
    add(SclKind::Word, end);
  }

  void number() {
    size_t i = at_;
    while (i < text_.size() && (isDigit(text_[i]) || text_[i] == '_'))
      ++i;
    if (i < text_.size() && text_[i] == '#')
      return add(SclKind::Literal, endOfConstant(i + 1, false));
    if (i + 1 < text_.size() && text_[i] == '.' && isDigit(text_[i + 1]))
      for (++i; i < text_.size() && (isDigit(text_[i]) || text_[i] == '_');)
        ++i;
    if (i < text_.size() && (text_[i] == 'e' || text_[i] == 'E')) {
      size_t exponent = i + 1;
      if (exponent < text_.size() && (text_[exponent] == '+' || text_[exponent] == '-'))
        ++exponent;
      if (exponent < text_.size() && isDigit(text_[exponent]))
        for (i = exponent; i < text_.size() && isDigit(text_[i]);)
          ++i;
    }
    add(SclKind::Literal, i);
  }

  void next() {
    const char c = sign();
    if (const size_t end = endOfComment(); end != at_)
      return add(SclKind::Comment, end);
    if (isBlank(c)) {
      size_t end = at_;
      while (end < text_.size() && isBlank(text_[end]))
        ++end;
      return add(SclKind::Blank, end);
    }
    if (c == '\'')
      return add(SclKind::Text, afterString(text_, at_));
    if (c == '"')
      return add(SclKind::Quoted, endOfQuoted(at_));
    if (c == '{')
      return add(SclKind::Attribute, afterPragma(text_, at_));
    if (c == '#' && sign(1) == '"')
      return add(SclKind::Local, endOfQuoted(at_ + 1));
    if (c == '#' && !wordAt(text_, at_ + 1).empty())
      return add(SclKind::Local, at_ + 1 + wordAt(text_, at_ + 1).size());
    if (isDigit(c))
      return number();
    if (!wordAt(text_, at_).empty())
      return word();
    for (const std::string_view each : kSigns)
      if (text_.substr(at_).starts_with(each))
        return add(SclKind::Sign, at_ + each.size());
    add(SclKind::Sign, at_ + 1);
  }

  std::string_view text_;
  size_t at_ = 0;
  size_t line_ = 1;
  std::vector<SclToken> tokens_;
};

} // namespace
} // namespace scl_scan

std::vector<SclToken> sclTokens(std::string_view text) { return scl_scan::Scanner(text).all(); }

std::string_view sclName(const SclToken &token) {
  std::string_view name = token.text;
  if (name.starts_with('#'))
    name.remove_prefix(1);
  if (name.starts_with('"'))
    name.remove_prefix(1);
  if (token.text.size() > 1 && name.ends_with('"'))
    name.remove_suffix(1);
  return name;
}

bool isSclWord(const SclToken &token, std::string_view capital) {
  return token.kind == SclKind::Word && std::ranges::equal(token.text, capital, [](char a, char b) {
           return (a >= 'a' && a <= 'z' ? a - 'a' + 'A' : a) == b;
         });
}

} // namespace stc::import
