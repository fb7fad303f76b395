// What a contour with a disc rolled along it covers, by its definition: all places that are nearer
// to the contour than the disc's radius, row by row.
#ifndef STRIDE_TESTS_UNIT_CNC_PROCESSORS_OFFSET_ORACLE_HPP
#define STRIDE_TESTS_UNIT_CNC_PROCESSORS_OFFSET_ORACLE_HPP

#include "tests/unit/cnc_processors/contours.hpp"

#include <cstddef>
#include <numeric>
#include <utility>

namespace stride::cnc::contours {

/// From one x to another one.
using Interval = std::pair<double, double>;
using Row = std::vector<Interval>;

/// Rows of places from y = low on.
struct Rows {
  double low;
  double step;
  std::vector<Row> rows;
  [[nodiscard]] double at(size_t i) const { return low + (static_cast<double>(i) + 0.5) * step; }
};

inline void unite(Row &row) {
  std::sort(row.begin(), row.end());
  Row merged;
  for (const Interval &part : row)
    if (!merged.empty() && part.first <= merged.back().second)
      merged.back().second = std::max(merged.back().second, part.second);
    else
      merged.push_back(part);
  row = merged;
}

/// What is left between `from` and `to`.
inline Row without(const Row &taken, double from, double to) {
  Row rest;
  for (const Interval &part : taken) {
    if (part.first > from)
      rest.emplace_back(from, std::min(part.first, to));
    from = std::max(from, part.second);
  }
  if (from < to)
    rest.emplace_back(from, to);
  return rest;
}

/// Where a row meets the places that are nearer to a line from a to b than r: they are convex.
inline bool meets(const Point &a, const Point &b, double r, double y, Interval &part) {
  part = {1e300, -1e300};
  const auto widen = [&part](double x) {
    part = {std::min(part.first, x), std::max(part.second, x)};
  };
  for (const Point &p : {a, b})
    if (std::fabs(y - p.y) < r) {
      const double w = std::sqrt(r * r - (y - p.y) * (y - p.y));
      widen(p.x - w);
      widen(p.x + w);
    }
  const double length = gapOf(a, b);
  if (length > 0) {
    const Point n{-(b.y - a.y) / length * r, (b.x - a.x) / length * r};
    const Point corners[] = {{a.x + n.x, a.y + n.y},
                             {b.x + n.x, b.y + n.y},
                             {b.x - n.x, b.y - n.y},
                             {a.x - n.x, a.y - n.y}};
    for (size_t i = 0; i < 4; ++i) {
      const Point &p = corners[i];
      const Point &q = corners[(i + 1) % 4];
      if ((p.y > y) != (q.y > y))
        widen(p.x + (y - p.y) / (q.y - p.y) * (q.x - p.x));
    }
  }
  return part.first < part.second;
}

/// Rows of what is inside of the closed line, or near it.
struct Covered {
  Rows inside, near;
};

inline Covered cover(const std::vector<Point> &line, double r, double step) {
  double low = 1e300;
  double high = -1e300;
  for (const Point &p : line) {
    low = std::min(low, p.y);
    high = std::max(high, p.y);
  }
  const double margin = 1.2 * r + 3 * step;
  low -= margin;
  const auto count = static_cast<size_t>((high + margin - low) / step) + 1;
  Covered covered{{low, step, std::vector<Row>(count)}, {low, step, std::vector<Row>(count)}};
  std::vector<std::vector<double>> crossings(count);
  for (size_t i = 1; i < line.size(); ++i) {
    const Point &a = line[i - 1];
    const Point &b = line[i];
    const auto first = static_cast<size_t>((std::min(a.y, b.y) - r - low) / step - 1);
    const auto last = static_cast<size_t>((std::max(a.y, b.y) + r - low) / step + 1);
    for (size_t k = first; k <= last && k < count; ++k) {
      const double y = covered.near.at(k);
      if (Interval part; meets(a, b, r, y, part))
        covered.near.rows[k].push_back(part);
      if ((a.y > y) != (b.y > y))
        crossings[k].push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
  }
  for (size_t k = 0; k < count; ++k) {
    unite(covered.near.rows[k]);
    std::sort(crossings[k].begin(), crossings[k].end());
    for (size_t i = 1; i < crossings[k].size(); i += 2)
      covered.inside.rows[k].emplace_back(crossings[k][i - 1], crossings[k][i]);
  }
  return covered;
}

/// The area of the part that hangs together around a place; 0 if the place is not in it.
inline double areaAround(const Rows &rows, const Point &place) {
  std::vector<size_t> begin(rows.rows.size() + 1, 0);
  for (size_t k = 0; k < rows.rows.size(); ++k)
    begin[k + 1] = begin[k] + rows.rows[k].size();
  std::vector<size_t> parent(begin.back());
  std::iota(parent.begin(), parent.end(), size_t{0});
  const auto root = [&parent](size_t i) {
    while (parent[i] != i)
      i = parent[i] = parent[parent[i]];
    return i;
  };
  for (size_t k = 1; k < rows.rows.size(); ++k)
    for (size_t i = 0; i < rows.rows[k].size(); ++i)
      for (size_t j = 0; j < rows.rows[k - 1].size(); ++j) {
        const Interval &a = rows.rows[k][i];
        const Interval &b = rows.rows[k - 1][j];
        if (a.first < b.second && b.first < a.second)
          parent[root(begin[k] + i)] = root(begin[k - 1] + j);
      }
  const auto row = static_cast<size_t>((place.y - rows.low) / rows.step);
  size_t wanted = parent.size();
  for (size_t i = 0; i < rows.rows[row].size(); ++i)
    if (rows.rows[row][i].first <= place.x && place.x <= rows.rows[row][i].second)
      wanted = root(begin[row] + i);
  double area = 0;
  for (size_t k = 0; k < rows.rows.size(); ++k)
    for (size_t i = 0; i < rows.rows[k].size(); ++i)
      if (wanted != parent.size() && root(begin[k] + i) == wanted)
        area += (rows.rows[k][i].second - rows.rows[k][i].first) * rows.step;
  return area;
}

/// The area within the path of a disc that rolls around the closed line outside, where a place of
/// it is. A slot that it does not get into is inside; but if the place is in one, it is its area.
inline double areaOutside(const std::vector<Point> &line, double r, double step,
                          const Point &place) {
  const Covered covered = cover(line, r, step);
  double left = 1e300;
  double right = -1e300;
  for (const Point &p : line) {
    left = std::min(left, p.x - 2 * r);
    right = std::max(right, p.x + 2 * r);
  }
  Rows free = covered.near;
  for (size_t k = 0; k < free.rows.size(); ++k) {
    Row &row = free.rows[k];
    row.insert(row.end(), covered.inside.rows[k].begin(), covered.inside.rows[k].end());
    unite(row);
    row = without(row, left, right);
  }
  const double all = (right - left) * free.step * static_cast<double>(free.rows.size());
  const double around = areaAround(free, {left, free.at(0)});
  const double here = areaAround(free, place);
  return here == around ? all - around : here;
}

/// The area within the path of a disc that rolls inside of the closed line, in the part where a
/// place of it is.
inline double areaInside(const std::vector<Point> &line, double r, double step,
                         const Point &place) {
  Covered covered = cover(line, r, step);
  for (size_t k = 0; k < covered.inside.rows.size(); ++k) {
    Row rest;
    for (const Interval &part : covered.inside.rows[k])
      for (const Interval &left : without(covered.near.rows[k], part.first, part.second))
        if (left.first < left.second)
          rest.push_back(left);
    covered.inside.rows[k] = rest;
  }
  return areaAround(covered.inside, place);
}

} // namespace stride::cnc::contours

#endif // STRIDE_TESTS_UNIT_CNC_PROCESSORS_OFFSET_ORACLE_HPP
