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

/// Axes that bring the tool to a place of a leg, which may give tool axes. An SMC_ERROR.
int16_t axesOn(const group::Arm &arm, const group::PathPlace &place, const double *reference,
               double *axes) {
  const Frame<double> tool = group::valueOf(place.tool);
  if (place.given == 0)
    return axesFor(arm, tool, arm.configuration, reference, axes);
  for (int32_t k = 0; k < kArmAxes; ++k)
    if (group::isGiven(place.given, k))
      axes[k] = place.axes[k].c[0];
  const Outcome outcome = arm.kinematics.place(tool.place, arm.configuration, reference, axes);
  if (outcome != Outcome::Done)
    return kinematics::errorOf(outcome);
  return reaches(arm, axes, tool.place) ? int16_t{0} : error::SMC_ERROR__SMC_TRAFO_OUT_OF_WORKSPACE;
}

/// The axes at a way along a leg, from where they are nearby. An SMC_ERROR.
int16_t stepTo(const group::Arm &arm, const group::Leg &leg, double way, double (&axes)[kAxes]) {
  constexpr double kRounding = 1e-9;
  group::PathPlace place;
  group::placeAt(leg, group::Series(way), place);
  double found[kAxes] = {};
  if (const int16_t wrong = axesOn(arm, place, axes, found); wrong != 0)
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

/// How far axes are apart at most, in units of what counts as the same place.
double distanceOf(const group::Arm &arm, const double (&a)[kAxes], const double (&b)[kAxes]) {
  double most = 0.0;
  for (int32_t k = 0; k < arm.joints; ++k)
    most = exact::larger(most, exact::fabs(a[k] - b[k]) / nearness(arm, k));
  return most;
}

/// Whether axes jump between two places of a leg, from the first of which they are known: what they
/// go does not become less in ever smaller parts. It is looked for where they go furthest.
bool jumpBetween(const group::Arm &arm, const group::Leg &leg, double low, double high,
                 const double (&axes)[kAxes]) {
  constexpr int32_t kHalves = 24;
  constexpr double kFar = 10.0; // arms that are stretched turn quickly, too
  double begin[kAxes];
  __builtin_memcpy(begin, axes, sizeof begin);
  double apart = kFar + 1.0;
  for (int32_t i = 0; i < kHalves && apart > kFar; ++i) {
    const double middle = low + 0.5 * (high - low);
    double half[kAxes];
    double end[kAxes];
    __builtin_memcpy(half, begin, sizeof half);
    if (stepTo(arm, leg, middle, half) != 0)
      return false; // why it does not go on is said elsewhere
    __builtin_memcpy(end, half, sizeof end);
    if (stepTo(arm, leg, high, end) != 0)
      return false;
    const double first = distanceOf(arm, begin, half);
    const double second = distanceOf(arm, half, end);
    apart = exact::larger(first, second);
    (first >= second ? high : low) = middle;
    if (first < second)
      __builtin_memcpy(begin, half, sizeof begin);
  }
  return apart > kFar;
}

/// An angle, with the whole turns that bring it within limits, if any do. [°]
double turnedWithin(const group::AxisLimits &limits, double angle) {
  constexpr double kTurn = 360.0;
  double turned = angle;
  if (angle < limits.low)
    turned += kTurn * exact::ceil((limits.low - angle) / kTurn);
  else if (angle > limits.high)
    turned -= kTurn * exact::ceil((angle - limits.high) / kTurn);
  return turned >= limits.low && turned <= limits.high ? turned : angle;
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
  for (int32_t k = 0; k < arm.joints; ++k)
    axes[k] = group::withoutRounding(arm.limits[k], axes[k]);
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
  const group::Arm follows{arm.kinematics, arm.joints, arm.more, arm.limits,
                           configurationFor(arm, leg, ends.from)};
  for (int32_t k = 0; k < kArmAxes; ++k)
    ends.to[k] = ends.from[k];
  // Where nothing decides an angle at the start, it may have to be another one at once.
  constexpr double kFirst = 1e-3;
  constexpr double kFar = 20.0; // [°], [u]
  double low = 0.0;
  for (int32_t i = 0; i <= parts; ++i) {
    double before[kAxes];
    __builtin_memcpy(before, ends.to, sizeof before);
    double high = i == parts ? leg.length : leg.length * i / parts;
    if (i == 0)
      high = kFirst * leg.length / parts;
    if (const int16_t wrong = stepTo(follows, leg, high, ends.to); wrong != 0)
      return wrong;
    bool far = i == 0;
    for (int32_t k = 0; k < arm.joints; ++k)
      far = far || exact::fabs(ends.to[k] - before[k]) > kFar;
    if (far && jumpBetween(follows, leg, low, high, before))
      return error::SMC_ERROR__SMC_AXIS_GROUP_SINGULAR_PATH;
    low = high;
  }
  return 0;
}

int16_t settleLine(const group::Arm &arm, const group::Leg &leg, int32_t parts, Ends &ends) {
  constexpr double kTurn = 360.0;
  if (leg.kind == group::LegKind::Axes || !(leg.length > 0.0))
    return 0;
  Ends followed = ends;
  const int16_t wrong = followLeg(arm, leg, parts, followed);
  if (wrong == error::SMC_ERROR__SMC_AXIS_GROUP_SINGULAR_PATH)
    return wrong;
  if (wrong != 0)
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

int16_t settleWithToolAxes(const group::Arm &arm, group::Leg &leg, int32_t parts, bool anyTurn,
                           Ends &ends) {
  unsigned given = 0;
  if (!arm.kinematics.splits(given))
    return error::SMC_ERROR__SMC_CP_NO_AXIS_ORIENTATION;
  if (given == 0) // the tool does not turn by axes of its own
    return settleLine(arm, leg, parts, ends);
  for (int32_t k = 0; k < kArmAxes && anyTurn; ++k)
    if (group::isGiven(static_cast<uint8_t>(given), k) && arm.kinematics.turns(k))
      ends.to[k] = turnedWithin(arm.limits[k], ends.to[k]);
  group::giveToolAxes(leg, static_cast<uint8_t>(given), ends.from, ends.to);
  const int16_t wrong = settleLine(arm, leg, parts, ends);
  // Placing axes that would jump, or end in another configuration, would have to pass such a pose.
  return wrong == error::SMC_ERROR__SMC_AXIS_GROUP_SINGULAR_PATH ||
                 wrong == error::SMC_ERROR__SMC_CP_CONFIGS_DIFFER
             ? error::SMC_ERROR__SMC_CP_AXIS_ORIENTATION_SINGULAR
             : wrong;
}

kinematics::Configuration configurationFor(const group::Arm &arm, const group::Leg &leg,
                                           const double *axes) {
  return leg.given != 0 ? arm.kinematics.placingConfigurationOf(axes)
                        : arm.kinematics.configurationOf(axes);
}

} // namespace stride::robotics
