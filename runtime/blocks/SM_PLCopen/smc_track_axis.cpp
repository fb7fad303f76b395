// SMC_TrackAxis: after a master, within limits.
#include "runtime/axis/pursue_signal.hpp"
#include "runtime/axis/run_follower.hpp"

#include "st/SM_PLCopen/SMC_TrackAxis.h"

namespace {

namespace axis = ::stride::axis;
namespace motion = ::stride::motion;
using Block = ::st::SM_PLCopen::SMC_TrackAxis;

void run(Block &block) noexcept {
  auto &pursuit = block.stPursuit;
  const motion::BlockLimits limits{block.Velocity, block.Acceleration, block.Deceleration,
                                   block.Jerk};
  const motion::Turn turn =
      motion::callFollower(block.stBlock, pursuit.stSignal, block.stFollow, block.bExecute != 0,
                           block.Master, block.Slave, ::st::SM_DriveBasic::MC_BUFFER_MODE__Aborting,
                           [&] { return motion::checkPursuit(*block.Slave, limits); });
  if (turn == motion::Turn::None)
    return;
  motion::AxisRef &slave = *block.Slave;
  if (const int16_t problem = motion::checkPursuit(slave, limits); problem != axis::error::kNone)
    motion::fail(block.stBlock, &slave, problem);
  else if (turn == motion::Turn::Begin)
    motion::beginPursuit(pursuit, block.stFollow, slave,
                         motion::beginMaster(pursuit.stSignal, *block.Master), limits);
  else if (slave.bMovedInThisCycle == 0)
    motion::continuePursuit(pursuit, block.stFollow, slave,
                            motion::readMaster(pursuit.stSignal, *block.Master), limits);
}

} // namespace

void st::SM_PLCopen::SMC_TrackAxis::body__(::stride::Ctx & /*ctx__*/) {
  run(*this);
  bBusy = stBlock.bRunning;
  bCommandAborted = stBlock.bAborted;
  bError = stBlock.iError != axis::error::kNone;
  iErrorID = stBlock.iError;
  bInSync = stBlock.bRunning != 0 && stPursuit.bInSync != 0;
}
