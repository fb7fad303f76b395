// SMC_GroupPrepareTrigger, SMC_GroupReadTrigger, and what else looks ahead.
#include "runtime/blocks/SM3_Robotics/group_block.hpp"
#include "runtime/blocks/SM3_Robotics/requests.hpp"

#include "st/SM3_Robotics/SMC_AXIS_GROUP_STATE.h"
#include "st/SM3_Robotics/SMC_GroupPrepareTrigger.h"
#include "st/SM3_Robotics/SMC_GroupReadPositionInMovement.h"
#include "st/SM3_Robotics/SMC_GroupReadRemainingTrajectoryDuration.h"
#include "st/SM3_Robotics/SMC_GroupReadTrigger.h"
#include "st/SM3_Robotics/SMC_TRIGGER_STATUS.h"
#include "st/SM3_Robotics/SMC_TriggerPositionType.h"
#include "st/SM3_Robotics/SMC_TuneCPKernel.h"

namespace {

namespace robotics = ::stride::robotics;
namespace group = ::stride::group;
namespace decl = ::st::SM3_Robotics;
using robotics::GroupRef;
using robotics::Trigger;
using robotics::TriggerKind;
using robotics::TriggerStage;

/// What the inputs say; false: there is no such type.
bool placeOf(int16_t type, const decl::SMC_TriggerPosition &position,
             robotics::TriggerPlace &place) noexcept {
  decl::SMC_TriggerPosition_Plane plane;
  static_assert(sizeof position == sizeof plane);
  __builtin_memcpy(&plane, &position, sizeof plane);
  __builtin_memcpy(&place.position, &position, sizeof place.position);
  place.plane.normal = {plane.NormalVector.dX, plane.NormalVector.dY, plane.NormalVector.dZ};
  place.plane.distance = plane.Distance;
  place.system = plane.CoordSystem;
  switch (type) {
  case decl::SMC_TriggerPositionType__MvtRelative:
    place.kind = TriggerKind::Relative;
    return true;
  case decl::SMC_TriggerPositionType__MvtDistance:
    place.kind = TriggerKind::Distance;
    return true;
  case decl::SMC_TriggerPositionType__PlaneIntersection:
    place.kind = TriggerKind::Plane;
    return true;
  default:
    return false;
  }
}

/// Shows what has become of what has been prepared.
void follow(decl::SMC_GroupPrepareTrigger &block, const GroupRef &group) noexcept {
  const Trigger *trigger = robotics::triggerOf(robotics::stateOf(group).triggers, block.TriggerId);
  if (trigger == nullptr)
    return;
  block.CommandAborted = trigger->stage == TriggerStage::Unused;
  block.Prepared = block.CommandAborted == 0 && trigger->stage != TriggerStage::Failed;
  if (trigger->stage == TriggerStage::Failed)
    robotics::setError(block, trigger->error);
}

int16_t statusOf(const Trigger &trigger) noexcept {
  switch (trigger.stage) {
  case TriggerStage::Prepared:
  case TriggerStage::Bound:
    return decl::SMC_TRIGGER_STATUS__Enabled;
  case TriggerStage::Placed:
    return trigger.active ? decl::SMC_TRIGGER_STATUS__Active : decl::SMC_TRIGGER_STATUS__Enabled;
  case TriggerStage::Reached:
    return decl::SMC_TRIGGER_STATUS__Active;
  case TriggerStage::Failed:
    return decl::SMC_TRIGGER_STATUS__Error;
  case TriggerStage::None:
  case TriggerStage::Unused:
  case TriggerStage::Gone:
    break;
  }
  return decl::SMC_TRIGGER_STATUS__Unknown;
}

} // namespace

void decl::SMC_GroupPrepareTrigger::body__(::stride::Ctx &ctx__) {
  if (AxisGroup != nullptr)
    robotics::serve(ctx__, *AxisGroup);
  const bool rising = robotics::rises(*this);
  if (rising || Execute == 0) {
    robotics::setError(*this, 0);
    Prepared = CommandAborted = 0;
    TriggerId = 0;
  }
  if (rising) {
    robotics::TriggerPlace place{};
    int16_t error = robotics::kNoGroup;
    if (AxisGroup != nullptr) {
      uint64_t id = 0;
      error = ::st::SM_Error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_PARAMETER;
      robotics::makeRoomForTrigger(robotics::stateOf(*AxisGroup));
      if (placeOf(PositionType, Position, place))
        error = robotics::prepareTrigger(robotics::stateOf(*AxisGroup).triggers, ctx__.cycle + 1,
                                         place, udiMost, id);
      TriggerId = id;
    }
    robotics::setError(*this, error);
  }
  if (AxisGroup != nullptr && TriggerId != 0)
    follow(*this, *AxisGroup);
}

void decl::SMC_GroupReadTrigger::body__(::stride::Ctx &ctx__) {
  TriggerInfo = {};
  robotics::runReader(ctx__, *this, [&](GroupRef &group) -> int16_t {
    const Trigger *trigger = robotics::triggerOf(robotics::stateOf(group).triggers, TriggerId);
    if (trigger == nullptr)
      return 0;
    constexpr double kSecond = 1e-9;
    TriggerInfo.triggerStatus = static_cast<decl::SMC_TRIGGER_STATUS>(statusOf(*trigger));
    if (TriggerInfo.triggerStatus == decl::SMC_TRIGGER_STATUS__Active)
      TriggerInfo.triggerTime =
          trigger->time - kSecond * static_cast<double>(ctx__.cycleStartNs - trigger->startNs);
    return trigger->stage == TriggerStage::Failed ? trigger->error : int16_t{0};
  });
}

void decl::SMC_GroupReadPositionInMovement::body__(::stride::Ctx &ctx__) {
  Position = 0.0;
  MovementId = 0;
  robotics::runReader(ctx__, *this, [this](GroupRef &group) -> int16_t {
    const robotics::GroupState &state = robotics::stateOf(group);
    if (group.bOwns != 0 && !state.motion.abandoned)
      Position = group::positionInMovement(state.motion, MovementId);
    return 0;
  });
  Valid = Valid != 0 && MovementId != 0;
}

void decl::SMC_GroupReadRemainingTrajectoryDuration::body__(::stride::Ctx &ctx__) {
  RemainingDuration = 0.0;
  MovementId = 0;
  robotics::runReader(ctx__, *this, [this](GroupRef &group) -> int16_t {
    const robotics::GroupState &state = robotics::stateOf(group);
    constexpr double kRounding = 1e-9; // the forecast goes down with each cycle
    const bool known = group.eState == decl::SMC_AXIS_GROUP_STATE__GroupMoving &&
                       !state.motion.abandoned && !robotics::demandsRest(state) &&
                       state.rest.movement != 0 && state.rest.time <= state.forecast + kRounding;
    if (known) {
      RemainingDuration = state.rest.time;
      MovementId = state.rest.movement;
    }
    return 0;
  });
  Valid = Valid != 0 && MovementId != 0;
}

void decl::SMC_TuneCPKernel::body__(::stride::Ctx & /*ctx__*/) {
  if (AxisGroup == nullptr)
    return;
  const double time = fPlanningForecastDuration;
  double forecast = time > 0.0 && ::stride::exact::isfinite(time) ? time : 0.0;
  // SoftMotion 3 has it called in the task that plans.
  __atomic_store(&AxisGroup->fForecast, &forecast, __ATOMIC_RELAXED);
}
