#include "compiler/import/st_words.hpp"

#include <algorithm>

namespace stc::import {

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

size_t endOfRun(std::string_view text, size_t at, bool (*belongs)(char)) {
  while (at < text.size() && belongs(text[at]))
    ++at;
  return at;
}

/// After the comment at `at`, which begins with `(*`.
size_t endOfComment(std::string_view text, size_t at) {
  size_t depth = 0;
  while (at < text.size()) {
    const std::string_view two = text.substr(at, 2);
    if (two == "(*") {
      ++depth;
      at += 2;
    } else if (two == "*)") {
      at += 2;
      if (--depth == 0)
        return at;
    } else {
      ++at;
    }
  }
  return at;
}

size_t endOfText(std::string_view text, size_t at) {
  const char quote = text[at];
  for (++at; at < text.size() && text[at] != quote; ++at)
    if (text[at] == '$')
      ++at;
  return std::min(at + 1, text.size());
}

size_t after(std::string_view text, size_t at, std::string_view sign) {
  const size_t found = text.find(sign, at);
  return found == std::string_view::npos ? text.size() : found + sign.size();
}

/// After a comment, a text or a pragma at `at`; `at` when there is none.
size_t skipped(std::string_view text, size_t at) {
  const std::string_view two = text.substr(at, 2);
  if (two == "(*")
    return endOfComment(text, at);
  if (two == "//")
    return after(text, at, "\n");
  if (two == "/*")
    return after(text, at, "*/");
  if (text[at] == '\'' || text[at] == '"')
    return endOfText(text, at);
  return text[at] == '{' ? after(text, at, "}") : at;
}

} // namespace

std::vector<StWord> wordsOf(std::string_view text) {
  std::vector<StWord> words;
  size_t at = 0;
  while (at < text.size()) {
    if (const size_t next = skipped(text, at); next != at) {
      at = next;
      continue;
    }
    const char c = text[at];
    size_t end = at + 1;
    StWord::Kind kind = StWord::Kind::Sign;
    if (isLetter(c)) {
      kind = StWord::Kind::Name;
      end = endOfRun(text, at, [](char d) { return isLetter(d) || isDigit(d); });
    } else if (isDigit(c)) {
      kind = StWord::Kind::Number;
      end = endOfRun(text, at, [](char d) { return isLetter(d) || isDigit(d) || d == '#'; });
    } else if (c == '%') {
      kind = StWord::Kind::Address;
      end = endOfRun(text, at + 1,
                     [](char d) { return isLetter(d) || isDigit(d) || d == '.' || d == '*'; });
    }
    if (c != ' ' && c != '\t' && c != '\n' && c != '\r')
      words.push_back({kind, at, end});
    at = end;
  }
  return words;
}

std::string replaceWords(std::string_view text,
                         const std::function<std::string(const StWord &, std::string_view)> &by) {
  std::string result;
  size_t done = 0;
  for (const StWord &word : wordsOf(text)) {
    const std::string other = by(word, text.substr(word.begin, word.end - word.begin));
    if (other.empty())
      continue;
    result += text.substr(done, word.begin - done);
    result += other;
    done = word.end;
  }
  result += text.substr(done);
  return result;
}

} // namespace stc::import
