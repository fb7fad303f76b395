#include "runtime/axis/pursue_signal.hpp"

#include "runtime/axis/catch_up.hpp"
#include "runtime/numeric/profile/pursuit.hpp"

namespace stride::motion {

int16_t checkPursuit(const AxisRef &ref, const BlockLimits &limits) noexcept {
  const bool good =
      exact::isPositive(limits.velocity) &&
      checkLimits(ref, limits.acceleration, limits.deceleration, limits.jerk) == LimitError::None;
  return good ? axis::error::kNone : axis::error::kInvalidParameter;
}

void beginPursuit(PursuitState &pursuit, FollowState &follow, AxisRef &ref,
                  const MasterMotion &signal, const BlockLimits &limits) noexcept {
  auto &gear = pursuit.stGear;
  gear.fNumerator = 1.0;
  gear.fDenominator = 1.0;
  const double ahead = -wayTo(follow, ref, signal.position.hi); // the first look is as shown
  engageGear(gear, ref, signal.position,
             ::stride::detail::add(cam::Total{follow.fPosition, 0.0}, {-ahead, 0.0}),
             {follow.fPosition, 0.0});
  pursuit.bInSync = 0;
  pursuit.fApart = ahead;
  pursuit.fVelocity = signal.velocity;
  pursuit.fAcceleration = signal.acceleration;
  if (ref.bMovedInThisCycle != 0)
    return;
  // The axis has the set values of the cycle before: so must the signal.
  const MasterMotion before = cycleBefore(ref, signal);
  const MasterMotion now = sinceCycleBefore(ref, signal);
  pursuit.fApart = ahead + now.travel;
  pursuit.fVelocity = before.velocity;
  continuePursuit(pursuit, follow, ref, now, limits);
}

void continuePursuit(PursuitState &pursuit, FollowState &follow, AxisRef &ref,
                     const MasterMotion &signal, const BlockLimits &limits) noexcept {
  alignFollowing(follow, ref);
  const Pursued next = pursue({{pursuit.fApart, follow.fVelocity, follow.fAcceleration},
                               {0.0, pursuit.fVelocity, pursuit.fAcceleration},
                               {signal.travel, signal.velocity, signal.acceleration},
                               ref.fTaskCycle,
                               plainDynamics(ref, limits)});
  pursuit.bInSync = next.reached;
  pursuit.fApart = next.reached ? 0.0 : next.axis.position - signal.travel;
  pursuit.fVelocity = signal.velocity;
  pursuit.fAcceleration = signal.acceleration;
  turnGear(pursuit.stGear, follow, ref, signal,
           next.reached ? numeric::MotionState{}
                        : numeric::MotionState{pursuit.fApart, next.axis.velocity - signal.velocity,
                                               next.axis.acceleration - signal.acceleration});
}

} // namespace stride::motion
