#include "runtime/axis/run_keys.hpp"

#include "runtime/axis/plan_axis.hpp"
#include "runtime/numeric/exact_math.hpp"

namespace stride::motion {
namespace {

/// Whether a halt that began now would end on the way to the target of the motion in progress, or
/// there is no target. Otherwise going on is the nearer rest: a ramp whose acceleration has to be
/// taken away first leads beyond the target, or back.
bool haltsOnItsWay(const AxisRef &ref, const JogState &jog) noexcept {
  auto plan = ref.stPlanner;
  if (plan.bActive == 0 || plan.bToGoal == 0)
    return true;
  const State now = axis::planState(plan, axis::planTime(plan));
  Profile profile;
  if (planStop(profile, now, dynamicsOf(ref, {0.0, 0.0, jog.fDeceleration, jog.fJerk})) !=
      PlanError::None)
    return true; // whoever begins it finds out why
  const double way = profile.end.position - now.position;
  const double rest = plan.fGoal - now.position;
  return way * rest >= 0.0 && exact::fabs(way) <= exact::fabs(rest);
}

} // namespace

void brakeByKeys(JogState &jog, BlockState &block, AxisRef &ref) noexcept {
  if (!haltsOnItsWay(ref, jog)) {
    continueCommand(block, ref);
    return;
  }
  if (!keep(block, ref))
    return;
  jog.bBraking = 1;
  Command halt = {};
  halt.eKind = kind::kHalt;
  halt.fDeceleration = jog.fDeceleration;
  halt.fJerk = jog.fJerk;
  startCommand(block, ref, halt);
}

} // namespace stride::motion
