// What all path processors have in common: objects come from a queue, one a step, and what becomes
// of them goes into another queue. A processor says what becomes of one object; the stream sees to
// it that nothing is lost when a queue is full or empty, and that a path ends as it should. Free of
// the C++ standard library: linked into every application.
//
// A processor is a trivially copyable struct P, all zeros at first, with
//
//   static constexpr Generator kGenerator   who fills the queue;
//   static constexpr bool kLooksAhead       whether it needs the objects that follow: it then
//   begins
//                                           only when the input is full or complete;
//   void start(P &);                        a new path; what the user sets (radius, ...) stays;
//   Step next(P &, const Source &, Output &);
//   Step finish(P &, Ending, Output &);     no object follows: puts out what it has held back.
//   void placePause(P &, PathObject &);     left out where a synchronisation (G75) stays as it is.
//
// next() and finish() put out at most kMostPerStep objects. Step::Again asks to be called again
// with the same object, when there is more to put out than that. Source: SoftMotion V2.3 manual,
// sections 6.2.3 to 6.2.6.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_STREAM_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_STREAM_HPP

#include "runtime/numeric/cnc/queue.hpp"

namespace stride::cnc {

/// So many objects fit into a queue that is not full.
inline constexpr int32_t kMostPerStep = 3;
static_assert(kMostPerStep <= static_cast<int32_t>(kReservedPlaces));

/// Why a processor has stopped: an SMC_ERROR.
enum class StreamError : int16_t {
  None = 0,
  InvalidParameter = 311, ///< SMC_INVALID_PARAMETER: what the user sets is no number, or negative.
  PauseInCorrection = 1410, ///< SMC_TRC_SYNC_NOT_ALLOWED: G75 while the tool is corrected.
  PlaneChanged = 1414,      ///< SMC_TRC_PLANE_CHANGED: an arc in another plane than those before.
  InvalidObject = 1419,     ///< SMC_PATH_INVALID_OBJECT: without a shape, or no line as a ramp.
  NoQueue = 1501,           ///< SMC_NO_OUTQUEUE_TYPE: the input is no queue, or a damaged one.
  RangeTooLong = 1700,      ///< SMC_SAA_RANGE_TOO_LONG
  SmoothingPart = 1701,     ///< SMC_SAA_SMOOTHING_PART
  ProbeInRange = 1710,      ///< SMC_PROBE_G31_NOT_ALLOWED
  FeatureBit = 1900,        ///< SMC_SBS_FEATURE_BIT
  SwitchPoint = 1901,       ///< SMC_SBS_SWITCH_POINT
  NotInSpace = 1902,        ///< SMC_SBS_NOT_3D: a length counts in a plane.
};

/// What a processor did with an object.
enum class Step : uint8_t {
  Took,   ///< The next one, please.
  Again,  ///< There is more to put out: the same one again.
  Failed, ///< Output::error says why. Nothing more is put out.
};

/// Why no object follows.
enum class Ending : uint8_t {
  Pause, ///< The path goes on when the motion has come to its end (G75): modes stay.
  End,   ///< The path is complete.
};

/// Where objects come from.
struct Source {
  const PathObject &object; ///< The next one.
  const Queue *queue;       ///< It is the first one there; those that follow may be looked at.
};

/// Where objects go.
struct Output {
  Queue *queue;
  int32_t count;     ///< How many have been put out in this step.
  StreamError error; ///< Of Step::Failed.
};

/// Puts an object out. Where it is, to be changed in this step only; null if it is more than
/// kMostPerStep, which is a fault of the processor.
PathObject *put(Output &output, const PathObject &object) noexcept;

/// What a stream is doing. The order of the first two is that of memory that is zero.
enum class StreamPhase : uint8_t {
  Idle,
  Running,
  Draining, ///< The output has to become empty before the input goes on (G75).
  Done,     ///< The path is complete.
  Failed,   ///< See StreamState::error.
};

struct StreamState {
  StreamPhase phase;
  StreamPhase broken; ///< Idle by abortStream(): what it was doing; else Idle. Then it was about
                      ///< to take
  int32_t first;      ///< the object with this number (0: none yet)
  uint32_t position;  ///< at this place of the input.
  bool named;         ///< The output has the name of the input's program.
  StreamError error;
};

/// Begins: the output is made empty, or, to append, only reopened.
void startStream(StreamState &stream, Queue *output, Generator generator, bool append) noexcept;

/// Gives up. The processor keeps what it holds back.
void abortStream(StreamState &stream, const Queue *input) noexcept;

/// Goes on with the path of abortStream(), and what the processor has held back of it. FALSE:
/// nothing has been given up, or the input holds another path since.
bool resumeStream(StreamState &stream, const Queue *input, Queue *output) noexcept;

/// What there is to do in this call.
enum class StreamTurn : uint8_t {
  Nothing,
  Take,  ///< The first object of the input.
  Pause, ///< It is a synchronisation (G75).
  End,   ///< The input is empty and complete.
};

StreamTurn turnOf(StreamState &stream, Queue *input, Queue *output, bool looksAhead) noexcept;

/// What follows of Step for the queues; `turn` is what was done.
void settleStep(StreamState &stream, StreamTurn turn, Step step, Queue *input,
                Output &output) noexcept;

/// One step: takes one object at most.
template <class Processor>
void stepStream(StreamState &stream, Processor &processor, Queue *input, Queue *output) noexcept {
  const StreamTurn turn = turnOf(stream, input, output, Processor::kLooksAhead);
  if (turn == StreamTurn::Nothing)
    return;
  Output to{output, 0, StreamError::None};
  Step step = Step::Took;
  if (turn == StreamTurn::Take)
    step = next(processor, Source{*objectAt(input, 0), input}, to);
  else
    step = finish(processor, turn == StreamTurn::Pause ? Ending::Pause : Ending::End, to);
  settleStep(stream, turn, step, input, to);
  // The synchronisation has been put out just now.
  if constexpr (requires(PathObject & pause) { placePause(processor, pause); })
    if (turn == StreamTurn::Pause && stream.phase == StreamPhase::Draining)
      placePause(processor, *objectFromEnd(output, 0));
}

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_STREAM_HPP
