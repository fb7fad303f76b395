// The blocks that say what a group is: its axes, kinematics, coordinate systems, tool, and whether
// it is enabled.
#include "runtime/blocks/SM3_Robotics/carriers.hpp"
#include "runtime/blocks/SM3_Robotics/group_block.hpp"
#include "runtime/blocks/SM3_Robotics/overrides.hpp"
#include "runtime/numeric/group/kept_path.hpp"

#include "st/SM3_Robotics/MC_AddAxisToGroup.h"
#include "st/SM3_Robotics/MC_GroupDisable.h"
#include "st/SM3_Robotics/MC_GroupEnable.h"
#include "st/SM3_Robotics/MC_ReadCoordinateTransform.h"
#include "st/SM3_Robotics/MC_RemoveAxisFromGroup.h"
#include "st/SM3_Robotics/MC_SetCoordinateTransform.h"
#include "st/SM3_Robotics/MC_SetKinTransform.h"
#include "st/SM3_Robotics/MC_UngroupAllAxes.h"
#include "st/SM3_Robotics/SMC_AXIS_GROUP_STATE.h"
#include "st/SM3_Robotics/SMC_COORD_SYSTEM.h"
#include "st/SM3_Robotics/SMC_GroupSetTool.h"
#include "st/SM3_Robotics/SMC_GroupUpdate.h"
#include "st/SM3_Robotics/SMC_SetKinConfiguration.h"

namespace {

namespace robotics = ::stride::robotics;
namespace decl = ::st::SM3_Robotics;
namespace error = ::st::SM_Error;
using robotics::GroupRef;

bool isDisabled(const GroupRef &group) noexcept {
  return group.eState == decl::SMC_AXIS_GROUP_STATE__GroupDisabled;
}

/// Which of the group's axes it is; -1: none.
int32_t indexOf(const GroupRef &group, const void *axis) noexcept {
  for (int32_t i = 0; i < group.uiAxes; ++i)
    if (group.apAxis.v[i] == axis)
      return i;
  return -1;
}

} // namespace

void decl::MC_GroupEnable::body__(::stride::Ctx &ctx__) {
  robotics::runOnce(ctx__, *this, [&](GroupRef &group) { return robotics::enable(ctx__, group); });
}

void decl::MC_GroupDisable::body__(::stride::Ctx &ctx__) {
  robotics::runOnce(ctx__, *this, [](GroupRef &group) -> int16_t {
    if (group.eState != decl::SMC_AXIS_GROUP_STATE__GroupStandby)
      return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
    ::stride::group::abortInterrupted(robotics::stateOf(group).motion);
    robotics::endTriggers(robotics::stateOf(group));
    group.eState = decl::SMC_AXIS_GROUP_STATE__GroupDisabled;
    return 0;
  });
}

void decl::MC_AddAxisToGroup::body__(::stride::Ctx &ctx__) {
  robotics::runOnce(ctx__, *this, [this](GroupRef &group) -> int16_t {
    if (!isDisabled(group) || Axis == nullptr)
      return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
    if (indexOf(group, Axis) >= 0)
      return error::SMC_ERROR__SMC_AXIS_GROUP_AXIS_ADDED_TWICE;
    if (group.uiAxes >= robotics::kAxes)
      return error::SMC_ERROR__SMC_AXIS_GROUP_TOO_MANY_AXES;
    group.apAxis.v[group.uiAxes] = Axis;
    ++group.uiAxes;
    return 0;
  });
}

void decl::MC_RemoveAxisFromGroup::body__(::stride::Ctx &ctx__) {
  robotics::runOnce(ctx__, *this, [this](GroupRef &group) -> int16_t {
    if (!isDisabled(group))
      return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
    const int32_t index = indexOf(group, Axis);
    if (index < 0)
      return error::SMC_ERROR__SMC_AXIS_GROUP_AXIS_NOT_IN_GROUP;
    --group.uiAxes;
    for (int32_t i = index; i < group.uiAxes; ++i)
      group.apAxis.v[i] = group.apAxis.v[i + 1];
    robotics::removeShares(group, index);
    return 0;
  });
}

void decl::MC_UngroupAllAxes::body__(::stride::Ctx &ctx__) {
  robotics::runOnce(ctx__, *this, [](GroupRef &group) -> int16_t {
    if (!isDisabled(group))
      return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
    for (; group.uiAxes > 0; --group.uiAxes)
      robotics::resetShares(group, group.uiAxes - 1);
    return 0;
  });
}

void decl::MC_SetKinTransform::body__(::stride::Ctx &ctx__) {
  robotics::runOnce(ctx__, *this, [&](GroupRef &group) {
    return robotics::setKinematics(ctx__, group, KinTransform);
  });
}

void decl::SMC_SetKinConfiguration::body__(::stride::Ctx &ctx__) {
  robotics::runOnce(ctx__, *this, [this](GroupRef &group) -> int16_t {
    if (group.eState == decl::SMC_AXIS_GROUP_STATE__GroupErrorStop)
      return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
    group.stConfiguration = ConfigData;
    group.bConfiguration = 1;
    return 0;
  });
}

void decl::MC_SetCoordinateTransform::body__(::stride::Ctx &ctx__) {
  robotics::runOnce(ctx__, *this, [this](GroupRef &group) -> int16_t {
    const int32_t index = robotics::settableSystem(CoordSystem);
    if (index < 0)
      return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_COORDINATE_SYSTEM;
    if (!robotics::isFinite(CoordTransform))
      return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_PARAMETER;
    if (CoordSystem == decl::SMC_COORD_SYSTEM__MCS &&
        (robotics::isInUse(group, decl::SMC_COORD_SYSTEM__PCS_1) ||
         robotics::isInUse(group, decl::SMC_COORD_SYSTEM__PCS_2)))
      return error::SMC_ERROR__SMC_AXIS_GROUP_PCS_STILL_IN_USE;
    if (robotics::isInUse(group, CoordSystem))
      return error::SMC_ERROR__SMC_AXIS_GROUP_PCS_STILL_IN_USE;
    if (index > 0)
      group.astCarrier.v[index - 1] = {};
    group.astSystem.v[index] = CoordTransform;
    return 0;
  });
}

void decl::MC_ReadCoordinateTransform::body__(::stride::Ctx &ctx__) {
  robotics::runReader(ctx__, *this, [this](GroupRef &group) -> int16_t {
    const int32_t index = robotics::settableSystem(CoordSystem);
    if (index < 0)
      return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_COORDINATE_SYSTEM;
    CoordTransform = group.astSystem.v[index];
    if (const int32_t carrier = robotics::carrierOf(group, CoordSystem); carrier != 0) {
      double pose[robotics::kArmAxes];
      robotics::toPose(robotics::systemInWorld(group, carrier), pose);
      static_assert(sizeof pose == sizeof CoordTransform);
      __builtin_memcpy(&CoordTransform, pose, sizeof pose);
    }
    return 0;
  });
}

void decl::SMC_GroupSetTool::body__(::stride::Ctx &ctx__) {
  robotics::runOnce(ctx__, *this,
                    [&](GroupRef &group) { return robotics::setTool(ctx__, group, ToolOffset); });
}

void decl::SMC_GroupUpdate::body__(::stride::Ctx &ctx__) {
  const bool enabled = Enable != 0;
  robotics::setError(*this, enabled && AxisGroup == nullptr ? robotics::kNoGroup : int16_t{0});
  if (enabled && AxisGroup != nullptr)
    robotics::serve(ctx__, *AxisGroup);
}
