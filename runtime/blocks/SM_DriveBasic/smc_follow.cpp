// SMC_FollowPosition, SMC_FollowVelocity, SMC_FollowPositionVelocity: set values of the program.
#include "runtime/axis/follow.hpp"
#include "runtime/numeric/exact_math.hpp"

#include "st/SM_DriveBasic/SMC_FollowPosition.h"
#include "st/SM_DriveBasic/SMC_FollowPositionVelocity.h"
#include "st/SM_DriveBasic/SMC_FollowVelocity.h"

namespace {

namespace axis = ::stride::axis;
namespace exact = ::stride::exact;
namespace motion = ::stride::motion;
using motion::AxisRef;

/// One call of any of the blocks, which needs `needs` of the drive. `usable`: the inputs are
/// numbers. `write` writes this cycle's set values.
template <class Block, class Write>
void run(Block &block, motion::Needs needs, bool usable, Write write) noexcept {
  auto &state = block.stBlock;
  AxisRef *ref = block.Axis;
  switch (motion::beginCall(state, block.bExecute != 0, ref)) {
  case motion::Call::Start: {
    const int16_t problem = motion::refusal(*ref, needs);
    if (problem != axis::error::kNone)
      motion::fail(state, ref, problem);
    else if (!usable)
      motion::fail(state, ref, axis::error::kOutOfRange);
    else
      motion::beginFollowing(block.stFollow, state, *ref);
    break;
  }
  case motion::Call::Go:
    // Without set values the axis is not moved on: it brakes into error stop.
    if (motion::keep(state, *ref) && !usable)
      motion::fail(state, ref, axis::error::kOutOfRange);
    break;
  case motion::Call::Idle:
    break;
  }
  if (state.bRunning != 0 && ref->bMovedInThisCycle == 0) {
    motion::alignFollowing(block.stFollow, *ref);
    write(*ref);
  }
  block.bBusy = state.bRunning;
  block.bCommandAborted = state.bAborted;
  block.bError = state.iError != axis::error::kNone;
  block.iErrorID = state.iError;
}

/// The demanded set position as the axis shows positions now.
template <class Block> double demanded(const Block &block, const AxisRef &ref) noexcept {
  const double shift =
      block.bFixedCoordinateSystem != 0 ? ref.fOffsetPosition - block.stFollow.fFirstOffset : 0.0;
  return block.fSetPosition + shift;
}

} // namespace

void st::SM_DriveBasic::SMC_FollowPosition::body__(::stride::Ctx & /*ctx__*/) {
  run(*this, motion::Needs::Position, exact::isfinite(fSetPosition), [this](AxisRef &ref) {
    const double position = demanded(*this, ref);
    const double way = motion::wayTo(stFollow, ref, position);
    motion::followStep(stFollow, ref, position, way, way / ref.fTaskCycle);
  });
}

void st::SM_DriveBasic::SMC_FollowPositionVelocity::body__(::stride::Ctx & /*ctx__*/) {
  run(*this, motion::Needs::Position,
      exact::isfinite(fSetPosition) && exact::isfinite(fSetVelocity), [this](AxisRef &ref) {
        const double position = demanded(*this, ref);
        motion::followStep(stFollow, ref, position, motion::wayTo(stFollow, ref, position),
                           fSetVelocity);
      });
}

void st::SM_DriveBasic::SMC_FollowVelocity::body__(::stride::Ctx & /*ctx__*/) {
  run(*this, motion::Needs::Velocity, exact::isfinite(fSetVelocity), [this](AxisRef &ref) {
    const double way = 0.5 * (stFollow.fVelocity + fSetVelocity) * ref.fTaskCycle;
    motion::followStep(stFollow, ref, stFollow.fPosition + way, way, fSetVelocity);
  });
}
