// What the threads of the tasks ask of the system: a thread of its own for each test has it
// afterwards.
#include "runtime/task/realtime.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include <thread>
#include <utility>
#include <vector>

namespace {

using ::testing::HasSubstr;

template <class Work> void inThread(Work work) { std::thread(work).join(); }

int priorityOfThread(int &policy) {
  ::sched_param parameters{};
  EXPECT_EQ(::pthread_getschedparam(::pthread_self(), &policy, &parameters), 0);
  return parameters.sched_priority;
}

TEST(Realtime, APriorityNearerTo0IsAHigherOneOfTheSystem) {
  inThread([] {
    ::sched_param wanted{};
    wanted.sched_priority = 1;
    int policy = SCHED_OTHER;
    if (::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &wanted) != 0) {
      EXPECT_FALSE(stride::task::useFifo(3));
      priorityOfThread(policy);
      EXPECT_EQ(policy, SCHED_OTHER);
      return;
    }
    const std::pair<uint32_t, int> expected[] = {{0, 80}, {1, 79}, {17, 63}, {31, 49}};
    for (const auto &[task, priority] : expected) {
      EXPECT_TRUE(stride::task::useFifo(task));
      EXPECT_EQ(priorityOfThread(policy), priority);
      EXPECT_EQ(policy, SCHED_FIFO);
    }
  });
}

TEST(Realtime, LookingWhetherItIsPermittedLeavesTheThreadAsItWas) {
  inThread([] {
    int before = -1;
    const int priority = priorityOfThread(before);
    const stride::task::RealtimeReport report = stride::task::prepareRealtime();
    ::munlockall();
    int after = -1;
    EXPECT_EQ(priorityOfThread(after), priority);
    EXPECT_EQ(after, before);
    EXPECT_EQ(report.fifo, stride::task::useFifo(31));
    for (const std::string &warning : report.warnings)
      EXPECT_THAT(warning, ::testing::AnyOf(HasSubstr("SCHED_FIFO"), HasSubstr("mlockall")));
    EXPECT_EQ(report.fifo, report.warnings.empty() ||
                               report.warnings[0].find("SCHED_FIFO") == std::string::npos);
  });
}

TEST(Realtime, AThreadRunsOnTheCoreThatItIsPinnedTo) {
  inThread([] {
    ::cpu_set_t all;
    CPU_ZERO(&all);
    ASSERT_EQ(::sched_getaffinity(0, sizeof all, &all), 0);
    const std::vector<uint32_t> cores = stride::task::allowedCores();
    EXPECT_EQ(static_cast<int>(cores.size()), CPU_COUNT(&all));
    for (const uint32_t core : cores) {
      EXPECT_TRUE(CPU_ISSET(core, &all));
      EXPECT_TRUE(stride::task::pinTo(core));
      EXPECT_EQ(::sched_getcpu(), static_cast<int>(core));
    }
    EXPECT_FALSE(stride::task::pinTo(CPU_SETSIZE));
    EXPECT_FALSE(stride::task::pinTo(UINT32_MAX));
  });
}

TEST(Realtime, TimersAreExact) {
  inThread([] {
    stride::task::useExactTimers();
    EXPECT_EQ(::prctl(PR_GET_TIMERSLACK), 1);
    stride::task::touchStack(64 << 10);
  });
}

} // namespace
