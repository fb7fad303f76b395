// What a group says of itself.
#include "runtime/blocks/SM3_Robotics/group_block.hpp"

#include "st/SM3_Robotics/MC_GroupReadActualPosition.h"
#include "st/SM3_Robotics/MC_GroupReadError.h"
#include "st/SM3_Robotics/MC_GroupReadStatus.h"
#include "st/SM3_Robotics/SMC_AXIS_GROUP_STATE.h"
#include "st/SM3_Robotics/SMC_GroupReadSetPosition.h"

namespace {

namespace robotics = ::stride::robotics;
namespace decl = ::st::SM3_Robotics;
using robotics::GroupRef;

} // namespace

void decl::MC_GroupReadStatus::body__(::stride::Ctx &ctx__) {
  GroupMoving = GroupHoming = GroupErrorStop = GroupStandby = GroupStopping = GroupDisabled = 0;
  TrackingDynamicCS = InSync = 0;
  ActiveMovementId = FirstReferencedMovementId = LastAcceptedMovementId = 0;
  PositionLag = OrientationLag = CurrentPlanningForecast = 0.0;
  robotics::runReader(ctx__, *this, [this](GroupRef &group) -> int16_t {
    const robotics::GroupState &state = robotics::stateOf(group);
    GroupMoving = group.eState == decl::SMC_AXIS_GROUP_STATE__GroupMoving;
    GroupErrorStop = group.eState == decl::SMC_AXIS_GROUP_STATE__GroupErrorStop;
    GroupStandby = group.eState == decl::SMC_AXIS_GROUP_STATE__GroupStandby;
    GroupStopping = group.eState == decl::SMC_AXIS_GROUP_STATE__GroupStopping;
    GroupDisabled = group.eState == decl::SMC_AXIS_GROUP_STATE__GroupDisabled;
    const ::stride::group::Movement *active = ::stride::group::activeOf(state.motion);
    if (GroupMoving != 0 && active != nullptr && !state.motion.abandoned)
      ActiveMovementId = active->id;
    const bool settles = (state.motion.ride.follows && !state.hasReached) ||
                         !::stride::group::isStill(state.motion.left);
    FirstReferencedMovementId = settles ? state.referenced : ActiveMovementId;
    LastAcceptedMovementId = state.lastAccepted;
    TrackingDynamicCS = state.motion.ride.follows ? 1 : 0;
    InSync = state.motion.ride.inSync ? 1 : 0;
    PositionLag = ::stride::group::lagOf(state.motion);
    OrientationLag = state.orientationLag;
    if (group.bOwns != 0)
      CurrentPlanningForecast = state.forecast;
    return 0;
  });
}

void decl::MC_GroupReadError::body__(::stride::Ctx &ctx__) {
  GroupErrorID = ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR;
  robotics::runReader(ctx__, *this, [this](GroupRef &group) -> int16_t {
    GroupErrorID = group.eError;
    return 0;
  });
}

void decl::MC_GroupReadActualPosition::body__(::stride::Ctx &ctx__) {
  robotics::runReader(ctx__, *this, [&](GroupRef &group) {
    return robotics::readPosition(ctx__, group, CoordSystem, true, Position, KinematicConfig);
  });
}

void decl::SMC_GroupReadSetPosition::body__(::stride::Ctx &ctx__) {
  robotics::runReader(ctx__, *this, [&](GroupRef &group) {
    return robotics::readPosition(ctx__, group, CoordSystem, false, Position, KinematicConfig);
  });
}
