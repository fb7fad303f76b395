// Tool correction and loops together, against what a disc covers that is rolled along the contour.
#include "runtime/numeric/cnc/object_shape.hpp"
#include "runtime/numeric/cnc/processors/avoid_loop.hpp"
#include "runtime/numeric/cnc/processors/tool_correction.hpp"

#include "tests/unit/cnc_processors/offset_oracle.hpp"
#include "tests/unit/cnc_processors/outlines.hpp"
#include "tests/unit/cnc_processors/stream_harness.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::contours;
using namespace stride::cnc::test;

std::vector<PathObject> corrected(Drawing d, double r, uint8_t side) {
  for (PathObject &o : d.path) {
    o.toolRadius = r;
    o.marks = 0;
  }
  d.path.front().marks = side | kAvoidLoops;
  d.path.back().marks = kEndToolCorrection | kEndAvoidLoops;
  const auto tool = std::make_unique<ToolCorrection>();
  std::memset(static_cast<void *>(tool.get()), 0, sizeof *tool);
  std::vector<PathObject> path = runPath(*tool, d.path, {200, 2000, 0, 0}).objects;
  std::erase_if(path, [](const PathObject &o) { return o.moveType == MoveType::Positioning; });
  const auto loops = std::make_unique<LoopAvoider>();
  const Outcome run = runPath(*loops, path, {2000, 2000, 0, 0});
  EXPECT_EQ(run.stream.phase, StreamPhase::Done);
  return run.objects;
}

/// Where the shifted path begins.
Point beginOf(const Drawing &d, double r, uint8_t side) {
  const Point a = startOf(d.path.front());
  const Point b = endOf(d.path.front());
  const double length = gapOf(a, b);
  const double left = side == kToolLeft ? r : -r;
  return {a.x - (b.y - a.y) / length * left, a.y + (b.x - a.x) / length * left};
}

/// Places along a path, so many that chords are nowhere further from it than `error`.
std::vector<Point> finely(const std::vector<PathObject> &path, double error) {
  std::vector<Point> points;
  for (const PathObject &o : path) {
    int steps = 1;
    if (o.moveType == MoveType::Spline || isEllipse(o.moveType))
      steps = static_cast<int>(4 / std::sqrt(error));
    else if (o.moveType != MoveType::Line && o.moveType != MoveType::Positioning)
      steps = 1 + static_cast<int>(std::fabs(o.parameterRange[1]) * M_PI / 180 /
                                   std::sqrt(8 * error / o.shape[2]));
    if (points.empty())
      points.push_back(startOf(o));
    for (int i = 1; i <= steps; ++i)
      points.push_back(placeOfObject(o, static_cast<double>(i) / steps));
  }
  return points;
}

/// Boxes of pieces of a line, for distances.
class Nearness {
public:
  explicit Nearness(const std::vector<Point> &line) : line_(line) {
    for (size_t i = 1; i < line.size(); i += kRun) {
      Box box{1e300, -1e300, 1e300, -1e300};
      for (size_t k = i - 1; k < std::min(i + kRun, line.size()); ++k)
        box = {std::min(box.left, line[k].x), std::max(box.right, line[k].x),
               std::min(box.low, line[k].y), std::max(box.high, line[k].y)};
      boxes_.push_back(box);
    }
  }
  [[nodiscard]] double distance(const Point &p) const {
    double least = 1e300;
    for (size_t n = 0; n < boxes_.size(); ++n) {
      const Box &box = boxes_[n];
      const double dx = std::max({box.left - p.x, p.x - box.right, 0.0});
      const double dy = std::max({box.low - p.y, p.y - box.high, 0.0});
      if (dx * dx + dy * dy >= least * least)
        continue;
      const size_t from = 1 + n * kRun;
      for (size_t i = from; i < std::min(from + kRun, line_.size()); ++i)
        least = std::min(least, distanceToSegment(p, line_[i - 1], line_[i]));
    }
    return least;
  }

private:
  static constexpr size_t kRun = 16;
  struct Box {
    double left, right, low, high;
  };
  const std::vector<Point> &line_;
  std::vector<Box> boxes_;
};

