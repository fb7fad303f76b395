// MC_MoveAbsolute: positioning on linear and rotary axes.
#include "runtime/axis/exact_math.hpp"
#include "runtime/motion/modulo.hpp"
#include "runtime/motion/plan_axis.hpp"
#include "runtime/motion/trapezoid.hpp"

#include "st/SM_DriveBasic/MC_BUFFER_MODE.h"
#include "st/SM_PLCopen/MC_MoveAbsolute.h"

namespace {

namespace axis = ::stride::axis;
namespace exact = ::stride::exact;
namespace motion = ::stride::motion;
using Block = ::st::SM_PLCopen::MC_MoveAbsolute;
using axis::AxisRef;

axis::Ownership ownership(Block &block) noexcept { return {block.iOwner, block.ulOwnerCount}; }

void clearOutputs(Block &block) noexcept {
  block.Done = 0;
  block.CommandAborted = 0;
  block.Error = 0;
  block.ErrorID = axis::error::kNone;
}

void end(Block &block) noexcept {
  block.bRunning = 0;
  block.bWaiting = 0;
  block.Busy = 0;
  block.Active = 0;
}

void fail(Block &block, int16_t errorId) noexcept {
  end(block);
  block.Error = 1;
  block.ErrorID = errorId;
  if (block.Axis != nullptr)
    axis::noteError(*block.Axis, errorId);
}

void abort(Block &block) noexcept {
  end(block);
  block.CommandAborted = 1;
}

void finish(Block &block) noexcept {
  end(block);
  block.Done = 1;
  block.Axis->nAxisState = axis::state::kStandstill;
  axis::releaseAxis(*block.Axis);
}

/// Why the axis takes no motion command now; kNone if it does.
int16_t refusal(const AxisRef &ref) noexcept {
  if (ref.nAxisState == axis::state::kErrorStop)
    return axis::error::kNotReady;
  if (const int16_t error = axis::readiness(ref); error != axis::error::kNone)
    return error;
  if (ref.nAxisState == axis::state::kStopping)
    return axis::error::kStopBlocks;
  if (ref.nAxisState == axis::state::kHoming)
    return axis::error::kNotReady;
  return axis::error::kNone;
}

/// Plans the stored command from the axis's present set values; an SMC_ERROR.
int16_t plan(const Block &block, motion::Profile &profile, double &target) noexcept {
  const auto &command = block.stCommand;
  const AxisRef &ref = *block.Axis;
  const motion::TrapezoidLimits limits{command.fVelocity, command.fAcceleration,
                                       command.fDeceleration};
  target = command.fPosition;
  double goal = target;
  if (axis::isRotary(ref)) {
    if (!exact::isfinite(target))
      return axis::error::kMoveAbsoluteValues;
    target = axis::wrapPosition(target, ref.fPositionPeriod);
    const motion::ModuloRequest request{ref.fSetPosition,
                                        ref.fSetVelocity,
                                        target,
                                        ref.fPositionPeriod,
                                        static_cast<motion::Direction>(command.eDirection),
                                        ref.nDirection < 0 ? motion::Direction::Negative
                                                           : motion::Direction::Positive,
                                        limits};
    if (!motion::resolveModulo(request, goal))
      return axis::error::kMoveAbsoluteValues;
  }
  if (motion::planTrapezoid(profile, ref.fSetPosition, ref.fSetVelocity, goal, limits) !=
      motion::PlanError::None)
    return axis::error::kMoveAbsoluteValues;
  return axis::error::kNone;
}

bool isDirection(int16_t direction) noexcept { return direction >= -1 && direction <= 3; }

/// Takes the axis and moves it, or fails and leaves it as it is.
void launch(Block &block) noexcept {
  AxisRef &ref = *block.Axis;
  motion::Profile profile;
  double target = 0.0;
  if (const int16_t error = plan(block, profile, target); error != axis::error::kNone) {
    fail(block, error);
    return;
  }
  axis::takeAxis(ref, ownership(block));
  motion::beginProfile(ref, profile, target, block.stCommand.fDeceleration);
  ref.nAxisState = axis::state::kDiscrete;
  block.bRunning = 1;
  block.bWaiting = 0;
  block.Busy = 1;
  block.Active = 1;
  if (ref.bMovedInThisCycle == 0 && axis::stepPlan(ref))
    finish(block);
}

void start(Block &block) noexcept {
  clearOutputs(block);
  if (block.bRunning != 0 && block.pAxis != block.Axis) {
    fail(block, axis::error::kAxisChanged);
    return;
  }
  AxisRef &ref = *block.Axis;
  block.pAxis = block.Axis;
  if (const int16_t error = refusal(ref); error != axis::error::kNone) {
    fail(block, error);
    return;
  }
  if (axis::isRotary(ref) && !isDirection(block.Direction)) {
    fail(block, axis::error::kMoveAbsoluteDirection);
    return;
  }
  auto &command = block.stCommand;
  command.fPosition = block.Position;
  command.fVelocity = block.Velocity;
  command.fAcceleration = block.Acceleration;
  command.fDeceleration = block.Deceleration;
  command.fJerk = block.Jerk;
  command.eDirection = block.Direction;
  command.eBufferMode = block.BufferMode;
  const bool owner = block.bWaiting == 0 && axis::ownsAxis(ref, ownership(block));
  const bool follows = command.eBufferMode != ::st::SM_DriveBasic::MC_BUFFER_MODE__Aborting &&
                       ref.iOwner != 0 && !owner;
  if (!follows) {
    launch(block);
    return;
  }
  // Checks the values now; the motion is planned again when its turn comes.
  motion::Profile profile;
  double target = 0.0;
  if (const int16_t error = plan(block, profile, target); error != axis::error::kNone) {
    fail(block, error);
    return;
  }
  block.bRunning = 1;
  block.bWaiting = 1;
  block.Busy = 1;
  block.Active = 0;
  block.iOwner = ref.iOwner;
  block.ulOwnerCount = ref.ulOwnerCount;
}

/// BufferMode other than Aborting: the command begins when the motion before it is at rest. (The
/// blending modes ask for a velocity at the joint; 0 is the one that is always possible.)
/// The command waits for the motion of the owner noted in iOwner and ulOwnerCount to end.
void wait(Block &block) noexcept {
  AxisRef &ref = *block.Axis;
  if (const int16_t error = refusal(ref); error != axis::error::kNone)
    fail(block, error);
  else if (ref.ulOwnerCount != block.ulOwnerCount)
    abort(block);
  else if (ref.iOwner == 0)
    launch(block);
}

void proceed(Block &block) noexcept {
  if (block.pAxis != block.Axis) {
    fail(block, axis::error::kAxisChanged);
    return;
  }
  if (block.bWaiting != 0) {
    wait(block);
    return;
  }
  AxisRef &ref = *block.Axis;
  const axis::Ownership own = ownership(block);
  if (!axis::ownsAxis(ref, own)) {
    if (const int16_t reason = axis::lossReason(ref, own); reason != axis::error::kNone)
      fail(block, reason);
    else
      abort(block);
    return;
  }
  if (!axis::isPowered(ref)) {
    axis::releaseAxis(ref);
    fail(block, axis::error::kNotPowered);
    return;
  }
  if (ref.bMovedInThisCycle == 0 && axis::stepPlan(ref))
    finish(block);
}

} // namespace

void st::SM_PLCopen::MC_MoveAbsolute::body__(::stride::Ctx & /*ctx__*/) {
  const bool rising = Execute != 0 && bExecuteOld == 0;
  bExecuteOld = Execute;
  if (Axis == nullptr) {
    if (rising || bRunning != 0) {
      clearOutputs(*this);
      fail(*this, axis::error::kNoAxis);
    } else if (Execute == 0) {
      clearOutputs(*this);
    }
    return;
  }
  if (rising)
    start(*this);
  else if (bRunning != 0)
    proceed(*this);
  else if (Execute == 0)
    clearOutputs(*this);
}
