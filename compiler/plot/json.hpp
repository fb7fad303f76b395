#ifndef STRIDE_COMPILER_PLOT_JSON_HPP
#define STRIDE_COMPILER_PLOT_JSON_HPP
// Data for the scripts of HTML pages.

#include <string>
#include <string_view>
#include <vector>

namespace stc::plot {

/// A text as JSON within an HTML page: nothing in it ends the script.
[[nodiscard]] std::string jsonText(std::string_view text);
/// Numbers as JSON; null for those that are none.
void appendJson(std::string &out, const std::vector<double> &values);

} // namespace stc::plot

#endif // STRIDE_COMPILER_PLOT_JSON_HPP
