#include "runtime/axis/catch_up.hpp"

#include "runtime/axis/plan_axis.hpp"

namespace stride::motion {
namespace {

Dynamics dynamicsOf(const CatchUpState &state, const AxisRef &ref) noexcept {
  // Overrides are for the master: a slave that obeyed its own would never get there.
  return plainDynamics(ref, {1.0, state.fAcceleration, state.fDeceleration, state.fJerk});
}

/// To a velocity that does not change: along a plan.
bool rampOn(CatchUpState &state, const FollowState &follow, const AxisRef &ref,
            const Demand &demand, numeric::MotionState &now) noexcept {
  auto &plan = state.stPlan;
  if (state.bPlanned == 0) {
    Profile profile;
    if (planVelocity(profile, {0.0, follow.fVelocity, follow.fAcceleration}, demand.velocity,
                     dynamicsOf(state, ref)) != PlanError::None)
      return false;
    loadPlan(plan, profile, ref.fTaskCycle);
    state.bPlanned = 1;
    state.fWay = 0.0;
  }
  ++plan.ulCycle;
  const double t = axis::planTime(plan);
  now = axis::planState(plan, t);
  const double way = now.position;
  now.position = way - state.fWay;
  state.fWay = way;
  return axis::isPlanOver(plan, t);
}

/// The greatest acceleration towards `side` at the slave's velocity. [u/s^2]
double limitTowards(const CatchUpState &state, const FollowState &follow, double side) noexcept {
  return side * follow.fVelocity >= 0.0 ? state.fAcceleration : state.fDeceleration;
}

/// Trapezoids: as far towards a velocity as the limits allow in a cycle; where the slave turns
/// round the other one begins to count.
numeric::MotionState towards(const CatchUpState &state, const FollowState &follow, double velocity,
                             double cycle) noexcept {
  const double v = follow.fVelocity;
  const double side = exact::signOf(velocity - v);
  const double stop = exact::fabs(v) / state.fDeceleration;
  if (v * velocity < 0.0 && stop < cycle) {
    const double rest = cycle - stop;
    const double a = side * exact::smaller(state.fAcceleration, exact::fabs(velocity) / rest);
    return {0.5 * (v * stop + a * rest * rest), a * rest, a};
  }
  const double most = limitTowards(state, follow, side);
  const double a = side * exact::smaller(most, exact::fabs(velocity - v) / cycle);
  return numeric::evaluateCubic({0.0, v, a}, 0.0, cycle);
}

/// The master gets away: with all that is allowed after it.
numeric::MotionState chase(const Dynamics &dynamics, const FollowState &follow, double wanted,
                           double cycle) noexcept {
  const double change = wanted - follow.fAcceleration;
  const double most = dynamics.jerk * cycle;
  const double jerk =
      exact::fabs(change) > most ? exact::signOf(change) * dynamics.jerk : change / cycle;
  return numeric::evaluateCubic({0.0, follow.fVelocity, follow.fAcceleration}, jerk, cycle);
}

/// Whether an acceleration is beyond the limit, and more so than the slave's present one.
bool isTooMuch(const CatchUpState &state, const FollowState &follow, double acceleration) noexcept {
  const double limit = limitTowards(state, follow, exact::signOf(acceleration));
  return exact::fabs(acceleration) > limit * (1.0 + 1e-12) &&
         exact::fabs(acceleration) > exact::fabs(follow.fAcceleration);
}

/// The slave's next set values after those in `follow`: now.position is the way [u]. True: the
/// slave has the master's velocity.
bool catchUp(CatchUpState &state, const FollowState &follow, const AxisRef &ref,
             const Demand &demand, numeric::MotionState &now) noexcept {
  const double cycle = ref.fTaskCycle;
  const double before = state.fVelocity;
  state.fVelocity = demand.velocity;
  now = {follow.fVelocity * cycle, follow.fVelocity, 0.0};
  if (demand.steady && demand.velocity == before)
    return rampOn(state, follow, ref, demand, now);
  state.bPlanned = 0;
  // Seen from a place that moves with the master, and with its mean acceleration in this cycle: the
  // difference has to vanish.
  const double mean = (demand.velocity - before) / cycle;
  const double behind = follow.fVelocity - before;
  const double side = behind < 0.0 ? 1.0 : -1.0;
  const double limit = limitTowards(state, follow, side);
  const double room = limit - side * mean;
  Dynamics dynamics = dynamicsOf(state, ref);
  const bool trapezoid = dynamics.ramp == RampType::Trapezoid;
  if (!trapezoid)
    dynamics.ramp = RampType::Parabolic;
  if (behind != 0.0 && !(room > 1e-9 * limit)) {
    now = trapezoid ? towards(state, follow, demand.velocity, cycle)
                    : chase(dynamics, follow, side * limit, cycle);
    return false;
  }
  dynamics.acceleration = exact::larger(room, 1e-9 * limit);
  dynamics.deceleration = dynamics.acceleration;
  Profile profile;
  if (planVelocity(profile, {0.0, behind, follow.fAcceleration - mean}, 0.0, dynamics) !=
      PlanError::None)
    return false;
  const State rest = profile.at(cycle);
  now = {demand.travel + rest.position, demand.velocity + rest.velocity, mean + rest.acceleration};
  if (isTooMuch(state, follow, now.acceleration)) {
    // The slave gets past the master in this cycle, and there the other limit counts.
    now = trapezoid ? towards(state, follow, demand.velocity, cycle)
                    : chase(dynamics, follow, follow.fAcceleration, cycle);
    return false;
  }
  if (trapezoid && now.velocity * follow.fVelocity < 0.0 &&
      cycle * (1.0 + 1e-9) < profile.duration) {
    now = towards(state, follow, demand.velocity, cycle);
    return false;
  }
  return !(cycle * (1.0 + 1e-9) < profile.duration) ||
         (demand.rough && exact::fabs(rest.velocity) <= limit * cycle);
}

} // namespace

LimitError checkLimits(const AxisRef &ref, double acceleration, double deceleration,
                       double jerk) noexcept {
  if (!exact::isPositive(acceleration) || !exact::isfinite(jerk) || jerk < 0.0)
    return LimitError::Acceleration;
  if (!exact::isPositive(deceleration))
    return LimitError::Deceleration;
  const Dynamics dynamics = plainDynamics(ref, {1.0, acceleration, deceleration, jerk});
  if (dynamics.ramp != RampType::Trapezoid && !exact::isPositive(dynamics.jerk))
    return LimitError::Acceleration;
  return LimitError::None;
}

Demand demandOf(const GearState &gear, const MasterState &state,
                const MasterMotion &master) noexcept {
  const double factor = gearFactor(gear);
  const bool rough = state.bActual != 0;
  return {factor * master.velocity, factor * master.travel, master.acceleration == 0.0, rough};
}

MasterMotion cycleBefore(const AxisRef &slave, const MasterMotion &master) noexcept {
  MasterMotion before = master;
  before.velocity -= master.acceleration * slave.fTaskCycle;
  return before;
}

MasterMotion sinceCycleBefore(const AxisRef &slave, const MasterMotion &master) noexcept {
  MasterMotion now = master;
  now.travel = (master.velocity - 0.5 * master.acceleration * slave.fTaskCycle) * slave.fTaskCycle;
  return now;
}

void beginCatchUp(CatchUpState &state, const Demand &last) noexcept {
  state.fVelocity = last.velocity;
  state.bPlanned = 0;
}

bool catchUpToGear(CatchUpState &state, GearState &gear, FollowState &follow, AxisRef &slave,
                   const MasterState &masterState, const MasterMotion &master) noexcept {
  numeric::MotionState now;
  const bool reached = catchUp(state, follow, slave, demandOf(gear, masterState, master), now);
  const double way = now.position;
  if (!reached) {
    now.position += follow.fPosition;
    followState(follow, slave, now, way);
    return false;
  }
  engageGear(gear, slave, master.position, detail::twoSum(follow.fPosition, way),
             {follow.fPosition, 0.0});
  return true;
}

} // namespace stride::motion
