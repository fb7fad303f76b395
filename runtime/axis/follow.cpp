#include "runtime/axis/follow.hpp"

#include "runtime/axis/set_point.hpp"

namespace stride::motion {

void beginFollowing(FollowState &follow, BlockState &block, AxisRef &ref) noexcept {
  take(block, ref, axis::state::kSynchronized);
  startFollowing(follow, ref);
}

void startFollowing(FollowState &follow, AxisRef &ref) noexcept {
  const numeric::MotionState start = axis::setState(ref);
  ref.nAxisState = axis::state::kSynchronized;
  ref.stPlanner.fDeceleration = 0.0; // an error stop brakes with fSWMaxDeceleration
  follow.fPosition = start.position;
  follow.fVelocity = start.velocity;
  follow.fAcceleration = start.acceleration;
  follow.fOffset = ref.fOffsetPosition;
  follow.fFirstOffset = ref.fOffsetPosition;
}

void alignFollowing(FollowState &follow, const AxisRef &ref) noexcept {
  follow.fPosition += ref.fOffsetPosition - follow.fOffset;
  follow.fOffset = ref.fOffsetPosition;
}

double wayTo(const FollowState &follow, const AxisRef &ref, double position) noexcept {
  const double way = position - follow.fPosition;
  if (!axis::isRotary(ref))
    return way;
  const double forward = numeric::wrapPosition(way, ref.fPositionPeriod);
  return forward <= 0.5 * ref.fPositionPeriod ? forward : forward - ref.fPositionPeriod;
}

void followState(FollowState &follow, AxisRef &ref, const numeric::MotionState &state,
                 double way) noexcept {
  follow.fPosition = axis::shownPosition(ref, state.position);
  follow.fVelocity = state.velocity;
  follow.fAcceleration = state.acceleration;
  axis::writeSetPoint(ref, state);
  ref.bTravelGiven = 1;
  ref.fTravel = way + ref.stSuperimposed.fVelocity * ref.fTaskCycle;
}

void followStep(FollowState &follow, AxisRef &ref, double position, double way,
                double velocity) noexcept {
  const double acceleration = (velocity - follow.fVelocity) / ref.fTaskCycle;
  followState(follow, ref, {position, velocity, acceleration}, way);
}

} // namespace stride::motion
