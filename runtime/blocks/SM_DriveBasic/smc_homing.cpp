// SMC_Homing: the reference run onto a switch that the program reads.
#include "runtime/axis/command.hpp"
#include "runtime/axis/motion_block.hpp"
#include "runtime/axis/shift_position.hpp"
#include "runtime/numeric/exact_math.hpp"

#include "st/SM_DriveBasic/SMC_HOMING_MODE.h"
#include "st/SM_DriveBasic/SMC_Homing.h"

namespace {

namespace axis = ::stride::axis;
namespace exact = ::stride::exact;
namespace mode = ::st::SM_DriveBasic;
namespace motion = ::stride::motion;
using Block = ::st::SM_DriveBasic::SMC_Homing;
using motion::AxisRef;

/// SMC_Homing.byPhase.
enum Phase : uint8_t { kToSwitch, kOffSwitch, kToIndex, kStop, kToZero };

bool acrossTheSwitch(int16_t homingMode) noexcept {
  return homingMode == mode::SMC_HOMING_MODE__FAST_SLOW_S_STOP ||
         homingMode == mode::SMC_HOMING_MODE__FAST_SLOW_STOP_S ||
         homingMode == mode::SMC_HOMING_MODE__FAST_SLOW_I_S_STOP;
}

bool afterTheStop(int16_t homingMode) noexcept {
  return homingMode == mode::SMC_HOMING_MODE__FAST_BSLOW_STOP_S ||
         homingMode == mode::SMC_HOMING_MODE__FAST_SLOW_STOP_S;
}

bool atTheIndex(int16_t homingMode) noexcept {
  return homingMode == mode::SMC_HOMING_MODE__FAST_BSLOW_I_S_STOP ||
         homingMode == mode::SMC_HOMING_MODE__FAST_SLOW_I_S_STOP;
}

/// An SMC_ERROR.
int16_t checkInputs(const Block &block) noexcept {
  const auto &in = block.stInputs;
  const bool known = in.nHomingMode == mode::SMC_HOMING_MODE__FAST_BSLOW_S_STOP ||
                     acrossTheSwitch(in.nHomingMode) || afterTheStop(in.nHomingMode) ||
                     atTheIndex(in.nHomingMode);
  if (!known || !exact::isPositive(in.fVelocitySlow) || !exact::isPositive(in.fVelocityFast) ||
      !exact::isPositive(in.fAcceleration) || !exact::isPositive(in.fDeceleration) ||
      !exact::isfinite(in.fHomePosition) || !(in.fSignalDelay >= 0.0) ||
      !exact::isfinite(in.fSignalDelay) || (in.nDirection != 1 && in.nDirection != -1))
    return axis::error::kHomingValues;
  return axis::error::kNone;
}

/// What the inputs that are looked at in every call do not allow; an SMC_ERROR.
int16_t checkCall(const Block &block) noexcept {
  return acrossTheSwitch(block.stInputs.nHomingMode) && block.bIgnoreHWLimit != 0
             ? axis::error::kHomingNeedsLimits
             : axis::error::kNone;
}

/// Gives the axis the next command of the run; the instance stays its owner. An SMC_ERROR.
int16_t command(Block &block, AxisRef &ref, motion::Command next) noexcept {
  const auto &in = block.stInputs;
  next.fAcceleration = in.fAcceleration;
  next.fDeceleration = in.fDeceleration;
  next.fJerk = in.fJerk;
  next.ulOwner = axis::drawOwner(ref);
  if (motion::beginCommand(ref, next) != axis::error::kNone)
    return axis::error::kHomingValues;
  block.stBlock.ulOwner = next.ulOwner;
  ref.nAxisState = axis::state::kHoming;
  return axis::error::kNone;
}

int16_t runAt(Block &block, AxisRef &ref, double velocity, int16_t direction) noexcept {
  motion::Command next = {};
  next.eKind = motion::kind::kVelocity;
  next.fVelocity = velocity;
  next.eDirection = direction;
  return command(block, ref, next);
}

/// Leaves the switch slowly.
int16_t leaveSwitch(Block &block, AxisRef &ref) noexcept {
  const auto &in = block.stInputs;
  const auto direction =
      static_cast<int16_t>(acrossTheSwitch(in.nHomingMode) ? in.nDirection : -in.nDirection);
  block.byPhase = kOffSwitch;
  return runAt(block, ref, in.fVelocitySlow, direction);
}

int16_t stop(Block &block, AxisRef &ref) noexcept {
  motion::Command next = {};
  next.eKind = motion::kind::kHalt;
  block.byPhase = kStop;
  return command(block, ref, next);
}

constexpr uint32_t kPast = sizeof(Block::aPast.v) / sizeof(double);

double pastPosition(const Block &block, uint32_t cyclesAgo) noexcept {
  return block.aPast.v[(block.udiPast - 1U - cyclesAgo) % kPast];
}

/// Notes where the axis is, going on over the start of a turn.
void notePosition(Block &block, const AxisRef &ref) noexcept {
  double position = ref.fActPosition;
  if (axis::isRotary(ref) && block.udiPast > 0) {
    const double period = ref.fPositionPeriod;
    const double last = pastPosition(block, 0);
    position =
        last + stride::numeric::wrapPosition(position - last + 0.5 * period, period) - 0.5 * period;
  }
  block.aPast.v[block.udiPast % kPast] = position;
  ++block.udiPast;
}

/// Where the axis was `seconds` ago.
double positionBefore(const Block &block, const AxisRef &ref, double seconds) noexcept {
  const uint32_t known = block.udiPast < kPast ? block.udiPast : kPast;
  const double cycles = seconds / ref.fTaskCycle;
  if (known < 2)
    return pastPosition(block, 0) - ref.fActVelocity * seconds;
  const double oldest = static_cast<double>(known - 1U);
  const uint32_t whole =
      cycles < oldest - 1.0 ? static_cast<uint32_t>(cycles) : known - 2U; // beyond: carried on
  const double newer = pastPosition(block, whole);
  const double older = pastPosition(block, whole + 1U);
  return newer + (cycles - static_cast<double>(whole)) * (older - newer);
}

/// The place that the axis counted as `position` becomes the home position.
void setReference(const Block &block, AxisRef &ref, double position) noexcept {
  axis::shiftPosition(ref, block.stInputs.fHomePosition - position);
}

int16_t start(Block &block, AxisRef &ref) noexcept {
  auto &in = block.stInputs;
  in = {block.fHomePosition, block.fVelocitySlow, block.fVelocityFast, block.fAcceleration,
        block.fDeceleration, block.fJerk,         block.fSignalDelay,  block.nDirection,
        block.nHomingMode,   block.bReturnToZero};
  const bool own = block.stBlock.bRunning != 0 && axis::ownsAxis(ref, block.stBlock.ulOwner);
  block.stBlock.bRunning = 0;
  if (const int16_t problem = motion::homingRefusal(ref); problem != axis::error::kNone && !own)
    return problem;
  if (const int16_t problem = checkInputs(block); problem != axis::error::kNone)
    return problem;
  if (const int16_t problem = checkCall(block); problem != axis::error::kNone)
    return problem;
  block.udiPast = 0;
  block.byPhase = kToSwitch;
  const int16_t problem = block.bEndSwitch == 0
                              ? leaveSwitch(block, ref)
                              : runAt(block, ref, in.fVelocityFast, in.nDirection);
  if (problem == axis::error::kNone)
    block.stBlock.bRunning = 1;
  return problem;
}

/// What is due in this cycle before the axis moves on. An SMC_ERROR.
int16_t react(Block &block, AxisRef &ref) noexcept {
  const auto &in = block.stInputs;
  switch (block.byPhase) {
  case kToSwitch:
    if (block.bEndSwitch == 0)
      return leaveSwitch(block, ref);
    break;
  case kOffSwitch:
    if (block.bEndSwitch == 0)
      break;
    if (atTheIndex(in.nHomingMode)) {
      block.byPhase = kToIndex;
      break;
    }
    if (!afterTheStop(in.nHomingMode))
      setReference(block, ref, positionBefore(block, ref, in.fSignalDelay));
    return stop(block, ref);
  case kToIndex:
    if (block.bIndexOccured == 0)
      break;
    setReference(block, ref, block.fIndexPosition);
    return stop(block, ref);
  default:
    break;
  }
  return axis::error::kNone;
}

/// The axis has come to rest: the end, or the way to zero.
int16_t rest(Block &block, AxisRef &ref) noexcept {
  const auto &in = block.stInputs;
  if (block.byPhase == kStop && afterTheStop(in.nHomingMode))
    setReference(block, ref, ref.fSetPosition);
  if (block.byPhase == kStop && in.bReturnToZero != 0) {
    motion::Command next = {};
    next.eKind = motion::kind::kAbsolute;
    next.fVelocity = in.fVelocityFast;
    block.byPhase = kToZero;
    return command(block, ref, next);
  }
  motion::finish(block.stBlock);
  motion::release(ref);
  return axis::error::kNone;
}

int16_t proceed(Block &block, AxisRef &ref) noexcept {
  if (const int16_t problem = checkCall(block); problem != axis::error::kNone)
    return problem;
  ref.bHWLimitIgnored = block.bIgnoreHWLimit;
  notePosition(block, ref);
  if (const int16_t problem = react(block, ref); problem != axis::error::kNone)
    return problem;
  (void)motion::advance(ref);
  return ref.stPlanner.bActive == 0 ? rest(block, ref) : axis::error::kNone;
}

} // namespace

void st::SM_DriveBasic::SMC_Homing::body__(::stride::Ctx & /*ctx__*/) {
  int16_t problem = axis::error::kNone;
  switch (motion::beginCall(stBlock, bExecute != 0, Axis)) {
  case motion::Call::Start:
    problem = start(*this, *Axis);
    if (problem == axis::error::kNone)
      problem = proceed(*this, *Axis);
    break;
  case motion::Call::Go:
    if (motion::keep(stBlock, *Axis))
      problem = proceed(*this, *Axis);
    break;
  case motion::Call::Idle:
    break;
  }
  if (problem != axis::error::kNone)
    motion::fail(stBlock, Axis, problem);
  bDone = stBlock.bDone;
  bCommandAborted = stBlock.bAborted;
  bError = stBlock.iError != axis::error::kNone;
  nErrorID = stBlock.iError;
  bStartLatchingIndex = stBlock.bRunning != 0 && byPhase == kToIndex;
  bBusy = stBlock.bRunning;
}
