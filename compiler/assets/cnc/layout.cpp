// The layout of CNC files.

#include "compiler/assets/cnc/cnc_source.hpp"

namespace stc {

namespace {

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Where the part that begins at `at` and ends with `last` is over.
size_t endOf(std::string_view line, size_t at, char last) {
  const size_t found = line.find(last, at + 1);
  return found == std::string_view::npos ? line.size() : found + 1;
}

/// A number without the zeros before its first digit.
size_t copyNumber(std::string_view line, size_t at, std::string &out) {
  if (line[at] == '+' || line[at] == '-') {
    if (line[at] == '-')
      out += '-';
    ++at;
  }
  while (at + 1 < line.size() && line[at] == '0' && isDigit(line[at + 1]))
    ++at;
  if (at < line.size() && line[at] == '.')
    out += '0';
  while (at < line.size() && (isDigit(line[at]) || line[at] == '.'))
    out += line[at++];
  return at;
}

/// Sets off what follows from what is there.
void separate(std::string &out, size_t begin) {
  if (out.size() > begin && out.back() != ' ' && out.back() != '/')
    out += ' ';
}

void formatLine(std::string_view line, std::string &out) {
  const size_t begin = out.size();
  size_t at = 0;
  while (at < line.size()) {
    const char c = line[at];
    if (isBlank(c)) {
      ++at;
    } else if (c == '(' || (c == '/' && line.substr(at, 2) == "//")) {
      const size_t end = c == '(' ? endOf(line, at, ')') : line.size();
      separate(out, begin);
      out += line.substr(at, end - at);
      at = end;
    } else if (c == '$') {
      const size_t end = endOf(line, at, '$');
      out += line.substr(at, end - at);
      at = end;
    } else if (isLetter(c)) {
      separate(out, begin);
      while (at < line.size() && isLetter(line[at]))
        out += static_cast<char>(line[at++] & ~0x20);
      if (out.size() - begin > 2 && out.ends_with("PROBE"))
        out += ' ';
    } else if (isDigit(c) || c == '+' || c == '-' || c == '.') {
      at = copyNumber(line, at, out);
    } else {
      out += line[at++];
    }
  }
  while (out.size() > begin && isBlank(out.back()))
    out.pop_back();
}

} // namespace

std::string formatCnc(std::string_view text) {
  std::string out;
  bool named = false;
  while (!text.empty()) {
    const size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    while (!line.empty() && isBlank(line.back()))
      line.remove_suffix(1);
    // The program's name stays as it is.
    if (!line.empty() && line.front() == '%' && !named)
      out += line;
    else
      formatLine(line, out);
    named = named || !line.empty();
    out += '\n';
  }
  return out;
}

} // namespace stc
