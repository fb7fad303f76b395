// What is said of a group before it moves, and what it says of itself: kinematics, tool, position.
#include "runtime/blocks/SM3_Robotics/planning.hpp"

#include "runtime/axis/axis_ref.hpp"
#include "runtime/numeric/kinematics/orientation.hpp"

#include "st/SM3_Robotics/SMC_AXIS_GROUP_STATE.h"
#include "st/SM3_Robotics/SMC_COORD_SYSTEM.h"

namespace stride::robotics {
namespace {

namespace decl = ::st::SM3_Robotics;
namespace error = ::st::SM_Error;
using kinematics::Frame;
using kinematics::Outcome;

bool isMovingOrFailed(const GroupRef &group) noexcept {
  return group.eState != decl::SMC_AXIS_GROUP_STATE__GroupDisabled &&
         group.eState != decl::SMC_AXIS_GROUP_STATE__GroupStandby;
}

} // namespace

int16_t setKinematics(Ctx &ctx, GroupRef &group, Interface kinematics) {
  if (isMovingOrFailed(group))
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  const kinematics::KinematicsOf looked(ctx, kinematics);
  if (looked.check() != Outcome::Done)
    return kinematics::errorOf(looked.check());
  if (const int16_t wrong = whyNotAside(group, looked); wrong != 0)
    return wrong;
  const bool enabled = group.eState != decl::SMC_AXIS_GROUP_STATE__GroupDisabled;
  if (enabled && looked.ref().joints() != group.uiJoints)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_NUMBER_OF_AXES;
  group.itfKinematics = kinematics;
  group.bConfiguration = 0;
  group.bTool = 0;
  return 0;
}

int16_t setTool(Ctx &ctx, GroupRef &group, const decl::MC_COORD_REF &tool) {
  if (group.eState == decl::SMC_AXIS_GROUP_STATE__GroupDisabled ||
      group.eState == decl::SMC_AXIS_GROUP_STATE__GroupErrorStop)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  kinematics::KinematicsOf looked(ctx, group.itfKinematics);
  const Outcome outcome = looked.setTool(frameOf(tool));
  if (outcome != Outcome::Done)
    return kinematics::errorOf(outcome);
  group.stTool = tool;
  group.bTool = 1;
  return 0;
}

int16_t readPosition(Ctx &ctx, GroupRef &group, int16_t system, bool actual,
                     decl::SMC_POS_REF &position,
                     ::st::SM3_Transformation::CONFIGDATA &configuration) {
  double axes[kAxes] = {};
  for (int32_t i = 0; i < group.uiAxes; ++i) {
    const axis::AxisRef &axis = *group.apAxis.v[i];
    axes[placeOf(group, i)] = actual ? axis.fActPosition : axis.fSetPosition;
  }
  return positionOf(ctx, group, system, axes, position, configuration);
}

int16_t positionOf(Ctx &ctx, GroupRef &group, int16_t system, const double (&axes)[kAxes],
                   decl::SMC_POS_REF &position,
                   ::st::SM3_Transformation::CONFIGDATA &configuration) {
  double result[kArmAxes];
  __builtin_memcpy(result, axes, sizeof result);
  configuration = {};
  if (system != decl::SMC_COORD_SYSTEM__ACS) {
    const GroupArm arm(ctx, group);
    if (const int16_t wrong = whyNoTool(group, arm); wrong != 0)
      return wrong;
    Frame<double> tool;
    const Outcome outcome = arm.arm.kinematics.forward(axes, tool);
    if (outcome != Outcome::Done)
      return kinematics::errorOf(outcome);
    Frame<double> origin;
    if (const int16_t wrong = originOf(group, arm, system, origin); wrong != 0)
      return wrong;
    toPose(kinematics::inverted(origin) * tool, result);
    const kinematics::Configuration stands = arm.arm.kinematics.configurationOf(axes);
    __builtin_memcpy(&configuration, &stands, sizeof configuration);
  }
  static_assert(sizeof position == sizeof result);
  __builtin_memcpy(&position, result, sizeof position);
  return 0;
}

} // namespace stride::robotics
