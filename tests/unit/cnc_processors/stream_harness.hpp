// Runs a path through a processor, by queues of any size that are filled and emptied in any rhythm.
#ifndef STRIDE_TESTS_UNIT_CNC_PROCESSORS_STREAM_HARNESS_HPP
#define STRIDE_TESTS_UNIT_CNC_PROCESSORS_STREAM_HARNESS_HPP

#include "runtime/numeric/cnc/processors/stream.hpp"

#include <cstdint>
#include <random>
#include <vector>

namespace stride::cnc::test {

/// A queue with its memory.
struct OwnedQueue {
  explicit OwnedQueue(uint32_t places) : memory(places) {
    queue.structId = kQueueStructId;
    queue.buffer = reinterpret_cast<uint8_t *>(memory.data());
    queue.size = static_cast<uint32_t>(places * sizeof(PathObject));
    queue.generator = kByNobody;
  }
  OwnedQueue(const OwnedQueue &) = delete;
  OwnedQueue &operator=(const OwnedQueue &) = delete;

  std::vector<PathObject> memory;
  Queue queue{};
};

/// How a path is run.
struct Rhythm {
  uint32_t inputPlaces = 5;
  uint32_t outputPlaces = 5;
  uint32_t seed = 0;   ///< 0: each side does as much as it can in every turn.
  int32_t longest = 0; ///< Steps after which the test gives up; 0: by the number of objects.
};

struct Outcome {
  std::vector<PathObject> objects;
  StreamState stream{};
  bool ended = false; ///< Done or failed, not given up.
  int32_t steps = 0;
  int32_t most = 0; ///< Objects that one step has put out.
};

/// isSyncing() of what a processor fills.
inline bool endsWithPause(const Queue &queue) {
  const PathObject *last = objectFromEnd(&queue, 0);
  return last != nullptr && last->moveType == MoveType::Function &&
         last->switchId[0] == kSynchronise;
}

/// As SMC_NCDecoder fills a queue, and as SMC_Interpolator empties it.
template <class Processor>
Outcome runPath(Processor &processor, const std::vector<PathObject> &path,
                const Rhythm &rhythm = {}) {
  OwnedQueue input(rhythm.inputPlaces);
  OwnedQueue output(rhythm.outputPlaces);
  Outcome run;
  std::mt19937 random(rhythm.seed);
  const auto now = [&] { return rhythm.seed == 0 || random() % 3 == 0; };
  const auto limit =
      rhythm.longest != 0 ? rhythm.longest : 1000 + 50 * static_cast<int32_t>(path.size());
  startStream(run.stream, &output.queue, Processor::kGenerator, false);
  start(processor);
  size_t fed = 0;
  bool waits = false;
  while (run.steps < limit && !run.ended) {
    ++run.steps;
    waits = waits && countOf(&input.queue) != 0;
    while (fed < path.size() && !waits && !isFull(&input.queue) && now()) {
      waits = path[fed].moveType == MoveType::Function && path[fed].switchId[0] == kSynchronise;
      append(&input.queue, &path[fed++]);
    }
    if (fed == path.size() && now())
      input.queue.endOfList = 1;
    const auto before = static_cast<int32_t>(countOf(&output.queue));
    if (now())
      stepStream(run.stream, processor, &input.queue, &output.queue);
    const auto made = static_cast<int32_t>(countOf(&output.queue)) - before;
    run.most = made > run.most ? made : run.most;
    run.ended = run.stream.phase == StreamPhase::Done || run.stream.phase == StreamPhase::Failed;
    while (now() && countOf(&output.queue) != 0 &&
           (run.ended || isFull(&output.queue) || endsWithPause(output.queue))) {
      run.objects.push_back(*objectAt(&output.queue, 0));
      removeAt(&output.queue, 0);
    }
  }
  for (; countOf(&output.queue) != 0; removeAt(&output.queue, 0))
    run.objects.push_back(*objectAt(&output.queue, 0));
  return run;
}

} // namespace stride::cnc::test

#endif // STRIDE_TESTS_UNIT_CNC_PROCESSORS_STREAM_HARNESS_HPP
