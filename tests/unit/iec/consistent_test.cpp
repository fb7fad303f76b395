#include "runtime/iec/consistent.h"

#include <gtest/gtest.h>

#include <cstddef>

namespace {

struct Value {
  int32_t a, b;
};

struct State {
  Value value;
  stride::Consistent<Value, 3, 2> copies; // task 0 writes, tasks 1 and 2 read
};

class ConsistentTest : public testing::Test {
protected:
  State state_{};
  stride::Ctx ctx_{};

  ConsistentTest() { ctx_.state = &state_; }

  int32_t seen(uint32_t task) {
    ctx_.taskIndex = task;
    return stride::seen<Value>(ctx_, offsetof(State, copies)).a;
  }
  void take(uint32_t task) {
    ctx_.taskIndex = task;
    state_.copies.take(ctx_, task - 1);
  }
  void give(int32_t a) {
    state_.value.a = a;
    state_.copies.give(state_.value);
  }
};

TEST_F(ConsistentTest, BeforeTheTasksRunAllSeeTheVariable) {
  state_.copies.begin(ctx_, state_.value);
  state_.value.a = 5;
  EXPECT_EQ(seen(0), 5);
  EXPECT_EQ(seen(1), 5);
  EXPECT_EQ(seen(2), 5);
}

TEST_F(ConsistentTest, AReaderKeepsItsCopyUntilItTakesTheNext) {
  state_.value.a = 1;
  state_.copies.settle(ctx_, state_.value, {1, 2});
  state_.value.a = 2; // in the middle of the writer's cycle
  EXPECT_EQ(seen(0), 2);
  EXPECT_EQ(seen(1), 1);
  take(1);
  EXPECT_EQ(seen(1), 1) << "nothing has been given";
  give(3);
  EXPECT_EQ(seen(1), 1);
  take(1);
  EXPECT_EQ(seen(1), 3);
  EXPECT_EQ(seen(2), 1);
  for (int32_t a = 4; a < 20; ++a) { // the writer is faster
    give(a);
    EXPECT_EQ(seen(1), 3);
  }
  take(1);
  take(1); // so is the reader
  EXPECT_EQ(seen(1), 19);
  take(2);
  EXPECT_EQ(seen(2), 19);
}

} // namespace
