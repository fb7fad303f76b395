// What stands between tokens: blanks, comments, pragmas.
#include "compiler/syntax/characters.hpp"
#include "compiler/syntax/scanner.hpp"

#include <algorithm>
#include <cstring>

namespace stc {

bool Scanner::atLineStart(std::size_t place) const {
  while (place > 0 && (text_[place - 1] == ' ' || text_[place - 1] == '\t'))
    --place;
  return place == 0 || text_[place - 1] == '\n';
}

std::size_t Scanner::significant(std::size_t place) const {
  for (;;) {
    while (place < text_.size() && classOf(text_[place]) == blank)
      ++place;
    const std::string_view rest = text_.substr(std::min(place, text_.size()));
    if (rest.starts_with("//")) {
      place = std::min(text_.find('\n', place), text_.size());
    } else if (rest.starts_with("/*")) {
      const auto end = text_.find("*/", place + 2);
      place = end == std::string_view::npos ? text_.size() : end + 2;
    } else if (rest.starts_with("(*")) {
      unsigned depth = 0;
      do {
        if (text_.compare(place, 2, "(*") == 0) {
          ++depth;
          place += 2;
        } else if (text_.compare(place, 2, "*)") == 0) {
          --depth;
          place += 2;
        } else {
          ++place;
        }
      } while (depth != 0 && place < text_.size());
    } else {
      return place;
    }
  }
}

void Scanner::nestedComment(std::size_t begin) {
  const char *const data = text_.data();
  const std::size_t size = text_.size();
  unsigned depth = 1;
  std::size_t place = begin + 2;
  while (place + 1 < size) {
    const char c = data[place];
    if (c == '*' && data[place + 1] == ')') {
      place += 2;
      if (--depth == 0) {
        place_ = place;
        return;
      }
    } else if (c == '(' && data[place + 1] == '*') {
      place += 2;
      ++depth;
    } else {
      ++place;
    }
  }
  place_ = size;
  Diagnostic &d = diagnostics_.report(Code::unterminatedComment, span(begin, begin + 2),
                                      "this comment has no end", "the comment begins here");
  d.help("close it with `*)`");
  if (depth > 1)
    d.note("comments nest: " + std::to_string(depth) +
           " `(*` are still open at the end of the file");
}

void Scanner::blockComment(std::size_t begin) {
  const auto end = text_.find("*/", begin + 2);
  place_ = end == std::string_view::npos ? text_.size() : end + 2;
  if (end == std::string_view::npos)
    diagnostics_
        .report(Code::unterminatedComment, span(begin, begin + 2), "this comment has no end",
                "the comment begins here")
        .help("close it with `*/`");
}

void Scanner::lineComment(std::size_t begin) {
  const void *newline = std::memchr(text_.data() + begin, '\n', text_.size() - begin);
  std::size_t end =
      newline == nullptr
          ? text_.size()
          : static_cast<std::size_t>(static_cast<const char *>(newline) - text_.data());
  place_ = end;
  if (at(begin + 2) != '/' || at(begin + 3) == '/' || !atLineStart(begin))
    return;
  std::size_t from = begin + 3;
  if (from < end && text_[from] == ' ')
    ++from;
  while (end > from && classOf(text_[end - 1]) == blank)
    --end;
  trivia_.push_back({Trivia::Kind::doc,
                     static_cast<std::uint32_t>(begin),
                     static_cast<std::uint32_t>(end),
                     text_.substr(from, end - from),
                     {}});
}

void Scanner::pragma(std::size_t begin) {
  std::size_t end = begin + 1;
  while (end < text_.size() && text_[end] != '}') {
    const char c = text_[end];
    if (c == '\'' ||
        c == '"') { // a quoted text may hold a brace, unless it does not end on its line
      const auto stop = text_.find_first_of(c == '\'' ? "'\n" : "\"\n", end + 1);
      if (stop != std::string_view::npos && text_[stop] == c)
        end = stop;
    }
    ++end;
  }
  if (end >= text_.size()) {
    diagnostics_
        .report(Code::unterminatedPragma, span(begin, begin + 1), "this pragma has no end",
                "the pragma begins here")
        .help("close it with `}`");
    const auto line = text_.find('\n', begin);
    place_ = line == std::string_view::npos ? text_.size() : line;
    return;
  }
  place_ = end + 1;
  const auto from = static_cast<std::uint32_t>(begin);
  const auto to = static_cast<std::uint32_t>(place_);
  std::size_t p = begin + 1;
  const auto skip = [&] {
    while (p < end && classOf(text_[p]) == blank)
      ++p;
  };
  const auto quotedText = [&]() -> std::string_view {
    skip();
    const char quote = p < end ? text_[p] : '\0';
    if (quote != '\'' && quote != '"')
      return {};
    const auto close = text_.find(quote, p + 1);
    if (close >= end)
      return {};
    const std::string_view content = text_.substr(p + 1, close - p - 1);
    p = close + 1;
    return content;
  };
  skip();
  const std::string_view keyword = wordAt(p);
  p += keyword.size();
  if (isWord(keyword, "external")) {
    trivia_.push_back({Trivia::Kind::external, from, to, {}, {}});
  } else if (isWord(keyword, "attribute")) {
    const std::string_view name = quotedText();
    skip();
    std::string_view value;
    if (p + 1 < end && text_.compare(p, 2, ":=") == 0) {
      p += 2;
      value = quotedText();
    }
    if (!name.empty())
      trivia_.push_back({Trivia::Kind::attribute, from, to, name, value});
  } else if (isWord(keyword, "warning")) {
    warningPragma(p, end);
  } else if (isWord(keyword, "if")) {
    diagnostics_.report(Code::notSupported, span(begin, place_),
                        "conditional compilation is not supported by this version");
  } else {
    bracesAsBlock(begin, place_);
  }
}

/// `{warning disable SE0390}`, `{warning restore unused-variable}`; codes of other compilers are
/// passed over.
void Scanner::warningPragma(std::size_t place, std::size_t end) {
  const auto nextWord = [&] {
    while (place < end && (classOf(text_[place]) == blank || text_[place] == ','))
      ++place;
    const std::size_t begin = place;
    while (place < end && classOf(text_[place]) != blank && text_[place] != ',')
      ++place;
    return text_.substr(begin, place - begin);
  };
  const std::string_view action = nextWord();
  const bool disable = isWord(action, "disable");
  if (!disable && !isWord(action, "restore"))
    return;
  for (std::string_view word = nextWord(); !word.empty(); word = nextWord()) {
    if (const CodeInfo *code = findCode(word)) {
      diagnostics_.setSilent(file_, static_cast<std::uint32_t>(place), code->code, disable);
      continue;
    }
    const bool foreign = (word[0] == 'C' || word[0] == 'c') && word.size() > 1 &&
                         word.find_first_not_of("0123456789", 1) == std::string_view::npos;
    if (!foreign)
      diagnostics_
          .report(Code::unknownDiagnostic, span(place - word.size(), place),
                  "there is no diagnostic `" + std::string(word) + "`", "unknown")
          .help("`stride explain --list` shows all codes and names");
  }
}

void Scanner::skipBlanks() {
  const char *const data = text_.data();
  const std::size_t size = text_.size();
  while (place_ < size) {
    const char c = data[place_];
    if (classOf(c) == blank)
      ++place_;
    else if (c == '/' && at(place_ + 1) == '/')
      lineComment(place_);
    else if (c == '/' && at(place_ + 1) == '*')
      blockComment(place_);
    else if (c == '(' && at(place_ + 1) == '*')
      nestedComment(place_);
    else if (c == '{')
      pragma(place_);
    else if (c == '\xC2' && at(place_ + 1) == '\xA0') // no-break space
      place_ += 2;
    else
      return;
  }
}

} // namespace stc
