// MC_GearOut, MC_CamOut: on without the master.
#include "runtime/axis/run_command.hpp"
#include "runtime/axis/set_point.hpp"

#include "st/SM_PLCopen/MC_CamOut.h"
#include "st/SM_PLCopen/MC_GearOut.h"

namespace {

namespace axis = ::stride::axis;
namespace motion = ::stride::motion;
using motion::AxisRef;

void uncouple(motion::BlockState &state, AxisRef &slave) noexcept {
  int16_t problem = motion::refusal(slave);
  const bool again = state.bRunning != 0 && axis::ownsAxis(slave, state.ulOwner);
  if (problem == axis::error::kNone && slave.nAxisState != axis::state::kSynchronized && !again)
    problem = axis::error::kNotReady;
  if (problem != axis::error::kNone) {
    motion::fail(state, &slave, problem);
    return;
  }
  state.ulOwner = axis::drawOwner(slave);
  state.bRunning = 1;
  state.bWaiting = 0;
  state.bReached = 0;
  motion::beginCoasting(slave, state.ulOwner);
  if (slave.stPlanner.fEndVelocity == 0.0) {
    axis::writeMotion(slave, 0.0, 0.0);
    motion::finish(state);
    motion::release(slave);
    return;
  }
  motion::continueCommand(state, slave);
}

void run(motion::BlockState &state, bool execute, AxisRef *slave) noexcept {
  switch (motion::beginCall(state, execute, slave)) {
  case motion::Call::Start:
    uncouple(state, *slave);
    break;
  case motion::Call::Go:
    motion::continueCommand(state, *slave);
    if (state.bAborted != 0) {
      // It was Done; what follows then does not abort it.
      motion::clearOutcome(state);
      state.bDone = state.bExecuteOld;
    }
    break;
  case motion::Call::Idle:
    break;
  }
}

template <class Block> void runBlock(Block &block) noexcept {
  auto &state = block.stBlock;
  run(state, block.Execute != 0, block.Slave);
  block.Done = state.bDone;
  block.Busy = state.bRunning;
  block.Error = state.iError != axis::error::kNone;
  block.ErrorID = state.iError;
}

} // namespace

void st::SM_PLCopen::MC_GearOut::body__(::stride::Ctx & /*ctx__*/) { runBlock(*this); }

void st::SM_PLCopen::MC_CamOut::body__(::stride::Ctx & /*ctx__*/) { runBlock(*this); }
