#include "runtime/task/task_thread.hpp"

#include "runtime/app/state_block.hpp"
#include "runtime/iec/data_stack.h"
#include "runtime/task/fatal.hpp"
#include "runtime/task/fault.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <sys/mman.h>
#include <vector>

namespace {

using stride::task::runOnTaskThread;

using stride::app::kFourGiB;

uint64_t addressOf(const void *p) { return reinterpret_cast<uint64_t>(p); }

TEST(TaskThreadTest, TheStackOfCppIsFarFromWhatStReaches) {
  runOnTaskThread([&] { EXPECT_GT(addressOf(__builtin_frame_address(0)), kFourGiB); });
}

/// The data stack that a call has.
struct Seen {
  stride::Ctx ctx{};
  uint64_t top = 0;
  uint64_t end = 0;

  static void look(stride::Ctx *ctx) {
    auto *seen = reinterpret_cast<Seen *>(ctx);
    seen->top = addressOf(ctx->dataTop);
    seen->end = addressOf(ctx->dataEnd);
  }
};

TEST(TaskThreadTest, DataStacksLieBelowFourGiBAtTheSamePlaceEachTime) {
  Seen first;
  Seen second;
  for (Seen *seen : {&first, &second}) {
    runOnTaskThread([&] {
      const stride::task::MemoryGuard guard;
      ASSERT_FALSE(stride::task::guardedCall(Seen::look, seen->ctx));
    });
    EXPECT_EQ(seen->ctx.dataTop, nullptr);
  }
  EXPECT_NE(first.top, 0U);
  EXPECT_EQ(first.end - first.top, stride::task::kDataStack);
  EXPECT_LT(first.end, kFourGiB);
  EXPECT_EQ(first.top, second.top);
}

/// How many pages from the lower end of the thread's data stack on are in memory.
size_t pagesInMemory() {
  const stride::task::DataStackRange range = stride::task::dataStack();
  std::vector<unsigned char> pages((range.high - range.low) / 4096);
  EXPECT_EQ(::mincore(reinterpret_cast<void *>(range.low), range.high - range.low, pages.data()),
            0);
  const auto in = [](unsigned char page) { return (page & 1U) != 0; };
  return static_cast<size_t>(std::find_if_not(pages.begin(), pages.end(), in) - pages.begin());
}

TEST(TaskThreadTest, AsMuchOfTheDataStackIsTouchedAsIsAskedForAndThere) {
  runOnTaskThread([&] {
    stride::task::touchDataStack(4096); // there is none
    const stride::task::MemoryGuard guard;
    EXPECT_EQ(pagesInMemory(), 0U);
    stride::task::touchDataStack(3 * 4096 + 1);
    EXPECT_GE(pagesInMemory(), 4U);
    stride::task::touchDataStack(stride::task::kDataStack); // and not what lies above it
    EXPECT_EQ(pagesInMemory(), stride::task::kDataStack / 4096);
    stride::task::touchDataStack(SIZE_MAX);
  });
}

TEST(TaskThreadTest, DataStacksAndStatesOfTwoApplicationsAreApart) {
  const stride::app::StateBlock one(1U << 20);
  const stride::app::StateBlock two(1U << 20);
  ASSERT_TRUE(one.belowFourGiB());
  ASSERT_TRUE(two.belowFourGiB());
  runOnTaskThread([&] {
    const stride::task::MemoryGuard guard;
    const stride::task::DataStackRange outer = stride::task::dataStack();
    runOnTaskThread([&] {
      const stride::task::MemoryGuard innerGuard;
      const stride::task::DataStackRange inner = stride::task::dataStack();
      const auto range = [](const stride::app::StateBlock &state) {
        return stride::task::DataStackRange{addressOf(state.data()),
                                            addressOf(state.data()) + state.size()};
      };
      const stride::task::DataStackRange all[] = {range(one), range(two), outer, inner};
      for (const auto &a : all) {
        for (const auto &b : all) {
          EXPECT_TRUE(&a == &b || a.low >= b.high + stride::app::LowMemory::kGuard ||
                      b.low >= a.high + stride::app::LowMemory::kGuard);
        }
      }
    });
  });
}

/// Takes places, raises and calls once more within.
void nested(stride::Ctx *ctx) {
  const stride::OnDataStack<stride::LINT> outer(*ctx);
  const char *const top = ctx->dataTop;
  const auto inner = stride::task::guardedCall(
      [](stride::Ctx *c) {
        stride::OnDataStack<stride::LINT[1000]> large(*c);
        *reinterpret_cast<volatile int *>(uint64_t{0x10}) = large.value()[0] == 0 ? 1 : 2;
      },
      *ctx);
  EXPECT_EQ(inner->code(), stride::ExceptionCode::AccessViolation);
  EXPECT_EQ(ctx->dataTop, top);
  stride::OnDataStack<stride::LINT> second(*ctx);
  EXPECT_EQ(reinterpret_cast<char *>(&second.value()), top);
  *reinterpret_cast<volatile int *>(uint64_t{0x10}) = 1;
}

TEST(TaskThreadTest, CallsWithinCallsGiveTheirPlacesBack) {
  runOnTaskThread([] {
    const stride::task::MemoryGuard guard;
    stride::Ctx ctx{};
    const auto outer = stride::task::guardedCall(nested, ctx);
    ASSERT_TRUE(outer.has_value());
    EXPECT_EQ(outer->code(), stride::ExceptionCode::AccessViolation);
    EXPECT_EQ(ctx.dataTop, nullptr);
  });
}

void storeInCode(stride::Ctx *) {
  *reinterpret_cast<volatile char *>(reinterpret_cast<uintptr_t>(&storeInCode)) = 0;
}
void storeInConstant(stride::Ctx *) {
  static constexpr char kText[] = "constant";
  *const_cast<volatile char *>(kText) = 0;
}

TEST(TaskThreadTest, CodeAndConstantsAreNotWritten) {
  runOnTaskThread([] {
    const stride::task::MemoryGuard guard;
    for (const auto store : {storeInCode, storeInConstant}) {
      stride::Ctx ctx{};
      const auto exception = stride::task::guardedCall(store, ctx);
      ASSERT_TRUE(exception.has_value());
      EXPECT_EQ(exception->code(), stride::ExceptionCode::AccessViolation);
    }
  });
}

TEST(FatalReportTest, SaysWhatHappenedOutsideOfSt) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(
      {
        const stride::task::FatalReport report(3);
        stride::task::noteCycle("Motion", 12);
        *reinterpret_cast<volatile int *>(uint64_t{0x30}) = 1;
      },
      ::testing::ExitedWithCode(3),
      "error: fatal: invalid memory access at 0x30 outside of ST \\(task Motion, cycle 12\\)");
  EXPECT_EXIT(
      {
        const stride::task::FatalReport report(3);
        std::abort();
      },
      ::testing::ExitedWithCode(3), "error: fatal: the runtime found itself damaged");
}

