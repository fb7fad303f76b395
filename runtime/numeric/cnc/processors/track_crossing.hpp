// Where two curves in a plane meet. Free of the C++ standard library: linked into every
// application.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_TRACK_CROSSING_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_TRACK_CROSSING_HPP

#include "runtime/numeric/cnc/processors/plane_track.hpp"

namespace stride::cnc {

/// Both parameters of a place that two curves have in common.
struct Crossing {
  double first, second;
};

inline constexpr int32_t kMostCrossings = 8;

/// Places that two curves have in common, at most kMostCrossings; ends belong to them. Lines and
/// arcs to rounding, others to about 1e-9 of their size. Where curves lie upon each other there is
/// none. How many.
int32_t crossingsOf(const Track &first, const Track &second,
                    Crossing (&found)[kMostCrossings]) noexcept;

/// What lies around a curve, with nothing left over at lines.
struct Box {
  double left, right, low, high;
};

Box boxOf(const Track &track) noexcept;

inline bool overlap(const Box &a, const Box &b) noexcept {
  return a.left <= b.right && b.left <= a.right && a.low <= b.high && b.low <= a.high;
}

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_TRACK_CROSSING_HPP
