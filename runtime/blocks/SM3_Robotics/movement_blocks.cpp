// MC_MoveLinearAbsolute, -Relative, MC_MoveDirectAbsolute, -Relative, MC_GroupHalt, MC_GroupStop.
#include "runtime/blocks/SM3_Robotics/movement_inputs.hpp"

#include "st/SM3_Robotics/MC_GroupHalt.h"
#include "st/SM3_Robotics/MC_GroupStop.h"
#include "st/SM3_Robotics/MC_MoveDirectAbsolute.h"
#include "st/SM3_Robotics/MC_MoveDirectRelative.h"
#include "st/SM3_Robotics/MC_MoveLinearAbsolute.h"
#include "st/SM3_Robotics/MC_MoveLinearRelative.h"
#include "st/SM3_Robotics/MC_TRANSITION_MODE.h"
#include "st/SM3_Robotics/SMC_AXIS_GROUP_STATE.h"
#include "st/SM_DriveBasic/MC_BUFFER_MODE.h"

namespace stride::robotics {

namespace decl = ::st::SM3_Robotics;
namespace buffer = ::st::SM_DriveBasic;

group::CornerSpeed cornerSpeedOf(int16_t mode) noexcept {
  switch (mode) {
  case buffer::MC_BUFFER_MODE__BlendingPrevious:
    return group::CornerSpeed::First;
  case buffer::MC_BUFFER_MODE__BlendingNext:
    return group::CornerSpeed::Second;
  case buffer::MC_BUFFER_MODE__BlendingHigh:
    return group::CornerSpeed::Greater;
  default:
    return group::CornerSpeed::Smaller;
  }
}

group::Transition transitionOf(int16_t bufferMode, int16_t transition) noexcept {
  if (bufferMode < buffer::MC_BUFFER_MODE__BlendingLow)
    return group::Transition::None;
  switch (transition) {
  case decl::MC_TRANSITION_MODE__TMCornerDistance:
    return group::Transition::Distance;
  case decl::MC_TRANSITION_MODE__TMStartVelocity:
    return group::Transition::StartVelocity;
  default:
    return group::Transition::None;
  }
}

} // namespace stride::robotics

namespace {

namespace robotics = ::stride::robotics;
namespace decl = ::st::SM3_Robotics;
namespace buffer = ::st::SM_DriveBasic;
using robotics::Request;

template <class Block>
void runLinear(::stride::Ctx &ctx, Block &block, const decl::SMC_POS_REF &position, bool relative) {
  robotics::runMovement(ctx, block, [&](Request &request) {
    request.kind = robotics::RequestKind::Linear;
    request.relative = relative;
    robotics::fillCoordinates(position, request.position);
    robotics::fillModes(block, request);
    robotics::fillPath(block, request);
    robotics::fillOrientation(block, request);
  });
}

template <class Block>
void runDirect(::stride::Ctx &ctx, Block &block, const decl::SMC_POS_REF &position, bool relative) {
  robotics::runMovement(ctx, block, [&](Request &request) {
    request.kind = robotics::RequestKind::Direct;
    request.relative = relative;
    robotics::fillCoordinates(position, request.position);
    robotics::fillModes(block, request);
  });
}

} // namespace

void decl::MC_MoveLinearAbsolute::body__(::stride::Ctx &ctx__) {
  runLinear(ctx__, *this, Position, false);
}
void decl::MC_MoveLinearRelative::body__(::stride::Ctx &ctx__) {
  runLinear(ctx__, *this, Distance, true);
}
void decl::MC_MoveDirectAbsolute::body__(::stride::Ctx &ctx__) {
  runDirect(ctx__, *this, Position, false);
}
void decl::MC_MoveDirectRelative::body__(::stride::Ctx &ctx__) {
  runDirect(ctx__, *this, Distance, true);
}

void decl::MC_GroupHalt::body__(::stride::Ctx &ctx__) {
  robotics::runMovement(ctx__, *this, [this](Request &request) {
    request.kind = robotics::RequestKind::Halt;
    request.bufferMode = buffer::MC_BUFFER_MODE__Aborting;
    request.deceleration = Deceleration;
    request.jerk = Jerk;
    request.order.accelerationFactor = AccFactor;
    request.order.jerkFactor = JerkFactor;
    request.torqueFactor = TorqueFactor;
    request.forgets = ClearMovements != 0;
  });
  Active = Busy;
}

void decl::MC_GroupStop::body__(::stride::Ctx &ctx__) {
  if (AxisGroup != nullptr)
    robotics::serve(ctx__, *AxisGroup);
  if (robotics::rises(*this)) {
    Request stop = {};
    stop.kind = robotics::RequestKind::Halt;
    stop.deceleration = Deceleration;
    stop.jerk = Jerk;
    stop.order.accelerationFactor = AccFactor;
    stop.order.jerkFactor = JerkFactor;
    stop.torqueFactor = 1.0;
    const int16_t error = AxisGroup != nullptr
                              ? robotics::beginStop(ctx__, *AxisGroup, stop, stBlock.ulId)
                              : robotics::kNoGroup;
    robotics::setError(*this, error);
    // One that is refused while it holds the group goes on to hold it.
    stBlock.bRunning = error == 0 || (stBlock.bRunning != 0 && AxisGroup != nullptr);
    Done = CommandAborted = 0;
  } else if (Execute == 0 && stBlock.bRunning == 0) {
    robotics::setError(*this, 0);
    Done = CommandAborted = 0;
  }
  if (stBlock.bRunning != 0) {
    const bool holds = AxisGroup->eState == decl::SMC_AXIS_GROUP_STATE__GroupStopping;
    const bool rests = holds && robotics::rests(*AxisGroup);
    const bool ends = rests && Execute == 0;
    CommandAborted = !holds && Error == 0;
    Done = rests && Error == 0;
    if (ends) {
      stBlock.ulId = 0;
      robotics::endStop(*AxisGroup);
    }
    stBlock.bRunning = holds && !ends;
  }
  Active = stBlock.bRunning;
  Busy = stBlock.bRunning != 0 && Error == 0;
}
