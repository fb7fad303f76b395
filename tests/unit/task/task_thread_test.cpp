#include "runtime/task/task_thread.hpp"

#include "runtime/app/state_block.hpp"
#include "runtime/task/fault.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <stdexcept>

namespace {

using stride::task::runOnTaskThread;

constexpr uint64_t kFourGiB = uint64_t{1} << 32;

uint64_t addressOf(const void *p) { return reinterpret_cast<uint64_t>(p); }

TEST(TaskThreadTest, LocalsLieBelowFourGiBAtTheSamePlaceEachTime) {
  uint64_t first = 0;
  uint64_t second = 0;
  runOnTaskThread([&] { first = addressOf(__builtin_frame_address(0)); });
  runOnTaskThread([&] { second = addressOf(__builtin_frame_address(0)); });
  EXPECT_LT(first, kFourGiB);
  EXPECT_EQ(first, second);
}

TEST(TaskThreadTest, StacksAndStatesOfTwoApplicationsDoNotMeet) {
  const stride::app::StateBlock one(1U << 20);
  const stride::app::StateBlock two(1U << 20);
  ASSERT_TRUE(one.belowFourGiB());
  ASSERT_TRUE(two.belowFourGiB());
  runOnTaskThread([&] {
    const uint64_t outer = addressOf(__builtin_frame_address(0));
    runOnTaskThread([&] {
      const uint64_t inner = addressOf(__builtin_frame_address(0));
      const uint64_t distance = inner > outer ? inner - outer : outer - inner;
      EXPECT_GT(distance, stride::task::kTaskStack);
      for (const uint64_t stack : {outer, inner}) {
        for (const stride::app::StateBlock *state : {&one, &two}) {
          const uint64_t begin = addressOf(state->data());
          EXPECT_TRUE(stack < begin || stack >= begin + state->size());
        }
      }
    });
  });
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
