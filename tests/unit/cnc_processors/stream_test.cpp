// The stream that all path processors are in: what goes in comes out, in any rhythm.
#include "tests/unit/cnc_processors/stream_harness.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::test;

/// Puts each object out as often as it says in `sentence`, the last one only when it knows the
/// next.
struct Repeating {
  static constexpr Generator kGenerator = kByScaleQueue;
  static constexpr bool kLooksAhead = false;
  PathObject held;
  int32_t left; ///< How often it is still to be put out.
  int32_t paused, ended;
};

bool spill(Repeating &p, Output &output) {
  while (p.left > 0 && output.count < kMostPerStep) {
    put(output, p.held);
    --p.left;
  }
  return p.left == 0;
}
void start(Repeating &p) { p.left = 0; }
Step next(Repeating &p, const Source &source, Output &output) {
  if (!spill(p, output))
    return Step::Again;
  p.held = source.object;
  p.left = p.held.sentence;
  return Step::Took;
}
Step finish(Repeating &p, Ending ending, Output &output) {
  if (!spill(p, output))
    return Step::Again;
  ++(ending == Ending::Pause ? p.paused : p.ended);
  return Step::Took;
}

/// Needs the object after the next one.
struct Counting {
  static constexpr Generator kGenerator = kByAvoidLoop;
  static constexpr bool kLooksAhead = true;
  uint32_t fewest; ///< That it has seen before the end, less the places that are left.
};
void start(Counting &p) { p.fewest = UINT32_MAX; }
Step next(Counting &p, const Source &source, Output &output) {
  if (source.queue->endOfList == 0 && countOf(source.queue) < p.fewest)
    p.fewest = countOf(source.queue);
  put(output, source.object);
  return Step::Took;
}
Step finish(Counting & /*p*/, Ending /*ending*/, Output & /*output*/) { return Step::Took; }

/// Refuses the number 7.
struct Refusing {
  static constexpr Generator kGenerator = kByAvoidLoop;
  static constexpr bool kLooksAhead = false;
};
void start(Refusing & /*p*/) {}
Step next(Refusing & /*p*/, const Source &source, Output &output) {
  if (source.object.number != 7) {
    put(output, source.object);
    return Step::Took;
  }
  output.error = StreamError::InvalidParameter;
  return Step::Failed;
}
Step finish(Refusing & /*p*/, Ending /*ending*/, Output & /*output*/) { return Step::Took; }

PathObject numbered(int32_t number, int32_t times) {
  PathObject object{};
  object.moveType = MoveType::Line;
  object.number = number;
  object.sentence = times;
  return object;
}

PathObject pause(int32_t number) {
  PathObject object = numbered(number, 1);
  object.moveType = MoveType::Function;
  object.switchId[0] = kSynchronise;
  return object;
}

std::vector<PathObject> pathOf(int32_t count) {
  std::vector<PathObject> path;
  for (int32_t i = 0; i < count; ++i)
    path.push_back(i % 17 == 11 ? pause(i) : numbered(i, i * 5 % 9));
  return path;
}

std::vector<int32_t> numbersOf(const std::vector<PathObject> &path, bool repeated) {
  std::vector<int32_t> numbers;
  for (const PathObject &object : path)
    for (int32_t i = 0; i < (repeated ? object.sentence : 1); ++i)
      numbers.push_back(object.number);
  return numbers;
}

TEST(CncStream, LosesNothingInAnyRhythm) {
  const std::vector<PathObject> path = pathOf(60);
  const std::vector<int32_t> expected = numbersOf(path, true);
  for (uint32_t seed = 0; seed < 200; ++seed) {
    Repeating processor{};
    const Outcome run = runPath(processor, path, {5 + seed % 7, 5 + seed % 5, seed, 100000});
    ASSERT_EQ(run.stream.phase, StreamPhase::Done) << seed;
    ASSERT_EQ(numbersOf(run.objects, false), expected) << seed;
    EXPECT_LE(run.most, kMostPerStep);
    EXPECT_EQ(processor.paused, 3);
    EXPECT_EQ(processor.ended, 1);
  }
}

TEST(CncStream, GoesOnAfterASynchronisationWhenItsOutputIsEmpty) {
  OwnedQueue input(8);
  OwnedQueue output(8);
  StreamState stream{};
  Repeating processor{};
  startStream(stream, &output.queue, Repeating::kGenerator, false);
  EXPECT_EQ(output.queue.generator, kByScaleQueue);
  const PathObject first = numbered(1, 4);
  const PathObject wait = pause(2);
  append(&input.queue, &first);
  append(&input.queue, &wait);
  for (int i = 0; i < 10; ++i)
    stepStream(stream, processor, &input.queue, &output.queue);
  // All four and the pause; the pause stays in the input, so that the decoder waits.
  EXPECT_EQ(countOf(&output.queue), 5U);
  EXPECT_EQ(countOf(&input.queue), 1U);
  EXPECT_EQ(stream.phase, StreamPhase::Draining);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(countOf(&input.queue), 1U);
    removeAt(&output.queue, 0);
    stepStream(stream, processor, &input.queue, &output.queue);
  }
  EXPECT_EQ(countOf(&input.queue), 0U);
  EXPECT_EQ(stream.phase, StreamPhase::Running);
  input.queue.endOfList = 1;
  stepStream(stream, processor, &input.queue, &output.queue);
  EXPECT_EQ(stream.phase, StreamPhase::Done);
  EXPECT_EQ(output.queue.endOfList, 1);
  stepStream(stream, processor, &input.queue, &output.queue);
  EXPECT_EQ(processor.ended, 1);
}

