#include "runtime/iec/pool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

namespace {

namespace pool = stride::pool;

constexpr uint64_t kSize = 4096;

class PoolTest : public testing::Test {
protected:
  alignas(16) stride::BYTE memory_[pool::wholeSize(kSize)] = {};

  void *allocate(uint64_t size, int64_t count = 1) {
    return pool::allocate(memory_, kSize, size, count, 7);
  }
  uint64_t offset(const void *p) const {
    return static_cast<uint64_t>(static_cast<const stride::BYTE *>(p) - memory_);
  }
};

TEST_F(PoolTest, TakesTheFirstPlaceThatIsLargeEnough) {
  void *a = allocate(16);
  void *b = allocate(100);
  void *c = allocate(16);
  EXPECT_EQ(offset(a), 32U);
  EXPECT_EQ(offset(b), 32U + 16 + 32);
  EXPECT_TRUE(pool::release(memory_, kSize, b));
  EXPECT_EQ(allocate(64), b);
  EXPECT_NE(allocate(64), nullptr);
  EXPECT_TRUE(pool::release(memory_, kSize, a));
  EXPECT_EQ(allocate(8), a);
  EXPECT_GT(offset(c), offset(b));
}

TEST_F(PoolTest, ObjectsAreZeroAndAligned) {
  void *p = allocate(24, 3);
  std::memset(p, 0xFF, 72);
  ASSERT_TRUE(pool::release(memory_, kSize, p));
  const auto *again = static_cast<stride::BYTE *>(allocate(24, 3));
  EXPECT_TRUE(std::all_of(again, again + 72, [](stride::BYTE b) { return b == 0; }));
  EXPECT_EQ(offset(again) % 16, 0U);
  const stride::PoolBlock *block = pool::find(memory_, kSize, again);
  ASSERT_NE(block, nullptr);
  EXPECT_EQ(block->count, 3U);
  EXPECT_EQ(block->elementSize, 24U);
  EXPECT_EQ(block->typeHash, 7U);
}

TEST_F(PoolTest, RefusesWhatIsNotAnObject) {
  auto *p = static_cast<stride::BYTE *>(allocate(64));
  EXPECT_FALSE(pool::release(memory_, kSize, p + 16));
  EXPECT_FALSE(pool::release(memory_, kSize, &p));
  EXPECT_TRUE(pool::release(memory_, kSize, p));
  EXPECT_FALSE(pool::release(memory_, kSize, p));
}

TEST_F(PoolTest, RefusesCountsThatCannotBe) {
  EXPECT_EQ(allocate(1, 0), nullptr);
  EXPECT_EQ(allocate(1, -1), nullptr);
  EXPECT_EQ(allocate(1, INT64_MAX), nullptr);
  EXPECT_EQ(allocate(UINT64_MAX / 2, 4), nullptr);
  EXPECT_EQ(allocate(kSize, 1), nullptr);
  EXPECT_NE(allocate(kSize - sizeof(stride::PoolBlock), 1), nullptr);
  EXPECT_EQ(allocate(1, 1), nullptr);
}

TEST_F(PoolTest, RandomUseKeepsObjectsApartAndJoinsWhatIsFree) {
  std::mt19937 random(1);
  struct Object {
    stride::BYTE *at;
    uint64_t size;
    stride::BYTE mark;
  };
  std::vector<Object> objects;
  const auto intact = [](const Object &o) {
    return std::all_of(o.at, o.at + o.size, [&](stride::BYTE b) { return b == o.mark; });
  };
  for (unsigned step = 0; step < 20000; ++step) {
    if (objects.empty() || random() % 3 != 0) {
      const uint64_t size = 1 + random() % 200;
      auto *at = static_cast<stride::BYTE *>(allocate(size));
      if (at == nullptr)
        continue;
      const auto mark = static_cast<stride::BYTE>(step);
      std::memset(at, mark, size);
      objects.push_back({at, size, mark});
    } else {
      const size_t i = random() % objects.size();
      ASSERT_TRUE(intact(objects[i]));
      ASSERT_TRUE(pool::release(memory_, kSize, objects[i].at));
      objects.erase(objects.begin() + static_cast<ptrdiff_t>(i));
    }
  }
  for (const Object &o : objects) {
    EXPECT_TRUE(intact(o));
    EXPECT_TRUE(pool::release(memory_, kSize, o.at));
  }
  EXPECT_EQ(offset(allocate(kSize - sizeof(stride::PoolBlock))), sizeof(stride::PoolBlock));
}

TEST_F(PoolTest, NextFindsObjectsInTheirOrder) {
  EXPECT_EQ(pool::next(memory_, kSize, 0), kSize);
  void *a = allocate(16);
  void *b = allocate(2000); // its bits begin in one word and end in another
  void *c = allocate(16);
  const uint64_t header = sizeof(stride::PoolBlock);
  EXPECT_EQ(pool::next(memory_, kSize, 0), offset(a) - header);
  EXPECT_EQ(pool::next(memory_, kSize, 1), offset(b) - header);
  EXPECT_EQ(pool::next(memory_, kSize, offset(b)), offset(c) - header);
  EXPECT_EQ(pool::next(memory_, kSize, offset(c)), kSize);
  ASSERT_TRUE(pool::release(memory_, kSize, b));
  EXPECT_EQ(pool::next(memory_, kSize, 1), offset(c) - header);
  EXPECT_EQ(allocate(2000), b);
}

} // namespace
