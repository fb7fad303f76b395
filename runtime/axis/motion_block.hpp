// What all blocks started by Execute that move an axis have in common: the edge, the ownership of
// the axis, and how long the outputs stay. Manual section 5.2, PLCopen Motion Control 1.0
// section 2.
#ifndef STRIDE_RUNTIME_AXIS_MOTION_BLOCK_HPP
#define STRIDE_RUNTIME_AXIS_MOTION_BLOCK_HPP

#include "runtime/axis/present_state.hpp"

#include "st/SM_DriveBasic/MC_BUFFER_MODE.h"
#include "st/SM_DriveBasic/SMC_BLOCK_STATE.h"

namespace stride::motion {

using BlockState = ::st::SM_DriveBasic::SMC_BLOCK_STATE;
using axis::AxisRef;

/// Whether the number is one of MC_BUFFER_MODE.
inline bool isBufferMode(int16_t mode) noexcept {
  return mode >= ::st::SM_DriveBasic::MC_BUFFER_MODE__Aborting &&
         mode <= ::st::SM_DriveBasic::MC_BUFFER_MODE__BlendingHigh;
}

/// What the call of a block has to do.
enum class Call : uint8_t {
  Idle,  ///< Nothing runs.
  Start, ///< Rising edge: the inputs are read and the command starts.
  Go,    ///< The started command runs on.
};

/// Forgets what the last command came to.
inline void clearOutcome(BlockState &block) noexcept {
  block.bDone = 0;
  block.bAborted = 0;
  block.iError = axis::error::kNone;
}

/// The command is over with an error, which the axis notes as well. An axis that the block was
/// moving brakes because of it.
inline void fail(BlockState &block, AxisRef *ref, int16_t errorId) noexcept {
  if (ref != nullptr && block.bRunning != 0 && axis::ownsAxis(*ref, block.ulOwner))
    ref->stPlanner.wStopReason = static_cast<uint16_t>(errorId);
  block.bRunning = 0;
  block.bWaiting = 0;
  block.bDone = 0;
  block.iError = errorId;
  if (ref != nullptr)
    axis::noteError(*ref, errorId);
}

/// The command is over because the runtime took the axis, for `reason`. An error stop has entered
/// that into the axis's list already.
inline void lose(BlockState &block, AxisRef &ref, int16_t reason) noexcept {
  fail(block, ref.nAxisState == axis::state::kErrorStop ? nullptr : &ref, reason);
}

/// The command is over because another one took the axis.
inline void abort(BlockState &block) noexcept {
  block.bRunning = 0;
  block.bWaiting = 0;
  block.bDone = 0;
  block.bAborted = 1;
}

/// The command is over because its motion is gone: by an error stop, without power, or because
/// another one took its place.
inline void loseMotion(BlockState &block, AxisRef &ref) noexcept {
  if (ref.nAxisState == axis::state::kErrorStop)
    lose(block, ref, static_cast<int16_t>(ref.stPlanner.wStopReason));
  else if (!axis::isPowered(ref))
    fail(block, &ref, axis::error::kNotPowered);
  else
    abort(block);
}

/// The command is over as it should be. What becomes of the axis is the caller's.
inline void finish(BlockState &block) noexcept {
  block.bRunning = 0;
  block.bWaiting = 0;
  block.bDone = 1;
}

/// First in every call: looks at the edge, deletes outcomes whose time is over and checks the axis.
/// Start is returned with a cleared outcome; what was running under this instance is still there.
inline Call beginCall(BlockState &block, bool execute, AxisRef *ref) noexcept {
  const bool rising = execute && block.bExecuteOld == 0;
  block.bExecuteOld = execute;
  if (rising)
    clearOutcome(block);
  else if (!execute && block.bRunning == 0)
    clearOutcome(block);
  if (ref == nullptr) {
    if (rising || block.bRunning != 0)
      fail(block, nullptr, axis::error::kNoAxis);
    return Call::Idle;
  }
  if (block.bRunning != 0 && block.pAxis != ref) {
    fail(block, ref, axis::error::kAxisChanged);
    return Call::Idle;
  }
  if (rising) {
    block.pAxis = ref;
    return Call::Start;
  }
  return block.bRunning != 0 ? Call::Go : Call::Idle;
}

/// What a command needs: that the axis gets to a place, that it moves with a velocity, or neither
/// (set torques).
enum class Needs : uint8_t { Position, Velocity, Force };

/// kWrongMode if the drive regulates what does not bring that about, or kNone.
inline int16_t modeRefusal(const AxisRef &ref, Needs needs) noexcept {
  const axis::Regulated regulated = axis::regulated(ref);
  const bool fits = regulated == axis::Regulated::Position || needs == Needs::Force ||
                    (regulated == axis::Regulated::Velocity && needs == Needs::Velocity);
  return fits ? axis::error::kNone : axis::error::kWrongMode;
}

/// Why the axis takes no motion command now, or kNone: no power, no task cycle, error stop, held by
/// MC_Stop, homing, a drive that regulates something else.
inline int16_t refusal(const AxisRef &ref, Needs needs = Needs::Position) noexcept {
  if (ref.nAxisState == axis::state::kErrorStop)
    return axis::error::kNotReady;
  if (const int16_t error = axis::readiness(ref); error != axis::error::kNone)
    return error;
  if (ref.nAxisState == axis::state::kStopping)
    return axis::error::kStopBlocks;
  if (ref.nAxisState == axis::state::kHoming)
    return axis::error::kNotReady;
  return modeRefusal(ref, needs);
}

/// Why the axis takes no homing command now, or kNone: homing begins in standstill.
inline int16_t homingRefusal(const AxisRef &ref) noexcept {
  if (ref.nAxisState != axis::state::kHoming)
    if (const int16_t error = refusal(ref); error != axis::error::kNone)
      return error;
  return ref.nAxisState == axis::state::kStandstill ? axis::error::kNone
                                                    : axis::error::kHomeNotStandstill;
}

/// The block becomes the axis's owner and its command runs; whoever owned the axis, or waited for
/// it, finds out at its next call. `axisState` is one of axis::state.
inline void take(BlockState &block, AxisRef &ref, int16_t axisState) noexcept {
  ref.stQueue.uiCount = 0;
  axis::settleSuperimposed(ref);
  block.ulOwner = axis::takeAxis(ref);
  block.bRunning = 1;
  block.bWaiting = 0;
  ref.nAxisState = axisState;
}

/// Whether the running block may go on moving the axis; if not, the outcome says why.
inline bool keep(BlockState &block, AxisRef &ref) noexcept {
  if (!axis::ownsAxis(ref, block.ulOwner)) {
    if (const int16_t reason = axis::lossReason(ref, block.ulOwner); reason != axis::error::kNone)
      lose(block, ref, reason);
    else
      abort(block);
    return false;
  }
  if (!axis::isPowered(ref)) {
    axis::releaseAxis(ref);
    fail(block, &ref, axis::error::kNotPowered);
    return false;
  }
  return true;
}

/// Ends the ownership: the axis is at rest and free.
inline void release(AxisRef &ref) noexcept {
  ref.nAxisState = axis::state::kStandstill;
  axis::releaseAxis(ref);
}

/// Last in every call of a block with the pins of PLCopen: CommandAborted, Error, ErrorID, Busy,
/// Active. Done and its like are the block's own.
template <class Block> void showOutcome(Block &block) noexcept {
  const BlockState &state = block.stBlock;
  block.CommandAborted = state.bAborted;
  block.Error = state.iError != axis::error::kNone;
  block.ErrorID = state.iError;
  block.Busy = state.bRunning;
  block.Active = state.bRunning != 0 && state.bWaiting == 0;
}

} // namespace stride::motion

#endif
