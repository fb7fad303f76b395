// Pieces of a path: the manual's example, shapes of corners by closed forms, and every refusal.
#include "runtime/numeric/csy/trajectory.hpp"

#include "path_words.hpp"

#include <cmath>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

namespace {

using namespace stride::csy;
using stride::test::PathPoint;
using stride::test::pathWords;

constexpr double kPi = 3.14159265358979323846;

struct Path {
  std::unique_ptr<TrajectoryTable> table = std::make_unique<TrajectoryTable>();
  std::unique_ptr<Trajectory> trajectory = std::make_unique<Trajectory>();
  Problem problem;
};

Path pathOf(const std::vector<PathPoint> &points, int axes = 2) {
  Path path;
  const std::vector<int16_t> words = pathWords(points, axes);
  path.problem =
      readTable(words.data(), static_cast<uint32_t>(words.size()), kMostPoints, *path.table);
  if (path.problem.error == PathError::None)
    path.problem = computeTrajectory(*path.table, *path.trajectory);
  return path;
}

PathPoint line(float x, float y) { return {.x = x, .y = y}; }

PathPoint blend(float x, float y, int16_t type, float first, float second = 0.0F) {
  return {.x = x, .y = y, .type = type, .parF1 = first, .parF2 = second};
}

/// Table 4.2 of the manual, with the lengths of the blends that its numbers follow from.
Path manualsPath() {
  return pathOf({line(0, 0), blend(2000, 4000, 10, 1000), line(3500, 4000),
                 blend(4000, 3000, 10, 500), line(3000, 2000), blend(2000, 2000, 1, 1000, 999),
                 line(0, 0)});
}

TEST(CsyTrajectory, HasThePositionsOfTheManual) {
  const Path path = manualsPath();
  ASSERT_EQ(path.problem.error, PathError::None);
  const Trajectory &trajectory = *path.trajectory;
  // The manual's numbers are REAL. It prints 5263.540 for P2, which its next number contradicts.
  const double lines[] = {0, 3472.136, 5763.540, 6381.574, 8162.267, 8162.267, 11990.695};
  const double blends[] = {0, 5263.540, 5763.540, 7248.053, 8162.267, 10161.267, 11990.695};
  for (size_t i = 0; i < 7; ++i) {
    EXPECT_NEAR(trajectory.endOfLine[i], lines[i], 0.002) << i;
    EXPECT_NEAR(trajectory.endOfBlend[i], blends[i], 0.002) << i;
  }
  const double turn = std::atan2(4000.0, 2000.0);
  const double radius = 1000 / std::tan(turn / 2);
  EXPECT_NEAR(trajectory.endOfBlend[1] - trajectory.endOfLine[1], radius * turn, 1e-9);
  EXPECT_NEAR(trajectory.length, 11990.69411, 5e-6);
  // A line without length has no points of its own.
  EXPECT_EQ(trajectory.camPoints, 1U + 1 + 15 + 1 + 1 + 15 + 1 + 15 + 1);
}

TEST(CsyTrajectory, MakesACircleOfASquaresCorners) {
  const float side = 30;
  const Path path = pathOf({line(15, 0), blend(30, 0, 10, 15), blend(30, 30, 10, 15),
                            blend(0, 30, 10, 15), blend(0, 0, 10, 15), line(15, 0)});
  ASSERT_EQ(path.problem.error, PathError::None);
  EXPECT_NEAR(path.trajectory->length, kPi * side, 1e-9);
  for (double s = 0; s <= path.trajectory->length; s += 0.37) {
    const Vector3 place = positionAt(*path.trajectory, s);
    EXPECT_NEAR(std::hypot(place.x - 15, place.y - 15), 15, 1e-9);
  }
}

struct Middle {
  Vector3 place;
  double distance; ///< to the corner
};

Middle middleOfCorner(int16_t type, int16_t form) {
  PathPoint corner = blend(0, 0, type, 1, 1);
  corner.parW3 = form;
  const Path path = pathOf({line(-3, 0), corner, line(0, 3)});
  EXPECT_EQ(path.problem.error, PathError::None);
  const Vector3 place = positionAt(*path.trajectory, 3);
  return {place, std::hypot(place.x, place.y)};
}

TEST(CsyTrajectory, BlendsByHermitePolynomials) {
  const Middle cubic = middleOfCorner(1, 100);
  EXPECT_NEAR(cubic.place.x, -0.25, 1e-12);
  EXPECT_NEAR(cubic.place.y, 0.25, 1e-12);
  const Middle quintic = middleOfCorner(2, 100);
  EXPECT_NEAR(quintic.place.x, -0.1875, 1e-12);
  EXPECT_NEAR(quintic.place.y, 0.1875, 1e-12);
  EXPECT_NEAR(middleOfCorner(1, 50).distance, 0.530330, 1e-6);
  EXPECT_NEAR(middleOfCorner(1, 200).distance, 0.0, 1e-12);
  EXPECT_NEAR(middleOfCorner(1, 0).distance, cubic.distance, 0.0); // not given: 100
  EXPECT_NEAR(middleOfCorner(1, 49).distance, middleOfCorner(1, 50).distance, 0.0);
  EXPECT_NEAR(middleOfCorner(1, 201).distance, middleOfCorner(1, 200).distance, 0.0);
  EXPECT_GT(middleOfCorner(1, 51).distance, 0.52);
}

TEST(CsyTrajectory, ShortensBlends) {
  const auto ends = [](const PathPoint &corner) {
    const Path path = pathOf({line(-3, 0), corner, line(0, 4)});
    EXPECT_EQ(path.problem.error, PathError::None);
    return std::pair{path.trajectory->endOfLine[1],
                     path.trajectory->endOfBlend[1] - path.trajectory->endOfLine[1]};
  };
  // The line before has 3, the one after 4; then the ratios 2 and 1/0.66.
  EXPECT_EQ(ends(blend(0, 0, 1, 2, 1)), (std::pair{1.0, 3.0}));
  EXPECT_EQ(ends(blend(0, 0, 1, 2.5F, 1)), (std::pair{1.0, 3.0}));
  EXPECT_EQ(ends(blend(0, 0, 1, 1, 2.5F)), (std::pair{2.0, 3.0}));
  EXPECT_EQ(ends(blend(0, 0, 1, 9, 9)), (std::pair{0.0, 7.0}));
  const auto [line2, blend2] = ends(blend(0, 0, 2, 3, 1));
  EXPECT_NEAR(line2, 3 - 1 / 0.66, 1e-12);
  EXPECT_NEAR(blend2, 1 + 1 / 0.66, 1e-12);
  EXPECT_EQ(ends(blend(0, 0, 10, 9)).first, 0.0);
}

TEST(CsyTrajectory, LeavesWhatTheBlendBeforeHasTaken) {
  const Path path =
      pathOf({line(0, 0), blend(10, 0, 1, 4, 7), blend(10, 10, 1, 6, 5), line(0, 10)});
  ASSERT_EQ(path.problem.error, PathError::None);
  // 7 of 10 are taken: 3 are left, and no straight part between both blends.
  EXPECT_EQ(path.trajectory->endOfBlend[1], 6.0 + 11);
  EXPECT_EQ(path.trajectory->endOfLine[2], 17.0);
  EXPECT_EQ(path.trajectory->endOfBlend[2], 17.0 + 3 + 5);
  EXPECT_EQ(pathOf({line(0, 0), blend(10, 0, 1, 6, 10), blend(10, 10, 1, 6, 5), line(0, 10)})
                .problem.error,
            PathError::BlendTooLong);
}

TEST(CsyTrajectory, GoesAroundACornerTheLongWay) {
  PathPoint corner = blend(10, 0, 10, 2);
  corner.parW4 = 1;
  const Path path = pathOf({line(0, 0), corner, line(10, 10)});
  ASSERT_EQ(path.problem.error, PathError::None);
  EXPECT_NEAR(path.trajectory->length, 8 + 2 * 1.5 * kPi + 8, 1e-9);
  const Vector3 place = positionAt(*path.trajectory, 8 + 2 * 0.75 * kPi);
  EXPECT_NEAR(place.x, 8 - std::sqrt(2), 1e-9); // beyond the centre (8, 2)
  EXPECT_NEAR(place.y, 2 + std::sqrt(2), 1e-9);
}

PathPoint arc(float x, float y, int16_t type, float first, float second, bool clockwise) {
  PathPoint point = blend(x, y, type, first, second);
  point.parW1 = 20;
  point.parW4 = clockwise ? 1 : 0;
  return point;
}

TEST(CsyTrajectory, MakesArcs) {
  // A quarter by its radius: counter-clockwise the centre is on the left.
  Path path = pathOf({line(0, 0), arc(3, 3, 11, 3, 0, false)});
  ASSERT_EQ(path.problem.error, PathError::None);
  EXPECT_NEAR(path.trajectory->length, 1.5 * kPi, 1e-9);
  EXPECT_NEAR(positionAt(*path.trajectory, 0.75 * kPi).x, 3 * std::sqrt(0.5), 1e-9);
  path = pathOf({line(0, 0), arc(3, 3, 11, 3, 0, true)});
  EXPECT_NEAR(positionAt(*path.trajectory, 0.75 * kPi).x, 3 - 3 * std::sqrt(0.5), 1e-9);
  // Half a circle exactly.
  EXPECT_NEAR(pathOf({line(0, 0), arc(6, 0, 11, 3, 0, true)}).trajectory->length, 3 * kPi, 1e-9);
  // By the centre: a quarter, three quarters, all.
  EXPECT_NEAR(pathOf({line(2, 0), arc(0, 2, 12, 0, 0, false)}).trajectory->length, kPi, 1e-9);
  EXPECT_NEAR(pathOf({line(2, 0), arc(0, 2, 12, 0, 0, true)}).trajectory->length, 3 * kPi, 1e-9);
  path = pathOf({line(2, 0), arc(2, 0, 12, 0, 0, true)});
  EXPECT_NEAR(path.trajectory->length, 4 * kPi, 1e-9);
  EXPECT_NEAR(positionAt(*path.trajectory, kPi).y, -2, 1e-9);
}

TEST(CsyTrajectory, MovesACentreThatIsALittleOff) {
  const auto at = [](float x, float y) {
    return pathOf({line(2, 0), arc(-2, 0, 12, x, y, false)});
  };
  // Exact centres are on x = 0.
  EXPECT_NEAR(at(0.9F, 0).trajectory->length, 2 * kPi, 1e-9);
  EXPECT_EQ(at(0.99F, 0).problem.error, PathError::None);
  EXPECT_EQ(at(1.01F, 0).problem.error, PathError::CentreOff);
}

TEST(CsyTrajectory, HoldsTheAngleOfATool) {
  PathPoint start{.x = 0, .y = 0, .z = 5, .type = 100};
  PathPoint first{.x = 10, .y = 0, .z = 30};
  PathPoint second{.x = 10, .y = 20, .z = 90};
  first.parW1 = 4;
  Path path = pathOf({start, first, second}, 3);
  ASSERT_EQ(path.problem.error, PathError::None);
  EXPECT_EQ(path.trajectory->length, 30.0); // the angle is no way
  EXPECT_EQ(positionAt(*path.trajectory, 0).z, 30.0);
  EXPECT_EQ(positionAt(*path.trajectory, 10).z, 30.0);
  EXPECT_EQ(positionAt(*path.trajectory, 10.001).z, 90.0);
  start.type = 101;
  path = pathOf({start, first, second}, 3);
  EXPECT_EQ(positionAt(*path.trajectory, 20).z, 270.0);
  start.type = 0;
  path = pathOf({start, first, second}, 3);
  EXPECT_NEAR(path.trajectory->length, std::hypot(10, 25) + std::hypot(20, 60), 1e-9);
}

TEST(CsyTrajectory, FillsCamsWithTheEndsOfAllPieces) {
  const Path path = manualsPath();
  std::vector<double> master(path.trajectory->camPoints);
  std::vector<Vector3> slaves(path.trajectory->camPoints);
  fillCams(*path.trajectory, master.data(), slaves.data());
  EXPECT_EQ(master.front(), 0.0);
  EXPECT_EQ(master[1], path.trajectory->endOfLine[1]);
  EXPECT_NEAR(master[16], path.trajectory->endOfBlend[1], 1e-9);
  EXPECT_EQ(master.back(), path.trajectory->length);
  for (size_t i = 1; i < master.size(); ++i) {
    EXPECT_GT(master[i], master[i - 1]);
    const Vector3 place = positionAt(*path.trajectory, master[i]);
    EXPECT_NEAR(slaves[i].x, place.x, 1e-9);
    EXPECT_NEAR(slaves[i].y, place.y, 1e-9);
  }
}

std::vector<CamPoint> loopOf(const Trajectory &trajectory) {
  std::vector<CamPoint> points(loopPoints(trajectory));
  CamCursor cursor{};
  for (CamPoint &point : points)
    point = nextCamPoint(trajectory, cursor);
  return points;
}

TEST(CsyTrajectory, LeadsTheSlavesOfAnOpenPathBack) {
  const Path path = pathOf({line(1, 2), line(4, 6)});
  const std::vector<CamPoint> points = loopOf(*path.trajectory);
  ASSERT_EQ(points.size(), 2U + kSpareCamPoints);
  EXPECT_EQ(points[1].master, 5.0);
  EXPECT_EQ(points[1].slave.x, 4.0);
  for (int i = 1; i <= 5; ++i) {
    EXPECT_NEAR(points[static_cast<size_t>(1 + i)].master, 5.0 + i, 1e-12);
    EXPECT_NEAR(points[static_cast<size_t>(1 + i)].slave.x, 4.0 - 0.6 * i, 1e-12);
    EXPECT_NEAR(points[static_cast<size_t>(1 + i)].slave.y, 6.0 - 0.8 * i, 1e-12);
  }
  EXPECT_EQ(points.back().slave.x, points.front().slave.x);
  EXPECT_EQ(points.back().slave.y, points.front().slave.y);
}

TEST(CsyTrajectory, ClosesACamWhereThePathCloses) {
  const Path path = manualsPath();
  const std::vector<CamPoint> points = loopOf(*path.trajectory);
  ASSERT_EQ(points.size(), path.trajectory->camPoints);
  EXPECT_EQ(points.back().master, path.trajectory->length);
  EXPECT_EQ(points.back().slave.x, points.front().slave.x);
  EXPECT_EQ(points.back().slave.y, points.front().slave.y);
  // A tool that ends with another angle does not close it.
  PathPoint start{.type = 100};
  PathPoint there{.x = 10, .z = 30};
  PathPoint back{.x = 0, .z = 210};
  const Path withTool = pathOf({start, there, back}, 3);
  EXPECT_FALSE(isClosed(*withTool.trajectory));
  const std::vector<CamPoint> tool = loopOf(*withTool.trajectory);
  EXPECT_EQ(tool.size(), 3U + kSpareCamPoints);
  EXPECT_EQ(tool.back().master, 20.0 + 180.0);
  EXPECT_EQ(tool.back().slave.z, 30.0);
}

struct Refusal {
  const char *name;
  PathError error;
  uint32_t point;
  std::vector<PathPoint> points;
  int axes = 2;
};

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

PathPoint with(PathPoint point, int16_t parW1, int16_t parW2) {
  point.parW1 = parW1;
  point.parW2 = parW2;
  return point;
}

std::vector<Refusal> refusals() {
  const PathPoint origin = line(0, 0);
  const PathPoint end = line(5, 7);
  return {
      {"cubic's first length", PathError::BlendLength, 1, {origin, blend(5, 0, 1, 0, 1), end}},
      {"cubic's second length", PathError::BlendLength, 1, {origin, blend(5, 0, 1, 1, 0), end}},
      {"quintic's length", PathError::BlendLength, 1, {origin, blend(5, 0, 2, -1, 1), end}},
      {"arc's length", PathError::BlendLength, 1, {origin, blend(5, 0, 10, kNan), end}},
      {"equal points", PathError::EqualPoints, 2, {origin, end, end}},
      {"equal points before a blend",
       PathError::EqualPoints,
       1,
       {origin, blend(0, 0, 1, 1, 1), end}},
      {"not a number", PathError::EqualPoints, 1, {origin, line(kNan, 1), end}},
      {"blend by an arc in space",
       PathError::ArcWithThreeAxes,
       1,
       {origin, blend(5, 0, 10, 1), end},
       3},
      {"arc in space", PathError::ArcWithThreeAxes, 1, {origin, arc(3, 3, 11, 3, 0, false)}, 3},
      {"turning back", PathError::ArcOfHalfTurn, 1, {origin, blend(5, 0, 10, 1), line(1, 0)}},
      {"straight on", PathError::ArcOfNoTurn, 1, {origin, blend(5, 0, 10, 1), line(9, 0)}},
      {"radius too small", PathError::RadiusTooSmall, 1, {origin, arc(6, 0, 11, 2.999F, 0, true)}},
      {"radius is no number", PathError::RadiusTooSmall, 1, {origin, arc(6, 0, 11, kNan, 0, true)}},
      {"no way for an arc", PathError::NoCircle, 1, {origin, arc(0, 0, 11, 3, 0, true)}},
      {"no circle", PathError::NoCircle, 1, {origin, arc(0, 0, 12, 0, 0, true)}},
      {"radius 0", PathError::RadiusZero, 1, {origin, arc(3, 3, 11, 0, 0, true)}},
      {"blend at the end", PathError::BlendTooLong, 2, {origin, end, blend(9, 0, 1, 1, 1)}},
      {"blend before an arc",
       PathError::BlendTooLong,
       1,
       {origin, blend(5, 0, 2, 1, 1), arc(9, 3, 11, 9, 0, true)}},
      {"blend before nothing",
       PathError::NextSegmentZero,
       1,
       {origin, blend(5, 0, 1, 1, 1), line(5, 0), end}},
      {"no points of a line", PathError::NoLinePoints, 1, {origin, with(line(3, 4), 0, 15)}},
      {"no points before a blend",
       PathError::NoLinePoints,
       1,
       {origin, with(blend(5, 0, 2, 1, 1), 0, 15), end}},
      {"no points of a cubic",
       PathError::NoCubicPoints,
       1,
       {origin, with(blend(5, 0, 1, 1, 1), 1, 0), end}},
      {"no points of a quintic",
       PathError::NoQuinticPoints,
       1,
       {origin, with(blend(5, 0, 2, 1, 1), 1, -3), end}},
      {"no points of a blend's arc",
       PathError::NoBlendArcPoints,
       1,
       {origin, with(blend(5, 0, 10, 1), 1, 0), end}},
      {"no points of an arc",
       PathError::NoArcPoints,
       1,
       {origin, with(arc(3, 3, 11, 3, 0, true), 0, 0)}},
      {"too many points",
       PathError::TooManyCamPoints,
       2,
       {origin, with(line(3, 4), 4994, 0), with(line(9, 4), 2, 0)}},
      {"unknown type", PathError::UnknownType, 1, {origin, blend(3, 4, 3, 1, 1), end}},
      {"a tool later on", PathError::UnknownType, 1, {origin, blend(3, 4, 100, 1, 1)}, 3},
      {"one point", PathError::NoPoints, 0, {origin}},
  };
}

TEST(CsyTrajectory, RefusesWithTheManualsCode) {
  for (const Refusal &each : refusals()) {
    const Path path = pathOf(each.points, each.axes);
    EXPECT_EQ(path.problem.error, each.error) << each.name;
    EXPECT_EQ(path.problem.point, each.point) << each.name;
  }
  EXPECT_EQ(pathOf({line(0, 0), with(line(3, 4), 4994, 0), with(line(9, 4), 1, 0)}).problem.error,
            PathError::None);
}

} // namespace
