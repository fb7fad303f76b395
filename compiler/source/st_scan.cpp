#include "compiler/source/st_scan.hpp"

#include "runtime/common/text.hpp"

#include <algorithm>

namespace stc {

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

} // namespace

size_t commentEnd(std::string_view text, size_t at) {
  const std::string_view rest = text.substr(std::min(at, text.size()));
  if (rest.starts_with("//"))
    return std::min(text.find('\n', at), text.size());
  if (rest.starts_with("/*")) {
    const auto end = text.find("*/", at + 2);
    return end == std::string_view::npos ? text.size() : end + 2;
  }
  if (!rest.starts_with("(*"))
    return at;
  unsigned depth = 0;
  do {
    if (text.compare(at, 2, "(*") == 0) {
      ++depth;
      at += 2;
    } else if (text.compare(at, 2, "*)") == 0) {
      --depth;
      at += 2;
    } else {
      ++at;
    }
  } while (depth != 0 && at < text.size());
  return at;
}

size_t afterPragma(std::string_view text, size_t at) {
  if (at >= text.size() || text[at] != '{')
    return at;
  for (++at; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '}')
      return at + 1;
    const char before = text[at - 1]; // an apostrophe of a word begins no text
    if ((c != '\'' && c != '"') || isLetter(before) || isDigit(before))
      continue;
    const size_t stop = text.find_first_of(c == '\'' ? "'\n" : "\"\n", at + 1);
    if (stop != std::string_view::npos && text[stop] == c)
      at = stop;
  }
  return text.size();
}

size_t afterComment(std::string_view text, size_t at) {
  const size_t end = commentEnd(text, at);
  return end != at ? end : afterPragma(text, at);
}

size_t afterString(std::string_view text, size_t at) {
  if (at >= text.size() || (text[at] != '\'' && text[at] != '"'))
    return at;
  const char quote = text[at];
  for (++at; at < text.size(); ++at) {
    if (text[at] == '$')
      ++at;
    else if (text[at] == quote || text[at] == '\n')
      return at + 1;
  }
  return text.size();
}

size_t codeFrom(std::string_view text, size_t at) {
  while (at < text.size()) {
    const size_t next = afterComment(text, at);
    if (next != at)
      at = next;
    else if (static_cast<unsigned char>(text[at]) <= ' ')
      ++at;
    else
      break;
  }
  return at;
}

std::string_view wordAt(std::string_view text, size_t at) {
  at = std::min(at, text.size());
  const size_t end = endOfRun(text, at, [](char c) { return isLetter(c) || isDigit(c); });
  return text.substr(at, end - at);
}

std::string firstKeyword(std::string_view text) {
  return stride::common::upperCase(wordAt(text, codeFrom(text)));
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n\f\v";
  const size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos)
    return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::vector<StWord> wordsOf(std::string_view text) {
  std::vector<StWord> words;
  for (size_t at = codeFrom(text); at < text.size(); at = codeFrom(text, at)) {
    if (const size_t next = afterString(text, at); next != at) {
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

} // namespace stc
