// Moves along a path whose speed changes with the pieces, by closed forms.
#include "runtime/numeric/csy/modulated_move.hpp"

#include "path_words.hpp"

#include <cmath>
#include <memory>

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

} // namespace
