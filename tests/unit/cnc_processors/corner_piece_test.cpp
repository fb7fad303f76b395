// Pieces in the corners of a path, against what their parameters say.
#include "tests/unit/cnc_processors/sampled_path.hpp"

#include "runtime/numeric/cnc/processors/corner_piece.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::test;

constexpr double kDegree = M_PI / 180;

/// Two lines that meet in a corner, in any plane, with a frame that is that of X and Y.
struct LineCorner {
  LineCorner(double degrees, double lengthBefore, double lengthAfter, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    Point t{any(random), any(random), seed == 0 ? 0 : any(random)};
    t = t * (1 / sizeOf(t));
    Point side = outer(t, seed == 0 ? Point{0, 0, 1} : Point{any(random), any(random), 0.3});
    side = side * (1 / sizeOf(side));
    corner = {7 * any(random), 5 * any(random), seed == 0 ? 0.25 : any(random)};
    first = t;
    last = t * std::cos(degrees * kDegree) + side * std::sin(degrees * kDegree);
    before = line(corner - first * lengthBefore, corner);
    after = line(corner, corner + last * lengthAfter);
  }
  Point corner, first, last;
  PathObject before, after, piece{};
};

double nearest(const PathObject &piece, const Point &place) {
  double best = 1e300;
  for (int i = 0; i <= 4000; ++i)
    best = std::min(best, sizeOf(placeAt(piece, i / 4000.0) - place));
  return best;
}

/// That it leads from one to the other without a kink, and nowhere leaves the triangle.
void expectInTriangle(const LineCorner &c) {
  const Point from = endOf(c.before);
  const Point to = startOf(c.after);
  const double size = std::max(sizeOf(c.corner - from), sizeOf(to - c.corner));
  EXPECT_LT(sizeOf(placeAt(c.piece, 0) - from), 1e-12 * (10 + size));
  EXPECT_LT(sizeOf(placeAt(c.piece, 1) - to), 1e-12 * (10 + size));
  EXPECT_EQ(startOf(c.piece), from);
  EXPECT_EQ(endOf(c.piece), to);
  EXPECT_LT(sizeOf(tangentAt(c.piece, 0) - c.first), 1e-7);
  EXPECT_LT(sizeOf(tangentAt(c.piece, 1) - c.last), 1e-7);
  for (int i = 0; i <= 100; ++i) {
    const Point p = placeAt(c.piece, i / 100.0) - c.corner;
    // p = -a * first + b * last with a, b >= 0 and a / cut + b / cut <= 1
    const double cosine = inner(c.first, c.last);
    const double u = -inner(p, c.first);
    const double v = inner(p, c.last);
    const double det = 1 - cosine * cosine;
    const double a = (u + cosine * v) / det;
    const double b = (v + cosine * u) / det;
    EXPECT_GT(a, -1e-7 * size);
    EXPECT_GT(b, -1e-7 * size);
    EXPECT_LT(a / sizeOf(c.corner - from) + b / sizeOf(to - c.corner), 1 + 1e-7);
    EXPECT_LT(sizeOf(p - (c.last * b - c.first * a)), 1e-7 * size);
  }
  // The error of chords is proportional to the square of their number.
  const double length = (4 * lengthOf(c.piece, 4000) - lengthOf(c.piece, 2000)) / 3;
  EXPECT_NEAR(c.piece.length, length, 1e-10 * (1 + size));
}

CornerChange make(LineCorner &c, PieceKind kind, double distance, bool symmetrical = false) {
  BeforeCorner known{-1, false, {}};
  return makeCorner(c.before, c.after, {kind, distance, symmetrical, 0}, known, c.piece);
}

