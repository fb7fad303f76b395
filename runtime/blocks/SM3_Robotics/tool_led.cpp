#include "runtime/blocks/SM3_Robotics/tool_led.hpp"

namespace stride::robotics {
namespace {

namespace error = ::st::SM_Error;
using kinematics::Frame;
using kinematics::Outcome;
using kinematics::Vector;

/// How far an axis may be from where the kinematics has it: but for rounding, which counts most
/// where arms are stretched, it is there. [u]
double nearness(const group::Arm &arm, int32_t axis) {
  constexpr double kTime = 1e-3; // at the greatest velocity [s]
  constexpr double kAngle = 0.01;
  constexpr double kPart = 1e-6;
  return exact::larger(kTime * arm.limits[axis].velocity,
                       arm.kinematics.turns(axis) ? kAngle : kPart * arm.kinematics.reach());
}

/// The arm in the configuration in which axes stand.
group::Arm standing(const group::Arm &arm, const double *axes) {
  return {arm.kinematics, arm.joints, arm.more, arm.limits, arm.kinematics.configurationOf(axes)};
}

/// The axes at a way along a leg, from where they are nearby. An SMC_ERROR.
int16_t stepTo(const group::Arm &arm, const group::Leg &leg, double way, double (&axes)[kAxes]) {
  constexpr double kRounding = 1e-9;
  group::PathPlace place;
  group::placeAt(leg, group::Series(way), place);
  double found[kAxes] = {};
  if (const int16_t wrong =
          axesFor(arm, group::valueOf(place.tool), arm.configuration, axes, found);
      wrong != 0)
    return wrong;
  for (int32_t k = 0; k < arm.joints; ++k) {
    const group::AxisLimits &limits = arm.limits[k];
    const double slack = kRounding * (exact::fabs(limits.low) + exact::fabs(limits.high));
    if (found[k] < limits.low - slack || found[k] > limits.high + slack)
      return error::SMC_ERROR__SMC_TRAFO_AXIS_LIMITS_EXCEEDED;
    axes[k] = found[k];
  }
  return 0;
}

} // namespace

bool reaches(const group::Arm &arm, const double *axes, const Vector<double> &place) {
  constexpr double kNear = 1e-6;
  Frame<double> reached;
  return arm.kinematics.forward(axes, reached) == Outcome::Done &&
         (reached.place - place).norm() <= kNear * arm.kinematics.reach();
}

int16_t axesFor(const group::Arm &arm, const Frame<double> &pose,
                const kinematics::Configuration &configuration, const double *reference,
                double *axes) {
  const Outcome outcome = arm.kinematics.inverse(pose, configuration, reference, axes);
  if (outcome != Outcome::Done)
    return kinematics::errorOf(outcome);
  return reaches(arm, axes, pose.place) ? int16_t{0} : error::SMC_ERROR__SMC_TRAFO_OUT_OF_WORKSPACE;
}

int16_t whyNotFrom(const group::Arm &arm, const double (&axes)[kAxes]) {
  Frame<double> pose;
  if (const Outcome outcome = arm.kinematics.forward(axes, pose); outcome != Outcome::Done)
    return kinematics::errorOf(outcome);
  double chosen[kAxes] = {};
  if (arm.kinematics.inverse(pose, arm.kinematics.configurationOf(axes), axes, chosen) !=
      Outcome::Done)
    return 0; // that a limit is exceeded is found where the path is looked at
  for (int32_t k = 0; k < arm.joints; ++k)
    if (!(exact::fabs(chosen[k] - axes[k]) <= nearness(arm, k)))
      return error::SMC_ERROR__SMC_CP_CONFIGS_DIFFER;
  return 0;
}

int16_t followLeg(const group::Arm &arm, const group::Leg &leg, int32_t parts, Ends &ends) {
  const group::Arm follows = standing(arm, ends.from);
  for (int32_t k = 0; k < kArmAxes; ++k)
    ends.to[k] = ends.from[k];
  for (int32_t i = 1; i <= parts; ++i)
    if (const int16_t wrong =
            stepTo(follows, leg, i == parts ? leg.length : leg.length * i / parts, ends.to);
        wrong != 0)
      return wrong;
  return 0;
}

int16_t settleLine(const group::Arm &arm, const group::Leg &leg, Ends &ends) {
  constexpr double kTurn = 360.0;
  constexpr int32_t kParts = 12;
  if (leg.kind == group::LegKind::Axes || !(leg.length > 0.0))
    return 0;
  Ends followed = ends;
  if (followLeg(arm, leg, kParts, followed) != 0)
    return 0; // why it does not go on is said where the path is looked at
  for (int32_t k = 0; k < arm.joints; ++k) {
    const double apart = followed.to[k] - ends.to[k];
    const double turns = exact::floor(apart / kTurn + 0.5);
    if (!(exact::fabs(apart - turns * kTurn) <= nearness(arm, k)))
      return error::SMC_ERROR__SMC_CP_CONFIGS_DIFFER;
    if (turns != 0.0)
      ends.to[k] = followed.to[k];
  }
  return 0;
}

} // namespace stride::robotics
