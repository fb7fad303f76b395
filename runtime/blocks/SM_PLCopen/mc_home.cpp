// MC_Home: the drive looks for its reference.
#include "runtime/axis/command.hpp"
#include "runtime/axis/motion_block.hpp"
#include "runtime/axis/set_point.hpp"
#include "runtime/numeric/exact_math.hpp"

#include "st/SM_PLCopen/MC_Home.h"

namespace {

namespace axis = ::stride::axis;
namespace exact = ::stride::exact;
namespace motion = ::stride::motion;
using Block = ::st::SM_PLCopen::MC_Home;
using motion::AxisRef;

constexpr uint16_t kLongest = 1000; ///< Cycles within which the drive has to begin.

motion::Command halt(const Block &block, double deceleration) noexcept {
  motion::Command command = {};
  command.eKind = motion::kind::kHalt;
  command.fDeceleration = deceleration;
  command.ulOwner = block.stBlock.ulOwner;
  return command;
}

/// The drive moves the axis: where it will be at the end of the cycle, as far as is known here.
void followDrive(AxisRef &ref) noexcept {
  axis::writeSetPoint(
      ref, {ref.fSavePosition + ref.fSaveVelocity * ref.fTaskCycle, ref.fSaveVelocity, 0.0});
}

/// Whether the inputs can be used; an SMC_ERROR.
int16_t checkInputs(const Block &block, const AxisRef &ref) noexcept {
  if (!exact::isfinite(block.Position))
    return axis::error::kOutOfRange;
  if (motion::checkCommand(ref, halt(block, block.Deceleration)) != axis::error::kNone)
    return axis::error::kHomeStop;
  return axis::error::kNone;
}

int16_t refusal(const Block &block, const AxisRef &ref) noexcept {
  if (const int16_t error = motion::homingRefusal(ref); error != axis::error::kNone)
    return error;
  return checkInputs(block, ref);
}

void begin(Block &block, AxisRef &ref) noexcept {
  auto &state = block.stBlock;
  block.fDeceleration = block.Deceleration;
  block.uiCycles = 0;
  block.iPending = axis::error::kNone;
  if (const int16_t error = refusal(block, ref); error != axis::error::kNone) {
    motion::fail(state, &ref, error);
    return;
  }
  motion::take(state, ref, axis::state::kHoming);
  ref.fReference = block.Position;
  ref.bStartReference = 1;
  ref.byHoming = static_cast<uint8_t>(axis::DriveHoming::Asked);
  followDrive(ref);
}

/// The axis is at rest.
void end(Block &block, AxisRef &ref) noexcept {
  motion::release(ref);
  if (block.iPending != axis::error::kNone)
    motion::fail(block.stBlock, &ref, block.iPending);
  else
    motion::finish(block.stBlock);
}

/// Brakes from where the drive has brought the axis.
void brake(Block &block, AxisRef &ref) noexcept {
  ref.bStartReference = 0;
  if (const int16_t error = motion::beginCommand(ref, halt(block, block.fDeceleration));
      error != axis::error::kNone) {
    block.iPending = axis::error::kHomeStop;
    axis::writeMotion(ref, 0.0, 0.0);
    end(block, ref);
    return;
  }
  ref.nAxisState = axis::state::kHoming;
  (void)motion::advance(ref);
  if (ref.stPlanner.bActive == 0)
    end(block, ref);
}

void proceed(Block &block, AxisRef &ref) noexcept {
  if (!axis::isDriveHoming(ref)) {
    (void)motion::advance(ref);
    if (ref.stPlanner.bActive == 0)
      end(block, ref);
    return;
  }
  switch (static_cast<axis::DriveHoming>(ref.byHoming)) {
  case axis::DriveHoming::Found:
    brake(block, ref);
    return;
  case axis::DriveHoming::Failed:
    block.iPending = axis::error::kHomeFailed;
    brake(block, ref);
    return;
  case axis::DriveHoming::Running:
    break;
  default:
    if (++block.uiCycles <= kLongest)
      break;
    block.iPending = axis::error::kHomeNotStarted;
    brake(block, ref);
    return;
  }
  followDrive(ref);
}

/// A new edge during the reference run gives it other values; the drive goes on.
void restart(Block &block, AxisRef &ref) noexcept {
  const int16_t error = checkInputs(block, ref);
  if (error == axis::error::kNone) {
    block.fDeceleration = block.Deceleration;
    ref.fReference = block.Position;
    proceed(block, ref);
    return;
  }
  block.iPending = error;
  if (axis::isDriveHoming(ref))
    brake(block, ref);
  else
    proceed(block, ref);
}

void start(Block &block, AxisRef &ref) noexcept {
  const auto &state = block.stBlock;
  if (state.bRunning != 0 && axis::ownsAxis(ref, state.ulOwner) && axis::isPowered(ref))
    restart(block, ref);
  else
    begin(block, ref);
}

} // namespace

void st::SM_PLCopen::MC_Home::body__(::stride::Ctx & /*ctx__*/) {
  switch (motion::beginCall(stBlock, Execute != 0, Axis)) {
  case motion::Call::Start:
    start(*this, *Axis);
    break;
  case motion::Call::Go:
    if (motion::keep(stBlock, *Axis))
      proceed(*this, *Axis);
    else if (stBlock.iError == axis::error::kCommunication)
      motion::fail(stBlock, Axis, axis::error::kHomeFailed);
    break;
  case motion::Call::Idle:
    break;
  }
  Done = stBlock.bDone;
  motion::showOutcome(*this);
}
