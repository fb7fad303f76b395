#include "runtime/common/text.hpp"

namespace stride::common {

std::string lowerCase(std::string_view text) {
  std::string out(text);
  for (char &c : out)
    c = lowerCase(c);
  return out;
}

std::string upperCase(std::string_view text) {
  std::string out(text);
  for (char &c : out)
    c = upperCase(c);
  return out;
}

/// U+0080 to U+009F are two bytes, the first of which alone is none of them.
void hideControls(std::string &text, std::string_view kept, size_t from) noexcept {
  for (size_t i = from; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const unsigned before = i == 0 ? 0U : static_cast<unsigned char>(text[i - 1]);
    if ((byte < 0x20 || byte == 0x7F) && kept.find(text[i]) == std::string_view::npos)
      text[i] = '?';
    else if (before == 0xC2 && byte >= 0x80 && byte < 0xA0)
      text[i - 1] = text[i] = '?';
  }
}

std::string escapedMarkup(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
    case '&':
      out += "&amp;";
      break;
    case '<':
      out += "&lt;";
      break;
    case '>':
      out += "&gt;";
      break;
    case '"':
      out += "&quot;";
      break;
    case '\n':
    case '\t':
      out += c;
      break;
    default:
      out += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    }
  }
  return out;
}

} // namespace stride::common
