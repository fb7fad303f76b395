// MC_Stop: brakes from any motion and blocks the axis.
#include "runtime/motion/plan_axis.hpp"
#include "runtime/motion/trapezoid.hpp"

#include "st/SM_PLCopen/MC_Stop.h"

namespace {

namespace axis = ::stride::axis;
namespace motion = ::stride::motion;
using Block = ::st::SM_PLCopen::MC_Stop;
using axis::AxisRef;

axis::Ownership ownership(Block &block) noexcept { return {block.iOwner, block.ulOwnerCount}; }

void clearOutputs(Block &block) noexcept {
  block.Done = 0;
  block.Error = 0;
  block.ErrorID = axis::error::kNone;
}

void fail(Block &block, int16_t errorId) noexcept {
  block.bRunning = 0;
  block.Busy = 0;
  block.Done = 0;
  block.Error = 1;
  block.ErrorID = errorId;
  if (block.Axis != nullptr)
    axis::noteError(*block.Axis, errorId);
}

/// The axis is at rest: done, and free again unless Execute holds it.
void stopped(Block &block) noexcept {
  block.Done = 1;
  block.Busy = 0;
  if (block.Execute != 0)
    return;
  block.bRunning = 0;
  block.Axis->nAxisState = axis::state::kStandstill;
  axis::releaseAxis(*block.Axis);
}

void start(Block &block) noexcept {
  clearOutputs(block);
  AxisRef &ref = *block.Axis;
  if (block.bRunning != 0 && block.pAxis != block.Axis) {
    fail(block, axis::error::kAxisChanged);
    return;
  }
  block.pAxis = block.Axis;
  const bool own = block.bRunning != 0 && axis::ownsAxis(ref, ownership(block));
  if (ref.nAxisState == axis::state::kErrorStop) {
    fail(block, axis::error::kStopInErrorStop);
    return;
  }
  if (const int16_t error = axis::readiness(ref); error != axis::error::kNone) {
    fail(block, error);
    return;
  }
  if (ref.nAxisState == axis::state::kStopping && !own) {
    fail(block, axis::error::kStopBlocks);
    return;
  }
  motion::Profile profile;
  switch (motion::planStop(profile, ref.fSetPosition, ref.fSetVelocity, block.Deceleration)) {
  case motion::PlanError::None:
    break;
  case motion::PlanError::InvalidLimit:
    fail(block, axis::error::kStopValues);
    return;
  case motion::PlanError::InvalidState:
  case motion::PlanError::Unrepresentable:
    fail(block, axis::error::kStopUnknown);
    return;
  }
  axis::takeAxis(ref, ownership(block));
  motion::beginProfile(ref, profile, profile.end.position, block.Deceleration);
  ref.nAxisState = axis::state::kStopping;
  block.bRunning = 1;
  block.Busy = 1;
  if (ref.bMovedInThisCycle == 0 && axis::stepPlan(ref))
    stopped(block);
}

void proceed(Block &block) noexcept {
  if (block.pAxis != block.Axis) {
    fail(block, axis::error::kAxisChanged);
    return;
  }
  AxisRef &ref = *block.Axis;
  const axis::Ownership own = ownership(block);
  if (!axis::ownsAxis(ref, own)) {
    const int16_t reason = axis::lossReason(ref, own);
    fail(block, reason != axis::error::kNone ? reason : axis::error::kStopUnknown);
    return;
  }
  if (!axis::isPowered(ref)) {
    axis::releaseAxis(ref);
    fail(block, axis::error::kNotPowered);
    return;
  }
  if (ref.stPlanner.bActive == 0) { // holds the axis since an earlier call
    if (block.Execute == 0) {
      stopped(block);
      clearOutputs(block);
    }
    return;
  }
  if (ref.bMovedInThisCycle == 0 && axis::stepPlan(ref))
    stopped(block);
}

} // namespace

void st::SM_PLCopen::MC_Stop::body__(::stride::Ctx & /*ctx__*/) {
  const bool rising = Execute != 0 && bExecuteOld == 0;
  bExecuteOld = Execute;
  if (Axis == nullptr) {
    if (rising || bRunning != 0)
      fail(*this, axis::error::kNoAxis);
    else if (Execute == 0)
      clearOutputs(*this);
    return;
  }
  if (rising)
    start(*this);
  else if (bRunning != 0)
    proceed(*this);
  else if (Execute == 0)
    clearOutputs(*this);
}
