// The laws of motion against the literature's peak values (VDI 2143; Norton, Cam Design and
// Manufacturing Handbook, table 3-3) and against numeric differentiation.
#include "runtime/numeric/cam/curve.hpp"
#include "runtime/numeric/cam/laws.hpp"

#include <cmath>
#include <gtest/gtest.h>

using namespace stride::cam;

namespace {

struct Peaks {
  double v = 0.0;
  double a = 0.0;
  double j = 0.0;
};

template <class Evaluate> Peaks peaksOf(Evaluate evaluate) {
  Peaks peaks;
  constexpr int kSteps = 80000;
  for (int i = 0; i <= kSteps; ++i) {
    const Point point = evaluate(static_cast<double>(i) / kSteps);
    peaks.v = std::fmax(peaks.v, std::fabs(point.v));
    peaks.a = std::fmax(peaks.a, std::fabs(point.a));
    peaks.j = std::fmax(peaks.j, std::fabs(point.j));
  }
  return peaks;
}

Peaks peaksOf(const LawShape &shape) {
  return peaksOf([&](double u) { return evaluateLaw(shape, u); });
}

const LawShape kShapes[] = {
    {Law::Harmonic},
    {Law::Cycloidal},
    {Law::ModifiedSine},
    {Law::ModifiedTrapezoid},
    {Law::Harmonic, 0.25, 0.3},
    {Law::Cycloidal, 0.25, 0.7},
    {Law::ModifiedSine, 0.25, 0.45},
    {Law::ModifiedTrapezoid, 0.25, 0.6},
    {Law::ModifiedSine, 0.0, 0.5},
    {Law::ModifiedSine, 0.4, 0.5},
    {Law::ModifiedSine, 0.8, 0.2},
};

/// A quintic from rest to rest, with the laws' norm.
Segment polynomial345() { return makeSegment({}, {0, 0, 0, 0}, {1, 1, 0, 0}); }

} // namespace

TEST(Laws, PeaksAreThoseOfTheLiterature) {
  const Peaks harmonic = peaksOf({Law::Harmonic});
  EXPECT_NEAR(harmonic.v, 1.5708, 5e-5);
  EXPECT_NEAR(harmonic.a, 4.9348, 5e-5);
  EXPECT_NEAR(harmonic.j, 15.503, 5e-3);
  const Peaks cycloidal = peaksOf({Law::Cycloidal});
  EXPECT_NEAR(cycloidal.v, 2.0, 1e-12);
  EXPECT_NEAR(cycloidal.a, 2 * M_PI, 1e-12);
  EXPECT_NEAR(cycloidal.j, 4 * M_PI * M_PI, 1e-11);
  const Peaks sine = peaksOf({Law::ModifiedSine});
  EXPECT_NEAR(sine.v, 1.7596, 5e-5);
  EXPECT_NEAR(sine.a, 5.5280, 5e-5);
  EXPECT_NEAR(sine.j, 69.47, 5e-3);
  const Peaks trapezoid = peaksOf({Law::ModifiedTrapezoid});
  EXPECT_NEAR(trapezoid.v, 2.0, 1e-12);
  EXPECT_NEAR(trapezoid.a, 4.8881, 5e-5);
  EXPECT_NEAR(trapezoid.j, 61.43, 5e-3);
  const Peaks quintic = peaksOf([](double u) { return evaluateSegment(polynomial345(), u); });
  EXPECT_NEAR(quintic.v, 1.875, 1e-12);
  EXPECT_NEAR(quintic.a, 5.7735, 5e-5);
  EXPECT_NEAR(quintic.j, 60.0, 1e-12);
}

TEST(Laws, GoExactlyFromZeroToOne) {
  for (const LawShape &shape : kShapes) {
    EXPECT_EQ(evaluateLaw(shape, 0.0).y, 0.0);
    EXPECT_EQ(evaluateLaw(shape, 0.0).v, 0.0);
    EXPECT_EQ(evaluateLaw(shape, 1.0).y, 1.0);
    EXPECT_EQ(evaluateLaw(shape, 1.0).v, 0.0);
    if (shape.law != Law::Harmonic && shape.parameter > 0.0) {
      EXPECT_EQ(evaluateLaw(shape, 0.0).a, 0.0);
      EXPECT_EQ(evaluateLaw(shape, 1.0).a, 0.0);
    }
  }
}

TEST(Laws, DerivativesAreTheDerivatives) {
  for (const LawShape &shape : kShapes) {
    constexpr int kSteps = 3137; // meets no joint
    constexpr double kStep = 1e-5;
    for (int i = 1; i < kSteps; ++i) {
      const double u = static_cast<double>(i) / kSteps;
      const Point left = evaluateLaw(shape, u - kStep);
      const Point here = evaluateLaw(shape, u);
      const Point right = evaluateLaw(shape, u + kStep);
      const double jerk = std::fmax(100.0, std::fabs(here.j));
      EXPECT_NEAR((right.y - left.y) / (2 * kStep), here.v, 1e-5 * jerk);
      EXPECT_NEAR((right.v - left.v) / (2 * kStep), here.a, 1e-5 * jerk);
      if (std::fabs(right.j - left.j) < 1.0) { // else the jerk jumps between
        EXPECT_NEAR((right.a - left.a) / (2 * kStep), here.j, 1e-5 * jerk);
      }
    }
  }
}

