#include "compiler/import/st_scan.hpp"

#include "runtime/common/text.hpp"

#include <algorithm>

namespace stc::import {

namespace {

bool isWordSign(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

size_t afterNested(std::string_view text, size_t at, std::string_view open,
                   std::string_view close) {
  size_t depth = 0;
  while (at < text.size()) {
    const std::string_view rest = text.substr(at);
    if (rest.starts_with(open)) {
      ++depth;
      at += open.size();
    } else if (rest.starts_with(close)) {
      at += close.size();
      if (--depth == 0)
        return at;
    } else {
      ++at;
    }
  }
  return text.size();
}

size_t afterPragma(std::string_view text, size_t at) {
  for (++at; at < text.size(); ++at) {
    const size_t end = afterString(text, at);
    if (end != at)
      at = end - 1;
    else if (text[at] == '}')
      return at + 1;
  }
  return text.size();
}

} // namespace

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

size_t afterComment(std::string_view text, size_t at) {
  const std::string_view rest = text.substr(std::min(at, text.size()));
  if (rest.starts_with("(*"))
    return afterNested(text, at, "(*", "*)");
  if (rest.starts_with("/*"))
    return afterNested(text, at, "/*", "*/");
  if (rest.starts_with("//"))
    return std::min(text.find('\n', at), text.size());
  if (rest.starts_with('{'))
    return afterPragma(text, at);
  return at;
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
  size_t end = at;
  while (end < text.size() && isWordSign(text[end]))
    ++end;
  return text.substr(std::min(at, text.size()), end - at);
}

std::string firstKeyword(std::string_view text) {
  return stride::common::upperCase(wordAt(text, codeFrom(text)));
}

std::string quotedForSt(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'' || c == '$')
      out += '$';
    out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return out;
}

std::string asIdentifier(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const bool plain = isWordSign(c) && static_cast<unsigned char>(c) < 0x80;
    if (plain && c != '_')
      out += c;
    else if (out.empty() || out.back() != '_') // two in a row are not allowed
      out += '_';
  }
  if (out.size() > 1 && out.back() == '_')
    out.pop_back();
  if (out.empty() || (out.front() >= '0' && out.front() <= '9'))
    out.insert(0, "_");
  return out;
}

std::string withSlashes(std::string_view path) {
  std::string out(path);
  std::ranges::replace(out, '\\', '/');
  return out;
}

std::string stemOf(std::string_view path) {
  const std::string whole = withSlashes(path);
  const size_t slash = whole.find_last_of('/');
  const std::string name = slash == std::string::npos ? whole : whole.substr(slash + 1);
  return name.substr(0, name.find_last_of('.'));
}

} // namespace stc::import
