// A path that follows a workpiece: at every moment the path is where its X is that of the
// workpiece, so that time and velocity come from there. Free of the C++ standard library: linked
// into every application. Source: SoftMotion V2.3 manual, section 6.7.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_X_INTERPOLATOR_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_X_INTERPOLATOR_HPP

#include "runtime/numeric/cnc/queue.hpp"
#include "runtime/numeric/path/segment.hpp"

namespace stride::cnc {

/// What became of a cycle.
enum class XPhase : uint8_t {
  Following, ///< The path is at this X.
  Waiting,   ///< X is before the path's start, or after all objects of a path that goes on.
  Done,      ///< X is at the end of a complete path, or after it.
  Failed,    ///< See XFollower::error.
};

/// Why it failed.
enum class XError : uint8_t {
  None,
  NoQueue,        ///< No usable queue.
  NoIntersection, ///< An object goes nowhere along X, or back: no place of it, or more than one.
  Shape,          ///< An object has no shape that can be driven.
};

/// Trivially copyable, may be moved in memory between two calls. Made by startFollowing.
struct XFollower {
  path::Segment here; ///< Of the first object of the queue, if `begun`.
  Position position;  ///< Where the path is.
  Vector3 tangent;    ///< Of length 1; 0 while nothing moves.
  double way;         ///< Along `here`. [u]
  double length;      ///< Way of the last cycle. [u]
  uint32_t switches;  ///< Which ones are on.
  int32_t source;     ///< Its sourceLine; -1: there is none.
  int16_t lastSwitch; ///< Passed in the last cycle; 0: none.
  uint8_t passed;     ///< Switch points of the first object.
  bool begun;         ///< `here` is that of the first object.
  XPhase phase;
  XError error;
};

void startFollowing(XFollower &follower) noexcept;

/// A cycle: the place of the path whose X is `x`. With `forward` the path leads to greater X, else
/// to smaller ones; objects that are done leave the queue, and the path never goes back to them.
/// Objects that do not move (M functions, jumps) are passed over. [u] in
void follow(XFollower &follower, Queue *queue, double x, bool forward) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_X_INTERPOLATOR_HPP
