// Slopes for A, B and C, so that they go smoothly from object to object: SMC_RecomputeABCSlopes.
// Free of the C++ standard library: linked into every application.
// Source: SoftMotion 3.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_ABC_SLOPES_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_ABC_SLOPES_HPP

#include "runtime/numeric/cnc/processors/stream.hpp"

namespace stride::cnc {

/// The user sets the first members.
///
/// Where the path goes on from object i to the next one, A, B and C have there
///   (value at the end of i + 1 - value at the start of i) / (length of i + length of i + 1).
struct AbcSlopes {
  static constexpr Generator kGenerator = kByNobody;
  static constexpr bool kLooksAhead = false;

  double angle;       ///< Corners that turn more are stops. [rad] >= 0
  bool linearAtStops; ///< At stops the slope of going evenly; else 0.
  // Its own:
  PathObject held; ///< The last motion, whose end is open.
  double length;   ///< Its own. [u]
  bool holds;
};

inline void start(AbcSlopes &slopes) noexcept { slopes.holds = false; }
Step next(AbcSlopes &slopes, const Source &source, Output &output) noexcept;
Step finish(AbcSlopes &slopes, Ending ending, Output &output) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_ABC_SLOPES_HPP