TEST(CornerPiece, CubicKeepsTheTangentAndComesAsNearAsSaid) {
  for (unsigned seed = 0; seed < 12; ++seed)
    for (const double degrees : {0.5, 3.0, 37.0, 90.0, 122.0, 165.0}) {
      LineCorner c(degrees, 10 + seed, 31, seed);
      const double distance = 0.7 + 0.3 * seed;
      ASSERT_EQ(make(c, PieceKind::Cubic, distance), CornerChange::Cut);
      EXPECT_NEAR(sizeOf(endOf(c.before) - c.corner), distance, 1e-12);
      EXPECT_NEAR(sizeOf(startOf(c.after) - c.corner), distance, 1e-12);
      expectInTriangle(c);
      const double turn = degrees * kDegree;
      const double radius = distance / std::tan(turn / 2);
      EXPECT_NEAR(nearest(c.piece, c.corner), radius * (1 / std::cos(turn / 2) - 1),
                  1e-6 * distance);
      EXPECT_EQ(c.piece.moveType, seed == 0 ? MoveType::Spline : MoveType::Spline3d);
    }
}

TEST(CornerPiece, QuinticKeepsTheCurvature) {
  // The table of the design: what the blend keeps away from the corner, over the cut.
  const double table[][2] = {{15, 0.059}, {30, 0.118},  {60, 0.240},
                             {90, 0.369}, {120, 0.525}, {150, 0.712}};
  for (unsigned seed = 0; seed < 6; ++seed)
    for (const auto &row : table) {
      LineCorner c(row[0], 12, 40, seed);
      const double distance = 0.4 + seed;
      ASSERT_EQ(make(c, PieceKind::Quintic, distance), CornerChange::Cut);
      expectInTriangle(c);
      EXPECT_NEAR(nearest(c.piece, c.corner) / distance, row[1], 4e-3); // the table has two digits
      EXPECT_LT(sizeOf(curvatureAt(c.piece, 2e-4, 1e-4)) * distance, 0.02);
      EXPECT_LT(sizeOf(curvatureAt(c.piece, 1 - 2e-4, 1e-4)) * distance, 0.02);
    }
}

TEST(CornerPiece, ShortNeighboursAreCutByHalf) {
  for (const PieceKind kind : {PieceKind::Cubic, PieceKind::Quintic})
    for (unsigned seed = 0; seed < 5; ++seed) {
      LineCorner c(70, 1.5, 20, seed);
      ASSERT_EQ(make(c, kind, 2), CornerChange::Cut);
      EXPECT_NEAR(sizeOf(endOf(c.before) - c.corner), 0.75, 1e-12);
      EXPECT_NEAR(sizeOf(startOf(c.after) - c.corner), 2, 1e-12);
      expectInTriangle(c);
      if (kind == PieceKind::Quintic) {
        EXPECT_LT(sizeOf(curvatureAt(c.piece, 2e-4, 1e-4)), 0.02);
        EXPECT_LT(sizeOf(curvatureAt(c.piece, 1 - 2e-4, 1e-4)), 0.02);
      }
      LineCorner same(70, 1.5, 20, seed);
      ASSERT_EQ(make(same, kind, 2, true), CornerChange::Cut);
      EXPECT_NEAR(sizeOf(startOf(same.after) - same.corner), 0.75, 1e-12);
      expectInTriangle(same);
    }
}

