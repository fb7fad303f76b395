// One call of a block that moves an axis as long as a key is pressed, with a key for each
// direction.
#ifndef STRIDE_RUNTIME_AXIS_RUN_KEYS_HPP
#define STRIDE_RUNTIME_AXIS_RUN_KEYS_HPP

#include "runtime/axis/run_command.hpp"

#include "st/SM_DriveBasic/SMC_JOG_STATE.h"

namespace stride::motion {

using JogState = ::st::SM_DriveBasic::SMC_JOG_STATE;

/// Where two keys point: 1 forward, -1 backward, 0 for none or both.
inline int16_t wayOfKeys(bool forward, bool backward) noexcept {
  if (forward == backward)
    return 0;
  return forward ? int16_t{1} : int16_t{-1};
}

/// The keys are released: the running block brakes the axis, with what was read when one was
/// pressed.
void brakeByKeys(JogState &jog, BlockState &block, AxisRef &ref) noexcept;

/// One call: when a key is pressed, `read` fills in the command from the block's inputs for the way
/// (wayOfKeys). The outcome stays as long as the key is pressed, and one cycle at least.
template <class Read>
void runKeys(JogState &jog, BlockState &block, int16_t way, AxisRef *ref,
             const Read &read) noexcept {
  if (way != jog.nWay)
    block.bExecuteOld = 0; // the other key is a press of its own
  jog.nWay = way;
  switch (beginCall(block, way != 0, ref)) {
  case Call::Start: {
    Command command = {};
    read(command, way);
    jog.bBraking = 0;
    jog.fDeceleration = command.fDeceleration;
    jog.fJerk = command.fJerk;
    startCommand(block, *ref, command);
    break;
  }
  case Call::Go:
    if (way == 0 && jog.bBraking == 0)
      brakeByKeys(jog, block, *ref);
    else
      continueCommand(block, *ref);
    break;
  case Call::Idle:
    break;
  }
}

/// Last in every call of such a block.
template <class Block> void showKeys(Block &block) noexcept {
  const BlockState &state = block.stBlock;
  block.Busy = state.bRunning;
  block.CommandAborted = state.bAborted;
  block.Error = state.iError != axis::error::kNone;
  block.ErrorId = state.iError;
}

} // namespace stride::motion

#endif