TEST(Laws, AreContinuousInsideUpToTheAcceleration) {
  for (const LawShape &shape : kShapes) {
    constexpr int kSteps = 4096; // meets the joints of the symmetric ones
    for (int i = 1; i < kSteps; ++i) {
      const double u = static_cast<double>(i) / kSteps;
      const Point left = evaluateLaw(shape, std::nextafter(u, 0.0));
      const Point right = evaluateLaw(shape, u);
      EXPECT_NEAR(left.y, right.y, 1e-14);
      EXPECT_NEAR(left.v, right.v, 1e-13);
      EXPECT_NEAR(left.a, right.a, 1e-12);
    }
    const double u = shape.inflexion;
    const Point left = evaluateLaw(shape, std::nextafter(u, 0.0));
    const Point right = evaluateLaw(shape, std::nextafter(u, 1.0));
    EXPECT_NEAR(left.y, right.y, 1e-14);
    EXPECT_NEAR(left.v, right.v, 1e-13);
    EXPECT_NEAR(left.a, 0.0, 1e-12);
    EXPECT_NEAR(right.a, 0.0, 1e-12);
  }
}

TEST(Laws, ModifiedSineLiesBetweenHarmonicAndCycloidal) {
  for (int i = 0; i <= 100; ++i) {
    const double u = i / 100.0;
    EXPECT_NEAR(evaluateLaw({Law::ModifiedSine, 0.0}, u).y, evaluateLaw({Law::Harmonic}, u).y,
                1e-15);
    EXPECT_NEAR(evaluateLaw({Law::ModifiedSine, 0.5}, u).y, evaluateLaw({Law::Cycloidal}, u).y,
                1e-15);
    EXPECT_NEAR(evaluateLaw({Law::ModifiedSine, 0.5}, u).a, evaluateLaw({Law::Cycloidal}, u).a,
                1e-13);
  }
}

TEST(Laws, UnusableParametersAreSeen) {
  EXPECT_TRUE(isUsable({}));
  EXPECT_TRUE(isUsable({Law::ModifiedSine, 0.0, 0.5}));
  EXPECT_FALSE(isUsable({Law::ModifiedSine, 1.0, 0.5}));
  EXPECT_FALSE(isUsable({Law::ModifiedSine, -0.1, 0.5}));
  EXPECT_FALSE(isUsable({Law::ModifiedSine, std::nan(""), 0.5}));
  EXPECT_FALSE(isUsable({Law::Cycloidal, 0.25, 0.0}));
  EXPECT_FALSE(isUsable({Law::Cycloidal, 0.25, 1.0}));
  EXPECT_FALSE(isUsable({Law::Cycloidal, 0.25, INFINITY}));
  EXPECT_FALSE(isUsable({static_cast<Law>(5)}));
  EXPECT_FALSE(isUsable({static_cast<Law>(-1)}));
}

TEST(Laws, SegmentsMeetBothPlacesWhateverTheyAre) {
  const double velocities[] = {0.0, 1.5, -0.7};
  const double accelerations[] = {0.0, 0.2, -0.3};
  for (const LawShape &shape : kShapes)
    for (const double v0 : velocities)
      for (const double a0 : accelerations)
        for (const double v1 : velocities)
          for (const double a1 : accelerations) {
            const Node left{10, 3, v0, a0};
            const Node right{14, -5, v1, a1};
            const Segment segment = makeSegment(shape, left, right);
            const Point begin = evaluateSegment(segment, 10);
            const Point end = evaluateSegment(segment, 14);
            EXPECT_EQ(begin.y, 3.0);
            EXPECT_NEAR(end.y, -5.0, 1e-14);
            EXPECT_NEAR(begin.v, v0, 1e-14);
            EXPECT_NEAR(end.v, v1, 1e-14);
            if (shape.law != Law::Harmonic && shape.parameter > 0.0) {
              EXPECT_NEAR(begin.a, a0, 1e-14);
              EXPECT_NEAR(end.a, a1, 1e-14);
            }
          }
}

TEST(Laws, BetweenEqualVelocitiesThereIsTheLawAndALine) {
  const Segment segment = makeSegment({Law::ModifiedSine}, {0, 0, 0.5, 0}, {100, 80, 0.5, 0});
  for (int i = 0; i <= 100; ++i)
    EXPECT_NEAR(evaluateSegment(segment, i).y,
                0.5 * i + 30.0 * evaluateLaw({Law::ModifiedSine}, i / 100.0).y, 1e-13);
}
