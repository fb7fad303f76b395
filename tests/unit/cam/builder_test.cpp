// Cams from pieces: what each kind is at its ends, what implicit boundaries take over, what is
// refused.
#include "runtime/numeric/cam/builder.hpp"

#include "tests/unit/cam/built_cam.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace stride::cam;
using namespace stride::test;

namespace {

TEST(Builder, TheDefaultCam) {
  const BuiltCam cam({poly5(implicit(), bound(120, 120, 1)), poly5(implicit(), bound(240, 240, 1)),
                      poly5(implicit(), bound(360, 360))});
  ASSERT_EQ(cam.error, BuildError::None);
  ASSERT_EQ(cam.segments.size(), 3U);
  const Node places[] = {{0, 0, 0, 0}, {120, 120, 1, 0}, {240, 240, 1, 0}, {360, 360, 0, 0}};
  for (int i = 0; i < 3; ++i)
    for (double x = places[i].x; x <= places[i + 1].x; x += 7.5) {
      const Point want = evaluateQuintic(places[i], places[i + 1], x);
      const Point is = evaluateSegment(cam.segments[static_cast<size_t>(i)], x);
      EXPECT_NEAR(is.y, want.y, 1e-12 * 360) << x;
      EXPECT_NEAR(is.v, want.v, 1e-13) << x;
      EXPECT_NEAR(is.a, want.a, 1e-14) << x;
      EXPECT_NEAR(is.j, want.j, 1e-15) << x;
    }
  // By hand: 120 (10/8 - 15/16 + 6/32) - 120 (4/8 - 7/16 + 3/32).
  EXPECT_NEAR(cam.at(60).y, 41.25, 1e-12);
  EXPECT_NEAR(cam.at(180).y, 180, 1e-12);
  EXPECT_NEAR(cam.at(180).v, 1, 1e-14);
}

TEST(Builder, APolynomialOfDegree7HasAllOfItsBoundaries) {
  const BuiltCam cam({poly7(bound(1, 2, 3, -4, 5), bound(3, -1, 0.5, 2, -7))});
  ASSERT_EQ(cam.error, BuildError::None);
  expectPoint(cam.start(0), {2, 3, -4, 5}, 1e-13);
  expectPoint(cam.end(0), {-1, 0.5, 2, -7}, 1e-12);
}

TEST(Builder, ALineGivesItsSlopeToItsNeighbours) {
  const BuiltCam cam({poly5(implicit(), implicit()), line(bound(20, 20), bound(100, 100)),
                      poly5(implicit(), bound(120, 120))});
  ASSERT_EQ(cam.error, BuildError::None);
  expectPoint(cam.end(0), {20, 1, 0}, 1e-13);
  expectPoint(cam.start(2), {100, 1, 0}, 1e-13);
  expectPoint(cam.start(0), {0, 0, 0}, 0);
  expectPoint(cam.end(2), {120, 0, 0}, 1e-12);
}

TEST(Builder, ExplicitBoundariesMayJump) {
  const BuiltCam cam({poly5(bound(0, 0), bound(10, 5, 1)), poly5(bound(10, 6, -1), bound(20, 0))});
  ASSERT_EQ(cam.error, BuildError::None);
  expectPoint(cam.end(0), {5, 1, 0}, 1e-13);
  expectPoint(cam.start(1), {6, -1, 0}, 0);
}

TEST(Builder, CoefficientsAreOfTheWaySinceTheLeftEnd) {
  Piece given = poly5(bound(10, 3), bound(12, 3 + 2 - 4 + 16));
  given.kind = PieceKind::Coefficients;
  given.coefficients[0] = 3;
  given.coefficients[1] = 1;
  given.coefficients[2] = -1;
  given.coefficients[3] = 2;
  const BuiltCam cam({poly7(implicit(), implicit()), given, poly7(implicit(), bound(20, 0))});
  ASSERT_EQ(cam.error, BuildError::None);
  expectPoint(cam.at(11), {3 + 1 - 1 + 2, 1 - 2 + 6, -2 + 12, 12}, 1e-13);
  expectPoint(cam.end(0), {3, 1, -2, 12}, 1e-12);
  expectPoint(cam.start(2), {17, 1 - 4 + 24, -2 + 24, 12}, 1e-12);
}

TEST(Builder, Degree7TakesTheJerkOfANeighbour) {
  const BuiltCam cam({poly5(bound(0, 0), bound(3, 4, 2, 1)), poly7(implicit(), bound(7, 1))});
  ASSERT_EQ(cam.error, BuildError::None);
  const Point end = cam.end(0);
  EXPECT_GT(std::fabs(end.j), 0.1);
  expectPoint(cam.start(1), end, 1e-13);
}

TEST(Builder, LawsAreAtRestAtTheirEnds) {
  for (const PieceKind kind : {PieceKind::InclinedSine, PieceKind::ModifiedSine}) {
    Piece rise = poly5(implicit(), bound(10, 4));
    rise.kind = kind;
    rise.inflexion = 0.5;
    const BuiltCam cam({rise, poly5(implicit(), bound(20, 0))});
    ASSERT_EQ(cam.error, BuildError::None);
    expectPoint(cam.at(0), {0, 0, 0}, 1e-15);
    EXPECT_NEAR(cam.at(5).y, 2, 1e-14);
    const size_t last = cam.segments.size() - 2;
    expectPoint(cam.end(last), {4, 0, 0}, 1e-14);
    expectPoint(cam.start(last + 1), {4, 0, 0}, 0);
    EXPECT_NEAR(cam.at(5).v * 10 / 4, kind == PieceKind::InclinedSine ? 2.0 : 1.7596, 1e-4);
  }
}

TEST(Builder, AModifiedSineBetweenTwoVelocities) {
  for (const double inflexion : {0.1, 0.2, 0.5, 0.75}) {
    Piece piece = poly5(bound(0, 1, 2), bound(4, 3, -1));
    piece.kind = PieceKind::ModifiedSine;
    piece.inflexion = inflexion;
    const BuiltCam cam({poly5(bound(-2, 0), implicit()), piece, poly5(implicit(), bound(9, 0))});
    ASSERT_EQ(cam.error, BuildError::None);
    ASSERT_EQ(cam.segments.size(), 4U);
    expectPoint(cam.start(1), {1, 2, 0}, 1e-14);
    expectPoint(cam.end(2), {3, -1, 0}, 1e-13);
    expectPoint(cam.end(0), {1, 2, 0}, 1e-13);
    expectPoint(cam.start(3), {3, -1, 0}, 0);
    EXPECT_NEAR(cam.segments[1].end, 4 * inflexion, 1e-15);
    expectPoint(cam.end(1), cam.start(2), 3, 1e-13);
    EXPECT_NEAR(cam.end(1).a, 0, 1e-13);
  }
}

TEST(Builder, AModifiedSineOfOneHalfJumpsInItsVelocityUnlessItsBoundariesAgree) {
  Piece piece = poly5(bound(0, 0), bound(4, 3));
  piece.kind = PieceKind::ModifiedSine;
  for (const double inflexion : {0.0, 1.0}) {
    piece.inflexion = inflexion;
    const BuiltCam cam({piece});
    ASSERT_EQ(cam.error, BuildError::None);
    ASSERT_EQ(cam.segments.size(), 1U);
    EXPECT_NEAR(cam.start(0).y, 0, 1e-15);
    EXPECT_NEAR(cam.end(0).y, 3, 1e-14);
    EXPECT_NEAR(inflexion == 0.0 ? cam.start(0).v : cam.end(0).v, 1.7596 * 3 / 4, 1e-4);
    EXPECT_NEAR(inflexion == 0.0 ? cam.end(0).v : cam.start(0).v, 0, 1e-14);
  }
}

TEST(Builder, AModifiedSineWithALimitedAcceleration) {
  Piece piece = poly5(bound(0, 0), bound(10, 5, 0.1));
  piece.kind = PieceKind::ModifiedSineLimited;
  for (const double limit : {0.2, 0.3, 0.8, 5.0}) {
    piece.parameter = limit;
    const BuiltCam cam({piece});
    ASSERT_EQ(cam.error, BuildError::None) << limit;
    ASSERT_EQ(cam.segments.size(), 2U);
    double peak = 0.0;
    for (int i = 0; i <= 4000; ++i)
      peak = std::fmin(peak,
                       cam.at(cam.segments[1].start + i / 4000.0 * (10 - cam.segments[1].start)).a);
    EXPECT_NEAR(-peak, limit, 1e-6 * limit);
    expectPoint(cam.end(1), {5, 0.1, 0}, 1e-13);
  }
  piece.parameter = 0.001; // it could not stop
  EXPECT_EQ(BuiltCam({piece}).error, BuildError::InvalidParameter);
}

TEST(Builder, APlaceAloneLeavesTheDerivativesOpen) {
  // The natural spline through three places: symmetric, so the velocity in the middle is that of
  // the line between the outer ones.
  const BuiltCam cam({poly5(place(0, 0), place(1, 1)), poly5(implicit(), place(2, 2)),
                      poly5(implicit(), place(3, 3))});
  ASSERT_EQ(cam.error, BuildError::None);
  for (double x = 0; x < 3.01; x += 0.25)
    expectPoint(cam.at(x), {x, 1, 0, 0}, 1e-13);
}

TEST(Builder, WhatNothingDecidesIsAStraightLine) {
  const BuiltCam cam({poly5(place(0, 0), place(4, 2))});
  ASSERT_EQ(cam.error, BuildError::None);
  for (double x = 0; x < 4.01; x += 0.5)
    expectPoint(cam.at(x), {0.5 * x, 0.5, 0, 0}, 1e-14);
}

TEST(Builder, AModifiedSineGetsTheVelocityOfThePolynomialBeside) {
  Piece sine = poly5(implicit(), bound(20, 3));
  sine.kind = PieceKind::ModifiedSine;
  sine.inflexion = 0.5;
  const BuiltCam cam({poly5(bound(0, 0), place(10, 5)), sine});
  ASSERT_EQ(cam.error, BuildError::None);
  EXPECT_GT(std::fabs(cam.end(0).v), 0.1);
  expectPoint(cam.end(0), {5, cam.start(1).v, 0}, 1e-13);
}

TEST(Builder, AClosedCamGoesOverIntoItsStart) {
  const BuiltCam cam(
      {poly5(implicit(), bound(5, 3, 1, 0.5)), poly5(implicit(), bound(9, 7, -1, 0.25))}, true);
  ASSERT_EQ(cam.error, BuildError::None);
  expectPoint(cam.start(0), {7, -1, 0.25}, 0);
}

TEST(Builder, ALawBetweenVelocitiesAndAccelerations) {
  for (const Law law : {Law::Harmonic, Law::Cycloidal, Law::ModifiedSine, Law::ModifiedTrapezoid}) {
    Piece piece = poly5(bound(1, 1, 2, 0.5), bound(4, 3, -1, 0.25));
    piece.kind = PieceKind::Law;
    piece.law = law;
    piece.parameter = 0.25;
    piece.inflexion = 0.5;
    const BuiltCam cam({poly5(bound(0, 0), implicit()), piece, poly5(implicit(), bound(9, 0))});
    ASSERT_EQ(cam.error, BuildError::None);
    expectPoint(cam.end(0), cam.start(1), 3, 1e-12); // a harmonic one has accelerations of its own
    expectPoint(cam.end(1), cam.start(2), 3, 1e-12);
    expectPoint(cam.start(1), {1, 2}, 1e-13);
    if (law != Law::Harmonic)
      expectPoint(cam.start(1), {1, 2, 0.5}, 1e-13);
  }
}

TEST(Builder, Refusals) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto errorOf = [](std::vector<Piece> pieces) { return BuiltCam(std::move(pieces)).error; };
  EXPECT_EQ(errorOf({}), BuildError::NoPieces);
  EXPECT_EQ(errorOf({poly5(bound(0, 0), implicit())}), BuildError::BoundaryUnknown);
  EXPECT_EQ(errorOf({poly5(bound(0, 0), implicit()), poly5(implicit(), bound(9, 9))}),
            BuildError::BoundaryUnknown);
  EXPECT_EQ(errorOf({line(bound(0, 0), bound(3, 3)), line(bound(4, 3), bound(9, 9))}),
            BuildError::NotAdjacent);
  EXPECT_EQ(errorOf({line(bound(3, 0), bound(3, 3))}), BuildError::NoExtent);
  EXPECT_EQ(errorOf({line(implicit(), bound(-1, 3))}), BuildError::NoExtent);
  EXPECT_EQ(errorOf({line(implicit(), implicit()), line(bound(0, 0), bound(9, 9))}),
            BuildError::NoExtent);
  EXPECT_EQ(errorOf({line(bound(0, 0), bound(5, 3)), line(implicit(), implicit()),
                     line(bound(5, 0), bound(9, 9))}),
            BuildError::NoExtent);
  EXPECT_EQ(errorOf({line(bound(0, nan), bound(5, 3))}), BuildError::InvalidValue);
  EXPECT_EQ(errorOf({poly5(bound(0, 0, 1e308), bound(1e5, 3))}), BuildError::InvalidValue);
  Piece strange = line(bound(0, 0), bound(5, 3));
  strange.kind = static_cast<PieceKind>(8);
  EXPECT_EQ(errorOf({strange}), BuildError::InvalidValue);
  strange.kind = PieceKind::ModifiedSine;
  strange.inflexion = 1.5;
  EXPECT_EQ(errorOf({strange}), BuildError::InvalidParameter);
  strange.kind = PieceKind::Law;
  strange.inflexion = 0.5;
  strange.law = static_cast<Law>(99);
  EXPECT_EQ(errorOf({strange}), BuildError::InvalidParameter);
}

} // namespace
