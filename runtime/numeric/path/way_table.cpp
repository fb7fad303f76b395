#include "runtime/numeric/path/way_table.hpp"

#include "runtime/numeric/exact_math.hpp"

namespace stride::path {
namespace {

using exact::fabs;

constexpr int kParts = 16; ///< Of a WayTable.
constexpr int kMostSteps = 6;

bool isUneven(const WayTable &table, int part) noexcept {
  return (table.uneven >> static_cast<unsigned>(part) & 1U) != 0;
}

} // namespace

WayTable tableOf(const Shape &shape) noexcept {
  WayTable table{};
  for (int i = 0; i < kParts; ++i) {
    const double from = static_cast<double>(i) / kParts;
    const double to = static_cast<double>(i + 1) / kParts;
    const double length = lengthBetween(shape, from, to);
    table.way[i + 1] = table.way[i] + length;
    if (fabs(length - quickLength(shape, from, to)) > 1e-13 * shape.length)
      table.uneven |= 1U << static_cast<unsigned>(i);
  }
  return table;
}

double parameterAt(const Shape &shape, const WayTable &table, double way) noexcept {
  int part = 0;
  for (int half = kParts / 2; half > 0; half /= 2)
    if (table.way[part + half] <= way)
      part += half;
  const double from = static_cast<double>(part) / kParts;
  const double to = static_cast<double>(part + 1) / kParts;
  const double begin = table.way[part];
  const double span = table.way[part + 1] - begin;
  double u = from + (to - from) * exact::smaller((way - begin) / span, 1.0);
  if (isUneven(table, part))
    return parameterBetween(shape, from, to, way - begin, u);
  for (int i = 0; i < kMostSteps; ++i) {
    const double off = way - begin - quickLength(shape, from, u);
    u += off / speedAt(shape, u);
    if (fabs(off) <= 1e-14 * shape.length)
      break;
  }
  return exact::smaller(exact::larger(u, 0.0), 1.0);
}

double wayAt(const Shape &shape, const WayTable &table, double u) noexcept {
  if (u >= 1.0)
    return shape.length;
  const int part = static_cast<int>(u * kParts);
  const double from = static_cast<double>(part) / kParts;
  const double more =
      isUneven(table, part) ? lengthBetween(shape, from, u) : quickLength(shape, from, u);
  return exact::smaller(table.way[part] + more, shape.length);
}

} // namespace stride::path
