// A path without loops: where it crosses itself, what lies between is cut out.
//
// Between G61 and G60, each object is cut at the first place where an object that follows in the
// input crosses it, and the path goes on there. So the result does not cross itself as far as the
// input queue reaches. That the path only touches itself is no crossing, nor is its end at its
// start. What counts is the plane of the arcs; other axes go on from where they were. Functions (M)
// of a loop are kept, at the crossing. Free of the C++ standard library: linked into every
// application. Source: SoftMotion V2.3 manual, section 6.2.4.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_AVOID_LOOP_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_AVOID_LOOP_HPP

#include "runtime/numeric/cnc/processors/queue_index.hpp"
#include "runtime/numeric/cnc/processors/stream.hpp"

namespace stride::cnc {

struct LoopAvoider {
  static constexpr Generator kGenerator = kByAvoidLoop;
  static constexpr bool kLooksAhead = true;

  bool on;
  bool lost;           ///< `vanished` has switch points or marks.
  bool moved;          ///< `end` is where the path is.
  bool ended;          ///< The end of the loops' part is `known` objects after the first one.
  uint32_t known;      ///< Objects from the first one on that have been searched for that end.
  uint32_t skip;       ///< Objects that are still to be left out.
  double from;         ///< Where the first one after them begins, as a parameter of its track.
  Position end;        ///< Where the path is after a loop.
  Plane plane;         ///< Of the object that begins.
  PathObject vanished; ///< Switch points and marks of what has been left out.
  QueueIndex index;
};

void start(LoopAvoider &loops) noexcept;
Step next(LoopAvoider &loops, const Source &source, Output &output) noexcept;
Step finish(LoopAvoider &loops, Ending ending, Output &output) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_AVOID_LOOP_HPP
