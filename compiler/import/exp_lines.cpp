#include "compiler/import/exp_lines.hpp"

#include <algorithm>

namespace stc::import {

namespace {

constexpr std::string_view kBlanks = " \t\r\f\v";

bool isWordCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// The next comma that stands in no brackets and no text.
size_t endOfField(std::string_view fields) {
  int depth = 0;
  bool inText = false;
  for (size_t i = 0; i < fields.size(); ++i) {
    const char c = fields[i];
    if (c == '\'')
      inText = !inText;
    else if (!inText && (c == '(' || c == '['))
      ++depth;
    else if (!inText && (c == ')' || c == ']'))
      --depth;
    else if (!inText && depth == 0 && c == ',')
      return i;
  }
  return fields.size();
}

} // namespace

std::vector<std::string_view> linesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r'))
      line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::string joined(const std::vector<std::string> &lines) {
  std::string text;
  for (const std::string &line : lines)
    text += line + "\n";
  return text;
}

std::string_view trimmed(std::string_view text) {
  const size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos)
    return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::string_view firstWord(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const auto *end = std::find_if_not(line.begin(), line.end(), isWordCharacter);
  return line.substr(0, static_cast<size_t>(end - line.begin()));
}

std::string quoted(std::string_view text) {
  const size_t first = text.find('\'');
  const size_t last = text.rfind('\'');
  return first >= last ? std::string() : std::string(text.substr(first + 1, last - first - 1));
}

std::vector<std::string> foldersOf(std::string_view path) {
  std::vector<std::string> folders;
  while (path.starts_with("\\/")) {
    path.remove_prefix(2);
    const size_t end = std::min(path.find("\\/"), path.size());
    std::string name(trimmed(path.substr(0, end)));
    for (char &c : name)
      if (static_cast<unsigned char>(c) < ' ' ||
          std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos)
        c = '_';
    if (name.starts_with('.'))
      name.front() = '_';
    if (!name.empty())
      folders.push_back(std::move(name));
    path.remove_prefix(end);
  }
  return folders;
}

std::string declaredName(const std::vector<std::string> &lines) {
  bool keyword = true;
  for (const std::string &line : lines) {
    std::string_view rest = trimmed(line);
    if (keyword)
      rest = trimmed(rest.substr(firstWord(rest).size()));
    keyword = false;
    if (const std::string_view name = firstWord(rest); !name.empty())
      return std::string(name);
  }
  return {};
}

Task taskOf(std::string_view line) {
  line = trimmed(line);
  line = trimmed(line.substr(firstWord(line).size()));
  Task task;
  task.name = firstWord(line);
  const size_t open = std::min(line.find('('), line.size());
  std::string_view fields = line.substr(std::min(open + 1, line.size()));
  fields = fields.substr(0, std::min(fields.rfind(')'), fields.size()));
  while (!fields.empty()) {
    const size_t end = endOfField(fields);
    const std::string_view field = trimmed(fields.substr(0, end));
    const std::string_view key = firstWord(field);
    const size_t sign = field.find(":=");
    const std::string value(sign == std::string_view::npos ? std::string_view()
                                                           : trimmed(field.substr(sign + 2)));
    if (key == "PRIORITY")
      task.priority = value;
    else if (key == "INTERVAL")
      task.interval = value;
    else if (key == "EVENT" || key == "SINGLE")
      task.event = value;
    fields.remove_prefix(std::min(end + 1, fields.size()));
  }
  return task;
}

std::string CommentState::line(std::string_view text) {
  std::string result;
  char quote = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    const std::string_view two = text.substr(i, 2);
    if (depth_ == 0 && quote != 0 && text[i] == '$' && two.size() == 2) {
      result += two;
      ++i;
    } else if (depth_ == 0 && (quote != 0 ? text[i] == quote : text[i] == '\'' || text[i] == '"')) {
      quote = quote != 0 ? '\0' : text[i];
      result += text[i];
    } else if (quote == 0 && two == "(*") {
      const bool apart = depth_ != 0 && !nested_;
      changed_ += apart ? 1 : 0;
      depth_ += apart ? 0 : 1;
      result += apart ? "( *" : "(*";
      // `(*)` inside such a comment ends it: its asterisk belongs to the end, too.
      i += apart ? 0 : 1;
      if (apart)
        result.pop_back();
    } else if (depth_ != 0 && two == "*)") {
      --depth_;
      result += two;
      ++i;
    } else {
      result += text[i];
    }
  }
  return result;
}

} // namespace stc::import
