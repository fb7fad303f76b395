#ifndef STRIDE_COMPILER_CLI_LINE_DIFF_HPP
#define STRIDE_COMPILER_CLI_LINE_DIFF_HPP
// The difference of two texts, as `diff -u` shows it.

#include <string>
#include <string_view>

namespace stc::cli {

/// Empty for equal texts. Three lines of context; `name` stands in the head.
[[nodiscard]] std::string lineDiff(std::string_view before, std::string_view after,
                                   std::string_view name);

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_LINE_DIFF_HPP
