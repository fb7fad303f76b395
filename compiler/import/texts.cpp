#include "compiler/import/texts.hpp"

#include <algorithm>

namespace stc::import {

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
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (plain)
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
