#include "runtime/blocks/SM3_Robotics/planning.hpp"

#include "runtime/numeric/group/planning.hpp"

#include "st/SM3_Robotics/SMC_GROUP_PLANNING.h"

namespace stride::robotics {
namespace {

namespace decl = ::st::SM3_Robotics;
using group::GroupPlanning;

static_assert(sizeof(GroupPlanning) <= sizeof(decl::SMC_GROUP_PLANNING::aState));
static_assert(alignof(GroupPlanning) <= alignof(uint64_t));

GroupPlanning &planningOf(decl::SMC_GROUP_PLANNING &block) noexcept {
  return *reinterpret_cast<GroupPlanning *>(&block.aState);
}

bool isSame(const group::AxisCap &a, const group::AxisCap &b) noexcept {
  return a.velocity == b.velocity && a.acceleration == b.acceleration && a.jerk == b.jerk;
}

/// An online change may give a planning task to a group with a program's own kinematics.
bool plansAside(const GroupRef &group, const GroupArm &arm) noexcept {
  return isPlannedAside(group) && arm.isPlain();
}

/// Parts of the path that have been made known before an ancillary limit was there are not planned
/// with it.
void markUncapped(GroupState &state, const GroupPlanning &planning,
                  const group::GroupCommand &command) noexcept {
  for (int32_t k = 0; k < kAxes; ++k) {
    if (isSame(planning.mail.job.command.allowance.axis[k], command.allowance.axis[k]))
      continue;
    state.uncapped = exact::larger(state.uncapped, path::endOf(state.motion.motion.course));
    return;
  }
}

} // namespace

void planGroup(GroupRef &group, const GroupArm &arm, const group::GroupCommand &command) noexcept {
  GroupState &state = stateOf(group);
  if (!plansAside(group, arm)) {
    group::plan(state.motion, arm.arm, command);
    return;
  }
  GroupPlanning &planning = planningOf(*group.pPlanning);
  if (group::follow(state.motion, planning, arm.arm, command))
    markUncapped(state, planning, command);
}

void goOnGroup(GroupRef &group, const GroupArm &arm, const group::GroupCommand &command) noexcept {
  group::GroupMotion &motion = stateOf(group).motion;
  if (plansAside(group, arm))
    group::goOn(motion, planningOf(*group.pPlanning), arm.arm, command);
  else
    group::goOn(motion, arm.arm, command);
}

double finishCycle(GroupRef &group, const GroupArm &arm,
                   const group::GroupCommand &command) noexcept {
  group::GroupMotion &motion = stateOf(group).motion;
  if (!plansAside(group, arm))
    return group::rebase(motion);
  return group::post(motion, planningOf(*group.pPlanning), arm.arm, arm.plainKinematics(), command);
}

int16_t whyNotAside(const GroupRef &group, const kinematics::KinematicsOf &kinematics) noexcept {
  return isPlannedAside(group) && kinematics.plain() == nullptr
             ? ::st::SM_Error::SMC_ERROR__SMC_AXIS_GROUP_NOT_WITH_PLANNING_TASK
             : int16_t{0};
}

} // namespace stride::robotics

void ::st::SM3_Robotics::SMC_GROUP_PLANNING::body__(::stride::Ctx &ctx__) {
  namespace robotics = ::stride::robotics;
  constexpr double kSecond = 1e-9;
  const double interval = kSecond * static_cast<double>(ctx__.taskIntervalNs);
  const int32_t milliseconds = robotics::millisecondsOf(interval);
  ::stride::group::planAside(robotics::planningOf(*this),
                             {::stride::exact::larger(interval, kSecond),
                              robotics::kSteps * milliseconds, robotics::kSamples * milliseconds});
}
