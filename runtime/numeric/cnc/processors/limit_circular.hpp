// How fast arcs of circles may be gone over, and transitions to and from them:
// SMC_LimitCircularVelocities. Free of the C++ standard library: linked into every application.
// Source: SoftMotion V2.3 manual, section 6.2.7.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_LIMIT_CIRCULAR_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_LIMIT_CIRCULAR_HPP

#include "runtime/numeric/cnc/processors/stream.hpp"

namespace stride::cnc {

/// The user sets the first members; 0: no limit.
struct LimitCircular {
  static constexpr Generator kGenerator = kByLimitCircularVelocities;
  static constexpr bool kLooksAhead = false;

  double acceleration; ///< Across an arc, at most. [u/s^2]
  double jump;         ///< Of the acceleration where lines and arcs follow each other. [u/s^2]
  double perRadius;    ///< Velocity on an arc over its radius, at most. [1/s]
  // Its own:
  PathObject held;
  Vector3 curvature; ///< At the end of `held`. [1/u]
  bool known;        ///< It is a line or an arc.
  bool holds;
};

inline void start(LimitCircular &limit) noexcept { limit.holds = false; }
Step next(LimitCircular &limit, const Source &source, Output &output) noexcept;
Step finish(LimitCircular &limit, Ending ending, Output &output) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_LIMIT_CIRCULAR_HPP
