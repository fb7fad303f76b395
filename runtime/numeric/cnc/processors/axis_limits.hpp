// Limits of single axes that the program says (FA, EA and so on) become limits of the path:
// SMC_ExtendedVelocityChecks. Free of the C++ standard library: linked into every application.
// Source: SoftMotion 3.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_AXIS_LIMITS_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_AXIS_LIMITS_HPP

#include "runtime/numeric/cnc/processors/stream.hpp"

namespace stride::cnc {

/// Lowers velocity, acceleration and deceleration of an object so that A to W, and Z where the
/// length is that in the plane, keep PathObject::limits.
void limitByAxes(PathObject &object) noexcept;

struct LimitByAxes {
  static constexpr Generator kGenerator = kByNobody;
  static constexpr bool kLooksAhead = false;
};

inline void start(LimitByAxes & /*limit*/) noexcept {}
Step next(LimitByAxes &limit, const Source &source, Output &output) noexcept;
inline Step finish(LimitByAxes & /*limit*/, Ending /*ending*/, Output & /*output*/) noexcept {
  return Step::Took;
}

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_AXIS_LIMITS_HPP
