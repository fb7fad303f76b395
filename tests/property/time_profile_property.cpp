// Properties of courses through points in time, against definitions: a dense linear system for the
// cubic course, numeric integration, reproduction of polynomials.
#include "runtime/numeric/profile/time_profile.hpp"

#include "tests/support/cases.hpp"
#include "tests/support/kinematics.hpp"
#include "tests/support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace {

using stride::motion::planAccelerations;
using stride::motion::PlanError;
using stride::motion::planPositions;
using stride::motion::planVelocities;
using stride::motion::State;
using stride::motion::TimePiece;
using stride::motion::TimePoint;
using stride::motion::TimeProfile;
using stride::test::casesOf;

struct Problem {
  State start;
  std::vector<TimePoint> points;
};

class Random : public stride::test::Random {
public:
  using stride::test::Random::Random;

  /// Steps of whole milliseconds, values of any size, not too different from each other.
  Problem problem(int most) {
    Problem p{};
    const double size = std::pow(10.0, uniform(-4, 6));
    const double pace = std::pow(10.0, uniform(0, 5));
    const int n = 1 + below(most);
    for (int i = 0; i < n; ++i)
      p.points.push_back({std::ceil(pace * uniform(0.1, 1)) / 1000.0, size * uniform(-1, 1)});
    if (chance(0.7))
      p.start = {size * uniform(-1, 1), size * uniform(-1, 1) / pace * 1000.0,
                 size * uniform(-1, 1) / pace / pace * 1e6};
    return p;
  }
};

State at(const TimePiece &piece, double t) {
  return stride::test::movedOn(piece.origin, piece.jerk, t - piece.start);
}

/// Greatest magnitudes in a course.
struct Sizes {
  double position = 0;
  double velocity = 0;
  double acceleration = 0;
};

Sizes sizesOf(const TimeProfile &profile) {
  Sizes sizes;
  for (int i = 0; i < profile.count; ++i) {
    const TimePiece &piece = profile.pieces[i];
    const double end = i + 1 < profile.count ? profile.pieces[i + 1].start : profile.duration;
    for (const State &s : {piece.origin, at(piece, end)}) {
      sizes.position = std::max(sizes.position, std::fabs(s.position));
      sizes.velocity = std::max(sizes.velocity, std::fabs(s.velocity));
      sizes.acceleration = std::max(sizes.acceleration, std::fabs(s.acceleration));
    }
  }
  return sizes;
}

/// Starts with the given state, ends with its own, and has no jumps.
void expectContinuous(const TimeProfile &profile, const State &start) {
  const Sizes sizes = sizesOf(profile);
  const auto same = [&](const State &a, const State &b) {
    ASSERT_NEAR(a.position, b.position, 1e-9 * sizes.position);
    ASSERT_NEAR(a.velocity, b.velocity, 1e-9 * sizes.velocity);
    ASSERT_NEAR(a.acceleration, b.acceleration, 1e-9 * sizes.acceleration);
  };
  ASSERT_EQ(profile.pieces[0].start, 0.0);
  same(profile.at(0), start);
  for (int i = 0; i < profile.count; ++i) {
    const bool last = i + 1 == profile.count;
    const double end = last ? profile.duration : profile.pieces[i + 1].start;
    ASSERT_GT(end, profile.pieces[i].start);
    same(at(profile.pieces[i], end), last ? profile.end : profile.pieces[i + 1].origin);
  }
}

