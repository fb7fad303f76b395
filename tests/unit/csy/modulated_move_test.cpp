// Moves along a path whose speed changes with the pieces, by closed forms.
#include "runtime/numeric/csy/modulated_move.hpp"

#include "path_words.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace {

using namespace stride::csy;
using stride::test::pathWords;

std::unique_ptr<Trajectory> threeLines() {
  auto table = std::make_unique<TrajectoryTable>();
  auto trajectory = std::make_unique<Trajectory>();
  const std::vector<int16_t> words = pathWords({{}, {.x = 100}, {.x = 150}, {.x = 250}});
  EXPECT_EQ(readTable(words.data(), static_cast<uint32_t>(words.size()), kMostPoints, *table).error,
            PathError::None);
  EXPECT_EQ(computeTrajectory(*table, *trajectory).error, PathError::None);
  return trajectory;
}

double durationOf(ModulatedMove &move) {
  double time = 0;
  while (!advance(move, 1e-4).done)
    time += 1e-4;
  return time;
}

TEST(CsyModulatedMove, IsSlowWhereThePathSaysSo) {
  const auto trajectory = threeLines();
  const double speed[] = {20, 10, 40};
  auto move = std::make_unique<ModulatedMove>();
  ASSERT_TRUE(beginMove(*trajectory, speed, {0, 100, 50}, 0, 250, *move));
  // 0 to 20, down to 10 where the second line begins, up to 40, down to 0.
  const double first = 0.2 + (100 - 2 - 3) / 20.0 + 0.2;
  const double third = 0.3 + (100 - 7.5 - 16) / 40.0 + 0.8;
  EXPECT_NEAR(durationOf(*move), first + 5 + third, 2e-4);
  EXPECT_EQ(advance(*move, 1).position, 250.0);
}

TEST(CsyModulatedMove, RunsBackwardsAndKeepsTheMastersSpeed) {
  const auto trajectory = threeLines();
  const double speed[] = {20, 10, 40};
  auto move = std::make_unique<ModulatedMove>();
  ASSERT_TRUE(beginMove(*trajectory, speed, {16, 100, 50}, 240, 30, *move));
  const double last = 90; // on the third line, from 240 to 150
  const double time = 0.16 + (last - 1.28 - (256 - 100) / 100.0) / 16 + 0.12 + 5 + 0.06 +
                      (70 - (256 - 100) / 200.0 - 256 / 100.0) / 16 + 0.32;
  EXPECT_NEAR(durationOf(*move), time, 2e-4);
  EXPECT_EQ(advance(*move, 1).position, 30.0);
}

TEST(CsyModulatedMove, RefusesWhatIsNotOnThePath) {
  const auto trajectory = threeLines();
  const double speed[] = {20, 10, 40};
  const double still[] = {20, 0, 40};
  auto move = std::make_unique<ModulatedMove>();
  EXPECT_FALSE(beginMove(*trajectory, speed, {0, 100, 50}, 0, 250.1, *move));
  EXPECT_FALSE(beginMove(*trajectory, speed, {0, 100, 50}, 0, -0.1, *move));
  EXPECT_FALSE(beginMove(*trajectory, speed, {0, 100, 50}, 0, std::nan(""), *move));
  EXPECT_FALSE(beginMove(*trajectory, speed, {0, 0, 50}, 0, 250, *move));
  EXPECT_FALSE(beginMove(*trajectory, still, {0, 100, 50}, 0, 250, *move));
  EXPECT_TRUE(beginMove(*trajectory, still, {0, 100, 50}, 10, 90, *move));
  EXPECT_TRUE(beginMove(*trajectory, still, {0, 100, 50}, 90, 90, *move));
  EXPECT_TRUE(advance(*move, 0).done);
}

TEST(CsyModulatedMove, BrakesToRestWhereverItIs) {
  const auto trajectory = threeLines();
  const double speed[] = {20, 10, 40};
  auto move = std::make_unique<ModulatedMove>();
  ASSERT_TRUE(beginMove(*trajectory, speed, {0, 100, 50}, 0, 250, *move));
  EXPECT_EQ(brake(*move, 50, 0.01).position, 0.0); // not begun yet
  EXPECT_TRUE(brake(*move, 50, 0.01).done);
  while (advance(*move, 1e-3).velocity < 19.999) {
  }
  const double at = move->position;
  MasterState state{};
  int steps = 0;
  do
    state = brake(*move, 80, 0.004);
  while (++steps < 1000 && !state.done);
  EXPECT_EQ(steps, 63); // 0.25 s
  EXPECT_NEAR(state.position, at + 20.0 * 20.0 / 160.0, 1e-9);
  EXPECT_EQ(state.velocity, 0.0);
  EXPECT_EQ(brake(*move, 80, 0.004).position, state.position);
  // From there another move goes on.
  ASSERT_TRUE(beginMove(*trajectory, speed, {0, 100, 50}, state.position, 250, *move));
  durationOf(*move);
  EXPECT_EQ(move->position, 250.0);
}

TEST(CsyModulatedMove, BrakesNoFurtherThanItsTarget) {
  const auto trajectory = threeLines();
  const double speed[] = {20, 10, 40};
  for (const double deceleration : {50.0, 49.0, 5.0}) { // as the move, and less
    auto move = std::make_unique<ModulatedMove>();
    ASSERT_TRUE(beginMove(*trajectory, speed, {0, 100, 50}, 240, 30, *move));
    while (advance(*move, 1e-3).position > 31) {
    }
    MasterState state{};
    do
      state = brake(*move, deceleration, 0.004);
    while (!state.done);
    EXPECT_GE(state.position, 30.0);
    EXPECT_LT(state.position, 30.0 + 1e-9);
    EXPECT_EQ(state.velocity, 0.0);
  }
}

