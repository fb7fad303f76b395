// Texts: case, what a terminal and a markup language must not be given.
#ifndef STRIDE_RUNTIME_COMMON_TEXT_HPP
#define STRIDE_RUNTIME_COMMON_TEXT_HPP

#include <cstddef>
#include <string>
#include <string_view>

namespace stride::common {

/// The letter's lower-case form; only A to Z have one, whatever the locale says.
constexpr char lowerCase(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
[[nodiscard]] std::string lowerCase(std::string_view text);
/// The letter's upper-case form; only a to z have one.
constexpr char upperCase(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
[[nodiscard]] std::string upperCase(std::string_view text);

/// Shows control characters (U+0000 to U+001F, U+007F to U+009F) but those in `kept` as `?`, from
/// `from` on: names of files and values of variables must not command a terminal. In place, and
/// nothing gets longer.
void hideControls(std::string &text, std::string_view kept = {}, size_t from = 0) noexcept;

/// The text as the content or a quoted attribute of HTML, SVG or XML. Control characters but line
/// ends and tabs, which XML does not know, become `?`.
[[nodiscard]] std::string escapedMarkup(std::string_view text);

} // namespace stride::common

#endif
