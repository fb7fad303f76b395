// What stands between tokens: blanks, comments, pragmas.
#include "compiler/syntax/characters.hpp"
#include "compiler/syntax/scanner.hpp"

#include <algorithm>
#include <cstring>

namespace stc {

size_t commentEnd(std::string_view text, size_t place) {
  const std::string_view rest = text.substr(std::min(place, text.size()));
  if (rest.starts_with("//"))
    return std::min(text.find('\n', place), text.size());
  if (rest.starts_with("/*")) {
    const auto end = text.find("*/", place + 2);
    return end == std::string_view::npos ? text.size() : end + 2;
  }
  if (!rest.starts_with("(*"))
    return place;
  unsigned depth = 0;
  do {
    if (text.compare(place, 2, "(*") == 0) {
      ++depth;
      place += 2;
    } else if (text.compare(place, 2, "*)") == 0) {
      --depth;
      place += 2;
    } else {
      ++place;
    }
  } while (depth != 0 && place < text.size());
  return place;
}

bool Scanner::atLineStart(size_t place) const {
  while (place > 0 && (text_[place - 1] == ' ' || text_[place - 1] == '\t'))
    --place;
  return place == 0 || text_[place - 1] == '\n';
}

size_t Scanner::comment(size_t place) const { return commentEnd(text_, place); }

size_t Scanner::significant(size_t place) const {
  for (;;) {
    while (place < text_.size() && classOf(text_[place]) == kBlank)
      ++place;
    if (const size_t next = comment(place); next != place) {
      place = next;
    } else if (at(place) == '{') {
      const size_t end = pragmaEnd(place);
      if (end == std::string_view::npos)
        return place;
      place = end;
    } else {
      return place;
    }
  }
}

void Scanner::nestedComment(size_t begin) {
  const char *const data = text_.data();
  const size_t size = text_.size();
  unsigned depth = 1;
  size_t place = begin + 2;
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
  Diagnostic &d = diagnostics_.report(Code::UnterminatedComment, span(begin, begin + 2),
                                      "this comment has no end", "the comment begins here");
  d.help("close it with `*)`");
  if (depth > 1)
    d.note("comments nest: " + std::to_string(depth) +
           " `(*` are still open at the end of the file");
}

void Scanner::blockComment(size_t begin) {
  const auto end = text_.find("*/", begin + 2);
  place_ = end == std::string_view::npos ? text_.size() : end + 2;
  if (end == std::string_view::npos)
    diagnostics_
        .report(Code::UnterminatedComment, span(begin, begin + 2), "this comment has no end",
                "the comment begins here")
        .help("close it with `*/`");
}

void Scanner::lineComment(size_t begin) {
  const void *newline = std::memchr(text_.data() + begin, '\n', text_.size() - begin);
  size_t end = newline == nullptr
                   ? text_.size()
                   : static_cast<size_t>(static_cast<const char *>(newline) - text_.data());
  place_ = end;
  if (at(begin + 2) != '/' || at(begin + 3) == '/' || !atLineStart(begin))
    return;
  size_t from = begin + 3;
  if (from < end && text_[from] == ' ')
    ++from;
  while (end > from && classOf(text_[end - 1]) == kBlank)
    --end;
  trivia_.push_back({Trivia::Kind::Doc,
                     static_cast<uint32_t>(begin),
                     static_cast<uint32_t>(end),
                     text_.substr(from, end - from),
                     {}});
}

void Scanner::skipBlanks() {
  const char *const data = text_.data();
  const size_t size = text_.size();
  while (place_ < size) {
    const char c = data[place_];
    if (classOf(c) == kBlank)
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
