#ifndef STRIDE_COMPILER_PLOT_COLOR_SCALE_HPP
#define STRIDE_COMPILER_PLOT_COLOR_SCALE_HPP
// Colours for values, from small to great.

#include <cstddef>
#include <string>

namespace stc::plot {

/// How many colours there are.
inline constexpr size_t kColorCount = 24;

/// A colour as `#rrggbb`, 0 <= index < kColorCount: equally bright steps, also for colour-blind
/// readers.
[[nodiscard]] std::string colorOf(size_t index);

/// The index of the colour for a part from 0 to 1; what is outside has the colour next to it.
[[nodiscard]] size_t colorClass(double part);

} // namespace stc::plot

#endif // STRIDE_COMPILER_PLOT_COLOR_SCALE_HPP
