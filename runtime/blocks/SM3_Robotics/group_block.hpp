// What the blocks of axis groups have in common: the edge, and how long outputs stay.
#ifndef STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_GROUP_BLOCK_HPP
#define STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_GROUP_BLOCK_HPP

#include "runtime/blocks/SM3_Robotics/group.hpp"

namespace stride::robotics {

inline constexpr int16_t kNoGroup = ::st::SM_Error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;

template <class Block> void setError(Block &block, int16_t error) noexcept {
  block.Error = error != 0;
  block.ErrorID = static_cast<::st::SM_Error::SMC_ERROR>(error);
}

/// Whether Execute rises in this call.
template <class Block> bool rises(Block &block) noexcept {
  const bool rising = block.Execute != 0 && block.stBlock.bExecuteOld == 0;
  block.stBlock.bExecuteOld = block.Execute;
  return rising;
}

/// A block that does something at the edge, at once: `action` returns an SMC_ERROR.
template <class Block, class Action> void runOnce(Ctx &ctx, Block &block, const Action &action) {
  if (block.AxisGroup != nullptr)
    serve(ctx, *block.AxisGroup);
  if (rises(block)) {
    const int16_t error = block.AxisGroup != nullptr ? action(*block.AxisGroup) : kNoGroup;
    setError(block, error);
    block.Done = error == 0;
  } else if (block.Execute == 0) {
    setError(block, 0);
    block.Done = 0;
  }
  block.Busy = 0;
}

/// A block that reads as long as Enable is TRUE: `read` returns an SMC_ERROR.
template <class Block, class Read> void runReader(Ctx &ctx, Block &block, const Read &read) {
  int16_t error = 0;
  block.Valid = 0;
  if (block.AxisGroup != nullptr)
    serve(ctx, *block.AxisGroup);
  if (block.Enable != 0) {
    error = block.AxisGroup != nullptr ? read(*block.AxisGroup) : kNoGroup;
    block.Valid = error == 0;
  }
  setError(block, error);
  block.Busy = block.Enable;
}

/// Whether the movement of a block that has ended is being driven again, as MC_GroupContinue does.
template <class Block> bool isContinued(const Block &block, const GroupState &state) noexcept {
  return block.stBlock.bRunning == 0 && block.Execute != 0 && block.MovementId != 0 &&
         group::goesOn(group::outcomeOf(state.motion, block.stBlock.ulId));
}

/// One call of a block that asks for a movement, or to halt: `fill` writes the inputs into the
/// request.
template <class Block, class Fill> void runMovement(Ctx &ctx, Block &block, const Fill &fill) {
  auto &own = block.stBlock;
  if (block.AxisGroup != nullptr)
    serve(ctx, *block.AxisGroup);
  const bool rising = rises(block);
  if (rising || (block.Execute == 0 && own.bRunning == 0)) {
    setError(block, 0);
    block.Done = block.CommandAborted = block.CommandAccepted = 0;
    block.MovementId = 0;
  }
  if (rising) {
    Request request = {};
    fill(request);
    const int16_t error =
        block.AxisGroup != nullptr ? ask(ctx, *block.AxisGroup, request) : kNoGroup;
    setError(block, error);
    own.bRunning = error == 0;
    own.ulId = request.id;
    block.MovementId = request.id;
  }
  block.Active = 0;
  if (block.AxisGroup != nullptr && isContinued(block, stateOf(*block.AxisGroup))) {
    setError(block, 0);
    block.Done = block.CommandAborted = 0;
    own.bRunning = 1;
  }
  if (own.bRunning != 0 && block.AxisGroup != nullptr)
    follow(block, stateOf(*block.AxisGroup));
  block.Busy = own.bRunning;
}

/// Shows what has become of the movement.
template <class Block> void follow(Block &block, const GroupState &state) noexcept {
  using group::Outcome;
  const uint64_t id = block.stBlock.ulId;
  const Outcome outcome = group::outcomeOf(state.motion, id);
  block.stBlock.bRunning = group::goesOn(outcome);
  block.Active = outcome == Outcome::Active;
  block.CommandAccepted = outcome == Outcome::Queued || outcome == Outcome::Active ||
                          outcome == Outcome::Done || block.CommandAccepted != 0;
  block.Done = outcome == Outcome::Done;
  block.CommandAborted = outcome == Outcome::Aborted || outcome == Outcome::Unknown;
  if (outcome == Outcome::Failed)
    setError(block, state.error[id % group::kOutcomes]);
}

} // namespace stride::robotics

#endif // STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_GROUP_BLOCK_HPP
