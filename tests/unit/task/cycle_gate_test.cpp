#include "runtime/task/cycle_gate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace {

using namespace std::chrono_literals;
using stride::task::CycleGate;

class CycleGates : public ::testing::TestWithParam<bool> {};

// Three threads go in and out; who holds the gate sees nobody inside, again and again.
TEST_P(CycleGates, NobodyIsInsideWhileItIsHeld) {
  const bool turns = GetParam();
  CycleGate gate({0, 1, 2}, turns);
  std::atomic<int> inside{0};
  std::atomic<int> most{0};
  std::atomic<bool> end{false};
  std::atomic<int> rounds[3]{};
  std::vector<std::thread> threads;
  for (uint32_t task = 0; task < 3; ++task)
    threads.emplace_back([&, task] {
      while (!end) {
        gate.enter(task);
        const int now = ++inside;
        int seen = most;
        while (now > seen && !most.compare_exchange_weak(seen, now)) {
        }
        std::this_thread::yield();
        --inside;
        gate.leave(task);
        ++rounds[task];
        std::this_thread::sleep_for(50us);
      }
    });
  // A busy machine may take its time to let all of them in.
  const auto deadline = std::chrono::steady_clock::now() + 60s;
  const auto allCameIn = [&] {
    return std::all_of(std::begin(rounds), std::end(rounds), [](const auto &n) { return n > 10; });
  };
  for (int i = 0; i < 300 || (!allCameIn() && std::chrono::steady_clock::now() < deadline); ++i) {
    gate.hold();
    ASSERT_EQ(inside, 0);
    std::this_thread::sleep_for(20us);
    ASSERT_EQ(inside, 0);
    gate.release();
    std::this_thread::sleep_for(30us);
  }
  end = true;
  for (std::thread &thread : threads)
    thread.join();
  for (const std::atomic<int> &count : rounds)
    EXPECT_GT(count, 10);
  if (turns) {
    EXPECT_EQ(most, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(BothWays, CycleGates, ::testing::Bool());

TEST(CycleGateTest, TheMostImportantOfThoseThatWaitIsNext) {
  CycleGate gate({2, 0, 1}, true);
  std::vector<uint32_t> order; // guarded by the gate
  std::atomic<int> waiting{0};
  gate.hold();
  std::vector<std::thread> threads;
  for (uint32_t task = 0; task < 3; ++task)
    threads.emplace_back([&, task] {
      ++waiting;
      gate.enter(task);
      order.push_back(task);
      gate.leave(task);
    });
  while (waiting != 3)
    std::this_thread::yield();
  std::this_thread::sleep_for(100ms); // until all are in enter()
  gate.release();
  for (std::thread &thread : threads)
    thread.join();
  EXPECT_EQ(order, (std::vector<uint32_t>{1, 2, 0}));
}

} // namespace
