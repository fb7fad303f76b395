// A motion on top of another one: a distance that is added, or its halt.
#ifndef STRIDE_RUNTIME_AXIS_SUPERIMPOSED_HPP
#define STRIDE_RUNTIME_AXIS_SUPERIMPOSED_HPP

#include "runtime/axis/motion_block.hpp"

#include "st/SM_DriveBasic/SMC_ADDED_MOTION.h"

namespace stride::motion {

using AddedMotion = ::st::SM_DriveBasic::SMC_ADDED_MOTION;

/// Whether something is being added to the axis's motion.
inline bool isAdding(const AxisRef &ref) noexcept { return ref.stSuperimposed.ulOwner != 0; }

/// The block adds what added.stCommand says from now on (bHalt: brakes what is added), and covers
/// the way of the first cycle. Whoever added something before finds out at its next call. False if
/// it cannot be planned; then nothing has changed.
bool beginAdding(AddedMotion &added, BlockState &block, AxisRef &ref) noexcept;

/// Covers the way of another cycle, or says in the outcome why it is over.
void continueAdding(AddedMotion &added, BlockState &block, AxisRef &ref) noexcept;

/// A call of a block that adds something: `start` begins it, and outputs show what came out.
template <class Block, class Start> void runAdding(Block &block, Start start) noexcept {
  BlockState &state = block.stBlock;
  switch (beginCall(state, block.Execute != 0, block.Axis)) {
  case Call::Start:
    start(block, *block.Axis);
    break;
  case Call::Go:
    continueAdding(block.stAdded, state, *block.Axis);
    break;
  case Call::Idle:
    break;
  }
  block.Done = state.bDone;
  block.Busy = state.bRunning;
  block.CommandAborted = state.bAborted;
  block.Error = state.iError != axis::error::kNone;
  block.ErrorID = state.iError;
}

} // namespace stride::motion

#endif
