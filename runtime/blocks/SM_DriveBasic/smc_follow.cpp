// SMC_FollowPosition, SMC_FollowVelocity, SMC_FollowPositionVelocity, SMC_FollowSetValues: set
// values of the program.
#include "runtime/axis/follow.hpp"
#include "runtime/numeric/exact_math.hpp"

#include "st/SM_DriveBasic/SMC_FollowPosition.h"
#include "st/SM_DriveBasic/SMC_FollowPositionVelocity.h"
#include "st/SM_DriveBasic/SMC_FollowSetValues.h"
#include "st/SM_DriveBasic/SMC_FollowVelocity.h"

namespace {

namespace axis = ::stride::axis;
namespace exact = ::stride::exact;
namespace motion = ::stride::motion;
using motion::AxisRef;

/// One call of any of the blocks, which needs `needs` of the drive. `usable`: the inputs are
/// numbers. `write` writes this cycle's set values.
template <class Block, class Write>
void run(Block &block, motion::Needs needs, bool usable, Write write) noexcept {
  auto &state = block.stBlock;
  AxisRef *ref = block.Axis;
  switch (motion::beginCall(state, block.bExecute != 0, ref)) {
  case motion::Call::Start: {
    const int16_t problem = motion::refusal(*ref, needs);
    if (problem != axis::error::kNone)
      motion::fail(state, ref, problem);
    else if (!usable)
      motion::fail(state, ref, axis::error::kOutOfRange);
    else
      motion::beginFollowing(block.stFollow, state, *ref);
    break;
  }
  case motion::Call::Go:
    // Without set values the axis is not moved on: it brakes into error stop.
    if (!motion::keep(state, *ref))
      break;
    if (const int16_t problem = motion::modeRefusal(*ref, needs); problem != axis::error::kNone)
      motion::fail(state, ref, problem);
    else if (!usable)
      motion::fail(state, ref, axis::error::kOutOfRange);
    break;
  case motion::Call::Idle:
    break;
  }
  if (state.bRunning != 0 && ref->bMovedInThisCycle == 0) {
    motion::alignFollowing(block.stFollow, *ref);
    write(*ref);
  }
  block.bBusy = state.bRunning;
  block.bCommandAborted = state.bAborted;
  block.bError = state.iError != axis::error::kNone;
  block.iErrorID = state.iError;
}

/// The demanded set position as the axis shows positions now.
template <class Block> double demanded(const Block &block, const AxisRef &ref) noexcept {
  const double shift =
      block.bFixedCoordinateSystem != 0 ? ref.fOffsetPosition - block.stFollow.fFirstOffset : 0.0;
  return block.fSetPosition + shift;
}

/// The bits of SMC_FollowSetValues.dwValueMask.
enum ValueBit : uint32_t {
  kPosition = 1,
  kVelocity = 2,
  kAcceleration = 4,
  kJerk = 8,
  kTorque = 16,
  kCurrent = 32,
};

using FollowSetValues = ::st::SM_DriveBasic::SMC_FollowSetValues;

/// Whether every value that is to be written is a number.
bool areNumbers(const FollowSetValues &block) noexcept {
  const double values[] = {block.fSetPosition, block.fSetVelocity, block.fSetAcceleration,
                           block.fSetJerk,     block.fSetTorque,   block.fSetCurrent};
  uint32_t bit = kPosition;
  for (const double value : values) {
    if ((block.dwValueMask & bit) != 0 && !exact::isfinite(value))
      return false;
    bit <<= 1;
  }
  return true;
}

motion::Needs needsOf(uint32_t mask) noexcept {
  if ((mask & kPosition) != 0)
    return motion::Needs::Position;
  return (mask & (kVelocity | kAcceleration)) != 0 ? motion::Needs::Velocity : motion::Needs::Force;
}

void writeMotion(FollowSetValues &block, AxisRef &ref) noexcept {
  const uint32_t mask = block.dwValueMask;
  auto &follow = block.stFollow;
  const double before = follow.fVelocity;
  const double position = (mask & kPosition) != 0 ? demanded(block, ref) : follow.fPosition;
  const double way = (mask & kPosition) != 0 ? motion::wayTo(follow, ref, position) : 0.0;
  const double velocity = (mask & kVelocity) != 0 ? block.fSetVelocity : way / ref.fTaskCycle;
  const double acceleration =
      (mask & kAcceleration) != 0 ? block.fSetAcceleration : (velocity - before) / ref.fTaskCycle;
  motion::followState(follow, ref, {position, velocity, acceleration}, way);
}

void writeValues(FollowSetValues &block, AxisRef &ref) noexcept {
  const uint32_t mask = block.dwValueMask;
  if (axis::regulated(ref) == axis::Regulated::Force) {
    motion::startFollowing(block.stFollow, ref); // the set position follows the actual one
    ref.bMovedInThisCycle = 1;
  } else {
    writeMotion(block, ref);
  }
  if ((mask & kJerk) != 0)
    ref.fSetJerk = block.fSetJerk;
  if ((mask & kTorque) != 0)
    ref.fSetTorque = block.fSetTorque;
  if ((mask & kCurrent) != 0)
    ref.fSetCurrent = block.fSetCurrent;
  block.dwForces |= mask & (kTorque | kCurrent);
}

/// The execution is over: its torque and current do not stay.
void takeForces(FollowSetValues &block, AxisRef &ref) noexcept {
  if ((block.dwForces & kTorque) != 0)
    ref.fSetTorque = 0.0;
  if ((block.dwForces & kCurrent) != 0)
    ref.fSetCurrent = 0.0;
  block.dwForces = 0;
}

/// Ends the execution by bAbort. An axis in motion keeps its owner, which will not be called: the
/// runtime brakes it into error stop, unless another block takes it before.
void endFollowing(FollowSetValues &block) noexcept {
  auto &state = block.stBlock;
  auto *ref = static_cast<AxisRef *>(state.pAxis);
  if (state.bRunning != 0 && axis::ownsAxis(*ref, state.ulOwner)) {
    takeForces(block, *ref);
    if (ref->fSetVelocity == 0.0)
      motion::release(*ref);
  }
  state.bRunning = 0;
}

} // namespace