TEST(CncStream, WhoLooksAheadBeginsWhenTheQueueIsFull) {
  const std::vector<PathObject> path = pathOf(40);
  for (const uint32_t places : {5U, 6U, 20U}) {
    Counting processor{};
    std::vector<PathObject> lines;
    for (const PathObject &object : path)
      if (object.moveType == MoveType::Line)
        lines.push_back(object);
    const Outcome run = runPath(processor, lines, {places, 5, places, 100000});
    EXPECT_EQ(run.stream.phase, StreamPhase::Done);
    EXPECT_EQ(numbersOf(run.objects, false), numbersOf(lines, false));
    EXPECT_EQ(processor.fewest, places - kReservedPlaces);
  }
}

TEST(CncStream, StopsAtAnErrorAndKeepsWhatThereIs) {
  Refusing processor{};
  const Outcome run = runPath(processor, pathOf(11));
  EXPECT_EQ(run.stream.phase, StreamPhase::Failed);
  EXPECT_EQ(run.stream.error, StreamError::InvalidParameter);
  EXPECT_EQ(run.objects.size(), 7U);
}

TEST(CncStream, RefusesWhatIsNoQueue) {
  OwnedQueue input(8);
  OwnedQueue output(8);
  Repeating processor{};
  Queue damaged = input.queue;
  damaged.readPosition = 13;
  Queue *const wrong[] = {nullptr, &output.queue, &damaged};
  for (Queue *queue : wrong) {
    StreamState stream{};
    startStream(stream, &output.queue, Repeating::kGenerator, false);
    stepStream(stream, processor, queue, &output.queue);
    EXPECT_EQ(stream.phase, StreamPhase::Failed);
    EXPECT_EQ(stream.error, StreamError::NoQueue);
  }
}

TEST(CncStream, AppendsToWhatIsThere) {
  OwnedQueue input(20);
  OwnedQueue output(20);
  StreamState stream{};
  Repeating processor{};
  std::strcpy(input.queue.programName, "Bracket");
  for (const bool append : {false, true, false}) {
    startStream(stream, &output.queue, Repeating::kGenerator, append);
    start(processor);
    EXPECT_EQ(output.queue.endOfList, 0);
    const PathObject object = numbered(3, 2);
    stride::cnc::append(&input.queue, &object);
    input.queue.endOfList = 1;
    for (int i = 0; i < 4; ++i)
      stepStream(stream, processor, &input.queue, &output.queue);
    EXPECT_EQ(stream.phase, StreamPhase::Done);
    EXPECT_EQ(countOf(&output.queue), append ? 4U : 2U);
    EXPECT_STREQ(output.queue.programName, "Bracket");
  }
}

/// What a processor has held back when it was given up comes out when the path goes on.
TEST(CncStream, GoesOnAfterAnAbort) {
  OwnedQueue input(20);
  OwnedQueue output(20);
  StreamState stream{};
  Repeating processor{};
  startStream(stream, &output.queue, Repeating::kGenerator, false);
  start(processor);
  EXPECT_FALSE(resumeStream(stream, &input.queue, &output.queue)); // it is at work
  const auto feed = [&](int32_t number) {
    const PathObject object = numbered(number, 1);
    stride::cnc::append(&input.queue, &object);
  };
  feed(3);
  stepStream(stream, processor, &input.queue, &output.queue);
  EXPECT_EQ(countOf(&output.queue), 0U); // the object is held back
  abortStream(stream, &input.queue);
  abortStream(stream, &input.queue); // bAbort stays
  stepStream(stream, processor, &input.queue, &output.queue);
  EXPECT_EQ(stream.phase, StreamPhase::Idle);
  feed(4);
  ASSERT_TRUE(resumeStream(stream, &input.queue, &output.queue));
  input.queue.endOfList = 1;
  for (int i = 0; i < 4; ++i)
    stepStream(stream, processor, &input.queue, &output.queue);
  EXPECT_EQ(stream.phase, StreamPhase::Done);
  ASSERT_EQ(countOf(&output.queue), 2U);
  EXPECT_EQ(objectAt(&output.queue, 0)->number, 3);
  EXPECT_EQ(objectAt(&output.queue, 1)->number, 4);
  abortStream(stream, &input.queue);
  EXPECT_FALSE(resumeStream(stream, &input.queue, &output.queue)); // it was complete
}

/// Held back is what belongs to a path that its input does not have any more.
TEST(CncStream, BeginsAnewWhereItsInputHasAnotherPath) {
  OwnedQueue input(20);
  OwnedQueue output(20);
  StreamState stream{};
  Repeating processor{};
  const PathObject object = numbered(3, 1);
  for (const bool waits : {false, true}) {
    clear(&input.queue);
    startStream(stream, &output.queue, Repeating::kGenerator, false);
    start(processor);
    stride::cnc::append(&input.queue, &object);
    if (!waits) // else its first object is still there
      stepStream(stream, processor, &input.queue, &output.queue);
    abortStream(stream, &input.queue);
    clear(&input.queue);
    const PathObject other = numbered(8, 1);
    stride::cnc::append(&input.queue, &other);
    EXPECT_FALSE(resumeStream(stream, &input.queue, &output.queue));
    abortStream(stream, nullptr);
    EXPECT_FALSE(resumeStream(stream, nullptr, &output.queue));
  }
}

} // namespace
