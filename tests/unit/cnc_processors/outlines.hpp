// Closed contours of lines, arcs and splines as parts have them: letters, gears, slots, spirals.
#ifndef STRIDE_TESTS_UNIT_CNC_PROCESSORS_OUTLINES_HPP
#define STRIDE_TESTS_UNIT_CNC_PROCESSORS_OUTLINES_HPP

#include "tests/unit/cnc_processors/contours.hpp"

namespace stride::cnc::contours {

/// Where a side leads to. A bulge is the tangent of a quarter of the arc's angle, positive
/// counterclockwise, 0 for a line; with `isCurve` a spline with two control points.
struct Side {
  Point to;
  double bulge = 0;
  bool isCurve = false;
  Point first{0, 0}, second{0, 0};
};

inline Side lineTo(double x, double y) { return {{x, y}}; }
inline Side arcTo(double x, double y, double bulge) { return {{x, y}, bulge}; }
inline Side curveTo(double ax, double ay, double bx, double by, double x, double y) {
  return {{x, y}, 0, true, {ax, ay}, {bx, by}};
}

inline void draw(Drawing &d, const Side &side) {
  const Point from = d.here;
  const Point to = side.to;
  if (side.isCurve) {
    d.spline(to, {3 * (side.first.x - from.x), 3 * (side.first.y - from.y)},
             {3 * (to.x - side.second.x), 3 * (to.y - side.second.y)});
  } else if (side.bulge == 0) {
    d.line(to.x, to.y);
  } else {
    // The centre is on the bisector; to the left where the arc is a small counterclockwise one.
    const double off = (1 - side.bulge * side.bulge) / (4 * side.bulge);
    const Point centre{(from.x + to.x) / 2 - (to.y - from.y) * off,
                       (from.y + to.y) / 2 + (to.x - from.x) * off};
    PathObject &o = d.arc(centre, 4 * std::atan(side.bulge) * 180 / M_PI);
    o.end.coordinate[kAxisX] = to.x;
    o.end.coordinate[kAxisY] = to.y;
    d.here = to;
  }
}

/// The contour from the middle of its last side, a line, where no corner is. It stands askew, so
/// that nothing lies along an axis.
inline Drawing closed(std::vector<Side> sides) {
  for (Side &side : sides)
    for (Point *p : {&side.to, &side.first, &side.second})
      *p = {p->x * std::cos(0.37) - p->y * std::sin(0.37),
            p->x * std::sin(0.37) + p->y * std::cos(0.37)};
  Drawing d;
  const Point last = sides.back().to;
  const Point before = sides[sides.size() - 2].to;
  const Point middle{(last.x + before.x) / 2, (last.y + before.y) / 2};
  d.here = middle;
  d.line(last.x, last.y);
  for (size_t i = 0; i + 1 < sides.size(); ++i)
    draw(d, sides[i]);
  d.line(middle.x, middle.y);
  return d;
}

/// The same, gone over the other way.
inline Drawing reversed(const Drawing &forward) {
  Drawing d = forward;
  std::reverse(d.path.begin(), d.path.end());
  for (PathObject &o : d.path) {
    std::swap(o.start, o.end);
    const double from = o.parameterRange[0];
    const double range = o.parameterRange[1];
    if (o.moveType == MoveType::Spline) {
      o.parameterRange[0] = from == 0 && range == 0 ? 1 : range;
      o.parameterRange[1] = from;
    } else if (isCircle(o.moveType) || isEllipse(o.moveType)) {
      switch (o.moveType) {
      case MoveType::Clockwise:
        o.moveType = MoveType::Counterclockwise;
        break;
      case MoveType::Counterclockwise:
        o.moveType = MoveType::Clockwise;
        break;
      case MoveType::EllipseClockwise:
        o.moveType = MoveType::EllipseCounterclockwise;
        break;
      default:
        o.moveType = MoveType::EllipseClockwise;
      }
      o.parameterRange[0] = from - range; // clockwise ranges are positive
      o.parameterRange[1] = -range;
    }
  }
  return d;
}

/// Contours of a letter: the outer one counterclockwise, and those of its holes.
struct Letter {
  char name;
  Drawing outer;
  std::vector<Drawing> holes;
};

inline std::vector<Letter> letters() {
  const double k = 1; // half a circle
  return {
      {'L',
       closed({lineTo(25, 0), lineTo(25, 7), lineTo(8, 7), lineTo(8, 40), lineTo(0, 40),
               lineTo(0, 0)}),
       {}},
      {'A',
       closed({lineTo(7, 0), lineTo(10.5, 11), lineTo(20.5, 11), lineTo(24, 0), lineTo(31, 0),
               lineTo(19.5, 40), lineTo(11.5, 40), lineTo(0, 0)}),
       {closed({lineTo(18.5, 17), lineTo(15.5, 31), lineTo(12.5, 17)})}},
      {'B',
       closed(
           {lineTo(16, 0), arcTo(19, 21.5, 1.1), arcTo(15, 40, 0.95), lineTo(0, 40), lineTo(0, 0)}),
       {closed({lineTo(15, 6.5), arcTo(15, 18.5, k), lineTo(7, 18.5), lineTo(7, 6.5)}),
        closed({lineTo(14, 24), arcTo(14, 34, k), lineTo(7, 34), lineTo(7, 24)})}},
      {'e',
       closed({lineTo(5, 14), arcTo(24, 8, 0.9), lineTo(29, 4), arcTo(-2, 17, -1.1),
               arcTo(31, 17.5, -1.0), lineTo(31, 14), lineTo(18, 14)}),
       {}},
      {'S',
       closed({curveTo(2, 3, 8, 0, 14, 0), curveTo(24, 0, 30, 5, 30, 12),
               curveTo(30, 20, 24, 22, 17, 24), curveTo(11, 26, 9, 27, 9, 30),
               curveTo(9, 35, 20, 36, 24, 31), lineTo(29, 36), curveTo(20, 45, 2, 42, 2, 29.5),
               curveTo(2, 22, 8, 20, 14, 18), curveTo(20, 16, 23, 15, 23, 12),
               curveTo(23, 5, 9, 4, 4, 11), lineTo(0, 6)}),
       {}},
      {'W',
       closed({lineTo(10, 0), lineTo(18, 25), lineTo(26, 0), lineTo(33, 0), lineTo(42, 40),
               lineTo(35, 40), lineTo(29, 13), lineTo(21, 38), lineTo(15, 38), lineTo(7, 13),
               lineTo(1, 40), lineTo(-6, 40), lineTo(3, 0)}),
       {}},
  };
}

/// A wheel whose rim is hollows of half a circle or less side by side, with points between.
inline Drawing scallops(int count, double radius, double bulge) {
  std::vector<Side> sides;
  const auto at = [&](double i) {
    const double phi = 2 * M_PI * i / (count + 1);
    return Point{radius * std::cos(phi), radius * std::sin(phi)};
  };
  for (int i = 1; i <= count; ++i)
    sides.push_back(arcTo(at(i).x, at(i).y, bulge));
  sides.push_back(lineTo(at(0).x, at(0).y));
  return closed(sides);
}

/// A potato of many short lines and arcs, whose corners point in and out at random.
inline Drawing rough(std::mt19937 &random, int count, double unevenness) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Side> sides;
  for (int i = 0; i <= count; ++i) {
    const double phi = 2 * M_PI * i / (count + 1);
    const double r = 20 + unevenness * uniform(random) + 5 * std::sin(3 * phi);
    const Point to{r * std::cos(phi), r * std::sin(phi)};
    const double bulge = random() % 3 == 0 ? 0.4 * uniform(random) : 0;
    sides.push_back({to, i == count ? 0 : bulge});
  }
  return closed(sides);
}

