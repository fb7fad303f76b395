// The reference planner: closed forms, and that its plans keep the limits that they are made for.
#include "tests/oracle/path/reference_planner.hpp"

#include "tests/oracle/path/time_optimum.hpp"
#include "tests/support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace stride::oracle;
using stride::test::Random;

constexpr double kVelocity = 250;
constexpr double kAcceleration = 1750;
constexpr double kJerk = 50000;

Cell straight(double length) { return {length, 1 / kAcceleration, 0, kVelocity * kVelocity}; }

Cell curved(double length, double radius) {
  return {length, 1 / kAcceleration, 1 / (radius * kAcceleration),
          std::min(kVelocity * kVelocity, 0.9 * radius * kAcceleration)};
}

/// Fields of any length and curvature, and stops now and then.
std::vector<Cell> randomFields(uint64_t seed) {
  Random random(seed);
  std::vector<Cell> fields;
  for (int i = 2 + random.below(12); i > 0; --i) {
    const double length = random.magnitude(-3, 2);
    fields.push_back(random.chance(0.5) ? straight(length)
                                        : curved(length, random.magnitude(-2, 2)));
    if (random.chance(0.1))
      fields.push_back({1e-9, 1 / kAcceleration, 0, 0});
  }
  return fields;
}

void expectKept(const std::vector<Cell> &fields, double jerk, const ReferencePlan &plan) {
  ASSERT_TRUE(plan.found);
  double time = 0;
  Phase state{};
  double end = 0;
  for (const Cell &field : fields)
    end += field.length;
  size_t at = 0;
  double start = 0;
  for (const Phase &phase : plan.phases) {
    time += phase.duration;
    EXPECT_LE(std::fabs(phase.jerk), jerk);
    EXPECT_NEAR(phase.way, state.way, 1e-9 * (1 + end));
    EXPECT_NEAR(phase.velocity, state.velocity, 1e-7);
    EXPECT_NEAR(phase.acceleration, state.acceleration, 1e-6 * kAcceleration);
    for (const double part : {0.0, 0.3, 0.5, 1.0}) {
      state = after(phase, part * phase.duration);
      while (at + 1 < fields.size() && state.way > start + fields[at].length + 1e-9)
        start += fields[at++].length;
      const double square = state.velocity * state.velocity;
      EXPECT_LE(square, fields[at].ceiling * (1 + 1e-9) + 1e-9);
      EXPECT_LE(fields[at].tangential * std::fabs(state.acceleration) +
                    fields[at].curvature * square,
                1 + 1e-7);
    }
  }
  EXPECT_NEAR(state.way, end, 1e-8 * (1 + end));
  EXPECT_NEAR(state.velocity, 0, 1e-7);
  EXPECT_NEAR(time, plan.time, 1e-9 * (1 + time));
}

TEST(ReferencePlanner, OfALineIsTheSCurve) {
  for (const double length : {1e-3, 0.1, 4.2875, 10.0, 44.6, 100.0, 1000.0}) {
    const std::vector<Cell> line = {straight(length)};
    const ReferencePlan plan = referencePlan(line, kJerk);
    expectKept(line, kJerk, plan);
    EXPECT_NEAR(plan.time, restToRestTime(length, kVelocity, kAcceleration, kJerk),
                1e-9 * plan.time);
  }
}

TEST(ReferencePlanner, KeepsLimitsOfRandomFields) {
  for (uint64_t seed = 0; seed < 300 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Cell> fields = randomFields(seed);
    expectKept(fields, kJerk, referencePlan(fields, kJerk));
  }
}

/// The optimum is at least as quick, and not too much quicker.
TEST(ReferencePlanner, IsSlowerThanTheOptimum) {
  double sum = 0;
  int count = 0;
  for (uint64_t seed = 500; seed < 512 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Cell> fields = randomFields(seed);
    std::vector<Cell> cells;
    for (Cell field : fields) {
      const int parts =
          field.ceiling > 0 ? std::clamp(static_cast<int>(field.length / 0.05), 4, 500) : 1;
      field.length /= parts;
      cells.insert(cells.end(), static_cast<size_t>(parts), field);
    }
    const double reference = referencePlan(fields, kJerk).time;
    const Optimum optimum = timeOptimum(cells, kJerk);
    ASSERT_TRUE(optimum.solved);
    EXPECT_GT(reference, optimum.time * 0.998);
    EXPECT_LT(reference, optimum.time * 2);
    sum += reference / optimum.time;
    ++count;
  }
  EXPECT_LT(sum / count, 1.3);
}

TEST(ReferencePlanner, StopsWhereTheCeilingIsNothing) {
  const std::vector<Cell> fields = {straight(3), {1e-9, 1, 0, 0}, straight(20)};
  const ReferencePlan plan = referencePlan(fields, kJerk);
  EXPECT_NEAR(plan.time,
              restToRestTime(3, kVelocity, kAcceleration, kJerk) +
                  restToRestTime(20, kVelocity, kAcceleration, kJerk),
              1e-9);
  const Phase middle = stateAt(plan, restToRestTime(3, kVelocity, kAcceleration, kJerk));
  EXPECT_NEAR(middle.way, 3, 1e-8);
  EXPECT_NEAR(middle.velocity, 0, 1e-6);
  EXPECT_NEAR(stateAt(plan, 99).way, 23, 1e-8);
  EXPECT_EQ(stateAt(plan, 0).way, 0);
}

/// A slow field in the middle: through the notch at its velocity, without acceleration at its ends.
TEST(ReferencePlanner, PassesANotch) {
  std::vector<Cell> fields = {straight(60), straight(0.5), straight(60)};
  fields[1].ceiling = 50 * 50;
  const ReferencePlan plan = referencePlan(fields, kJerk);
  const double rise = changeWay(0, 250, kAcceleration, kJerk);
  const double fall = changeWay(250, 50, kAcceleration, kJerk);
  EXPECT_NEAR(plan.time,
              2 * (changeTime(250, kAcceleration, kJerk) + changeTime(200, kAcceleration, kJerk) +
                   (60 - rise - fall) / 250) +
                  0.5 / 50,
              1e-9);
}

TEST(ReferencePlanner, SharesTheLimitOfACircle) {
  const double radius = 10;
  const std::vector<Cell> circle = {curved(2 * std::numbers::pi * radius, radius)};
  const ReferencePlan plan = referencePlan(circle, kJerk);
  expectKept(circle, kJerk, plan);
  EXPECT_GT(plan.time, 2 * std::acosh(std::exp(std::numbers::pi)) * std::sqrt(radius / 1750));
  EXPECT_LT(plan.time, 0.80); // at 0.9 of the limit from the start on it would be 1.5
}

TEST(ReferencePlanner, FieldsJoinCellsThatAreAlike) {
  const std::vector<Cell> cells = {straight(1),  straight(2), curved(3, 5), curved(4, 5.01),
                                   curved(5, 8), straight(6), straight(7.5)};
  const std::vector<Cell> fields = fieldsOf(cells, 1.05);
  ASSERT_EQ(fields.size(), 4U);
  EXPECT_EQ(fields[0].length, 3);
  EXPECT_EQ(fields[1].length, 7);
  EXPECT_EQ(fields[1].curvature, cells[2].curvature);
  EXPECT_EQ(fields[1].ceiling, cells[2].ceiling);
  EXPECT_EQ(fields[2].length, 5);
  EXPECT_EQ(fields[3].length, 13.5);
  EXPECT_EQ(fieldsOf(cells, 1).size(), 5U);
  EXPECT_TRUE(fieldsOf({}).empty());
}

} // namespace
