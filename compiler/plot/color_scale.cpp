#include "compiler/plot/color_scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace stc::plot {

namespace {

// cividis, in five places.
constexpr std::array<std::array<double, 3>, 5> kScale = {
    {{0, 34, 78}, {66, 78, 107}, {124, 123, 120}, {187, 173, 105}, {253, 231, 55}}};

} // namespace

std::string colorOf(size_t index) {
  const double at = static_cast<double>(index) / (kColorCount - 1) * (kScale.size() - 1);
  const size_t first = std::min(static_cast<size_t>(at), kScale.size() - 2);
  const double part = at - static_cast<double>(first);
  int rgb[3];
  for (size_t i = 0; i < 3; ++i)
    rgb[i] = static_cast<int>(
        std::lround(kScale[first][i] + (kScale[first + 1][i] - kScale[first][i]) * part));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

size_t colorClass(double part) {
  return part > 0 ? static_cast<size_t>(std::min(part * kColorCount, kColorCount - 1.0)) : 0;
}

} // namespace stc::plot
