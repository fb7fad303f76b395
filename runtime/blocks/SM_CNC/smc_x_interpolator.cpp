// SMC_XInterpolator.
#include "runtime/blocks/SM_CNC/cnc_layout.hpp"
#include "runtime/numeric/cnc/x_interpolator.hpp"

#include "st/SM_CNC/SMC_Direction.h"
#include "st/SM_CNC/SMC_INT_STATUS.h"
#include "st/SM_CNC/SMC_XInterpolator.h"
#include "st/SM_DriveBasic/AXIS_REF.h"
#include "st/SM_DriveBasic/MC_Direction.h"
#include "st/SM_Error/SMC_ERROR.h"

namespace {

namespace cnc = ::stride::cnc;
namespace decl = ::st::SM_CNC;
namespace e = ::st::SM_Error;
using Block = decl::SMC_XInterpolator;

static_assert(sizeof(cnc::XFollower) <= sizeof(Block::aState));

constexpr double kSteady = 1e-9; ///< How little a velocity changes that is constant, as a part.

cnc::XFollower &stateOf(Block &block) noexcept {
  return *reinterpret_cast<cnc::XFollower *>(&block.aState);
}

int16_t errorOf(cnc::XError error) noexcept {
  switch (error) {
  case cnc::XError::None:
    break;
  case cnc::XError::NoQueue:
    return e::SMC_ERROR__SMC_NO_OUTQUEUE_TYPE;
  case cnc::XError::NoIntersection:
    return e::SMC_ERROR__SMC_XINT_NOINTERSECTION;
  case cnc::XError::Shape:
    return e::SMC_ERROR__SMC_INT_PATH_EXCEEDED;
  }
  return e::SMC_ERROR__SMC_NO_ERROR;
}

/// Outputs of a block that does nothing.
void idle(Block &block, int16_t status) noexcept {
  block.bWorking = block.bBusy = 0;
  block.iStatus = status;
  block.iActObjectSourceNo = -1;
  block.dVel = block.dLastVel = 0.0;
  block.vecActTangent = {};
  block.dWayPos = block.dLastWayPos;
  block.nDirection = decl::SMC_Direction__IPO_standstill;
}

void refuse(Block &block, int16_t error) noexcept {
  idle(block, decl::SMC_INT_STATUS__IPO_FINISHED);
  block.bError = 1;
  block.wErrorID = error;
}

int16_t movingStatus(const Block &block, const cnc::XFollower &state) noexcept {
  if (state.phase == cnc::XPhase::Waiting && state.length == 0.0)
    return decl::SMC_INT_STATUS__IPO_WAIT;
  const double change = block.dVel - block.dLastVel;
  if (!(::stride::exact::fabs(change) > kSteady * block.dVel))
    return decl::SMC_INT_STATUS__IPO_CONSTANT;
  return change > 0.0 ? decl::SMC_INT_STATUS__IPO_ACCEL : decl::SMC_INT_STATUS__IPO_DECEL;
}

void show(Block &block, const cnc::XFollower &state, double time) noexcept {
  __builtin_memcpy(&block.piSetPosition, &state.position, sizeof block.piSetPosition);
  block.dwSwitches = state.switches;
  if (state.lastSwitch != 0)
    block.iLastSwitch = state.lastSwitch;
  block.dVel = time > 0.0 ? state.length / time : 0.0;
  block.dWayPos = block.dLastWayPos + state.length;
  block.bWorking = block.bBusy = 1;
  block.iActObjectSourceNo = state.source;
  const bool moves = state.length > 0.0;
  if (moves)
    __builtin_memcpy(&block.vecActTangent, &state.tangent, sizeof block.vecActTangent);
  else
    block.vecActTangent = {};
  block.nDirection = !moves                 ? decl::SMC_Direction__IPO_standstill
                     : block.eDirection > 0 ? decl::SMC_Direction__IPO_positive
                                            : decl::SMC_Direction__IPO_negative;
  block.iStatus = movingStatus(block, state);
  block.dLastVel = block.dVel;
}

void work(Block &block) noexcept {
  namespace drive = ::st::SM_DriveBasic;
  if (block.eDirection != drive::MC_Direction__positive &&
      block.eDirection != drive::MC_Direction__negative) {
    refuse(block, e::SMC_ERROR__SMC_XINT_INVALID_DIRECTION);
    return;
  }
  cnc::XFollower &state = stateOf(block);
  const double x = block.X_Axis->fActPosition + block.dXOffset;
  cnc::follow(state, cnc::queueOf(block.poqDataIn), x, block.eDirection > 0);
  if (state.phase == cnc::XPhase::Failed) {
    refuse(block, errorOf(state.error));
    return;
  }
  show(block, state, block.dwIpoTime != 0 ? block.dwIpoTime * 1e-6 : block.X_Axis->fTaskCycle);
  if (state.phase == cnc::XPhase::Done) {
    const double way = block.dWayPos;
    idle(block, decl::SMC_INT_STATUS__IPO_FINISHED);
    block.dWayPos = way;
    block.bDone = 1;
  }
}

} // namespace

void st::SM_CNC::SMC_XInterpolator::body__(::stride::Ctx & /*ctx__*/) {
  const bool rising = bExecute != 0 && bExecuteOld == 0;
  bExecuteOld = bExecute;
  if (bAbort != 0 || (bExecute == 0 && bWorking == 0) || rising) {
    bDone = bError = 0;
    wErrorID = e::SMC_ERROR__SMC_NO_ERROR;
    idle(*this, bAbort != 0 ? SMC_INT_STATUS__IPO_FINISHED : SMC_INT_STATUS__IPO_UNKNOWN);
  }
  if (bAbort == 0 && rising) {
    cnc::startFollowing(stateOf(*this));
    iLastSwitch = 0;
  }
  if (bAbort == 0 && (rising || bWorking != 0))
    work(*this);
}