TEST(CornerPiece, ArcTouchesBothLines) {
  for (unsigned seed = 0; seed < 12; ++seed)
    for (const double degrees : {1e-4, 0.5, 37.0, 90.0, -122.0, 165.0}) {
      LineCorner c(degrees, 10, 3, seed);
      const double asked = 0.3 * (seed + 1);
      ASSERT_EQ(make(c, PieceKind::Arc, asked), CornerChange::Cut);
      const double cut = std::min(asked, 1.5);
      EXPECT_NEAR(sizeOf(endOf(c.before) - c.corner), cut, 1e-12);
      EXPECT_NEAR(sizeOf(startOf(c.after) - c.corner), cut, 1e-12);
      const double inside = M_PI - std::abs(degrees) * kDegree;
      const double radius = cut * std::tan(inside / 2);
      EXPECT_NEAR(c.piece.shape[2] / radius, 1, 1e-9);
      EXPECT_NEAR(c.piece.length / (radius * std::abs(degrees) * kDegree), 1, 1e-9);
      EXPECT_LT(sizeOf(placeAt(c.piece, 0) - endOf(c.before)), 1e-13 * radius + 1e-12);
      EXPECT_LT(sizeOf(placeAt(c.piece, 1) - startOf(c.after)), 1e-13 * radius + 1e-12);
      if (degrees == 1e-4)
        continue; // differences lose too many digits
      EXPECT_LT(sizeOf(tangentAt(c.piece, 0) - c.first), 1e-6);
      EXPECT_LT(sizeOf(tangentAt(c.piece, 1) - c.last), 1e-6);
      EXPECT_NEAR(sizeOf(curvatureAt(c.piece, 0.5, 0.1)) * radius, 1, 1e-6);
    }
}

TEST(CornerPiece, ArcsAreInTheirOwnPlane) {
  LineCorner left(50, 5, 5, 0);
  ASSERT_EQ(make(left, PieceKind::Arc, 1), CornerChange::Cut);
  EXPECT_EQ(left.piece.moveType, MoveType::Clockwise);
  LineCorner right(-50, 5, 5, 0);
  ASSERT_EQ(make(right, PieceKind::Arc, 1), CornerChange::Cut);
  EXPECT_EQ(right.piece.moveType, MoveType::Counterclockwise);
  EXPECT_EQ(right.piece.normal.z, 1);
  EXPECT_EQ(right.piece.shape[3], 0.25);
}

/// An arc and a line, or two arcs, whose corner is at `corner`.
void expectJoined(const PathObject &before, const PathObject &after, const PathObject &piece,
                  bool curvatureToo) {
  EXPECT_LT(sizeOf(placeAt(piece, 0) - placeAt(before, 1)), 1e-9);
  EXPECT_LT(sizeOf(placeAt(piece, 1) - placeAt(after, 0)), 1e-9);
  EXPECT_LT(sizeOf(tangentAt(piece, 0) - tangentAt(before, 1)), 1e-6);
  EXPECT_LT(sizeOf(tangentAt(piece, 1) - tangentAt(after, 0)), 1e-6);
  if (!curvatureToo)
    return;
  EXPECT_LT(sizeOf(curvatureAt(piece, 2e-4, 1e-4) - curvatureAt(before, 0.999)), 0.04);
  EXPECT_LT(sizeOf(curvatureAt(piece, 1 - 2e-4, 1e-4) - curvatureAt(after, 0.001)), 0.04);
}

TEST(CornerPiece, CurvesAreCutByACircleAroundTheCorner) {
  for (const PieceKind kind : {PieceKind::Cubic, PieceKind::Quintic})
    for (const double distance : {0.3, 1.0, 2.5}) {
      PathObject before = arc({0, 0, 1}, 4, -130, 110);
      const Point corner = endOf(before);
      PathObject after = arc(corner + Point{-7, 0, 0}, 7, 0, -95);
      PathObject piece{};
      BeforeCorner known{-1, false, {}};
      ASSERT_EQ(makeCorner(before, after, {kind, distance, false, 0}, known, piece),
                CornerChange::Cut);
      EXPECT_NEAR(sizeOf(endOf(before) - corner), distance, 1e-10);
      EXPECT_NEAR(sizeOf(startOf(after) - corner), distance, 1e-10);
      EXPECT_NEAR(known.room, 7 * 95 * kDegree / 2, 1e-9);
      expectJoined(before, after, piece, kind == PieceKind::Quintic);
      for (int i = 0; i <= 100; ++i)
        EXPECT_LT(sizeOf(placeAt(piece, i / 100.0) - corner), distance * (1 + 1e-9));
    }
}

