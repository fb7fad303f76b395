#include "runtime/numeric/profile/planner.hpp"

#include "runtime/numeric/exact_math.hpp"
#include "runtime/numeric/profile/parabolic.hpp"
#include "runtime/numeric/profile/ramps.hpp"

namespace stride::motion {
namespace {

PlanError refuse(Profile &profile, const State &start) noexcept {
  profile.count = 0;
  profile.duration = 0.0;
  profile.end = {start.position, 0.0, 0.0};
  return PlanError::InvalidLimit;
}

JerkLimits jerkLimits(const Dynamics &dynamics) noexcept {
  return {dynamics.velocity, dynamics.acceleration, dynamics.deceleration, dynamics.jerk};
}

} // namespace

PlanError planMove(Profile &profile, const State &start, double target, double endVelocity,
                   const Dynamics &dynamics) noexcept {
  switch (dynamics.ramp) {
  case RampType::Trapezoid:
  case RampType::Sigmoid:
  case RampType::SigmoidLimited:
    return planRampMove(profile, start, target, endVelocity, dynamics);
  case RampType::Parabolic:
    return planParabolic(profile, start, target, endVelocity, jerkLimits(dynamics));
  }
  return refuse(profile, start);
}

PlanError planVelocity(Profile &profile, const State &start, double velocity,
                       const Dynamics &dynamics) noexcept {
  switch (dynamics.ramp) {
  case RampType::Trapezoid:
  case RampType::Sigmoid:
  case RampType::SigmoidLimited:
    return planRampVelocity(profile, start, velocity, dynamics);
  case RampType::Parabolic: {
    JerkLimits limits = jerkLimits(dynamics);
    limits.velocity = 1.0; // does not matter
    return planParabolicVelocity(profile, start, velocity, limits);
  }
  }
  return refuse(profile, start);
}

PlanError planStop(Profile &profile, const State &start, const Dynamics &dynamics) noexcept {
  Dynamics stopping = dynamics;
  stopping.acceleration = dynamics.deceleration;
  return planVelocity(profile, start, 0.0, stopping);
}

double reachableEndVelocity(const State &start, double target, double wanted,
                            const Dynamics &dynamics) noexcept {
  if (!isFinite(start) || !exact::isfinite(target) || !exact::isfinite(wanted) ||
      !exact::isPositive(dynamics.acceleration) || !exact::isPositive(dynamics.deceleration) ||
      (dynamics.ramp != RampType::Trapezoid && !exact::isPositive(dynamics.jerk)))
    return 0.0;
  double reachable = 0.0;
  switch (dynamics.ramp) {
  case RampType::Trapezoid:
  case RampType::Sigmoid:
  case RampType::SigmoidLimited:
    reachable = reachableByRamp(start, target, wanted, dynamics);
    break;
  case RampType::Parabolic:
    reachable = reachableByParabola(start, target, wanted, jerkLimits(dynamics));
    break;
  }
  // Scaling can round it up.
  return exact::fabs(reachable) < exact::fabs(wanted) ? reachable : wanted;
}

} // namespace stride::motion
