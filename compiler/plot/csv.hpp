#ifndef STRIDE_COMPILER_PLOT_CSV_HPP
#define STRIDE_COMPILER_PLOT_CSV_HPP
// Lines and cells of a trace.

#include <string_view>
#include <vector>

namespace stc::plot {

/// The text without the mark that some editors write before it.
[[nodiscard]] std::string_view withoutByteOrderMark(std::string_view text);
/// The next line, without its end; it is taken off `rest`.
[[nodiscard]] std::string_view nextLine(std::string_view &rest);
/// What stands in a cell, without blanks and quotation marks around it.
[[nodiscard]] std::string_view cellText(std::string_view text);
/// The cells of a line, split at commas outside of brackets and quotation marks: `a[1,2]` is one.
[[nodiscard]] std::vector<std::string_view> cells(std::string_view line);

} // namespace stc::plot

#endif // STRIDE_COMPILER_PLOT_CSV_HPP
