// Pieces of the law of a path, against the textbook's functions in long double, against a numeric
// integration of the differential equation, and against themselves: time at a place and place at a
// time are each other's inverse.
#include "runtime/numeric/path/time_piece.hpp"

#include "motion_problems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace {

using namespace stride::path;
using stride::test::casesOf;
using stride::test::Random;

/// A piece that moves forwards all the way, of any size.
TimePiece randomPiece(Random &random) {
  const double length = random.magnitude(-6, 4);
  const double speed = random.magnitude(-3, 3);
  const double v0 = random.chance(0.1) ? 0.0 : speed * random.uniform(0.01, 1);
  const double v1 = v0 == 0.0 || random.chance(0.9) ? speed * random.uniform(0.01, 1) : 0.0;
  // v^2 is a parabola over the way between both ends; it must stay above zero.
  const double rise = (v1 * v1 - v0 * v0) / length;
  const double least = std::min(v0 * v0, v1 * v1);
  const double most = least > 0 ? 4 * least / (length * length) : std::fabs(rise) / length;
  const double gradient = random.chance(0.1) ? 0.0
                          : random.chance(0.5)
                              ? random.uniform(0, 0.99) * most
                              : -random.magnitude(-2, 1.5) * speed * speed / (length * length);
  const double a0 = 0.5 * (rise - gradient * length);
  return linearPiece(random.chance(0.5) ? 0.0 : random.uniform(-100, 100) * length, length, v0, a0,
                     gradient);
}

/// The same in long double by the textbook's functions.
WayState textbook(const TimePiece &p, long double t) {
  const long double g = p.gradient;
  const long double v0 = p.velocity;
  const long double a0 = p.acceleration;
  long double c = 1;
  long double s = t; // of sinh(q t) / q
  long double d = t * t / 2;
  if (g != 0) {
    const long double q = std::sqrt(std::fabs(g));
    c = g > 0 ? std::cosh(q * t) : std::cos(q * t);
    s = (g > 0 ? std::sinh(q * t) : std::sin(q * t)) / q;
    const long double half = g > 0 ? std::sinh(q * t / 2) : std::sin(q * t / 2);
    d = 2 * half * half / (q * q);
  }
  const long double v = v0 * c + a0 * s;
  return {static_cast<double>(p.start + v0 * s + a0 * d), static_cast<double>(v),
          static_cast<double>(a0 * c + g * v0 * s), static_cast<double>(g * v)};
}

/// Out of rest without acceleration it would never end; rounding makes less or more of that.
TEST(PathTimePiece, EndsEvenIfItNeverLeavesRest) {
  Random random(8);
  for (int i = 0; i < casesOf(20000) && !HasFailure(); ++i) {
    const double length = random.magnitude(-6, 4);
    const double gradient = random.magnitude(-6, 9);
    for (const bool into : {false, true}) {
      const double end = std::sqrt(gradient) * length;
      const TimePiece piece =
          linearPiece(0, length, into ? end : 0, into ? -gradient * length : 0, gradient);
      EXPECT_TRUE(std::isfinite(piece.duration)) << length << ", " << gradient;
      EXPECT_GT(piece.duration, 0);
      EXPECT_TRUE(std::isfinite(stateAt(piece, piece.duration).way));
    }
  }
}

