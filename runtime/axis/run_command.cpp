#include "runtime/axis/run_command.hpp"

namespace stride::motion {
namespace {

/// Shows what the call has brought: the end, or the velocity asked for.
void showProgress(BlockState &block, AxisRef &ref) noexcept {
  const auto &plan = ref.stPlanner;
  if (plan.bReached == 0) {
    block.bReached = 0;
    block.bDone = 0;
    return;
  }
  if (plan.bActive == 0) {
    finish(block);
    release(ref);
    return;
  }
  // Without Execute it is shown once.
  block.bDone = block.bExecuteOld != 0 || block.bReached == 0;
  block.bReached = 1;
}

Needs needsOf(const Command &command) noexcept {
  return command.eKind == kind::kVelocity || command.eKind == kind::kHalt ? Needs::Velocity
                                                                          : Needs::Position;
}

void move(BlockState &block, AxisRef &ref) noexcept {
  const bool endless = ref.stPlanner.bReached != 0;
  if (!advance(ref))
    showProgress(block, ref);
  else if (endless)
    abort(block);
  else
    finish(block);
}

} // namespace

bool awaitTurn(BlockState &block, AxisRef &ref) noexcept {
  if (axis::ownsAxis(ref, block.ulOwner)) {
    block.bWaiting = 0;
    return true;
  }
  if (!isQueued(ref, block.ulOwner)) {
    loseMotion(block, ref);
  } else if (ref.iOwner == 0 && ref.bMovedInThisCycle == 0 && beginQueued(ref, block.ulOwner)) {
    block.bWaiting = 0;
    return true;
  }
  return false;
}

void startCommand(BlockState &block, AxisRef &ref, const Command &inputs) noexcept {
  const bool owner = block.bRunning != 0 && axis::ownsAxis(ref, block.ulOwner);
  if (block.bWaiting != 0)
    withdrawCommand(ref, block.ulOwner);
  block.bWaiting = 0;
  block.bReached = 0;
  int16_t problem = refusal(ref, needsOf(inputs));
  if (problem == axis::error::kNone && !isBufferMode(inputs.eBufferMode))
    problem = axis::error::kInvalidParameter;
  if (problem != axis::error::kNone) {
    fail(block, &ref, problem);
    return;
  }
  Command command = inputs;
  command.ulOwner = axis::drawOwner(ref);
  const bool aborting = command.eBufferMode == ::st::SM_DriveBasic::MC_BUFFER_MODE__Aborting;
  if (aborting || ref.iOwner == 0 || owner) {
    problem = beginCommand(ref, command);
  } else {
    problem = checkCommand(ref, command);
    block.bWaiting = 1;
    if (problem == axis::error::kNone && !queueCommand(ref, command))
      problem = axis::error::kNotReady;
  }
  if (problem != axis::error::kNone) {
    fail(block, &ref, problem);
    return;
  }
  block.ulOwner = command.ulOwner;
  block.bRunning = 1;
  if (block.bWaiting == 0)
    move(block, ref);
}

void continueCommand(BlockState &block, AxisRef &ref) noexcept {
  if (block.bWaiting != 0 && !awaitTurn(block, ref))
    return;
  if (!keep(block, ref))
    return;
  if (!advanceOnWay(ref)) {
    move(block, ref);
    return;
  }
  block.bReached = 0;
  block.bDone = 0;
}

} // namespace stride::motion
