#include "compiler/syntax/format.hpp"

#include "compiler/source/identifier.hpp"
#include "compiler/syntax/format_layout.hpp"

#include <algorithm>

namespace stc {

namespace {

bool sameText(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) {
           return lowerCase(x) == lowerCase(y);
         });
}

/// Keywords, also those that are some only in their place.
bool mayChangeCase(const FormatItem &item) {
  return isKeywordType(item.type) || item.type == Tok::SET_ASSIGN ||
         item.type == Tok::RESET_ASSIGN || item.type == Tok::REF_ASSIGN ||
         (item.type == Tok::IDENT &&
          (isElementaryName(item.text) ||
           findKeyword(item.text, hashIdent(item.text)).kind != Keyword::Kind::None));
}

/// Comments without the blanks at the beginning of their lines.
std::string contentOf(std::string_view comment) {
  std::string out;
  bool lineStart = false;
  for (const char c : comment) {
    if (c == '\r' || (lineStart && (c == ' ' || c == '\t')))
      continue;
    lineStart = c == '\n';
    out += c;
  }
  return out;
}

/// The property that formatting must not break.
bool sameContent(const std::vector<FormatItem> &before, const std::vector<FormatItem> &after) {
  if (before.size() != after.size())
    return false;
  for (size_t i = 0; i < before.size(); ++i) {
    const FormatItem &a = before[i];
    const FormatItem &b = after[i];
    if (a.type != b.type || a.comments.size() != b.comments.size() ||
        !(a.text == b.text || (mayChangeCase(a) && sameText(a.text, b.text))))
      return false;
    for (size_t k = 0; k < a.comments.size(); ++k)
      if (contentOf(a.comments[k].text) != contentOf(b.comments[k].text))
        return false;
  }
  return true;
}

} // namespace

std::optional<std::string> format(const SourceFile &file, const FormatStyle &style) {
  const std::vector<FormatItem> before = readItems(file);
  std::string text = FormatLayout(before, style).run();
  const SourceFile result(file.id(), file.name(), text);
  if (!sameContent(before, readItems(result)))
    return std::nullopt;
  return text;
}

} // namespace stc
