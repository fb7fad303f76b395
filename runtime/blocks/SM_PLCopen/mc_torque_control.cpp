// MC_TorqueControl: a torque by a ramp.
#include "runtime/axis/motion_block.hpp"
#include "runtime/numeric/exact_math.hpp"

#include "st/SM_DriveBasic/MC_Direction.h"
#include "st/SM_PLCopen/MC_TorqueControl.h"

namespace {

namespace axis = ::stride::axis;
namespace basic = ::st::SM_DriveBasic;
namespace exact = ::stride::exact;
namespace motion = ::stride::motion;
using Block = ::st::SM_PLCopen::MC_TorqueControl;
using motion::AxisRef;

constexpr int16_t kNoTorqueMode = ::st::SM_Error::SMC_ERROR__SMC_ST_WRONG_CONTROLLER_MODE;

/// Looks at the inputs and, if they are good, keeps them. An SMC_ERROR.
int16_t readInputs(Block &block, const AxisRef &ref) noexcept {
  const bool good = exact::isfinite(block.Torque) && exact::isfinite(block.TorqueRamp) &&
                    block.TorqueRamp >= 0.0 && exact::isfinite(block.Velocity) &&
                    block.Velocity >= 0.0 &&
                    (block.Direction == basic::MC_Direction__positive ||
                     block.Direction == basic::MC_Direction__negative ||
                     block.Direction == basic::MC_Direction__current);
  if (!good)
    return axis::error::kInvalidParameter;
  const int16_t direction =
      block.Direction == basic::MC_Direction__current ? ref.nDirection : block.Direction;
  const double torque = direction < 0 ? -block.Torque : block.Torque;
  const double most = exact::fabs(ref.fSWMaxTorque);
  block.fTarget = exact::signOf(torque) * exact::smaller(exact::fabs(torque), most);
  block.fRamp = block.TorqueRamp;
  block.fMostVelocity = block.Velocity;
  return axis::error::kNone;
}

/// Moves the ramp on by one cycle and sets the torque.
void exert(Block &block, AxisRef &ref) noexcept {
  const double rest = block.fTarget - block.fTorque;
  const double step = block.fRamp * ref.fTaskCycle;
  if (block.fRamp == 0.0 || exact::fabs(rest) <= step * (1.0 + 1e-9))
    block.fTorque = block.fTarget;
  else
    block.fTorque += exact::signOf(rest) * step;
  const bool tooFast = block.fMostVelocity > 0.0 &&
                       exact::signOf(block.fTorque) * ref.fActVelocity > block.fMostVelocity;
  block.fWritten = tooFast ? 0.0 : block.fTorque;
  ref.fSetTorque = block.fWritten;
  ref.bMovedInThisCycle = 1;
}

/// The block has lost the axis: the torque goes, unless somebody else sets another one.
void letGo(Block &block, AxisRef &ref) noexcept {
  if (ref.fSetTorque == block.fWritten)
    ref.fSetTorque = 0.0;
  block.fWritten = 0.0;
}

void start(Block &block, AxisRef &ref) noexcept {
  auto &state = block.stBlock;
  const bool ran = state.bRunning != 0;
  int16_t problem = motion::refusal(ref, motion::Needs::Force);
  if (problem == axis::error::kNone &&
      ref.byRealControllerMode != basic::SMC_CONTROLLER_MODE__SMC_torque)
    problem = kNoTorqueMode;
  if (problem == axis::error::kNone)
    problem = readInputs(block, ref);
  if (problem != axis::error::kNone) {
    if (ran)
      letGo(block, ref);
    motion::fail(state, &ref, problem);
    return;
  }
  motion::take(state, ref, axis::state::kContinuous);
  block.fTorque = ref.fSetTorque;
  exert(block, ref);
}

void proceed(Block &block, AxisRef &ref) noexcept {
  auto &state = block.stBlock;
  if (motion::keep(state, ref) && block.ContinuousUpdate != 0)
    if (const int16_t problem = readInputs(block, ref); problem != axis::error::kNone)
      motion::fail(state, &ref, problem);
  if (state.bRunning != 0)
    exert(block, ref);
  else
    letGo(block, ref);
}

} // namespace

void st::SM_PLCopen::MC_TorqueControl::body__(::stride::Ctx & /*ctx__*/) {
  switch (motion::beginCall(stBlock, Execute != 0, Axis)) {
  case motion::Call::Start:
    start(*this, *Axis);
    break;
  case motion::Call::Go:
    proceed(*this, *Axis);
    break;
  case motion::Call::Idle:
    break;
  }
  InTorque = stBlock.bRunning != 0 && fWritten == fTarget && fTorque == fTarget;
  motion::showOutcome(*this);
}