/// Distances of the path from the contour, and what it goes around. False: the tool has no room
/// where the path begins, and nothing is judged.
bool judge(const Drawing &d, double r, uint8_t side, const std::string &what) {
  const std::vector<Point> contour = finely(d.path, 2e-4);
  const Nearness near(contour);
  if (near.distance(beginOf(d, r, side)) < r - 1e-4)
    return false;
  const bool outside = (areaOf(contour) > 0) == (side == kToolRight);
  const Point inner = beginOf(d, r + 0.06, side);
  const double expected =
      outside ? areaOutside(contour, r, 0.1, inner) : areaInside(contour, r, 0.1, inner);
  if (expected == 0)
    return false; // no more than a touch
  const std::vector<PathObject> path = corrected(d, r, side);
  double least = 1e300;
  double most = 0;
  for (const PathObject &o : path)
    for (int i = 0; i <= 12; ++i) {
      const double distance = near.distance(placeOfObject(o, i / 12.0));
      least = std::min(least, distance);
      most = std::max(most, distance);
    }
  const double area = std::fabs(areaOf(finely(path, 1e-4)));
  EXPECT_LT(greatestGap(path), 1e-9) << what;
  EXPECT_GE(least, r - 1.3e-3) << what;
  EXPECT_LE(most, r + 1.3e-3) << what;
  EXPECT_NEAR(area, expected, 5e-4 * (10 + expected)) << what;
  EXPECT_EQ(crossingsIn(finely(path, 6e-3)), 0) << what;
  // The way back is the way there.
  const uint8_t other = side == kToolLeft ? kToolRight : kToolLeft;
  const std::vector<PathObject> back = corrected(reversed(d), r, other);
  EXPECT_NEAR(std::fabs(areaOf(finely(back, 1e-4))), area, 1e-5 * (1 + area)) << what;
  return true;
}

/// Tools of several sizes on both sides: how many have been judged.
int judgeAll(const Drawing &d, const std::vector<double> &radii, const std::string &name) {
  int judged = 0;
  for (const double r : radii)
    for (const uint8_t side : {uint8_t{kToolLeft}, uint8_t{kToolRight}}) {
      const std::string what =
          name + (side == kToolLeft ? " left" : " right") + ", r = " + std::to_string(r);
      judged += judge(d, r, side, what) ? 1 : 0;
    }
  return judged;
}

TEST(OffsetOracle, KnowsARectangleAndARing) {
  const std::vector<Point> square{{0, 0}, {20, 0}, {20, 10}, {0, 10}, {0, 0}};
  EXPECT_NEAR(areaOutside(square, 3, 0.01, {10, -3.1}), 200 + 2 * 3 * 30 + M_PI * 9, 0.02);
  EXPECT_NEAR(areaInside(square, 3, 0.01, {10, 5}), 14 * 4, 0.02);
  EXPECT_EQ(areaInside(square, 5.1, 0.01, {10, 5}), 0);
}

TEST(OffsetArea, OfLetters) {
  int judged = 0;
  for (const Letter &letter : letters()) {
    const std::string name(1, letter.name);
    judged += judgeAll(letter.outer, {0.4, 2.3, 4.5, 9}, name);
    for (const Drawing &hole : letter.holes)
      judged += judgeAll(hole, {0.5, 1.7, 2.9}, name + "'s hole");
  }
  EXPECT_GT(judged, 50);
}

/// Between hollows that are too narrow for the tool it goes around the points.
TEST(OffsetArea, OfHollowsSideBySide) {
  int judged = 0;
  for (const double bulge : {-0.3, -0.6, -0.8})
    judged += judgeAll(scallops(17, 20, bulge), {0.6, 2.4, 4.2, 7, 15},
                       "scallops " + std::to_string(bulge));
  EXPECT_GE(judged, 20);
}

TEST(OffsetArea, OfCombs) {
  std::mt19937 random(31);
  int judged = 0;
  for (int i = 0; i < 16; ++i)
    judged += judgeAll(comb(random, 4), {0.3 + 0.11 * i, 2.6}, "comb " + std::to_string(i));
  EXPECT_GT(judged, 32);
}

/// Many objects lie within each corner: neighbours do not meet, others do.
TEST(OffsetArea, OfManyShortObjects) {
  std::mt19937 random(97);
  int judged = 0;
  for (int i = 0; i < 14; ++i) {
    const Drawing d = rough(random, 30 + 5 * (i % 9), 0.3 + 0.25 * (i % 7));
    if (crossingsIn(finely(d.path, 1e-3)) == 0)
      judged += judgeAll(d, {0.2 + 0.15 * i, 3 + 0.6 * i}, "rough " + std::to_string(i));
  }
  EXPECT_GT(judged, 14);
}

TEST(OffsetArea, OfSpirals) {
  int judged = 0;
  for (const double width : {2.0, 5.5})
    judged += judgeAll(spiral(3, 8, width), {0.7, 1.3, 3.5}, "spiral " + std::to_string(width));
  EXPECT_GT(judged, 5);
}

