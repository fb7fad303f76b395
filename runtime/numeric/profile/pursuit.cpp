#include "runtime/numeric/profile/pursuit.hpp"

namespace stride::motion {
namespace {

/// What is as good as nothing, relative to a limit.
constexpr double kNothing = 1e-9;

bool limitsJerk(const Dynamics &most) noexcept { return most.ramp != RampType::Trapezoid; }

/// The largest change of velocity per time at `velocity` towards `side`. [u/s^2]
double limitTowards(const Dynamics &most, double velocity, double side) noexcept {
  return velocity * side >= 0.0 ? most.acceleration : most.deceleration;
}

/// The velocity that the axis has when its acceleration has been taken away.
double settled(const State &state, const Dynamics &most) noexcept {
  if (!limitsJerk(most))
    return state.velocity;
  const double a = state.acceleration;
  return state.velocity + a * (exact::fabs(a) / (2.0 * most.jerk));
}

/// Whether the axis may get from one state to the other in a cycle.
bool isAllowed(const Pursuit &task, const State &next) noexcept {
  const Dynamics &most = task.most;
  const State &from = task.axis;
  const double fastest = exact::larger(most.velocity, exact::fabs(settled(from, most)));
  if (!(exact::fabs(settled(next, most)) <= fastest * (1.0 + kNothing)))
    return false;
  const double change = next.velocity - from.velocity;
  double limit = limitTowards(most, from.velocity, change);
  if (from.velocity * next.velocity < 0.0)       // it turns round on the way
    limit = limitsJerk(most) ? most.acceleration // that at the end of the cycle
                             : exact::smaller(most.acceleration, most.deceleration);
  if (!limitsJerk(most))
    return exact::fabs(change) <=
           limit * task.cycle * (1.0 + kNothing) + kNothing * kNothing * fastest;
  const double largest = exact::larger(limit, exact::fabs(from.acceleration));
  const double turn = exact::fabs(next.acceleration - from.acceleration);
  return exact::fabs(next.acceleration) <= largest * (1.0 + kNothing) &&
         turn <= most.jerk * task.cycle * (1.0 + 1e-6) + kNothing * largest;
}

/// The signal cannot be followed in this cycle: the axis takes its velocity as far as it may.
Pursued giveUp(const Pursuit &task) noexcept {
  Dynamics most = task.most;
  if (limitsJerk(most))
    most.ramp = RampType::Parabolic;
  const double speed = exact::smaller(exact::fabs(task.now.velocity), most.velocity);
  Profile profile;
  State next = task.axis;
  if (planVelocity(profile, task.axis, task.now.velocity < 0.0 ? -speed : speed, most) ==
      PlanError::None)
    next = profile.at(task.cycle);
  if (!limitsJerk(most))
    next.acceleration = (next.velocity - task.axis.velocity) / task.cycle;
  return {next, false};
}

/// The signal at the start of the cycle: as it was given then, or, if it has leapt since, as its
/// present motion leads back to.
State startOf(const Pursuit &task) noexcept {
  const double T = task.cycle;
  const State &now = task.now;
  const double way = now.position - task.before.position;
  const double expected = 0.5 * (task.before.velocity + now.velocity) * T;
  const double limit = exact::larger(task.most.acceleration, task.most.deceleration);
  const double slack = 0.25 * limit * T * T + kNothing * exact::fabs(expected);
  if (exact::fabs(way - expected) <= slack)
    return task.before;
  return {now.position - (now.velocity - 0.5 * now.acceleration * T) * T,
          now.velocity - now.acceleration * T, now.acceleration};
}

/// What the axis may do in relation to a signal that accelerates with `mean` in this cycle; false
/// if nothing.
bool relativeLimits(Dynamics &limits, const Pursuit &task, const State &start, const State &apart,
                    double mean) noexcept {
  limits = task.most;
  const double velocity = task.now.velocity;
  const bool still = velocity == 0.0 && start.velocity == 0.0;
  if (!still) {
    const double side =
        apart.position != 0.0 ? -exact::signOf(apart.position) : -exact::signOf(apart.velocity);
    if (!(side * velocity > 0.0 && task.axis.velocity * velocity >= 0.0))
      limits.acceleration = limits.deceleration =
          exact::smaller(limits.acceleration, limits.deceleration);
    limits.velocity -= side * velocity;
  }
  limits.acceleration -= exact::fabs(mean);
  limits.deceleration -= exact::fabs(mean);
  if (limitsJerk(limits)) {
    limits.ramp = RampType::Parabolic;
    limits.jerk -= exact::fabs(task.now.acceleration - start.acceleration) / task.cycle;
  }
  const Dynamics &most = task.most;
  return limits.velocity > kNothing * most.velocity &&
         limits.acceleration > kNothing * most.acceleration &&
         limits.deceleration > kNothing * most.deceleration &&
         (!limitsJerk(limits) || limits.jerk > kNothing * most.jerk);
}

} // namespace

Pursued pursue(const Pursuit &task) noexcept {
  const double T = task.cycle;
  const State start = startOf(task);
  // Seen from a place that moves as the signal does, the axis has to come to rest there.
  State apart{task.axis.position - start.position, task.axis.velocity - start.velocity,
              limitsJerk(task.most) ? task.axis.acceleration - start.acceleration : 0.0};
  const double mean = (task.now.velocity - start.velocity) / T;
  const double fastest = task.most.velocity;
  if (exact::fabs(apart.position) <= kNothing * fastest * T &&
      exact::fabs(apart.velocity) <= kNothing * fastest && isAllowed(task, task.now))
    return {task.now, true};
  Dynamics limits;
  if (!relativeLimits(limits, task, start, apart, mean))
    return giveUp(task);
  Profile profile;
  if (planMove(profile, apart, 0.0, 0.0, limits) != PlanError::None)
    return giveUp(task);
  if (profile.duration <= T * (1.0 + kNothing) && isAllowed(task, task.now))
    return {task.now, true};
  const State rest = profile.at(T);
  State next{task.now.position + rest.position, task.now.velocity + rest.velocity,
             task.now.acceleration + rest.acceleration};
  if (!limitsJerk(task.most))
    next.acceleration = (next.velocity - task.axis.velocity) / T;
  if (!isAllowed(task, next))
    return giveUp(task);
  return {next, false};
}

} // namespace stride::motion
