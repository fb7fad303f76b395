#include "runtime/numeric/path/way_table.hpp"

#include "runtime/numeric/exact_math.hpp"

namespace stride::path {
namespace {

using exact::fabs;

constexpr int kParts = 16; ///< Of a WayTable.
constexpr int kMostSteps = 6;
/// Of the speeds at the ends of a part: how much they may change in between, if both are the same.
constexpr double kLeastBend = 0.05;

/// How fast a part of a shape is gone through at both ends. [u]
struct Ends {
  double first, last;
};

/// About where a part of a way is in a part of a table, both from 0 to 1: by the cubic that leaves
/// both ends as the parameter does. `speed`: in the mean. [u]
double parameterIn(double x, double speed, const Ends &ends) noexcept {
  const double rest = 1.0 - x;
  const double guess =
      x * x * (3.0 - 2.0 * x) + x * rest * (rest * speed / ends.first - x * speed / ends.last);
  return guess > 0.0 && guess < 1.0 ? guess : x;
}

bool isUneven(const WayTable &table, int part) noexcept {
  return (table.uneven >> static_cast<unsigned>(part) & 1U) != 0;
}

} // namespace

WayTable tableOf(const Shape &shape) noexcept {
  constexpr double kEven = 1e-13; // of the length: both halves are a thousand times better
  WayTable table{};
  for (int i = 0; i < kParts; ++i) {
    const double from = static_cast<double>(i) / kParts;
    const double middle = (i + 0.5) / kParts;
    const double to = static_cast<double>(i + 1) / kParts;
    double length = quickLength(shape, from, middle) + quickLength(shape, middle, to);
    if (!(fabs(length - quickLength(shape, from, to)) <= kEven * shape.length)) {
      length = lengthBetween(shape, from, to);
      table.uneven |= 1U << static_cast<unsigned>(i);
    }
    table.way[i + 1] = table.way[i] + length;
  }
  return table;
}

double parameterAt(const Shape &shape, const WayTable &table, double way) noexcept {
  int part = 0;
  for (int half = kParts / 2; half > 0; half /= 2)
    if (table.way[part + half] <= way)
      part += half;
  const double from = static_cast<double>(part) / kParts;
  const double width = 1.0 / kParts;
  const double begin = table.way[part];
  const double span = table.way[part + 1] - begin;
  const double x = exact::smaller((way - begin) / span, 1.0);
  if (isUneven(table, part))
    return parameterBetween(shape, from, from + width, way - begin, from + width * x);
  const Ends ends{speedAt(shape, from), speedAt(shape, from + width)};
  double u = from + width * parameterIn(x, span / width, ends);
  const double slowest = exact::smaller(ends.first, ends.last);
  const double bend = fabs(ends.last - ends.first) + kLeastBend * (ends.first + ends.last);
  for (int i = 0; i < kMostSteps; ++i) {
    const double off = way - begin - quickLength(shape, from, u);
    u += off / speedAt(shape, u);
    // What Newton's step leaves goes with the square of what it has found.
    if (off * off * bend <= 1e-16 * shape.length * width * slowest * slowest)
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
