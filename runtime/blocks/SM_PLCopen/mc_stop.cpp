// MC_Stop: brakes from any motion and blocks the axis.
#include "runtime/axis/command.hpp"
#include "runtime/axis/motion_block.hpp"

#include "st/SM_PLCopen/MC_Stop.h"

namespace {

namespace axis = ::stride::axis;
namespace motion = ::stride::motion;
using Block = ::st::SM_PLCopen::MC_Stop;
using motion::AxisRef;

/// Brakes on; at rest the axis stays the block's until Execute is FALSE.
void brake(Block &block, AxisRef &ref) noexcept {
  auto &state = block.stBlock;
  if (ref.stPlanner.bActive != 0)
    (void)motion::advance(ref);
  if (ref.stPlanner.bActive != 0)
    return;
  // Without Execute it is shown once.
  const bool shown = state.bReached != 0;
  state.bReached = 1;
  if (block.Execute != 0) {
    state.bDone = 1;
    return;
  }
  motion::finish(state);
  if (shown)
    motion::clearOutcome(state);
  motion::release(ref);
}

void start(Block &block, AxisRef &ref) noexcept {
  auto &state = block.stBlock;
  const bool own = state.bRunning != 0 && axis::ownsAxis(ref, state.ulOwner);
  int16_t problem = ref.nAxisState == axis::state::kErrorStop ? axis::error::kStopInErrorStop
                                                              : axis::readiness(ref);
  if (problem == axis::error::kNone && ref.nAxisState == axis::state::kStopping && !own)
    problem = axis::error::kStopBlocks;
  if (problem == axis::error::kNone && axis::regulated(ref) == axis::Regulated::Force)
    problem = axis::error::kWrongMode; // no set value brakes it
  motion::Command command = {};
  command.eKind = motion::kind::kStop;
  command.fDeceleration = block.Deceleration;
  command.fJerk = block.Jerk;
  command.ulOwner = axis::drawOwner(ref);
  if (problem == axis::error::kNone)
    problem = motion::beginCommand(ref, command);
  if (problem != axis::error::kNone) {
    motion::fail(state, &ref, problem);
    return;
  }
  state.ulOwner = command.ulOwner;
  state.bRunning = 1;
  state.bReached = 0;
  ref.nAxisState = axis::state::kStopping;
  brake(block, ref);
}

} // namespace

void st::SM_PLCopen::MC_Stop::body__(::stride::Ctx & /*ctx__*/) {
  switch (motion::beginCall(stBlock, Execute != 0, Axis)) {
  case motion::Call::Start:
    start(*this, *Axis);
    break;
  case motion::Call::Go:
    if (motion::keep(stBlock, *Axis))
      brake(*this, *Axis);
    else if (stBlock.bAborted != 0) // only the runtime takes an axis from MC_Stop
      motion::fail(stBlock, Axis, axis::error::kStopUnknown);
    break;
  case motion::Call::Idle:
    break;
  }
  Done = stBlock.bDone;
  Error = stBlock.iError != axis::error::kNone;
  ErrorID = stBlock.iError;
  Busy = stBlock.bRunning != 0 && stBlock.bDone == 0;
}
