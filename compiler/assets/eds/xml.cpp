#include "compiler/assets/eds/xml.hpp"

#include "compiler/assets/eds/ini.hpp"

#include <algorithm>
#include <charconv>

namespace stc::eds {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

std::string_view withoutPrefix(std::string_view name) {
  const size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

/// A character by its number, in UTF-8; only those that a name may need.
std::string character(uint32_t number) {
  if (number < 0x20 || number > 0xFFFF)
    return "?";
  if (number < 0x80)
    return {static_cast<char>(number)};
  if (number < 0x800)
    return {static_cast<char>(0xC0U | number >> 6U), static_cast<char>(0x80U | (number & 0x3FU))};
  return {static_cast<char>(0xE0U | number >> 12U),
          static_cast<char>(0x80U | (number >> 6U & 0x3FU)),
          static_cast<char>(0x80U | (number & 0x3FU))};
}

std::string resolved(std::string_view text) {
  constexpr std::pair<std::string_view, char> kNames[] = {
      {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
  std::string result;
  while (!text.empty()) {
    size_t taken = 0;
    for (const auto &[name, sign] : kNames)
      if (taken == 0 && text.starts_with(name)) {
        result += sign;
        taken = name.size();
      }
    const size_t end = text.starts_with("&#") ? text.find(';') : std::string_view::npos;
    if (taken == 0 && end != std::string_view::npos) {
      std::string_view digits = text.substr(2, end - 2);
      const bool hex = digits.starts_with('x');
      digits.remove_prefix(hex ? 1 : 0);
      uint32_t number = 0;
      std::from_chars(digits.data(), digits.data() + digits.size(), number, hex ? 16 : 10);
      result += character(number);
      taken = end + 1;
    }
    if (taken == 0) {
      result += text.front();
      taken = 1;
    }
    text.remove_prefix(taken);
  }
  return inUtf8(result);
}

} // namespace

std::string_view XmlTag::operator[](std::string_view attribute) const {
  const auto found = attributes.find(attribute);
  return found == attributes.end() ? std::string_view() : std::string_view(found->second);
}

void XmlTags::skip(size_t count) {
  count = std::min(count, rest_.size());
  line_ += static_cast<size_t>(
      std::count(rest_.begin(), rest_.begin() + static_cast<ptrdiff_t>(count), '\n'));
  rest_.remove_prefix(count);
}

void XmlTags::readAttributes(std::string_view inside, XmlTag &tag) {
  while (!inside.empty()) {
    inside.remove_prefix(std::min(inside.find_first_not_of(kSpace), inside.size()));
    const size_t equals = inside.find('=');
    if (equals == std::string_view::npos)
      return;
    std::string_view name = inside.substr(0, equals);
    name = name.substr(0, name.find_last_not_of(kSpace) + 1);
    inside.remove_prefix(equals + 1);
    inside.remove_prefix(std::min(inside.find_first_not_of(kSpace), inside.size()));
    if (inside.empty() || (inside.front() != '"' && inside.front() != '\''))
      return;
    const size_t end = inside.find(inside.front(), 1);
    if (end == std::string_view::npos)
      return;
    tag.attributes.try_emplace(std::string(withoutPrefix(name)),
                               resolved(inside.substr(1, end - 1)));
    inside.remove_prefix(end + 1);
  }
}

bool XmlTags::next(XmlTag &tag) {
  for (;;) {
    const size_t begin = rest_.find('<');
    if (begin == std::string_view::npos)
      return false;
    skip(begin);
    if (rest_.starts_with("<!--")) {
      const size_t end = rest_.find("-->");
      skip(end == std::string_view::npos ? rest_.size() : end + 3);
      continue;
    }
    // The tag ends at the first > that is in no attribute.
    size_t end = 1;
    char quote = 0;
    while (end < rest_.size() && (quote != 0 || rest_[end] != '>')) {
      if (quote == rest_[end])
        quote = 0;
      else if (quote == 0 && (rest_[end] == '"' || rest_[end] == '\''))
        quote = rest_[end];
      ++end;
    }
    std::string_view inside = rest_.substr(1, end - 1);
    tag = {};
    tag.line = line_;
    skip(end + 1);
    if (inside.empty() || inside.front() == '?' || inside.front() == '!')
      continue;
    tag.opens = inside.front() != '/';
    tag.closes = !tag.opens || inside.back() == '/';
    inside.remove_prefix(tag.opens ? 0 : 1);
    const size_t nameEnd = std::min(inside.find_first_of(" \t\r\n/"), inside.size());
    tag.name = withoutPrefix(inside.substr(0, nameEnd));
    readAttributes(inside.substr(nameEnd), tag);
    return true;
  }
}

std::string XmlTags::text() const { return resolved(trimmed(rest_.substr(0, rest_.find('<')))); }

} // namespace stc::eds