TEST(CornerPiece, ArcsOnlyBetweenLines) {
  PathObject before = line({0, 0, 0}, {5, 0, 0});
  PathObject after = arc({5, 3, 0}, 3, 180, 60);
  after.start.coordinate[0] = 5;
  after = arc({8, 0, 0}, 3, 180, -60);
  PathObject piece{};
  BeforeCorner known{-1, false, {}};
  EXPECT_EQ(makeCorner(before, after, {PieceKind::Arc, 1, false, 0}, known, piece),
            CornerChange::Kept);
  EXPECT_EQ(endOf(before)[0], 5);
  EXPECT_EQ(known.room, -1);
}

TEST(CornerPiece, WhatCannotBeCutStays) {
  const auto kept = [](PathObject before, PathObject after, const PieceRules &rules) {
    PathObject piece{};
    BeforeCorner known{-1, false, {}};
    return makeCorner(before, after, rules, known, piece) == CornerChange::Kept;
  };
  const PathObject a = line({0, 0, 0}, {5, 0, 0});
  const PathObject b = line({5, 0, 0}, {5, 8, 0});
  const PieceRules rules{PieceKind::Cubic, 1, false, 0};
  EXPECT_FALSE(kept(a, b, rules));
  EXPECT_TRUE(kept(a, b, {PieceKind::Cubic, 0, false, 0}));
  EXPECT_TRUE(kept(a, b, {PieceKind::Cubic, -1, false, 0}));
  EXPECT_FALSE(kept(a, b, {PieceKind::Cubic, 1, false, 89.9 * kDegree}));
  EXPECT_TRUE(kept(a, b, {PieceKind::Cubic, 1, false, 90.1 * kDegree}));
  EXPECT_TRUE(kept(a, line({5, 0, 0}, {9, 0, 0}), rules));    // no corner
  EXPECT_TRUE(kept(a, line({5, 0, 0}, {0, 1e-3, 0}), rules)); // back again
  EXPECT_TRUE(kept(a, line({5, 1e-3, 0}, {5, 8, 0}), rules)); // they do not meet
  EXPECT_TRUE(kept(a, line({5, 0, 0}, {5, 0, 0}), rules));    // no way
  EXPECT_TRUE(kept(a, object(MoveType::Positioning, {5, 0, 0}, {5, 8, 0}), rules));
  PathObject probing = b;
  probing.probe = 1;
  EXPECT_TRUE(kept(a, probing, rules));
  PathObject profiled = b;
  profiled.start.axes = profiled.end.axes = 7 | 1 << kAxisP;
  profiled.start.sProfile = 1 << kAxisP;
  profiled.end.coordinate[kAxisP] = 4;
  EXPECT_TRUE(kept(a, profiled, rules));
  PathObject broken = b;
  broken.end.coordinate[1] = std::nan("");
  EXPECT_TRUE(kept(a, broken, rules));
}

TEST(CornerPiece, SlopesGoOnThroughThePiece) {
  PathObject before = line({0, 0, 0}, {5, 0, 0});
  PathObject after = line({5, 0, 0}, {5, 8, 0});
  before.start.axes = before.end.axes = after.start.axes = after.end.axes = 7 | 1 << kAxisB;
  before.end.coordinate[kAxisB] = after.start.coordinate[kAxisB] = 10;
  after.end.coordinate[kAxisB] = 26; // evenly, with a slope of 2
  before.slopes = 2;
  before.startSlope[1] = 0;
  before.endSlope[1] = 2;
  // 10 * u^2 * (3 - 2 u) + 5 * 2 * u^2 * (u - 1), u = 0.6 where 2 of 5 are cut off
  PathObject piece{};
  BeforeCorner known{-1, false, {}};
  ASSERT_EQ(makeCorner(before, after, {PieceKind::Quintic, 2, false, 0}, known, piece),
            CornerChange::Cut);
  EXPECT_NEAR(before.end.coordinate[kAxisB], 10 * 0.36 * 1.8 - 10 * 0.36 * 0.4, 1e-12);
  EXPECT_EQ(piece.start.coordinate[kAxisB], before.end.coordinate[kAxisB]);
  EXPECT_NEAR(piece.end.coordinate[kAxisB], 14, 1e-12);
  EXPECT_EQ(piece.slopes, 2);
  const auto whole = [](double u) { return 10 * u * u * (3 - 2 * u) + 10 * u * u * (u - 1); };
  EXPECT_NEAR(before.endSlope[1], (whole(0.6 + 1e-6) - whole(0.6 - 1e-6)) / 1e-5, 1e-8);
  EXPECT_EQ(piece.startSlope[1], before.endSlope[1]);
  EXPECT_NEAR(piece.endSlope[1], 2, 1e-12);
  EXPECT_EQ(after.slopes, 0);
}