/// Greatest acceleration, and greatest change of it in a step, by differences.
struct Course {
  double time, steepest, hardest;
};

Course courseOf(ModulatedMove &move, double step) {
  Course course{};
  double velocity = 0;
  double acceleration = 0;
  bool done = false;
  while (!done) {
    const MasterState state = advance(move, step);
    const double next = (state.velocity - velocity) / step;
    course.hardest = std::max(course.hardest, std::fabs(next));
    course.steepest = std::max(course.steepest, std::fabs(next - acceleration));
    velocity = state.velocity;
    acceleration = next;
    course.time += step;
    done = state.done;
  }
  return course;
}

TEST(CsyModulatedMove, ShapesItsRampsWithoutMoreTime) {
  const auto trajectory = threeLines();
  const double speed[] = {20, 10, 40};
  for (const double shape : {1.25, 1.5, 1.75, 2.0}) {
    auto move = std::make_unique<ModulatedMove>();
    ASSERT_TRUE(beginMove(*trajectory, speed, {0, 100, 50, shape}, 0, 250, *move));
    EXPECT_NEAR(durationOf(*move), 0.2 + 95 / 20.0 + 0.2 + 5 + 0.3 + 76.5 / 40.0 + 0.8, 2e-4)
        << shape;
    EXPECT_EQ(move->position, 250.0);
    // Half of a ramp's time: half of its speed; the peak: the mean by the shape.
    ASSERT_TRUE(beginMove(*trajectory, speed, {0, 100, 50, shape}, 0, 250, *move));
    EXPECT_NEAR(advance(*move, 0.1).velocity, 10, 1e-9);
    EXPECT_NEAR((advance(*move, 1e-6).velocity - 10) / 1e-6, 100 * shape, 0.1) << shape;
    ASSERT_TRUE(beginMove(*trajectory, speed, {0, 100, 50, shape}, 0, 250, *move));
    const Course course = courseOf(*move, 1e-4);
    EXPECT_LT(course.hardest, 100 * shape * (1 + 1e-6));
    // The shortest ramp lasts 0.2 s; its acceleration rises in 1 - 1 / shape of that.
    EXPECT_LT(course.steepest, 1.01 * 100 * shape * 1e-4 / (0.2 * (1 - 1 / shape))) << shape;
  }
}

TEST(CsyModulatedMove, LeadsOneRampOverSeveralPieces) {
  const auto trajectory = threeLines();
  const double free[] = {500, 500, 500};
  auto move = std::make_unique<ModulatedMove>();
  // Up to 187.08 after 175 mm, on the third line, and down on it.
  ASSERT_TRUE(beginMove(*trajectory, free, {0, 100, 700.0 / 3, 1.5}, 0, 250, *move));
  EXPECT_EQ(move->legs, 1U);
  const Course one = courseOf(*move, 1e-3);
  EXPECT_NEAR(one.time, std::sqrt(2 * 175 / 100.0) * (1 + 3 / 7.0), 2e-3);
  EXPECT_LT(one.steepest, 0.02 * 233 * 1.5);
  // One ramp has 141.42 mm/s at the end of the first line if it is steady, and 166.2 mm/s with this
  // shape: where that is too fast the first line has a ramp of its own. Neither takes more time.
  for (const double limit : {142.0, 166.0, 167.0}) {
    const double tight[] = {limit, 500, 500};
    ASSERT_TRUE(beginMove(*trajectory, tight, {0, 100, 700.0 / 3}, 0, 250, *move));
    const double steady = durationOf(*move);
    ASSERT_TRUE(beginMove(*trajectory, tight, {0, 100, 700.0 / 3, 1.5}, 0, 250, *move));
    EXPECT_EQ(move->legs, limit < 166.2 ? 2U : 1U) << limit;
    EXPECT_NEAR(durationOf(*move), steady, 2e-4) << limit;
    ASSERT_TRUE(beginMove(*trajectory, tight, {0, 100, 700.0 / 3, 1.5}, 0, 250, *move));
    double most = 0;
    while (move->position < 100)
      most = std::max(most, advance(*move, 1e-4).velocity);
    EXPECT_LE(most, limit + 0.02) << limit;
  }
}

TEST(CsyModulatedMove, ShapesItsWayBackAsItsWayThere) {
  const auto trajectory = threeLines();
  const double speed[] = {30, 60, 45};
  auto there = std::make_unique<ModulatedMove>();
  auto back = std::make_unique<ModulatedMove>();
  ASSERT_TRUE(beginMove(*trajectory, speed, {0, 90, 40, 1.75}, 0, 250, *there));
  ASSERT_TRUE(beginMove(*trajectory, speed, {0, 40, 90, 1.75}, 250, 0, *back));
  const double whole = durationOf(*there);
  ASSERT_TRUE(beginMove(*trajectory, speed, {0, 90, 40, 1.75}, 0, 250, *there));
  advance(*back, whole - std::floor(whole / 0.01) * 0.01);
  std::vector<double> places;
  for (double time = whole - std::floor(whole / 0.01) * 0.01; time < whole - 0.005; time += 0.01) {
    places.push_back(back->position);
    advance(*back, 0.01);
  }
  for (size_t i = places.size(); i-- > 0;)
    ASSERT_NEAR(advance(*there, 0.01).position, places[i], 0.02) << i;
}

} // namespace
