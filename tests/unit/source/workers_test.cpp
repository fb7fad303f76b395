#include "compiler/source/workers.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace stc {
namespace {

TEST(Workers, DoEachItemOnce) {
  for (const unsigned threads : {1U, 2U, 7U})
    for (const size_t items : {size_t{0}, size_t{1}, size_t{3}, size_t{1000}}) {
      std::vector<std::atomic<int>> done(items);
      std::vector<std::atomic<int>> busy(threads);
      Workers::each(items, threads, [&](size_t item, unsigned thread) {
        ASSERT_LT(thread, threads);
        EXPECT_EQ(busy[thread]++, 0);
        ++done[item];
        --busy[thread];
      });
      for (const std::atomic<int> &count : done)
        EXPECT_EQ(count, 1);
    }
}

TEST(Workers, ThrowWhatTheFirstItemThrows) {
  for (const unsigned threads : {1U, 2U, 7U})
    for (int run = 0; run < 20; ++run)
      try {
        Workers::each(100, threads, [](size_t item, unsigned) {
          if (item == 3)
            std::this_thread::yield();
          if (item >= 3)
            throw std::runtime_error(std::to_string(item));
        });
        FAIL() << "nothing was thrown";
      } catch (const std::runtime_error &e) {
        EXPECT_STREQ(e.what(), "3");
      }
}

TEST(Workers, AreAsManyAsThereIsWorkFor) {
  EXPECT_EQ(Workers(7).threadsFor(0, 0), 1U);
  EXPECT_EQ(Workers(7).threadsFor(6, 0), 6U);
  EXPECT_EQ(Workers(7).threadsFor(8, 0), 7U);
  ::setenv("STRIDE_JOBS", "2", 1);
  EXPECT_EQ(Workers().threadsFor(8, 32 * 1024 - 1), 1U);
  EXPECT_EQ(Workers().threadsFor(8, 32 * 1024), 2U);
  ::unsetenv("STRIDE_JOBS");
}

TEST(DefaultJobs, AreThoseOfTheEnvironment) {
  const unsigned own = defaultJobs();
  EXPECT_GE(own, 1U);
  ::setenv("STRIDE_JOBS", "3", 1);
  EXPECT_EQ(defaultJobs(), 3U);
  ::setenv("STRIDE_JOBS", "257", 1);
  EXPECT_EQ(defaultJobs(), 256U);
  for (const char *none : {"", "0", "-1", "two", "2x", "99999999999"}) {
    ::setenv("STRIDE_JOBS", none, 1);
    EXPECT_EQ(defaultJobs(), own) << none;
  }
  ::unsetenv("STRIDE_JOBS");
}

} // namespace
} // namespace stc