TEST(CornerPiece, OtherAxesGoAlong) {
  PathObject before = line({0, 0, 0}, {5, 0, 0});
  PathObject after = line({5, 0, 0}, {5, 8, 0});
  before.start.axes = before.end.axes = 7 | 1 << kAxisP;
  after.start.axes = after.end.axes = 7 | 1 << kAxisQ;
  before.end.coordinate[kAxisP] = after.start.coordinate[kAxisP] = after.end.coordinate[kAxisP] =
      10;
  after.end.coordinate[kAxisQ] = 4;
  after.velocity = 12;
  before.acceleration = 70;
  after.limits[0].velocity = 3;
  before.sentence = 40;
  PathObject piece{};
  BeforeCorner known{-1, false, {}};
  ASSERT_EQ(makeCorner(before, after, {PieceKind::Cubic, 2, false, 0}, known, piece),
            CornerChange::Cut);
  EXPECT_DOUBLE_EQ(before.end.coordinate[kAxisP], 6);
  EXPECT_DOUBLE_EQ(piece.start.coordinate[kAxisP], 6);
  EXPECT_DOUBLE_EQ(piece.end.coordinate[kAxisP], 10);
  EXPECT_DOUBLE_EQ(piece.end.coordinate[kAxisQ], 1);
  EXPECT_DOUBLE_EQ(after.start.coordinate[kAxisQ], 1);
  EXPECT_EQ(piece.start.axes, 7 | 1 << kAxisP | 1 << kAxisQ);
  EXPECT_EQ(piece.velocity, 12);
  EXPECT_EQ(piece.velocityEnd, 12);
  EXPECT_EQ(before.velocityEnd, 12);
  EXPECT_EQ(piece.acceleration, 70);
  EXPECT_EQ(piece.limits[0].velocity, 3);
  EXPECT_EQ(piece.sentence, 40);
}

TEST(CornerPiece, WhatLeavesThePlaneGoesAlongEvenly) {
  for (const PieceKind kind : {PieceKind::Cubic, PieceKind::Quintic, PieceKind::Arc}) {
    PathObject before = line({0, 0, 10}, {5, 0, 0});
    PathObject after = line({5, 0, 0}, {5, 8, 4});
    before.planar = after.planar = 1;
    before.length = 5;
    after.length = 8;
    PathObject piece{};
    BeforeCorner known{-1, false, {}};
    ASSERT_EQ(makeCorner(before, after, {kind, 2, false, 0}, known, piece), CornerChange::Cut);
    EXPECT_NEAR(endOf(before)[0], 3, 1e-12);
    EXPECT_NEAR(endOf(before)[2], 4, 1e-12);
    EXPECT_NEAR(startOf(after)[1], 2, 1e-12);
    EXPECT_NEAR(startOf(after)[2], 1, 1e-12);
    EXPECT_EQ(piece.planar, 1);
    const Point half = placeAt(piece, 0.5);
    EXPECT_NEAR(half[0] + half[1], 5, 1e-9); // by symmetry
  }
}

