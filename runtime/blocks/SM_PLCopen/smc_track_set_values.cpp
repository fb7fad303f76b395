// SMC_TrackSetValues: after a signal of the program, within limits.
#include "runtime/axis/pursue_signal.hpp"

#include "st/SM_PLCopen/SMC_TrackSetValues.h"

namespace {

namespace axis = ::stride::axis;
namespace exact = ::stride::exact;
namespace motion = ::stride::motion;
using Block = ::st::SM_PLCopen::SMC_TrackSetValues;

motion::BlockLimits limitsOf(const Block &block) noexcept {
  return {block.Velocity, block.Acceleration, block.Deceleration, block.Jerk};
}

motion::Signal signalOf(const Block &block) noexcept {
  return {block.fSetPosition, block.fSetVelocity, block.fSetAcceleration, block.SignalModuloPeriod};
}

int16_t checkInputs(const Block &block) noexcept {
  const bool numbers = exact::isfinite(block.fSetPosition) && exact::isfinite(block.fSetVelocity) &&
                       exact::isfinite(block.fSetAcceleration) &&
                       exact::isfinite(block.SignalModuloPeriod) && block.SignalModuloPeriod >= 0.0;
  return numbers ? motion::checkPursuit(*block.Axis, limitsOf(block))
                 : axis::error::kInvalidParameter;
}

void start(Block &block, motion::AxisRef &ref) noexcept {
  int16_t problem = motion::refusal(ref);
  if (problem == axis::error::kNone)
    problem = checkInputs(block);
  if (problem != axis::error::kNone) {
    motion::fail(block.stBlock, &ref, problem);
    return;
  }
  motion::beginFollowing(block.stFollow, block.stBlock, ref);
  motion::beginPursuit(block.stPursuit, block.stFollow, ref,
                       motion::beginSignal(block.stPursuit.stSignal, signalOf(block)),
                       limitsOf(block));
}

void proceed(Block &block, motion::AxisRef &ref) noexcept {
  if (!motion::keep(block.stBlock, ref))
    return;
  if (const int16_t problem = checkInputs(block); problem != axis::error::kNone)
    motion::fail(block.stBlock, &ref, problem);
  else if (ref.bMovedInThisCycle == 0)
    motion::continuePursuit(
        block.stPursuit, block.stFollow, ref,
        motion::readSignal(block.stPursuit.stSignal, signalOf(block), ref.fTaskCycle),
        limitsOf(block));
}

} // namespace

void st::SM_PLCopen::SMC_TrackSetValues::body__(::stride::Ctx & /*ctx__*/) {
  switch (motion::beginCall(stBlock, bExecute != 0, Axis)) {
  case motion::Call::Start:
    start(*this, *Axis);
    break;
  case motion::Call::Go:
    proceed(*this, *Axis);
    break;
  case motion::Call::Idle:
    break;
  }
  bBusy = stBlock.bRunning;
  bCommandAborted = stBlock.bAborted;
  bError = stBlock.iError != axis::error::kNone;
  iErrorID = stBlock.iError;
  bInSync = stBlock.bRunning != 0 && stPursuit.bInSync != 0;
}
