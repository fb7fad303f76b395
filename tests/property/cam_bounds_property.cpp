// The bounds of cams: every sampled value lies within, and each bound is reached.
#include "runtime/numeric/cam/bounds.hpp"
#include "runtime/numeric/cam/extremes.hpp"

#include "random_curves.hpp"

#include "motion_problems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace {

namespace cam = stride::cam;
using stride::test::casesOf;
using stride::test::MadeCurve;
using stride::test::Random;

double sizeOf(const cam::Range &range) {
  return std::fmax(std::fabs(range.low), std::fabs(range.high));
}

/// The greatest value of `f` on [low, high]: the best of many samples, made better nearby.
double greatest(const std::function<double(double)> &f, double low, double high) {
  constexpr int kSteps = 300;
  double best = low;
  double bestValue = f(low);
  for (int i = 1; i <= kSteps; ++i) {
    const double u = low + (high - low) * i / kSteps;
    if (const double value = f(u); value > bestValue) {
      best = u;
      bestValue = value;
    }
  }
  double left = std::fmax(low, best - (high - low) / kSteps);
  double right = std::fmin(high, best + (high - low) / kSteps);
  for (int i = 0; i < 60; ++i) {
    const double a = left + (right - left) / 3;
    const double b = right - (right - left) / 3;
    (f(a) < f(b) ? left : right) = f(a) < f(b) ? a : b;
  }
  return std::fmax(bestValue, f(0.5 * (left + right)));
}

struct Found {
  double maxPosition = -HUGE_VAL, minPosition = HUGE_VAL, maxSlope = 0, maxAcceleration = 0,
         minAcceleration = 0;
};

/// By sampling, piece after piece; no roots, no derivatives of derivatives.
Found sampled(const cam::Curve &curve, const cam::MasterLimits &limits) {
  Found found;
  const double v2 = limits.velocity * limits.velocity;
  const double a = limits.acceleration;
  const uint32_t pieces = cam::pieceCount(curve);
  for (uint32_t piece = 0; piece < pieces; ++piece)
    for (const bool periodic : {false, true}) {
      if (periodic ? !(curve.cubic && (piece == 0 || piece + 1 == pieces)) : curve.open)
        if (!(curve.open && periodic))
          continue;
      const cam::Segment segment = cam::pieceOf(curve, piece, periodic);
      const auto at = [&](double x) { return cam::evaluateSegment(segment, x); };
      const auto most = [&](const std::function<double(double)> &f) {
        // In portions: parts of laws have their extremes, too.
        double value = -HUGE_VAL;
        for (int i = 0; i < 4; ++i) {
          const double h = (segment.end - segment.start) / 4;
          value = std::fmax(value, greatest(f, segment.start + i * h, segment.start + (i + 1) * h));
        }
        return value;
      };
      found.maxPosition = std::fmax(found.maxPosition, most([&](double x) { return at(x).y; }));
      found.minPosition = std::fmin(found.minPosition, -most([&](double x) { return -at(x).y; }));
      found.maxSlope =
          std::fmax(found.maxSlope, most([&](double x) { return std::fabs(at(x).v); }));
      found.maxAcceleration = std::fmax(
          found.maxAcceleration,
          most([&](double x) { return std::fmax(at(x).a, 0.0) * v2 + std::fabs(at(x).v) * a; }));
      found.minAcceleration = std::fmin(
          found.minAcceleration,
          -most([&](double x) { return std::fmax(-at(x).a, 0.0) * v2 + std::fabs(at(x).v) * a; }));
    }
  return found;
}

cam::MasterLimits randomLimits(Random &random) {
  return {random.chance(0.2) ? 1.0 : random.magnitude(-1, 3),
          random.chance(0.3) ? 0.0 : random.magnitude(-1, 4)};
}

} // namespace

TEST(CamBounds, ContainEverySampledValue) {
  Random random(11);
  for (int i = 0; i < casesOf(4000); ++i) {
    const MadeCurve made = stride::test::randomCurve(random, 12);
    const cam::MasterLimits limits = randomLimits(random);
    const cam::Bounds bounds = cam::boundsOf(made.curve, limits);
    const double factor = random.uniform(-3, 3);
    const cam::Bounds scaled = cam::scaledBounds(bounds, factor);
    const bool periodic = made.curve.open || random.chance(0.5);
    uint32_t index = 0;
    for (int k = 0; k < 100; ++k) {
      const double x = k == 0   ? made.curve.start
                       : k == 1 ? made.curve.end
                                : random.uniform(made.curve.start, made.curve.end);
      const double v = limits.velocity * (k % 3 == 0 ? 1.0 : random.uniform(-1, 1));
      const double a = limits.acceleration * (k % 2 == 0 ? random.sign() : random.uniform(-1, 1));
      const cam::Point point = cam::evaluateCurve(made.curve, x, periodic, index);
      const double velocity = point.v * v;
      const double acceleration = point.a * v * v + point.v * a;
      const auto within = [](const cam::Range &range, double value) {
        const double slack = 1e-11 * sizeOf(range);
        return value >= range.low - slack && value <= range.high + slack;
      };
      ASSERT_TRUE(within(bounds.position, point.y)) << i << " " << k;
      ASSERT_TRUE(within(bounds.velocity, velocity)) << i << " " << k;
      ASSERT_TRUE(within(bounds.acceleration, acceleration)) << i << " " << k;
      ASSERT_TRUE(within(scaled.position, point.y * factor)) << i << " " << k;
      ASSERT_TRUE(within(scaled.velocity, velocity * factor)) << i << " " << k;
      ASSERT_TRUE(within(scaled.acceleration, acceleration * factor)) << i << " " << k;
    }
  }
}

