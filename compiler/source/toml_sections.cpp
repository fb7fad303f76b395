#include "compiler/source/toml_sections.hpp"

#include <algorithm>

namespace stc {

namespace {

size_t afterBlanks(std::string_view text, size_t at) {
  return std::min(text.find_first_not_of(" \t\r", at), text.size());
}

/// How much deeper the line leads into lists that go over several lines.
int depthOf(std::string_view line) {
  int depth = 0;
  char quote = 0;
  for (size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != 0) {
      i += quote == '"' && c == '\\' ? 1 : 0;
      quote = c == quote ? '\0' : quote;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      break;
    } else {
      depth += c == '[' || c == '{' ? 1 : 0;
      depth -= c == ']' || c == '}' ? 1 : 0;
    }
  }
  return depth;
}

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
  int depth = 0;
  size_t comments = std::string_view::npos; // where the comment lines before this line begin
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    const size_t first = afterBlanks(line, 0);
    const bool comment = first < line.size() && line[first] == '#';
    if (depth == 0 && first < line.size() && line[first] == '[') {
      begins.push_back(comments != std::string_view::npos ? comments : at);
      sections.push_back({nameOf(line.substr(first)), {}});
    } else {
      depth += depthOf(line);
    }
    if (depth != 0 || !comment)
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
