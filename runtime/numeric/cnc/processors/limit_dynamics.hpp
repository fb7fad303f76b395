// Velocity and accelerations of objects as low as limits of single axes ask: SMC_LimitDynamics.
// Free of the C++ standard library: linked into every application. Source: SoftMotion 3.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_LIMIT_DYNAMICS_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_LIMIT_DYNAMICS_HPP

#include "runtime/numeric/cnc/processors/stream.hpp"

namespace stride::cnc {

/// The user sets all members.
struct LimitDynamics {
  static constexpr Generator kGenerator = kByNobody;
  static constexpr bool kLooksAhead = false;

  double velocity;     ///< Of each of the axes; 0: no limit. [u/s] >= 0
  double acceleration; ///< Likewise, and its deceleration. [u/s^2] >= 0
  uint16_t axes;       ///< Which ones, by AxisBit.
};

inline void start(LimitDynamics & /*limit*/) noexcept {}
Step next(LimitDynamics &limit, const Source &source, Output &output) noexcept;
inline Step finish(LimitDynamics & /*limit*/, Ending /*ending*/, Output & /*output*/) noexcept {
  return Step::Took;
}

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_LIMIT_DYNAMICS_HPP