TEST(CamBounds, AreReached) {
  Random random(12);
  for (int i = 0; i < casesOf(600); ++i) {
    const MadeCurve made = stride::test::randomCurve(random, 5);
    const cam::MasterLimits limits = randomLimits(random);
    const cam::Bounds bounds = cam::boundsOf(made.curve, limits);
    const Found found = sampled(made.curve, limits);
    const double position = bounds.position.high - bounds.position.low;
    const double acceleration = sizeOf(bounds.acceleration);
    EXPECT_NEAR(bounds.position.high, found.maxPosition, 1e-9 * position) << i;
    EXPECT_NEAR(bounds.position.low, found.minPosition, 1e-9 * position) << i;
    EXPECT_NEAR(bounds.velocity.high, found.maxSlope * limits.velocity, 1e-9 * bounds.velocity.high)
        << i;
    EXPECT_EQ(bounds.velocity.low, -bounds.velocity.high);
    EXPECT_NEAR(bounds.acceleration.high, found.maxAcceleration, 1e-7 * acceleration) << i;
    EXPECT_NEAR(bounds.acceleration.low, found.minAcceleration, 1e-7 * acceleration) << i;
  }
}

TEST(CamBounds, PartsOfPiecesAreThePieces) {
  Random random(13);
  for (int i = 0; i < casesOf(2000); ++i) {
    const MadeCurve made = stride::test::randomSegments(random, 1, random.chance(0.5));
    const cam::Segment segment = cam::pieceOf(made.curve, 0, false);
    cam::Smooth parts[cam::kMostParts];
    const int count = cam::partsOf(segment, parts);
    double size = std::fabs(segment.stroke) * 100;
    for (const double c : segment.coefficients)
      size += std::fabs(c) * 50;
    const double h = segment.end - segment.start;
    ASSERT_EQ(parts[0].low, 0.0);
    ASSERT_EQ(parts[count - 1].high, 1.0);
    for (int k = 0; k < count; ++k) {
      if (k > 0) {
        ASSERT_EQ(parts[k].low, parts[k - 1].high);
      }
      const cam::Smooth slope = cam::derivativeOf(parts[k]);
      const cam::Smooth curvature = cam::derivativeOf(slope);
      for (int n = 1; n < 10; ++n) {
        const double u = parts[k].low + (parts[k].high - parts[k].low) * n / 10;
        const double x = segment.start + u * h;
        const double slack = 1e-12 * size * (1 + std::fabs(x) / h);
        const cam::Point point = cam::evaluateSegment(segment, x);
        EXPECT_NEAR(cam::valueOf(parts[k], u), point.y, slack);
        EXPECT_NEAR(cam::valueOf(slope, u), point.v * h, slack);
        EXPECT_NEAR(cam::valueOf(curvature, u), point.a * h * h, 100 * slack);
      }
    }
  }
}

TEST(CamBounds, RootsAreAllFound) {
  Random random(14);
  for (int i = 0; i < casesOf(5000); ++i) {
    // A polynomial that is made of its roots.
    const int degree = 1 + random.below(7);
    std::vector<double> made;
    for (int k = 0; k < degree; ++k)
      made.push_back(random.uniform(-0.5, 1.5));
    std::sort(made.begin(), made.end());
    bool close = false;
    for (size_t k = 1; k < made.size(); ++k)
      close = close || made[k] - made[k - 1] < 0.02;
    for (const double root : made)
      close = close || std::fabs(root) < 1e-6 || std::fabs(root - 1) < 1e-6;
    if (close)
      continue;
    cam::Smooth f;
    f.c[0] = random.sign();
    int terms = 1;
    for (const double root : made) {
      for (int k = terms; k > 0; --k)
        f.c[k] = f.c[k - 1] - root * f.c[k];
      f.c[0] *= -root;
      ++terms;
    }
    double roots[cam::kMostRoots];
    const int count = cam::rootsOf(f, roots);
    std::erase_if(made, [](double root) { return root < 0 || root > 1; });
    ASSERT_EQ(static_cast<size_t>(count), made.size()) << i;
    for (size_t k = 0; k < made.size(); ++k)
      EXPECT_NEAR(roots[k], made[k], 1e-8) << i;
  }
}
