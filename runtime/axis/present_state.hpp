// From where an axis goes on when somebody takes it over in the middle of a cycle: what is added to
// its motion may not have covered this cycle's way yet.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_AXIS_PRESENT_STATE_HPP
#define STRIDE_RUNTIME_AXIS_PRESENT_STATE_HPP

#include "runtime/axis/set_point.hpp"

namespace stride::axis {

/// What a superimposed motion has added by the time `later` [s] in this cycle. Its block may have
/// been called in this cycle already, or not yet.
inline numeric::MotionState addedState(const AxisRef &axis, double later) noexcept {
  const auto &added = axis.stSuperimposed;
  const numeric::MotionState state{added.fPosition, added.fVelocity, added.fAcceleration};
  if (added.ulOwner == 0)
    return state;
  return numeric::evaluateCubic(state, 0.0,
                                added.bMovedInThisCycle != 0 ? later - axis.fTaskCycle : later);
}

/// From where a command begins that ends what moves the axis: the set values of this cycle, if it
/// has been moved in it, else those of the cycle before.
inline numeric::MotionState presentState(const AxisRef &axis) noexcept {
  numeric::MotionState state = setState(axis);
  if (axis.bMovedInThisCycle == 0)
    return state;
  const auto &added = axis.stSuperimposed;
  const numeric::MotionState now = addedState(axis, axis.fTaskCycle);
  state.position = shownPosition(axis, state.position + (now.position - added.fPosition));
  state.velocity += now.velocity - added.fVelocity;
  state.acceleration += now.acceleration - added.fAcceleration;
  return state;
}

/// Ends a superimposed motion; its way in this cycle is part of the set values, if the motion below
/// has covered its own.
inline void settleSuperimposed(AxisRef &axis) noexcept {
  const numeric::MotionState state = presentState(axis);
  const bool adds = axis.stSuperimposed.ulOwner != 0;
  endSuperimposed(axis);
  if (adds && axis.bMovedInThisCycle != 0)
    writeSetPoint(axis, state);
}

} // namespace stride::axis

#endif
