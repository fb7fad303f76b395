// Texts of a driver's parameters (SetupParameters): lines, and whole numbers as ST writes them.
#ifndef STRIDE_RUNTIME_COMMON_SETUP_TEXT_HPP
#define STRIDE_RUNTIME_COMMON_SETUP_TEXT_HPP

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stride::common {

/// Without blanks, tabulators and carriage returns at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

[[nodiscard]] std::vector<std::string> linesOf(const std::string &text);

/// Digits and nothing else.
[[nodiscard]] std::optional<uint64_t> wholeNumber(std::string_view digits, int base);

/// A number without its type.
struct WholeNumber {
  uint64_t magnitude = 0;
  bool negative = false;
};

/// "-35", "16#1F", "2#1010", "1_000".
[[nodiscard]] std::optional<WholeNumber> wholeNumber(std::string_view text);

} // namespace stride::common

#endif
