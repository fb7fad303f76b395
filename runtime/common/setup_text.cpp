#include "runtime/common/setup_text.hpp"

#include <algorithm>
#include <charconv>

namespace stride::common {

std::string_view trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> linesOf(const std::string &text) {
  std::vector<std::string> lines;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

std::optional<uint64_t> wholeNumber(std::string_view digits, int base) {
  uint64_t value = 0;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size())
    return std::nullopt;
  return value;
}

std::optional<WholeNumber> wholeNumber(std::string_view text) {
  WholeNumber number;
  number.negative = text.starts_with('-');
  if (number.negative || text.starts_with('+'))
    text.remove_prefix(1);
  int base = 10;
  if (const size_t mark = text.find('#'); mark != std::string_view::npos) {
    const auto given = wholeNumber(text.substr(0, mark), 10);
    if (!given || (*given != 2 && *given != 8 && *given != 16))
      return std::nullopt;
    base = static_cast<int>(*given);
    text.remove_prefix(mark + 1);
  }
  std::string digits(text);
  std::erase(digits, '_');
  const auto magnitude = wholeNumber(digits, base);
  if (!magnitude)
    return std::nullopt;
  number.magnitude = *magnitude;
  return number;
}

} // namespace stride::common
