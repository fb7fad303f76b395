// Corner blends: what meets at their ends, how far they leave the corner, and that no other
// polynomial of their kind bends less.
#include "runtime/numeric/path/blend.hpp"

#include "motion_problems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace {

using namespace stride::path;
using stride::test::casesOf;
using stride::test::Random;

double sizeOf(const Vector3 &v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

/// Lines that meet in the origin, one at its cut before and the other at its cut after.
struct Corner {
  Derivatives before{}, after{};

  Corner(double turn, double cutBefore, double cutAfter) {
    before.d1 = {1, 0, 0};
    after.d1 = {std::cos(turn), std::sin(turn) * 0.6, std::sin(turn) * 0.8};
    before.p = before.d1 * -cutBefore;
    after.p = after.d1 * cutAfter;
  }
};

double greatestCurvature(const Shape &shape, int samples = 400) {
  double most = 0;
  for (int i = 0; i <= samples; ++i)
    most = std::max(most, sizeOf(overLength(overParameter(shape, i / double(samples))).d2));
  return most;
}

TEST(PathBlend, HasTangentAndCurvatureOfBothNeighbours) {
  for (int i = 0; i < casesOf(5000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const double size = random.magnitude(-5, 5);
    // Out of one arc into another.
    const auto arc = [&](double radius) {
      const double angle = random.uniform(-3, 3);
      return arcShape({random.uniform(-size, size), random.uniform(-size, size), 0}, {radius, 0, 0},
                      {0, radius * std::cos(0.3), radius * std::sin(0.3)}, angle,
                      random.sign() * 0.5, {});
    };
    const Shape first = arc(size * random.magnitude(-1, 1));
    const Shape second = arc(size * random.magnitude(-1, 1));
    const Derivatives before = overLength(overParameter(first, 0.7));
    const Derivatives after = overLength(overParameter(second, 0.2));
    if (turnBetween(before.d1, after.d1) > kMaxTurn)
      continue;
    const Shape blend = blendShape(before, after);
    const Derivatives begin = overLength(overParameter(blend, 0));
    const Derivatives end = overLength(overParameter(blend, 1));
    const auto same = [&](const Derivatives &a, const Derivatives &b) {
      ASSERT_LE(sizeOf(a.p - b.p), 1e-13 * (size + sizeOf(b.p) + blend.length));
      ASSERT_LE(sizeOf(a.d1 - b.d1), 1e-12);
      ASSERT_LE(sizeOf(a.d2 - b.d2), 1e-11 * (sizeOf(b.d2) + 1 / blend.length));
    };
    same(begin, before);
    same(end, after);
  }
}

TEST(PathBlend, LeavesTheCornerAsFarAsForetold) {
  for (int i = 0; i < casesOf(300) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const double turn = random.uniform(0.001, kMaxTurn);
    const double cut = random.magnitude(-4, 3);
    const Corner corner(turn, cut, cut);
    const Shape blend = blendShape(corner.before, corner.after);
    double nearest = 1e300;
    for (int k = 0; k <= 2000; ++k)
      nearest = std::min(nearest, sizeOf(overParameter(blend, k / 2000.0).p));
    // Even cuts: the middle is nearest to the corner.
    ASSERT_NEAR(nearest, deviationPerCut(turn) * cut, 1e-12 * cut);
    ASSERT_NEAR(sizeOf(overParameter(blend, 0.5).p), nearest, 1e-12 * cut);
  }
}

TEST(PathBlend, BendsAsLittleAsItsKindCan) {
  for (int degrees = 1; degrees <= 170; degrees += 13) {
    SCOPED_TRACE(std::to_string(degrees));
    const double turn = degrees * M_PI / 180;
    const Corner corner(turn, 2.5, 2.5);
    const double bend = greatestCurvature(blendShape(corner.before, corner.after));
    EXPECT_NEAR(curvatureTimesCut(turn), bend * 2.5, 0.004 * bend * 2.5);
    // Other lengths of the end derivatives.
    const double chord = sizeOf(corner.after.p - corner.before.p);
    for (double stretch = 0.5; stretch < 3; stretch += 0.02) {
      const double speed = stretch * chord;
      const Shape other = quinticShape({corner.before.p, corner.before.d1 * speed, {}, {}},
                                       {corner.after.p, corner.after.d1 * speed, {}, {}});
      EXPECT_GE(greatestCurvature(other), bend * 0.997) << stretch;
    }
  }
}

TEST(PathBlend, TurnsAreExactWhereTheyAreSmallAndWhereTheyAreHalfACircle) {
  EXPECT_EQ(turnBetween({1, 0, 0}, {1, 0, 0}), 0);
  EXPECT_NEAR(turnBetween({1, 0, 0}, {std::cos(1e-9), std::sin(1e-9), 0}), 1e-9, 1e-24);
  EXPECT_NEAR(turnBetween({0, 1, 0}, {0, 0, -1}), M_PI / 2, 1e-15);
  EXPECT_NEAR(turnBetween({0, 1, 0}, {0, -1, 0}), M_PI, 1e-15);
}

} // namespace