TEST(PathTimePiece, IsTheSolutionOfItsEquation) {
  for (int i = 0; i < casesOf(50000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const TimePiece p = randomPiece(random);
    ASSERT_GT(p.duration, 0);
    const double t = p.duration * (random.chance(0.1) ? 1 : random.uniform(0, 1));
    const WayState state = stateAt(p, t);
    const WayState right = textbook(p, t);
    const double vTop = std::max({p.velocity, velocityAt(p, p.start + p.length), right.velocity});
    const double aTop =
        std::max(std::fabs(p.acceleration), std::fabs(p.acceleration + p.gradient * p.length)) +
        vTop / p.duration;
    const double haze = 1e-15 * std::fabs(p.start);
    ASSERT_NEAR(state.way, right.way, 1e-13 * p.length + haze);
    ASSERT_NEAR(state.velocity, right.velocity, 1e-13 * vTop);
    ASSERT_NEAR(state.acceleration, right.acceleration, 1e-13 * aTop);
    ASSERT_DOUBLE_EQ(state.jerk, p.gradient * state.velocity);
  }
}

TEST(PathTimePiece, TimeAtAPlaceAndPlaceAtATimeAreInverse) {
  for (int i = 0; i < casesOf(50000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    TimePiece p = randomPiece(random);
    p.start = 0; // digits are not what is looked at here
    const WayState end = stateAt(p, p.duration);
    ASSERT_NEAR(end.way, p.length, 1e-13 * p.length);
    ASSERT_NEAR(timeAt(p, p.length), p.duration, 1e-15 * p.duration);
    ASSERT_EQ(timeAt(p, 0), 0);
    double before = 0;
    for (int k = 1; k <= 8; ++k) {
      const double t = p.duration * k / 8.5;
      const WayState state = stateAt(p, t);
      ASSERT_GT(state.way, before) << "not forwards";
      before = state.way;
      ASSERT_NEAR(timeAt(p, state.way), t, 1e-11 * p.duration);
      ASSERT_NEAR(velocityAt(p, state.way), state.velocity,
                  1e-7 * (p.velocity + end.velocity + state.velocity));
    }
  }
}

TEST(PathTimePiece, AnIntegrationInSmallStepsLeadsToTheSamePlace) {
  for (int i = 0; i < casesOf(2000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const TimePiece p = randomPiece(random);
    const int steps = 400; // Runge and Kutta's
    const long double h = static_cast<long double>(p.duration) / steps;
    long double x = 0;
    long double v = p.velocity;
    const auto acceleration = [&](long double at) {
      return static_cast<long double>(p.acceleration) + p.gradient * at;
    };
    for (int k = 0; k < steps; ++k) {
      const long double a1 = acceleration(x);
      const long double a2 = acceleration(x + h / 2 * v);
      const long double a3 = acceleration(x + h / 2 * (v + h / 2 * a1));
      const long double a4 = acceleration(x + h * (v + h / 2 * a2));
      x += h * v + h * h / 6 * (a1 + a2 + a3);
      v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    ASSERT_NEAR(static_cast<double>(x), p.length, 1e-8 * p.length);
    ASSERT_NEAR(static_cast<double>(v), stateAt(p, p.duration).velocity,
                1e-7 * (p.velocity + p.length / p.duration));
  }
}

TEST(PathTimePiece, HalfASwingLeadsFromRestToRest) {
  // a = A (1 - 2 x / h): v^2 = 2 A x (1 - x / h), which is a circle over the way.
  const double h = 3.0;
  const double a = 7.0;
  const TimePiece p = linearPiece(0, h, 0, a, -2 * a / h);
  EXPECT_NEAR(p.duration, M_PI / std::sqrt(2 * a / h), 1e-15);
  const WayState middle = stateAt(p, p.duration / 2);
  EXPECT_NEAR(middle.way, h / 2, 1e-15);
  EXPECT_NEAR(middle.velocity, std::sqrt(a * h / 2), 1e-14);
  EXPECT_NEAR(timeAt(p, h / 2), p.duration / 2, 1e-15);
  EXPECT_NEAR(stateAt(p, p.duration).velocity, 0, 1e-14);
}

TEST(PathTimePiece, ConstantJerkLeadsOutOfRestAndBackIntoIt) {
  for (int i = 0; i < casesOf(20000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const double length = random.magnitude(-9, 4);
    const double jerk = random.magnitude(-2, 7);
    const TimePiece from = pieceFromRest(0, length, jerk);
    const TimePiece to = pieceToRest(0, length, jerk);
    const long double duration = std::cbrt(6.0L * length / jerk);
    ASSERT_NEAR(from.duration, static_cast<double>(duration), 1e-15 * from.duration);
    ASSERT_EQ(from.duration, to.duration);
    for (const double part : {0.0, 0.013, 0.4, 0.77, 1.0}) {
      const double t = part * from.duration;
      const WayState out = stateAt(from, t);
      const WayState in = stateAt(to, to.duration - t);
      ASSERT_NEAR(out.way, jerk * t * t * t / 6, 1e-15 * length);
      ASSERT_NEAR(in.way, length - out.way, 1e-14 * length) << "mirrored";
      ASSERT_NEAR(in.velocity, out.velocity, 1e-14 * to.velocity);
      ASSERT_NEAR(in.acceleration, -out.acceleration, -1e-14 * to.acceleration);
      ASSERT_EQ(in.jerk, jerk);
      ASSERT_EQ(out.jerk, jerk);
      ASSERT_NEAR(timeAt(from, out.way), t, 1e-14 * from.duration);
      ASSERT_NEAR(velocityAt(from, out.way), out.velocity, 1e-14 * to.velocity);
    }
    ASSERT_EQ(stateAt(to, to.duration).way, length);
    ASSERT_EQ(stateAt(to, to.duration).velocity, 0);
    ASSERT_EQ(stateAt(from, 0).acceleration, 0);
    ASSERT_EQ(velocityAt(to, 0), to.velocity);
  }
}

} // namespace