/// An arc of an ellipse whose main axis is along the chord, which takes the middle of its longer
/// side: `half` of its parameter to each side, bulging by `bulge` of the main axis to the left.
void ellipticSide(Drawing &d, Point to, double half, double bulge) {
  const Point from = d.here;
  const double chord = gapOf(from, to);
  const double c = (to.x - from.x) / chord;
  const double s = (to.y - from.y) / chord;
  const double a = chord / (2 * std::sin(half));
  const double down = std::fabs(bulge) * a * std::cos(half) * (bulge > 0 ? -1 : 1);
  PathObject &o =
      d.add(bulge > 0 ? MoveType::EllipseClockwise : MoveType::EllipseCounterclockwise, to);
  o.shape[0] = (from.x + to.x) / 2 - s * down;
  o.shape[1] = (from.y + to.y) / 2 + c * down;
  o.shape[2] = c;
  o.shape[3] = s;
  o.shape[4] = a;
  o.shape[5] = std::fabs(bulge) * a;
  o.shape[6] = std::atan2(s, c) * 180 / M_PI;
  o.shape[7] = std::fabs(bulge);
  const double degrees = half * 180 / M_PI;
  o.parameterRange[0] = bulge > 0 ? 90 + degrees : 270 - degrees;
  o.parameterRange[1] = bulge > 0 ? 2 * degrees : -2 * degrees;
  ObjectShape shape{};
  EXPECT_EQ(shapeOf(o, shape), ShapeError::None);
  o.length = shape.length;
}

/// A closed contour around 0 of lines, arcs of circles and ellipses, and splines.
Drawing curvedContour(unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&random](double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random);
  };
  const int corners = 4 + static_cast<int>(seed % 5);
  std::vector<Point> points;
  for (int i = 0; i < corners; ++i) {
    const double phi = 2 * M_PI * (i + uniform(-0.25, 0.25)) / corners;
    const double r = uniform(15, 35);
    points.push_back({r * std::cos(phi), r * std::sin(phi)});
  }
  const auto middle = [](const Point &a, const Point &b) {
    return Point{(a.x + b.x) / 2, (a.y + b.y) / 2};
  };
  const Point begin = middle(points[0], points[1]);
  Drawing d;
  d.here = begin;
  d.line(points[1].x, points[1].y);
  for (size_t i = 2; i <= points.size(); ++i) {
    const Point to = points[i % points.size()];
    const Point from = d.here;
    const Point way{to.x - from.x, to.y - from.y};
    const double bulge = uniform(0.2, 1) * (uniform(0, 1) < 0.5 ? 1 : -1);
    const int kind = static_cast<int>(uniform(0, 4));
    if (kind == 0)
      d.line(to.x, to.y);
    else if (kind == 1)
      ellipticSide(d, to, uniform(0.3, 1.2), bulge > 0 ? 1 : -1); // a circle
    else if (kind == 2)
      ellipticSide(d, to, uniform(0.3, 1.5), bulge);
    else
      d.spline(to, {way.x * uniform(0.3, 1.2) - way.y * bulge, way.y + way.x * bulge},
               {way.x + way.y * uniform(-0.8, 0.8), way.y - way.x * uniform(-0.8, 0.8)});
    d.path.back().length = d.path.back().length > 0 ? d.path.back().length : gapOf(from, to);
  }
  d.line(begin.x, begin.y);
  return d;
}

/// Whether the contour crosses itself, or turns back at a corner, beside which it may do so.
bool isTangled(const Drawing &d) {
  constexpr double kStep = 1e-4;
  for (size_t i = 1; i < d.path.size(); ++i) {
    const Point a = placeOfObject(d.path[i - 1], 1 - kStep);
    const Point b = placeOfObject(d.path[i], 0);
    const Point c = placeOfObject(d.path[i], kStep);
    const double ahead = (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y);
    if (ahead < -0.95 * gapOf(a, b) * gapOf(b, c))
      return true;
  }
  return crossingsIn(sampled(d.path, 60)) != 0;
}

/// Corners of ellipses and splines with each other, inside and outside.
TEST(OffsetArea, OfCurves) {
  const char *const more = std::getenv("STRIDE_PATH_CASES");
  const unsigned cases = more != nullptr ? static_cast<unsigned>(std::atoi(more)) : 10;
  int judged = 0;
  for (unsigned seed = 0; seed < cases; ++seed) {
    const Drawing d = curvedContour(seed);
    if (isTangled(d))
      continue;
    EXPECT_LT(greatestMisfit(d.path), 1e-9);
    judged += judgeAll(d, {0.7, 2.3}, "curves " + std::to_string(seed));
  }
  EXPECT_GE(judged, static_cast<int>(2 * cases));
}

} // namespace