/// A bar with slots and pockets: teeth of any width and depth.
inline Drawing comb(std::mt19937 &random, int teeth) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Side> sides;
  double x = 0;
  for (int i = 0; i < teeth; ++i) {
    const double slot = 1 + 4 * uniform(random);
    const double deep = 5 + 20 * uniform(random);
    const double pocket = random() % 2 == 0 ? 0 : 3 * uniform(random);
    x += 4 + 6 * uniform(random);
    sides.push_back(lineTo(x, 0));
    sides.push_back(lineTo(x, deep));
    if (pocket > 0)
      sides.push_back(lineTo(x - pocket, deep));
    if (random() % 2 == 0)
      sides.push_back(arcTo(x + slot + pocket, deep + 3, -0.6));
    else
      sides.push_back(lineTo(x + slot + pocket, deep + 3));
    sides.push_back(lineTo(x + slot + pocket, deep));
    if (pocket > 0)
      sides.push_back(lineTo(x + slot, deep));
    sides.push_back(lineTo(x + slot, 0));
    x += slot;
    if (pocket > 0)
      x += 2 * pocket;
  }
  sides.push_back(lineTo(x + 10, 0));
  sides.push_back(lineTo(x + 10, 40));
  sides.push_back(lineTo(0, 40));
  sides.push_back(lineTo(0, 0));
  return closed(sides);
}

/// A band that winds up, of half circles.
inline Drawing spiral(int turns, double pitch, double width) {
  std::vector<Side> sides;
  const auto side = [](int i) { return i % 2 == 0 ? 1.0 : -1.0; };
  const auto radius = [pitch](int i) { return 6 + pitch * i / 2; };
  for (int i = 1; i <= 2 * turns; ++i)
    sides.push_back(arcTo(side(i) * radius(i), 0, 1));
  const double end = radius(2 * turns);
  sides.push_back(lineTo(end + width, 0));
  for (int i = 2 * turns - 1; i >= 0; --i)
    sides.push_back(arcTo(side(i) * (radius(i) + width), 0, -1));
  sides.push_back(lineTo(radius(0), 0));
  return closed(sides);
}

} // namespace stride::cnc::contours

#endif // STRIDE_TESTS_UNIT_CNC_PROCESSORS_OUTLINES_HPP
