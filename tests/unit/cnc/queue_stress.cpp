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

} // namespace
