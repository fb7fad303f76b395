#include "runtime/numeric/cnc/processors/stream.hpp"

namespace stride::cnc {
namespace {

bool isComplete(const Queue &queue) noexcept {
  return __atomic_load_n(&queue.endOfList, __ATOMIC_ACQUIRE) != 0;
}

void complete(Queue &queue) noexcept {
  __atomic_store_n(&queue.endOfList, uint8_t{1}, __ATOMIC_RELEASE);
}

bool isSynchronisation(const PathObject &object) noexcept {
  return object.moveType == MoveType::Function && object.switchId[0] == kSynchronise;
}

/// Who fills the queue waits until it is empty: nothing follows.
bool endsWithSynchronisation(const Queue *queue) noexcept {
  const PathObject *last = objectFromEnd(queue, 0);
  return last != nullptr && isSynchronisation(*last);
}

/// The number of the first object; 0: there is none.
int32_t firstNumber(const Queue *queue) noexcept {
  const PathObject *first = objectAt(queue, 0);
  return first != nullptr ? first->number : 0;
}

void fail(StreamState &stream, StreamError error) noexcept {
  stream.phase = StreamPhase::Failed;
  stream.error = error;
}

} // namespace

PathObject *put(Output &output, const PathObject &object) noexcept {
  if (output.count >= kMostPerStep)
    return nullptr;
  ++output.count;
  return append(output.queue, &object);
}

void startStream(StreamState &stream, Queue *output, Generator generator, bool appends) noexcept {
  stream = {};
  stream.phase = StreamPhase::Running;
  stream.named = appends;
  if (!appends)
    (void)clear(output);
  output->endOfList = 0;
  output->generator = generator;
}

void abortStream(StreamState &stream, const Queue *input) noexcept {
  const StreamPhase phase = stream.phase;
  if (phase != StreamPhase::Running && phase != StreamPhase::Draining) {
    stream.phase = StreamPhase::Idle; // already given up, or complete
    stream.error = StreamError::None;
    return;
  }
  stream.phase = StreamPhase::Idle;
  stream.broken = checkQueue(input) == QueueError::None ? phase : StreamPhase::Idle;
  if (stream.broken == StreamPhase::Idle)
    return;
  stream.first = firstNumber(input);
  stream.position = input->readPosition;
}

bool resumeStream(StreamState &stream, const Queue *input, Queue *output) noexcept {
  if (stream.broken == StreamPhase::Idle || checkQueue(input) != QueueError::None ||
      input->readPosition != stream.position ||
      (stream.first != 0 && firstNumber(input) != stream.first))
    return false;
  stream.phase = stream.broken;
  stream.broken = StreamPhase::Idle;
  output->endOfList = 0;
  return true;
}

StreamTurn turnOf(StreamState &stream, Queue *input, Queue *output, bool looksAhead) noexcept {
  if (stream.phase != StreamPhase::Running && stream.phase != StreamPhase::Draining)
    return StreamTurn::Nothing;
  if (input == output || checkQueue(input) != QueueError::None ||
      checkQueue(output) != QueueError::None) {
    fail(stream, StreamError::NoQueue);
    return StreamTurn::Nothing;
  }
  if (stream.phase == StreamPhase::Draining) {
    if (countOf(output) != 0)
      return StreamTurn::Nothing;
    // Only now who fills the input sees that all has been driven. It may have begun another path.
    if (const PathObject *first = objectAt(input, 0); first != nullptr && isSynchronisation(*first))
      (void)removeAt(input, 0);
    stream.phase = StreamPhase::Running;
  }
  if (isFull(output))
    return StreamTurn::Nothing;
  // Before the objects are looked at: the last one comes before it.
  const bool complete = isComplete(*input);
  const PathObject *first = objectAt(input, 0);
  if (first == nullptr)
    return complete ? StreamTurn::End : StreamTurn::Nothing;
  if (!stream.named) {
    __builtin_memcpy(output->programName, input->programName, sizeof output->programName);
    stream.named = true;
  }
  if (isSynchronisation(*first))
    return StreamTurn::Pause;
  if (looksAhead && !complete && !isFull(input) && !endsWithSynchronisation(input))
    return StreamTurn::Nothing;
  return StreamTurn::Take;
}

void settleStep(StreamState &stream, StreamTurn turn, Step step, Queue *input,
                Output &output) noexcept {
  if (step == Step::Failed) {
    fail(stream, output.error);
    return;
  }
  if (step == Step::Again)
    return;
  switch (turn) {
  case StreamTurn::Nothing:
    break;
  case StreamTurn::Take:
    (void)removeAt(input, 0);
    break;
  case StreamTurn::Pause:
    // After kMostPerStep objects not in this step but in the next one.
    if (const PathObject *pause = objectAt(input, 0); put(output, *pause) != nullptr)
      stream.phase = StreamPhase::Draining;
    break;
  case StreamTurn::End:
    complete(*output.queue);
    stream.phase = StreamPhase::Done;
    break;
  }
}

} // namespace stride::cnc
