// MC_MoveSuperImposed: a distance on top of another motion.
#include "runtime/axis/command.hpp"
#include "runtime/axis/motion_block.hpp"
#include "runtime/axis/plan_axis.hpp"
#include "runtime/axis/set_point.hpp"
#include "runtime/numeric/exact_math.hpp"

#include "st/SM_PLCopen/MC_MoveSuperImposed.h"

namespace {

namespace axis = ::stride::axis;
namespace exact = ::stride::exact;
namespace motion = ::stride::motion;
using Block = ::st::SM_PLCopen::MC_MoveSuperImposed;
using motion::AxisRef;

motion::State addedState(const AxisRef &ref) noexcept {
  const auto &added = ref.stSuperimposed;
  return {added.fPosition, added.fVelocity, added.fAcceleration};
}

void setAdded(AxisRef &ref, const motion::State &state) noexcept {
  auto &added = ref.stSuperimposed;
  added.fPosition = state.position;
  added.fVelocity = state.velocity;
  added.fAcceleration = state.acceleration;
}

/// Nothing moves the axis (any more): the block owns it.
void moveAlone(Block &block, AxisRef &ref) noexcept {
  auto added = ref.stSuperimposed;
  added.fBase = ref.fSetPosition - added.fPosition;
  block.bAlone = 1;
  axis::giveAxis(ref, block.stBlock.ulOwner);
  ref.stSuperimposed = added;
  ref.nAxisState = axis::state::kDiscrete;
}

/// Plans the rest of the way under the axis's overrides.
bool planRest(Block &block, const AxisRef &ref) noexcept {
  const auto &command = block.stCommand;
  const motion::BlockLimits limits{command.fVelocity, command.fAcceleration, command.fDeceleration,
                                   command.fJerk};
  motion::Profile profile;
  const bool held = !(ref.fVelocityFactor > 0.0);
  const motion::PlanError problem =
      held ? motion::planStop(profile, addedState(ref), motion::plainDynamics(ref, limits))
           : motion::planMove(profile, addedState(ref), command.fPosition, 0.0,
                              motion::dynamicsOf(ref, limits));
  if (problem != motion::PlanError::None)
    return false;
  motion::loadPlan(block.stPlan, profile, ref.fTaskCycle);
  block.stPlan.bHeld = held;
  block.ulOverrideCount = ref.ulOverrideCount;
  return true;
}

/// Covers the way of one cycle.
void move(Block &block, AxisRef &ref) noexcept {
  auto &added = ref.stSuperimposed;
  if (added.bMovedInThisCycle != 0)
    return;
  added.bMovedInThisCycle = 1;
  if (block.ulOverrideCount != ref.ulOverrideCount)
    (void)planRest(block, ref);
  auto &plan = block.stPlan;
  ++plan.ulCycle;
  const double t = axis::planTime(plan);
  const motion::State before = addedState(ref);
  const motion::State now = axis::planState(plan, t);
  setAdded(ref, now);
  if (block.bAlone != 0) {
    axis::writeSetPoint(ref, {added.fBase, 0.0, 0.0});
  } else if (ref.bMovedInThisCycle != 0) { // else the motion below comes later and adds it
    ref.fSetPosition =
        axis::shownPosition(ref, ref.fSetPosition + (now.position - before.position));
    axis::writeMotion(ref, ref.fSetVelocity + (now.velocity - before.velocity),
                      ref.fSetAcceleration + (now.acceleration - before.acceleration));
  }
  if (!axis::isPlanOver(plan, t) || plan.bHeld != 0)
    return;
  motion::finish(block.stBlock);
  added.ulOwner = 0;
  if (block.bAlone != 0) {
    axis::endSuperimposed(ref);
    motion::release(ref);
  }
}

void start(Block &block, AxisRef &ref) noexcept {
  auto &state = block.stBlock;
  auto &added = ref.stSuperimposed;
  int16_t problem = motion::refusal(ref);
  if (problem == axis::error::kNone && ref.iOwner == 0 && ref.stPlanner.bActive != 0)
    problem = axis::error::kNotReady; // it is still braked by itself
  auto &command = block.stCommand;
  // The way of a superimposed motion that has ended stays; one that runs is taken over with its
  // velocity.
  command.fPosition = added.fPosition + block.Distance;
  command.fVelocity = block.VelocityDiff;
  command.fAcceleration = block.Acceleration;
  command.fDeceleration = block.Deceleration;
  command.fJerk = block.Jerk;
  if (problem == axis::error::kNone &&
      !(exact::isPositive(block.VelocityDiff) && planRest(block, ref)))
    problem = axis::error::kSuperimposedValues;
  if (problem != axis::error::kNone) {
    motion::fail(state, &ref, problem);
    return;
  }
  // Whoever superimposes without a motion below owns the axis, too.
  const bool alone = ref.iOwner == 0 || (added.ulOwner != 0 && axis::ownsAxis(ref, added.ulOwner));
  state.ulOwner = axis::drawOwner(ref);
  state.bRunning = 1;
  added.ulOwner = state.ulOwner;
  block.bAlone = 0;
  if (alone)
    moveAlone(block, ref);
  move(block, ref);
}

void proceed(Block &block, AxisRef &ref) noexcept {
  auto &state = block.stBlock;
  const auto &added = ref.stSuperimposed;
  if (added.ulOwner != state.ulOwner) {
    if (ref.nAxisState == axis::state::kErrorStop)
      motion::lose(state, ref, static_cast<int16_t>(ref.stPlanner.wStopReason));
    else if (!axis::isPowered(ref))
      motion::fail(state, &ref, axis::error::kNotPowered);
    else
      motion::abort(state);
    return;
  }
  if (block.bAlone == 0 && ref.iOwner == 0)
    moveAlone(block, ref);
  move(block, ref);
}

} // namespace

void st::SM_PLCopen::MC_MoveSuperImposed::body__(::stride::Ctx & /*ctx__*/) {
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
  Done = stBlock.bDone;
  Busy = stBlock.bRunning;
  CommandAborted = stBlock.bAborted;
  Error = stBlock.iError != axis::error::kNone;
  ErrorID = stBlock.iError;
}
