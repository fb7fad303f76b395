#include "runtime/axis/run_follower.hpp"

#include "runtime/axis/run_command.hpp"

namespace stride::motion {

int16_t couplingRefusal(const AxisRef *master, const AxisRef &slave, int16_t bufferMode) noexcept {
  if (master == nullptr || master == &slave)
    return axis::error::kNoAxis;
  const int16_t problem = refusal(slave);
  return problem == axis::error::kNone && !isBufferMode(bufferMode) ? axis::error::kInvalidParameter
                                                                    : problem;
}

void withdrawFollower(BlockState &block, AxisRef &slave) noexcept {
  if (block.bWaiting != 0)
    withdrawCommand(slave, block.ulOwner);
  block.bWaiting = 0;
}

Turn startFollower(BlockState &block, FollowState &follow, AxisRef &slave,
                   int16_t bufferMode) noexcept {
  const bool owner = block.bRunning != 0 && axis::ownsAxis(slave, block.ulOwner);
  withdrawFollower(block, slave);
  block.bReached = 0;
  const bool aborting = bufferMode == ::st::SM_DriveBasic::MC_BUFFER_MODE__Aborting;
  if (aborting || slave.iOwner == 0 || owner) {
    beginFollowing(follow, block, slave);
    return Turn::Begin;
  }
  Command command = {};
  command.eKind = kind::kSynchronized;
  command.eBufferMode = ::st::SM_DriveBasic::MC_BUFFER_MODE__Buffered;
  command.ulOwner = axis::drawOwner(slave);
  if (!queueCommand(slave, command)) {
    fail(block, &slave, axis::error::kNotReady);
    return Turn::None;
  }
  block.ulOwner = command.ulOwner;
  block.bRunning = 1;
  block.bWaiting = 1;
  return Turn::None;
}

Turn continueFollower(BlockState &block, FollowState &follow, AxisRef &slave) noexcept {
  const bool waited = block.bWaiting != 0;
  if (waited && !awaitTurn(block, slave))
    return Turn::None;
  if (!keep(block, slave))
    return Turn::None;
  if (!waited)
    return Turn::Move;
  startFollowing(follow, slave);
  return Turn::Begin;
}

bool passOn(BlockState &block, AxisRef &slave, bool shown) noexcept {
  if (slave.bMovedInThisCycle == 0 || !giveToNext(slave))
    return false;
  if (shown)
    abort(block);
  else
    finish(block);
  return true;
}

void noteReached(BlockState &block, bool reached) noexcept {
  const bool before = block.bReached != 0;
  block.bReached = reached;
  block.bDone = reached && (block.bExecuteOld != 0 || !before);
}

void showReached(BlockState &block, AxisRef &slave, bool reached) noexcept {
  const bool before = block.bReached != 0;
  noteReached(block, reached);
  if (reached)
    (void)passOn(block, slave, before);
}

} // namespace stride::motion
