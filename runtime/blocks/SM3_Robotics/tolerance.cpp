// SMC_GroupSetPathTolerance.
#include "runtime/blocks/SM3_Robotics/tolerance.hpp"

#include "runtime/blocks/SM3_Robotics/group_block.hpp"

#include "st/SM3_Robotics/SMC_GroupSetPathTolerance.h"

namespace stride::robotics {
namespace {

namespace error = ::st::SM_Error;
using exact::fabs;
using kinematics::Frame;

constexpr double kRounding = 1e-9;

/// The angle of the turn between two orientations. [°]
double angleBetween(const kinematics::Matrix<double> &a, const kinematics::Matrix<double> &b) {
  constexpr double kDegrees = 57.29577951308232;
  // Of a turn the antisymmetric part has the length of its sine, the trace is 1 + 2 cosines.
  const kinematics::Matrix<double> turn = a.transpose() * b;
  const double x = turn(2, 1) - turn(1, 2);
  const double y = turn(0, 2) - turn(2, 0);
  const double z = turn(1, 0) - turn(0, 1);
  return kDegrees * ::stride::atan2(exact::sqrt(x * x + y * y + z * z), turn.trace() - 1.0);
}

/// How far the axes are from where they would be with the tool in another pose; what cannot be
/// reached is infinitely far.
void measureAxes(const group::Arm &arm, const double (&axes)[kAxes], const Frame<double> &there,
                 double (&lag)[kArmAxes]) {
  double path[kAxes];
  const bool reached = arm.kinematics.inverse(there, arm.kinematics.configurationOf(axes), axes,
                                              path) == kinematics::Outcome::Done;
  for (int32_t k = 0; k < arm.joints; ++k)
    lag[k] = reached ? fabs(path[k] - axes[k]) : exact::kInfinity;
}

} // namespace

int16_t lookAtLag(GroupRef &group, const GroupArm &arm) {
  GroupState &state = stateOf(group);
  const group::Ride &ride = state.motion.ride;
  state.hasReached = ride.follows && (state.hasReached || ride.inSync);
  state.orientationLag = 0.0;
  if (!ride.follows || ride.inSync)
    return 0;
  const Frame<double> tool = group::frameOf(state.motion.tool);
  const Frame<double> here = group::valueOf(group::copyOf(ride)) * tool;
  const Frame<double> there =
      group::valueOf(group::systemAt(ride.system, group::Series(ride.carrier.position))) * tool;
  state.orientationLag = angleBetween(here.turn, there.turn);
  const auto &tolerance = state.tolerance;
  if (tolerance.bSet == 0 || !state.hasReached)
    return 0;
  if ((here.place - there.place).norm() > tolerance.fPosition + kRounding)
    return error::SMC_ERROR__SMC_AXIS_GROUP_MAX_POSITION_LAG_EXCEEDED;
  if (state.orientationLag > tolerance.fOrientation + kRounding)
    return error::SMC_ERROR__SMC_AXIS_GROUP_MAX_ORIENTATION_LAG_EXCEEDED;
  double most[kArmAxes];
  static_assert(sizeof most == sizeof tolerance.stAxes);
  __builtin_memcpy(most, &tolerance.stAxes, sizeof most);
  double lag[kArmAxes] = {};
  measureAxes(arm.arm, state.motion.axes, there, lag);
  for (int32_t k = 0; k < arm.arm.joints; ++k)
    if (lag[k] > most[k] + kRounding)
      return error::SMC_ERROR__SMC_AXIS_GROUP_MAX_AXIS_LAG_EXCEEDED;
  return 0;
}

} // namespace stride::robotics

namespace {

namespace decl = ::st::SM3_Robotics;
namespace error = ::st::SM_Error;

bool isTolerance(double value) noexcept { return value >= 0.0 && ::stride::exact::isfinite(value); }

int16_t setTolerance(const decl::SMC_GroupSetPathTolerance &block,
                     ::stride::robotics::GroupRef &group) noexcept {
  double axes[::stride::robotics::kArmAxes];
  static_assert(sizeof axes == sizeof block.MaxAxisLag);
  __builtin_memcpy(axes, &block.MaxAxisLag, sizeof axes);
  bool good = isTolerance(block.MaxPositionLag) && isTolerance(block.MaxOrientationLag);
  for (const double axis : axes)
    good = good && isTolerance(axis);
  if (!good)
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_PARAMETER;
  group.stTolerance = {1, block.MaxPositionLag, block.MaxOrientationLag, block.MaxAxisLag};
  return 0;
}

} // namespace

void decl::SMC_GroupSetPathTolerance::body__(::stride::Ctx &ctx__) {
  if (AxisGroup != nullptr)
    ::stride::robotics::serve(ctx__, *AxisGroup);
  if (::stride::robotics::rises(*this)) {
    const int16_t wrong =
        AxisGroup != nullptr ? setTolerance(*this, *AxisGroup) : ::stride::robotics::kNoGroup;
    ::stride::robotics::setError(*this, wrong);
    Done = wrong == 0;
  } else if (Execute == 0) {
    ::stride::robotics::setError(*this, 0);
    Done = 0;
  }
}
