#include "runtime/axis/superimposed.hpp"

#include "runtime/axis/plan_axis.hpp"
#include "runtime/axis/set_point.hpp"

namespace stride::motion {
namespace {

State stateOf(const AxisRef &ref) noexcept {
  const auto &on = ref.stSuperimposed;
  return {on.fPosition, on.fVelocity, on.fAcceleration};
}

void setState(AxisRef &ref, const State &state) noexcept {
  auto &on = ref.stSuperimposed;
  on.fPosition = state.position;
  on.fVelocity = state.velocity;
  on.fAcceleration = state.acceleration;
}

/// Nothing moves the axis (any more): the block owns it.
void moveAlone(AddedMotion &added, BlockState &block, AxisRef &ref) noexcept {
  auto on = ref.stSuperimposed;
  on.fBase = ref.fSetPosition - on.fPosition;
  added.bAlone = 1;
  axis::giveAxis(ref, block.ulOwner);
  ref.stSuperimposed = on;
  ref.nAxisState = axis::state::kDiscrete;
}

/// Plans the rest of the way under the axis's overrides.
bool planRest(AddedMotion &added, const AxisRef &ref) noexcept {
  const auto &command = added.stCommand;
  const BlockLimits limits{command.fVelocity, command.fAcceleration, command.fDeceleration,
                           command.fJerk};
  Profile profile;
  const bool held = !(ref.fVelocityFactor > 0.0) && added.bHalt == 0;
  PlanError problem = PlanError::None;
  if (added.bHalt != 0)
    problem = planStop(profile, stateOf(ref), dynamicsOf(ref, limits));
  else if (held)
    problem = planStop(profile, stateOf(ref), plainDynamics(ref, limits));
  else
    problem = planMove(profile, stateOf(ref), command.fPosition, 0.0, dynamicsOf(ref, limits));
  if (problem != PlanError::None)
    return false;
  loadPlan(added.stPlan, profile, ref.fTaskCycle);
  added.stPlan.bHeld = held;
  added.ulOverrideCount = ref.ulOverrideCount;
  return true;
}

/// Covers the way of one cycle.
void move(AddedMotion &added, BlockState &block, AxisRef &ref) noexcept {
  auto &on = ref.stSuperimposed;
  if (on.bMovedInThisCycle != 0)
    return;
  on.bMovedInThisCycle = 1;
  if (added.ulOverrideCount != ref.ulOverrideCount)
    (void)planRest(added, ref);
  auto &plan = added.stPlan;
  ++plan.ulCycle;
  const double t = axis::planTime(plan);
  const State before = stateOf(ref);
  const State now = axis::planState(plan, t);
  setState(ref, now);
  if (added.bAlone != 0) {
    axis::writeSetPoint(ref, {on.fBase, 0.0, 0.0});
  } else if (ref.bMovedInThisCycle != 0) { // else the motion below comes later and adds it
    ref.fSetPosition =
        axis::shownPosition(ref, ref.fSetPosition + (now.position - before.position));
    axis::writeMotion(ref, ref.fSetVelocity + (now.velocity - before.velocity),
                      ref.fSetAcceleration + (now.acceleration - before.acceleration));
  }
  if (!axis::isPlanOver(plan, t) || plan.bHeld != 0)
    return;
  finish(block);
  on.ulOwner = 0;
  if (added.bAlone != 0) {
    axis::endSuperimposed(ref);
    release(ref);
  }
}

} // namespace

bool beginAdding(AddedMotion &added, BlockState &block, AxisRef &ref) noexcept {
  auto &on = ref.stSuperimposed;
  if (!planRest(added, ref))
    return false;
  // Whoever superimposes without a motion below owns the axis, too.
  const bool alone = ref.iOwner == 0 || (on.ulOwner != 0 && axis::ownsAxis(ref, on.ulOwner));
  block.ulOwner = axis::drawOwner(ref);
  block.bRunning = 1;
  on.ulOwner = block.ulOwner;
  added.bAlone = 0;
  if (alone)
    moveAlone(added, block, ref);
  move(added, block, ref);
  return true;
}

void continueAdding(AddedMotion &added, BlockState &block, AxisRef &ref) noexcept {
  if (ref.stSuperimposed.ulOwner != block.ulOwner) {
    loseMotion(block, ref);
    return;
  }
  if (added.bAlone == 0 && ref.iOwner == 0)
    moveAlone(added, block, ref);
  move(added, block, ref);
}

} // namespace stride::motion
