#include "compiler/source/toml_sections.hpp"

#include <algorithm>

namespace stc {

namespace {

size_t afterBlanks(std::string_view text, size_t at) {
  return std::min(text.find_first_not_of(" \t\r", at), text.size());
}

/// Where the lines before have led: into lists and texts that go over several lines.
class Nesting {
public:
  [[nodiscard]] bool isOutside() const { return depth_ == 0 && quote_ == 0; }

  void read(std::string_view line) {
    for (size_t i = 0; i < line.size();) {
      const char c = line[i];
      if (quote_ != 0)
        i += inText(line, i);
      else if (c == '"' || c == '\'')
        i += open(line, i);
      else if (c == '#')
        return;
      else
        i += outside(c);
    }
    if (!several_)
      quote_ = 0;
  }

private:
  static size_t quotesAt(std::string_view line, size_t at) {
    return std::min(line.find_first_not_of(line[at], at), line.size()) - at;
  }

  size_t outside(char c) {
    depth_ += c == '[' || c == '{' ? 1 : 0;
    depth_ -= c == ']' || c == '}' ? 1 : 0;
    return 1;
  }

  /// `"`, `"""`, or a text without characters.
  size_t open(std::string_view line, size_t at) {
    const size_t count = quotesAt(line, at);
    if (count == 2)
      return 2;
    several_ = count >= 3;
    quote_ = line[at];
    return several_ ? 3 : 1;
  }

  /// Quotes may stand right before the three that end a text of several lines.
  size_t inText(std::string_view line, size_t at) {
    if (line[at] == '\\' && quote_ == '"')
      return 2;
    if (line[at] != quote_)
      return 1;
    const size_t count = quotesAt(line, at);
    if (several_ && count < 3)
      return count;
    quote_ = 0;
    return several_ ? std::min<size_t>(count, 5) : 1;
  }

  int depth_ = 0;
  char quote_ = 0;       ///< 0: not in a text
  bool several_ = false; ///< which may go over several lines
};

/// Of `[[bus.drive]]`: `bus`.
std::string_view nameOf(std::string_view line) {
  const size_t begin = std::min(line.find_first_not_of("[ \t"), line.size());
  const size_t end = std::min(line.find_first_of(". \t]", begin), line.size());
  std::string_view name = line.substr(begin, end - begin);
  if (name.size() > 2 && (name.front() == '"' || name.front() == '\''))
    name = name.substr(1, name.size() - 2);
  return name;
}

} // namespace

std::vector<TomlSectionText> tomlSections(std::string_view text) {
  std::vector<TomlSectionText> sections;
  std::vector<size_t> begins;
  Nesting nesting;
  size_t comments = std::string_view::npos; // where the comment lines before this line begin
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    const size_t first = afterBlanks(line, 0);
    const bool outside = nesting.isOutside();
    const bool comment = outside && first < line.size() && line[first] == '#';
    if (outside && first < line.size() && line[first] == '[') {
      begins.push_back(comments != std::string_view::npos ? comments : at);
      sections.push_back({nameOf(line.substr(first)), {}});
    } else {
      nesting.read(line);
    }
    if (!comment)
      comments = std::string_view::npos;
    else if (comments == std::string_view::npos)
      comments = at;
    at = std::min(end + 1, text.size());
  }
  for (size_t i = 0; i < sections.size(); ++i) {
    const size_t end = i + 1 < begins.size() ? begins[i + 1] : text.size();
    sections[i].text = text.substr(begins[i], end - begins[i]);
  }
  return sections;
}

} // namespace stc