/// Solves a x = b with pivoting.
std::vector<double> solve(std::vector<std::vector<double>> a, std::vector<double> b) {
  const size_t n = b.size();
  for (size_t k = 0; k < n; ++k) {
    size_t pivot = k;
    for (size_t i = k + 1; i < n; ++i)
      if (std::fabs(a[i][k]) > std::fabs(a[pivot][k]))
        pivot = i;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (size_t i = k + 1; i < n; ++i) {
      const double f = a[i][k] / a[k][k];
      if (f == 0.0)
        continue;
      for (size_t j = k; j < n; ++j)
        a[i][j] -= f * a[k][j];
      b[i] -= f * b[k];
    }
  }
  for (size_t k = n; k-- > 0;) {
    for (size_t j = k + 1; j < n; ++j)
      b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

/// The cubic course by its definition: unknown are all coefficients c0 + c1 x + c2 x^2 + c3 x^3 of
/// all pieces, x from 0 to 1 in each.
class DenseCourse {
public:
  explicit DenseCourse(const Problem &p) {
    lengths_ = {0.5 * p.points[0].step, 0.5 * p.points[0].step};
    for (size_t i = 1; i < p.points.size(); ++i)
      lengths_.push_back(p.points[i].step);
    const size_t pieces = lengths_.size();
    const size_t n = 4 * pieces;
    std::vector<std::vector<double>> a;
    std::vector<double> b;
    const auto row = [&](double right) -> std::vector<double> & {
      a.emplace_back(n, 0.0);
      b.push_back(right);
      return a.back();
    };
    // value, first and second derivative of piece k at x = 0 or 1, times `factor`
    const auto add = [&](std::vector<double> &to, size_t k, int order, bool end, double f) {
      const double h = lengths_[k];
      const size_t c = 4 * k;
      if (order == 0) {
        to[c] += f;
        for (int i = 1; end && i < 4; ++i)
          to[c + static_cast<size_t>(i)] += f;
      } else if (order == 1) {
        to[c + 1] += f / h;
        if (end) {
          to[c + 2] += 2 * f / h;
          to[c + 3] += 3 * f / h;
        }
      } else {
        to[c + 2] += 2 * f / (h * h);
        if (end)
          to[c + 3] += 6 * f / (h * h);
      }
    };
    add(row(p.start.position), 0, 0, false, 1);
    add(row(p.start.velocity * lengths_[0]), 0, 1, false, lengths_[0]);
    add(row(p.start.acceleration * lengths_[0] * lengths_[0]), 0, 2, false,
        lengths_[0] * lengths_[0]);
    for (size_t k = 0; k + 1 < pieces; ++k) {
      const double h = lengths_[k];
      for (int order = 0; order < 3; ++order) {
        const double f = std::pow(h, order);
        auto &r = row(0);
        add(r, k, order, true, f);
        add(r, k + 1, order, false, -f);
      }
    }
    for (size_t i = 0; i < p.points.size(); ++i)
      add(row(p.points[i].value), i + 1, 0, true, 1);
    row(0)[n - 1] = 1; // no jerk in the last piece
    coefficients_ = solve(std::move(a), std::move(b));
  }

  double position(double t) const {
    size_t k = 0;
    while (k + 1 < lengths_.size() && t > lengths_[k])
      t -= lengths_[k++];
    const double x = t / lengths_[k];
    const double *c = &coefficients_[4 * k];
    return c[0] + x * (c[1] + x * (c[2] + x * c[3]));
  }

private:
  std::vector<double> lengths_;
  std::vector<double> coefficients_;
};

double timeOf(const Problem &p, size_t point) {
  double t = 0;
  for (size_t i = 0; i <= point; ++i)
    t += p.points[i].step;
  return t;
}

TEST(TimeProfileProperty, PositionsAreTheCubicCourse) {
  Random random(7);
  for (int round = 0; round < casesOf(40000); ++round) {
    const Problem p = random.problem(round % 100 == 0 ? 30 : 6);
    TimeProfile profile;
    ASSERT_EQ(planPositions(profile, p.start, p.points.data(), static_cast<int>(p.points.size())),
              PlanError::None);
    const DenseCourse oracle(p);
    const double scale = sizesOf(profile).position;
    for (int i = 0; i < 10; ++i) {
      const double t = random.uniform(0, profile.duration);
      ASSERT_NEAR(profile.at(t).position, oracle.position(t), 1e-8 * scale) << round;
    }
  }
}

TEST(TimeProfileProperty, PositionsAreReachedWithoutJumps) {
  Random random(11);
  for (int round = 0; round < casesOf(100000); ++round) {
    const Problem p = random.problem(round % 20 == 0 ? 100 : 12);
    TimeProfile profile;
    ASSERT_EQ(planPositions(profile, p.start, p.points.data(), static_cast<int>(p.points.size())),
              PlanError::None);
    expectContinuous(profile, p.start);
    const double scale = sizesOf(profile).position;
    for (size_t i = 0; i < p.points.size(); ++i)
      ASSERT_NEAR(profile.at(timeOf(p, i)).position, p.points[i].value, 1e-9 * scale) << round;
    ASSERT_EQ(profile.end.position, p.points.back().value);
    ASSERT_EQ(profile.pieces[profile.count - 1].jerk, 0.0) << round;
    // Beyond its end on and on.
    const State later = profile.at(profile.duration + 2.0);
    ASSERT_EQ(later.velocity, profile.end.velocity);
    ASSERT_NEAR(later.position, profile.end.position + 2.0 * later.velocity,
                1e-9 * (scale + std::fabs(later.velocity)));
  }
}

TEST(TimeProfileProperty, ParabolasAreReproduced) {
  Random random(13);
  for (int round = 0; round < casesOf(50000); ++round) {
    Problem p = random.problem(20);
    const State s = p.start;
    TimeProfile profile;
    const int n = static_cast<int>(p.points.size());
    // a parabola of positions
    double t = 0;
    for (TimePoint &point : p.points) {
      t += point.step;
      point.value = s.position + (s.velocity + 0.5 * s.acceleration * t) * t;
    }
    ASSERT_EQ(planPositions(profile, s, p.points.data(), n), PlanError::None);
    const double reach = std::fabs(s.position) + std::fabs(s.velocity * t) +
                         std::fabs(s.acceleration * t * t) + 1e-300;
    for (int i = 0; i < 5; ++i) {
      const double u = random.uniform(0, t);
      ASSERT_NEAR(profile.at(u).position, s.position + (s.velocity + 0.5 * s.acceleration * u) * u,
                  1e-7 * reach);
    }
    // a parabola of velocities, without a peak and not bent too much
    const double jerk = random.uniform(-0.5, 0.5) * s.acceleration / t;
    t = 0;
    for (TimePoint &point : p.points) {
      t += point.step;
      point.value = s.velocity + (s.acceleration + 0.5 * jerk * t) * t;
    }
    ASSERT_EQ(planVelocities(profile, s, p.points.data(), n), PlanError::None);
    const Sizes sizes = sizesOf(profile);
    for (int i = 0; i < 5; ++i) {
      const double u = random.uniform(0, t);
      const State expected = stride::test::movedOn(s, jerk, u);
      ASSERT_NEAR(profile.at(u).velocity, expected.velocity, 1e-9 * sizes.velocity + 1e-300);
      ASSERT_NEAR(profile.at(u).position, expected.position, 1e-9 * sizes.position + 1e-300);
    }
  }
}

TEST(TimeProfileProperty, VelocitiesStayBetweenTheirPoints) {
  Random random(29);
  for (int round = 0; round < casesOf(50000); ++round) {
    const Problem p = random.problem(12);
    TimeProfile profile;
    ASSERT_EQ(planVelocities(profile, p.start, p.points.data(), static_cast<int>(p.points.size())),
              PlanError::None);
    const double slack = 1e-9 * sizesOf(profile).velocity;
    double t = p.points[0].step;
    for (size_t i = 1; i < p.points.size(); ++i) {
      const auto [low, high] = std::minmax(p.points[i - 1].value, p.points[i].value);
      for (int k = 0; k < 4; ++k) {
        const double v = profile.at(t + random.uniform(0, 1) * p.points[i].step).velocity;
        ASSERT_GE(v, low - slack) << round;
        ASSERT_LE(v, high + slack) << round;
      }
      t += p.points[i].step;
    }
  }
}

/// The integral of what `of` picks from the state, by Simpson's rule between the corners of the
/// course, where it is exact for polynomials of third degree.
template <class Pick> double integral(const TimeProfile &profile, Pick of) {
  double sum = 0;
  for (int i = 0; i < profile.count; ++i) {
    const TimePiece &piece = profile.pieces[i];
    const double end = i + 1 < profile.count ? profile.pieces[i + 1].start : profile.duration;
    const double h = end - piece.start;
    sum +=
        h / 6 *
        (of(at(piece, piece.start)) + 4 * of(at(piece, piece.start + h / 2)) + of(at(piece, end)));
  }
  return sum;
}

TEST(TimeProfileProperty, VelocitiesAreReachedAndIntegrated) {
  Random random(17);
  for (int round = 0; round < casesOf(100000); ++round) {
    const Problem p = random.problem(round % 20 == 0 ? 100 : 12);
    TimeProfile profile;
    ASSERT_EQ(planVelocities(profile, p.start, p.points.data(), static_cast<int>(p.points.size())),
              PlanError::None);
    expectContinuous(profile, p.start);
    const Sizes sizes = sizesOf(profile);
    for (size_t i = 0; i + 1 < p.points.size(); ++i)
      ASSERT_NEAR(profile.at(timeOf(p, i)).velocity, p.points[i].value, 1e-9 * sizes.velocity);
    ASSERT_NEAR(profile.end.velocity, p.points.back().value, 1e-11 * sizes.velocity);
    ASSERT_NEAR(profile.end.position - p.start.position,
                integral(profile, [](const State &s) { return s.velocity; }),
                1e-9 * (sizes.position + sizes.velocity * profile.duration));
    ASSERT_EQ(profile.count, static_cast<int>(2 * p.points.size()));
  }
}

TEST(TimeProfileProperty, AccelerationsAreLinesAndIntegrated) {
  Random random(19);
  for (int round = 0; round < casesOf(100000); ++round) {
    const Problem p = random.problem(round % 20 == 0 ? 100 : 12);
    TimeProfile profile;
    ASSERT_EQ(
        planAccelerations(profile, p.start, p.points.data(), static_cast<int>(p.points.size())),
        PlanError::None);
    expectContinuous(profile, p.start);
    const Sizes sizes = sizesOf(profile);
    double before = p.start.acceleration;
    double t = 0;
    for (const TimePoint &point : p.points) {
      const double part = random.uniform(0, 1);
      const double expected = before + part * (point.value - before);
      ASSERT_NEAR(profile.at(t + part * point.step * (1 - 1e-12)).acceleration, expected,
                  1e-9 * sizes.acceleration);
      t += point.step;
      before = point.value;
    }
    ASSERT_NEAR(profile.end.velocity - p.start.velocity,
                integral(profile, [](const State &s) { return s.acceleration; }),
                1e-9 * (sizes.velocity + sizes.acceleration * profile.duration));
    ASSERT_NEAR(profile.end.position - p.start.position,
                integral(profile, [](const State &s) { return s.velocity; }),
                1e-9 * (sizes.position + sizes.velocity * profile.duration));
  }
}

TEST(TimeProfileProperty, DoesNotDependOnTheUnits) {
  Random random(23);
  for (int round = 0; round < casesOf(20000); ++round) {
    const Problem p = random.problem(20);
    Problem q = p;
    const double factor = std::ldexp(1.0, random.below(60) - 30);
    q.start = {p.start.position * factor, p.start.velocity * factor, p.start.acceleration * factor};
    for (TimePoint &point : q.points)
      point.value *= factor;
    for (const auto plan : {&planPositions, &planVelocities, &planAccelerations}) {
      TimeProfile a;
      TimeProfile b;
      const int n = static_cast<int>(p.points.size());
      ASSERT_EQ(plan(a, p.start, p.points.data(), n), PlanError::None);
      ASSERT_EQ(plan(b, q.start, q.points.data(), n), PlanError::None);
      for (int i = 0; i < 5; ++i) {
        const double t = random.uniform(0, 1.1 * a.duration);
        ASSERT_EQ(a.at(t).position * factor, b.at(t).position);
        ASSERT_EQ(a.at(t).velocity * factor, b.at(t).velocity);
        ASSERT_EQ(a.at(t).acceleration * factor, b.at(t).acceleration);
      }
    }
  }
}

TEST(TimeProfileProperty, RefusesWhatIsNoCourse) {
  const double nan = std::nan("");
  const State rest{0, 0, 0};
  std::vector<TimePoint> many(101, {0.001, 1.0});
  for (const auto plan : {&planPositions, &planVelocities, &planAccelerations}) {
    TimeProfile p;
    const TimePoint good[] = {{0.5, 1}, {0.5, 2}};
    EXPECT_EQ(plan(p, rest, good, 2), PlanError::None);
    EXPECT_EQ(plan(p, rest, good, 0), PlanError::InvalidLimit);
    EXPECT_EQ(p.count, 0);
    EXPECT_EQ(plan(p, rest, many.data(), 101), PlanError::InvalidLimit);
    EXPECT_EQ(plan(p, rest, many.data(), 100), PlanError::None);
    const TimePoint noStep[] = {{0.5, 1}, {0.0, 2}};
    EXPECT_EQ(plan(p, rest, noStep, 2), PlanError::InvalidState);
    const TimePoint noValue[] = {{0.5, nan}};
    EXPECT_EQ(plan(p, rest, noValue, 1), PlanError::InvalidState);
    EXPECT_EQ(plan(p, {nan, 0, 0}, good, 2), PlanError::InvalidState);
    const TimePoint far[] = {{1e-3, 1e308}, {1e-3, -1e308}};
    EXPECT_EQ(plan(p, {0, 1e308, 0}, far, 2), PlanError::Unrepresentable);
  }
}

} // namespace
