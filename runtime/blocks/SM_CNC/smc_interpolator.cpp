// SMC_Interpolator and SMC_Interpolator2Dir: their pins and the interpolator of numeric/cnc.
#include "runtime/numeric/cnc/interpolator.hpp"

#include "runtime/blocks/SM_CNC/cnc_layout.hpp"

#include "st/SM_CNC/SMC_Direction.h"
#include "st/SM_CNC/SMC_INT_STATUS.h"
#include "st/SM_CNC/SMC_INT_VELMODE.h"
#include "st/SM_CNC/SMC_Interpolator.h"
#include "st/SM_CNC/SMC_Interpolator2Dir.h"
#include "st/SM_Error/SMC_ERROR.h"

namespace {

namespace cnc = ::stride::cnc;
namespace path = ::stride::path;
namespace decl = ::st::SM_CNC;
using OneWay = decl::SMC_Interpolator;
using TwoWays = decl::SMC_Interpolator2Dir;

static_assert(sizeof(cnc::Interpolator) <= sizeof(OneWay::aState));
static_assert(sizeof(cnc::Interpolator) <= sizeof(TwoWays::aState));

/// The mean of a sine's acceleration over its greatest: 2 / pi.
constexpr double kOfSine = 0.63661977236758134308;
/// Steps of planning for each millisecond of the cycle, at least for one.
constexpr int32_t kBudget = 64;

template <class Block> cnc::Interpolator &stateOf(Block &block) noexcept {
  return *reinterpret_cast<cnc::Interpolator *>(&block.aState);
}

path::LawKind lawOf(int16_t mode) noexcept {
  switch (mode) {
  case decl::SMC_INT_VELMODE__SIGMOID:
  case decl::SMC_INT_VELMODE__SIGMOID_LIMIT:
    return path::LawKind::Sigmoid;
  case decl::SMC_INT_VELMODE__QUADRATIC:
  case decl::SMC_INT_VELMODE__QUADRATIC_SMOOTH:
    return path::LawKind::Jerk;
  default:
    return path::LawKind::Trapezoid;
  }
}

/// The arrays of limits hold X, Y, Z and the six additional axes, without A, B, C.
template <class Block> void takeLimits(const Block &block, path::AxesLimits &limits) noexcept {
  constexpr int32_t kLimits = 9;
  for (int32_t i = 0; i < kLimits; ++i) {
    const int32_t k = i <= cnc::kAxisZ ? i : i - 3 + cnc::kAxisP;
    limits.velocity[k] = block.adMaxVelAxis.v[i];
    limits.acceleration[k] = block.adMaxAccAxis.v[i];
    limits.jerk[k] = block.adMaxJerkAxis.v[i];
  }
}

template <class Block> cnc::Command commandOf(Block &block) noexcept {
  constexpr double kMicrosecond = 1e-6;
  cnc::Command command{};
  command.queue = cnc::queueOf(block.poqDataIn);
  command.cycle = static_cast<double>(block.dwIpoTime) * kMicrosecond;
  command.override = block.dOverride;
  command.quickDeceleration = block.dQuickDeceleration;
  command.jerk = block.dJerkMax;
  command.law = lawOf(block.iVelMode);
  command.share = block.iVelMode == decl::SMC_INT_VELMODE__SIGMOID_LIMIT ? kOfSine : 1.0;
  command.slowStop = block.bSlow_Stop != 0;
  command.quickStop = block.bQuick_Stop != 0;
  command.emergencyStop = block.bEmergency_Stop != 0;
  command.waitAtNextStop = block.bWaitAtNextStop != 0;
  command.singleStep = block.bSingleStep != 0;
  command.acknowledge = block.bAcknM != 0;
  command.limitKinks = block.bLimitKinks != 0;
  constexpr uint32_t kMillisecond = 1000;
  constexpr uint32_t kMost = 100;
  const uint32_t milliseconds = block.dwIpoTime / kMillisecond;
  command.budget = kBudget * static_cast<int32_t>(milliseconds < 1       ? 1
                                                  : milliseconds > kMost ? kMost
                                                                         : milliseconds);
  takeLimits(block, command.limits);
  return command;
}

/// Whether a limit is a number that is not negative.
bool isLimit(double value) noexcept { return ::stride::exact::isfinite(value) && value >= 0.0; }

bool areLimits(const path::AxesLimits &limits) noexcept {
  bool good = true;
  for (int32_t k = 0; k < cnc::kAxes; ++k)
    good = good && isLimit(limits.velocity[k]) && isLimit(limits.acceleration[k]) &&
           isLimit(limits.jerk[k]);
  return good;
}

/// What is wrong with the pins themselves: an SMC_ERROR.
template <class Block>
int16_t errorOf(const Block &block, const cnc::Command &command, bool rising) noexcept {
  if (block.dwIpoTime == 0)
    return ::st::SM_Error::SMC_ERROR__SMC_INT_INVALID_IPOTIME;
  if (block.iVelMode < decl::SMC_INT_VELMODE__TRAPEZOID ||
      block.iVelMode > decl::SMC_INT_VELMODE__QUADRATIC_SMOOTH)
    return ::st::SM_Error::SMC_ERROR__SMC_INT_INVALID_VELMODE;
  if (command.law == path::LawKind::Jerk && !::stride::exact::isPositive(command.jerk))
    return ::st::SM_Error::SMC_ERROR__SMC_INT_JERK_NONPOSITIVE;
  const bool overrides = !rising || ::stride::exact::isfinite(block.dOverride);
  if (!overrides || !isLimit(command.quickDeceleration) || !areLimits(command.limits))
    return ::st::SM_Error::SMC_ERROR__SMC_INVALID_PARAMETER;
  return 0;
}

/// An override that is no number while the path is driven: it comes to rest, and a warning says
/// why.
template <class Block> void takeOverride(Block &block, cnc::Command &command) noexcept {
  constexpr int16_t kWarning = ::st::SM_Error::SMC_ERROR__SMC_INVALID_PARAMETER;
  cnc::Interpolator &state = stateOf(block);
  if (!::stride::exact::isfinite(block.dOverride)) {
    command.override = 0.0;
    state.warning = kWarning;
  } else if (state.warning == kWarning) {
    state.warning = 0;
  }
}

int16_t movingStatus(const cnc::Interpolator &state) noexcept {
  constexpr double kSteady = 1e-6; // of the jerk's limit
  const path::WayState &motion = state.progress.motion;
  if (state.progress.waits)
    return decl::SMC_INT_STATUS__IPO_WAIT;
  if (motion.acceleration == 0.0)
    return decl::SMC_INT_STATUS__IPO_CONSTANT;
  const bool rises = motion.acceleration > 0.0;
  const double change = rises ? motion.jerk : -motion.jerk;
  const path::MotionSettings &settings = path::settingsAt(state.motion, state.motion.law.first);
  const double steady = kSteady * settings.jerk;
  if (settings.kind != path::LawKind::Jerk || (change < steady && change > -steady))
    return rises ? decl::SMC_INT_STATUS__IPO_ACCEL : decl::SMC_INT_STATUS__IPO_DECEL;
  if (rises)
    return change > 0.0 ? decl::SMC_INT_STATUS__IPO_INCREASING_ACCEL
                        : decl::SMC_INT_STATUS__IPO_DECREASING_ACCEL;
  return change > 0.0 ? decl::SMC_INT_STATUS__IPO_INCREASING_DECEL
                      : decl::SMC_INT_STATUS__IPO_DECREASING_DECEL;
}

int16_t statusOf(const cnc::Interpolator &state) noexcept {
  switch (state.phase) {
  case cnc::Phase::Filling:
    return decl::SMC_INT_STATUS__IPO_INIT;
  case cnc::Phase::Moving:
    return movingStatus(state);
  case cnc::Phase::Finished:
  case cnc::Phase::Failed:
    break;
  }
  return decl::SMC_INT_STATUS__IPO_FINISHED;
}

void setEnd(OneWay &block, bool end) noexcept { block.bDone = end; }
void setEnd(TwoWays &block, bool end) noexcept { block.bEndOfPath = end; }

/// Outputs of a block that does nothing.
template <class Block> void idle(Block &block) noexcept {
  block.bActive = 0;
  block.bWorking = 0;
  block.bBusy = 0;
  block.iActObjectSourceNo = -1;
  block.dVel = 0.0;
  block.vecActTangent = {};
  block.dWayPos = block.dLastWayPos;
  block.wM = 0;
  block.dActObjectLength = 0.0;
  block.dActObjectLengthPos = 0.0;
  block.pActObject = nullptr;
  block.wActProgram = 0;
}

template <class Block> void showObject(Block &block, const cnc::PathObject *object) noexcept {
  block.pActObject =
      cnc::declared(const_cast<cnc::PathObject *>(object)); // NOLINT: ST has no const
  block.wActProgram = object != nullptr ? object->program : 0;
}

template <class Block>
void show(Block &block, const cnc::Interpolator &state, double cycle) noexcept {
  const cnc::Progress &progress = state.progress;
  __builtin_memcpy(&block.piSetPosition, &progress.position, sizeof block.piSetPosition);
  block.iStatus = statusOf(state);
  block.bWorking = state.phase == cnc::Phase::Moving;
  block.bBusy = block.bWorking != 0 || state.phase == cnc::Phase::Filling;
  setEnd(block, state.phase == cnc::Phase::Finished || state.progress.atEnd);
  block.bError = state.phase == cnc::Phase::Failed;
  block.wErrorID = block.bError != 0 ? state.error : state.warning;
  block.iActObjectSourceNo = block.bWorking != 0 ? progress.source : -1;
  block.dVel = progress.length / cycle;
  __builtin_memcpy(&block.vecActTangent, &progress.tangent, sizeof block.vecActTangent);
  if (progress.lastSwitch != 0)
    block.iLastSwitch = progress.lastSwitch;
  block.dwSwitches = state.switches;
  block.dWayPos = block.dLastWayPos + progress.length;
  block.wM = progress.function;
  block.dActObjectLength = progress.objectLength;
  block.dActObjectLengthPos = progress.objectWay;
  block.bActive = block.bBusy;
}

template <class Block> void refuse(Block &block, int16_t error) noexcept {
  idle(block);
  block.bError = 1;
  block.wErrorID = error;
  block.iStatus = decl::SMC_INT_STATUS__IPO_FINISHED;
}

void adapt(const OneWay & /*block*/, cnc::Command & /*command*/) noexcept {}

/// Back only when the slow task has said that it can.
void adapt(const TwoWays &block, cnc::Command &command) noexcept {
  command.twoWays = true;
  if (block.bPrepared == 0 && command.override < 0.0)
    command.override = 0.0;
}

/// The body of both.
template <class Block> void run(Block &block) noexcept {
  const bool rising = block.bExecute != 0 && block.bExecuteOld == 0;
  block.bExecuteOld = block.bExecute;
  if (rising) {
    setEnd(block, false);
    block.bError = 0;
    block.wErrorID = 0;
  }
  if (block.bAbort != 0) {
    idle(block);
    setEnd(block, false);
    block.iStatus = decl::SMC_INT_STATUS__IPO_FINISHED;
    return;
  }
  cnc::Interpolator &state = stateOf(block);
  if (rising || block.bActive != 0) {
    cnc::Command command = commandOf(block);
    adapt(block, command);
    if (const int16_t error = errorOf(block, command, rising); error != 0) {
      refuse(block, error);
      return;
    }
    if (rising) {
      cnc::start(state, command);
      block.iLastSwitch = 0;
    }
    takeOverride(block, command);
    cnc::cycle(state, command);
    show(block, state, command.cycle);
    showObject(block, cnc::presentObject(state, command));
    return;
  }
  idle(block);
  if (block.bExecute == 0) {
    setEnd(block, false);
    block.bError = 0;
    block.wErrorID = 0;
    block.iStatus = decl::SMC_INT_STATUS__IPO_INIT;
  }
}

} // namespace

void st::SM_CNC::SMC_Interpolator::body__(::stride::Ctx & /*ctx__*/) { run(*this); }

void st::SM_CNC::SMC_Interpolator2Dir::body__(::stride::Ctx & /*ctx__*/) {
  if (bExecute != 0 && bExecuteOld == 0) {
    bPrepared = 0;
    iPrepareError = 0;
  }
  run(*this);
  if (bActive != 0 && iPrepareError != 0) {
    refuse(*this, iPrepareError);
    return;
  }
  const cnc::Interpolator &state = stateOf(*this);
  const bool moves = bActive != 0 && dVel > 0.0;
  nDirection = !moves            ? SMC_Direction__IPO_standstill
               : state.backwards ? SMC_Direction__IPO_negative
                                 : SMC_Direction__IPO_positive;
}