TEST(CornerPiece, NothingIsLeftOfAnObjectWhoseHalvesAreCut) {
  PathObject a = line({0, 0, 0}, {4, 0, 0});
  PathObject b = line({4, 0, 0}, {4, 3, 0});
  PathObject c = line({4, 3, 0}, {0, 3, 0});
  b.switchId[0] = 7;
  b.switchPosition[0] = 0.75;
  b.marks = kEndToolCorrection;
  PathObject first{};
  PathObject second{};
  BeforeCorner known{-1, false, {}};
  const PieceRules rules{PieceKind::Arc, 5, false, 0};
  ASSERT_EQ(makeCorner(a, b, rules, known, first), CornerChange::Cut);
  EXPECT_EQ(known.room, 1.5);
  EXPECT_EQ(startOf(b)[1], 1.5);
  ASSERT_EQ(makeCorner(b, c, rules, known, second), CornerChange::Replaced);
  EXPECT_EQ(startOf(second), (Point{4, 1.5, 0}));
  EXPECT_EQ(endOf(second), startOf(c));
  EXPECT_NEAR(second.shape[2], 1.5, 1e-12);
  EXPECT_NEAR(second.shape[0], 2.5, 1e-12);
  EXPECT_EQ(second.switchId[0], 7);
  EXPECT_NEAR(second.switchPosition[0], 0.75 / second.length, 1e-12);
  EXPECT_EQ(second.marks, kEndToolCorrection);
}

TEST(CornerPiece, SwitchPointsStayOrGoOntoThePiece) {
  PathObject before = line({0, 0, 0}, {10, 0, 0});
  PathObject after = line({10, 0, 0}, {10, 20, 0});
  const double at[] = {0.5, 0.85, 0.99};
  for (int i = 0; i < 3; ++i) {
    before.switchId[i] = static_cast<int16_t>(i + 1);
    before.switchPosition[i] = at[i];
  }
  after.switchId[0] = -1;
  after.switchPosition[0] = 0.06; // 1.2 from the corner
  after.switchId[1] = -2;
  after.switchPosition[1] = 0.6;
  PathObject piece{};
  BeforeCorner known{-1, false, {}};
  ASSERT_EQ(makeCorner(before, after, {PieceKind::Arc, 2, false, 0}, known, piece),
            CornerChange::Cut);
  EXPECT_EQ(before.switchId[0], 1);
  EXPECT_NEAR(before.switchPosition[0] * 8, 5, 1e-12);
  EXPECT_EQ(before.switchId[1], 0);
  EXPECT_EQ(piece.switchId[0], 2);
  EXPECT_NEAR(piece.switchPosition[0] * M_PI, 0.5, 1e-9);
  EXPECT_EQ(piece.switchId[1], 3);
  EXPECT_EQ(piece.switchPosition[1], 0.5); // it does not cross the middle
  EXPECT_EQ(piece.switchId[2], -1);
  EXPECT_NEAR((1 - piece.switchPosition[2]) * M_PI, 0.8, 1e-9);
  EXPECT_EQ(after.switchId[0], -2);
  EXPECT_NEAR(after.switchPosition[0] * 18, 10, 1e-9);
}

TEST(CornerPiece, NoSwitchPointIsLost) {
  PathObject before = line({0, 0, 0}, {10, 0, 0});
  PathObject after = line({10, 0, 0}, {10, 20, 0});
  for (int i = 0; i < 3; ++i) {
    before.switchId[i] = static_cast<int16_t>(i + 1);
    before.switchPosition[i] = 0.9;
    after.switchId[i] = static_cast<int16_t>(i + 4);
    after.switchPosition[i] = 0.01;
  }
  PathObject piece{};
  BeforeCorner known{-1, false, {}};
  ASSERT_EQ(makeCorner(before, after, {PieceKind::Cubic, 2, false, 0}, known, piece),
            CornerChange::Cut);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(before.switchId[i], 0);
    EXPECT_EQ(piece.switchId[i], i + 1);
    EXPECT_EQ(after.switchId[i], i + 4);
    EXPECT_EQ(after.switchPosition[i], 0);
  }
}

} // namespace
