#include "compiler/syntax/format_items.hpp"

#include "compiler/source/identifier.hpp"
#include "compiler/syntax/characters.hpp"
#include "compiler/syntax/scanner.hpp"

#include <algorithm>

namespace stc {

namespace {

bool isOneOf(std::string_view text, std::span<const std::string_view> names) {
  return std::any_of(names.begin(), names.end(),
                     [&](std::string_view name) { return isWord(text, name); });
}

constexpr std::string_view kIntegers[] = {"sint",  "int",   "dint", "lint", "usint", "uint",
                                          "udint", "ulint", "byte", "word", "dword", "lword"};
constexpr std::string_view kOthers[] = {"bool", "real", "lreal",       "time",          "ltime",
                                        "date", "tod",  "dt",          "ldate",         "ltod",
                                        "ldt",  "char", "time_of_day", "date_and_time", "wchar"};

class ItemReader {
public:
  explicit ItemReader(const SourceFile &file)
      : text_(file.text()), scanner_(file, ignored_), places_(file, ignored_) {}

  std::vector<FormatItem> read() {
    for (Token token = scanner_.next(); token.type != Token::kEnd; token = scanner_.next()) {
      if (token.begin < place_) // a part of the token before, in a wrong text
        continue;
      gap(token.begin);
      push(token.type, token.begin, token.end);
    }
    gap(text_.size());
    push(Token::kEnd, text_.size(), text_.size());
    return std::move(items_);
  }

private:
  void push(uint16_t type, size_t begin, size_t end) {
    item_.type = type;
    item_.text = text_.substr(begin, end - begin);
    item_.newlines = newlines_;
    items_.push_back(std::move(item_));
    item_ = {};
    newlines_ = 0;
    place_ = end;
  }

  void pushComment(size_t end) {
    FormatComment comment;
    comment.text = text_.substr(place_, end - place_);
    comment.toLineEnd = comment.text.starts_with("//");
    comment.newlines = newlines_;
    size_t begin = place_;
    while (begin > 0 && (text_[begin - 1] == ' ' || text_[begin - 1] == '\t'))
      --begin;
    comment.startsLine = begin == 0 || text_[begin - 1] == '\n';
    comment.margin = place_ - begin;
    while (comment.toLineEnd && classOf(comment.text.back()) == kBlank)
      comment.text.remove_suffix(1);
    item_.comments.push_back(comment);
    newlines_ = 0;
    place_ = end;
  }

  /// After the blank at `place`; `place` when there is none.
  [[nodiscard]] size_t behindBlank(size_t place) const {
    if (classOf(text_[place]) == kBlank)
      return place + 1;
    return text_.compare(place, 2, "\xC2\xA0") == 0 ? place + 2 : place;
  }

  /// Comments, and text that is no token, up to `end`.
  void gap(size_t end) {
    while (place_ < end) {
      if (const size_t next = behindBlank(place_); next != place_) {
        newlines_ += text_[place_] == '\n';
        place_ = next;
      } else if (const size_t behind = commentEnd(); behind != place_) {
        pushComment(std::min(behind, end));
      } else {
        size_t stop = place_ + 1;
        while (stop < end && behindBlank(stop) == stop)
          ++stop;
        push(kUnknownText, place_, stop);
      }
    }
  }

  [[nodiscard]] size_t commentEnd() const {
    if (text_[place_] != '{')
      return places_.comment(place_);
    const size_t end = places_.pragmaEnd(place_);
    return end == std::string_view::npos ? place_ : end;
  }

  std::string_view text_;
  Diagnostics ignored_;
  Scanner scanner_;
  Scanner places_;
  std::vector<FormatItem> items_;
  FormatItem item_;
  size_t place_ = 0;
  unsigned newlines_ = 0;
};

} // namespace

/// The comma after the last argument of a call goes; its comments stand before the bracket then.
static std::vector<FormatItem> withoutLastCommas(std::vector<FormatItem> items) {
  std::vector<FormatItem> out;
  std::vector<bool> calls; // of the open brackets
  for (size_t i = 0; i < items.size(); ++i) {
    const uint16_t type = items[i].type;
    const uint16_t before = out.empty() ? Token::kEnd : out.back().type;
    if (type == Tok::LPAREN)
      calls.push_back(before == Tok::IDENT || before == Tok::RBRACKET || before == Tok::CARET);
    else if (type == Tok::RPAREN && !calls.empty())
      calls.pop_back();
    if (type == Tok::COMMA && before != Tok::COMMA && before != Tok::LPAREN && !calls.empty() &&
        calls.back() && i + 1 < items.size() && items[i + 1].type == Tok::RPAREN) {
      FormatItem &closer = items[i + 1];
      closer.newlines = std::max(closer.newlines, items[i].newlines);
      closer.comments.insert(closer.comments.begin(), items[i].comments.begin(),
                             items[i].comments.end());
      continue;
    }
    out.push_back(std::move(items[i]));
  }
  return out;
}

std::vector<FormatItem> readItems(const SourceFile &file) {
  return withoutLastCommas(ItemReader(file).read());
}

std::set<std::string> jumpTargets(const std::vector<FormatItem> &items) {
  std::set<std::string> out;
  for (size_t i = 1; i < items.size(); ++i)
    if (items[i - 1].type == Tok::JMP && items[i].type == Tok::IDENT)
      out.insert(lowerCase(items[i].text));
  return out;
}

PragmaWord pragmaOf(std::string_view comment) {
  if (!comment.starts_with('{'))
    return PragmaWord::None;
  size_t begin = 1;
  while (begin < comment.size() && classOf(comment[begin]) == kBlank)
    ++begin;
  size_t end = begin;
  while (end < comment.size() && isWordChar(comment[end]))
    ++end;
  return findPragma(comment.substr(begin, end - begin));
}

bool isIntegerName(std::string_view text) { return isOneOf(text, kIntegers); }

bool isElementaryName(std::string_view text) {
  return isIntegerName(text) || isOneOf(text, kOthers);
}

} // namespace stc
