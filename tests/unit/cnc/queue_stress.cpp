// A queue under ThreadSanitizer: one thread appends paths, one reads and removes them. Nothing is
// lost, torn or out of order, and the second one knows where each path begins.
#include "runtime/numeric/cnc/queue.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace {

using namespace stride::cnc;

constexpr int32_t kPaths = 100;
constexpr int32_t kObjects = 40; ///< Of a path: more than the memory holds.

struct Shared {
  std::vector<PathObject> places = std::vector<PathObject>(9);
  Queue queue{};
  Shared() {
    queue.structId = kQueueStructId;
    queue.buffer = reinterpret_cast<uint8_t *>(places.data());
    queue.size = static_cast<uint32_t>(places.size() * sizeof(PathObject));
  }
};

/// Every member that is looked at says which object it is.
PathObject objectOf(int32_t number) {
  PathObject object{};
  object.number = object.sentence = number;
  object.velocity = object.limits[8].deceleration = static_cast<float>(number);
  return object;
}

void fill(Queue &queue) {
  for (int32_t path = 0; path < kPaths; ++path) {
    for (int32_t i = 0; i < kObjects;) {
      const PathObject object = objectOf(path * kObjects + i);
      if (append(&queue, &object) != nullptr)
        ++i;
      else
        std::this_thread::yield();
    }
    __atomic_store_n(&queue.endOfList, uint8_t{1}, __ATOMIC_RELEASE);
    while (countOf(&queue) != 0)
      std::this_thread::yield();
    __atomic_store_n(&queue.endOfList, uint8_t{0}, __ATOMIC_RELEASE);
  }
}

TEST(CncQueueStress, LosesNothingBetweenTwoThreads) {
  Shared shared;
  std::thread filler([&] { fill(shared.queue); });
  Queue *queue = &shared.queue;
  int32_t wrong = 0;
  for (int32_t number = 0; number < kPaths * kObjects;) {
    const PathObject *object = objectAt(queue, 0);
    // The last one of a path waits until the path is complete, as an interpolator does.
    const bool last = number % kObjects == kObjects - 1;
    if (object == nullptr || (last && __atomic_load_n(&queue->endOfList, __ATOMIC_ACQUIRE) == 0)) {
      std::this_thread::yield();
      continue;
    }
    wrong += object->number != number || object->sentence != number ||
             object->velocity != object->limits[8].deceleration;
    wrong += !removeAt(queue, 0);
    const auto removed = static_cast<uint32_t>(number % kObjects + 1);
    if (!last) // then the next path may have begun
      wrong += queue->removed != removed || historyOf(queue) > removed;
    ++number;
  }
  filler.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(countOf(queue), 0U);
}

/// As SMC_CheckVelocities, in the thread that appends.
void fillAndCheck(Queue &queue, int32_t count) {
  uint32_t fresh = 0;
  for (int32_t i = 0; i < count;) {
    PathObject object = objectOf(i);
    object.velocityEnd = 1;
    if (append(&queue, &object) == nullptr) {
      std::this_thread::yield();
      continue;
    }
    ++i;
    ++fresh;
    if (i % 3 == 0) // not after each one
      continue;
    for (uint32_t n = fresh; n > 0; --n)
      if (PathObject *before = objectFromEnd(&queue, n); before != nullptr)
        before->velocityEnd = 0;
    fresh = 0;
    tellChecked(&queue, queue.writePosition);
  }
  __atomic_store_n(&queue.endOfList, uint8_t{1}, __ATOMIC_RELEASE);
}

TEST(CncQueueStress, WhatIsCheckedIsSoForTheOtherThread) {
  constexpr int32_t kCount = 1001;
  static_assert(kCount % 3 != 0, "the last one is checked");
  Shared shared;
  tellChecked(&shared.queue, 0);
  std::thread filler([&] { fillAndCheck(shared.queue, kCount); });
  Queue *queue = &shared.queue;
  int32_t wrong = 0;
  for (int32_t number = 0; number < kCount;) {
    const uint32_t count = countOf(queue);
    const uint32_t unchecked = uncheckedOf(queue);
    const bool last = number + 1 == kCount;
    if (count < unchecked + (last ? 1 : 2)) {
      std::this_thread::yield();
      continue;
    }
    const PathObject *object = objectAt(queue, 0);
    wrong += object->number != number || (!last && object->velocityEnd != 0);
    wrong += !removeAt(queue, 0);
    ++number;
  }
  filler.join();
  EXPECT_EQ(wrong, 0);
}

} // namespace