void st::SM_DriveBasic::SMC_FollowPosition::body__(::stride::Ctx & /*ctx__*/) {
  run(*this, motion::Needs::Position, exact::isfinite(fSetPosition), [this](AxisRef &ref) {
    const double position = demanded(*this, ref);
    const double way = motion::wayTo(stFollow, ref, position);
    motion::followStep(stFollow, ref, position, way, way / ref.fTaskCycle);
  });
}

void st::SM_DriveBasic::SMC_FollowPositionVelocity::body__(::stride::Ctx & /*ctx__*/) {
  run(*this, motion::Needs::Position,
      exact::isfinite(fSetPosition) && exact::isfinite(fSetVelocity), [this](AxisRef &ref) {
        const double position = demanded(*this, ref);
        motion::followStep(stFollow, ref, position, motion::wayTo(stFollow, ref, position),
                           fSetVelocity);
      });
}

void st::SM_DriveBasic::SMC_FollowVelocity::body__(::stride::Ctx & /*ctx__*/) {
  run(*this, motion::Needs::Velocity, exact::isfinite(fSetVelocity), [this](AxisRef &ref) {
    const double way = 0.5 * (stFollow.fVelocity + fSetVelocity) * ref.fTaskCycle;
    motion::followStep(stFollow, ref, stFollow.fPosition + way, way, fSetVelocity);
  });
}

void st::SM_DriveBasic::SMC_FollowSetValues::body__(::stride::Ctx & /*ctx__*/) {
  if (bAbort != 0) {
    endFollowing(*this);
    stBlock.bExecuteOld = bExecute; // an edge meanwhile does not count
    motion::clearOutcome(stBlock);
    bBusy = bCommandAborted = bError = 0;
    iErrorID = axis::error::kNone;
    return;
  }
  const bool ran = stBlock.bRunning != 0;
  const motion::Needs needs = needsOf(dwValueMask);
  run(*this, needs, areNumbers(*this), [this](AxisRef &ref) { writeValues(*this, ref); });
  if (ran && stBlock.bRunning == 0 && Axis != nullptr)
    takeForces(*this, *Axis);
}