TEST(FatalReportTest, WithoutItSignalsEndTheProcessAsUsual) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(
      {
        const stride::task::MemoryGuard guard;
        *reinterpret_cast<volatile int *>(uint64_t{0x30}) = 1;
      },
      ::testing::KilledBySignal(SIGSEGV), "");
}

TEST(TaskThreadTest, ExceptionsArePassedOn) {
  EXPECT_THROW(runOnTaskThread([] { throw std::runtime_error("x"); }), std::runtime_error);
}

[[gnu::noinline]] int dig(int depth) {
  volatile char frame[4096];
  frame[0] = static_cast<char>(depth);
  return depth == 0 ? 0 : dig(depth - 1) + frame[0];
}

void digForever(stride::Ctx *) { static_cast<void>(dig(100'000'000)); }
void touchWildMemory(stride::Ctx *) { *reinterpret_cast<volatile int *>(uint64_t{0x10}) = 1; }

TEST(TaskThreadTest, OverflowsAndWildPointersEndTheCallOnly) {
  runOnTaskThread([] {
    const stride::task::MemoryGuard guard;
    stride::Ctx ctx{};
    const auto overflow = stride::task::guardedCall(digForever, ctx);
    ASSERT_TRUE(overflow.has_value());
    EXPECT_EQ(overflow->code(), stride::ExceptionCode::StackOverflow);
    const auto wild = stride::task::guardedCall(touchWildMemory, ctx);
    ASSERT_TRUE(wild.has_value());
    EXPECT_EQ(wild->code(), stride::ExceptionCode::AccessViolation);
  });
}

} // namespace
