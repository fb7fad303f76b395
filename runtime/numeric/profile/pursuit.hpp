// One axis after a moving signal, within its limits: one cycle at a time, a pure function.
#ifndef STRIDE_RUNTIME_NUMERIC_PROFILE_PURSUIT_HPP
#define STRIDE_RUNTIME_NUMERIC_PROFILE_PURSUIT_HPP

#include "runtime/numeric/profile/planner.hpp"

namespace stride::motion {

/// A cycle of a pursuit. Positions count from any place.
struct Pursuit {
  State axis;    ///< At the start of the cycle.
  State before;  ///< The signal then.
  State now;     ///< The signal at the end of the cycle.
  double cycle;  ///< [s]
  Dynamics most; ///< What the axis may; all ramp types but Trapezoid keep to the jerk.
};

/// Where the axis is at the end of the cycle.
struct Pursued {
  State axis;
  bool reached; ///< It is where the signal is, exactly, and moves with it.
};

/// The axis's next state. It gets to a signal of constant velocity in the shortest time that its
/// limits allow (where acceleration and deceleration differ and the axis has to slow down for a
/// signal that is behind it, both count as the smaller one), and stays on a signal that keeps to
/// the limits itself. A signal that leaps is pursued anew; one that is too fast gets away.
/// Velocity, acceleration and jerk of the axis never exceed the limits, or go back to them
/// steadily.
Pursued pursue(const Pursuit &task) noexcept;

} // namespace stride::motion

#endif
