// Groups that are planned in another task: see runtime/numeric/group/planning.hpp.
#ifndef STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_PLANNING_HPP
#define STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_PLANNING_HPP

#include "runtime/blocks/SM3_Robotics/frames.hpp"

namespace stride::robotics {

/// Steps of planning and places of the path to look at, for each millisecond.
inline constexpr int32_t kSteps = 64;
inline constexpr int32_t kSamples = 24;

/// For how many of them a task with that interval plans in one call. [s] in
inline int32_t millisecondsOf(double interval) noexcept {
  return static_cast<int32_t>(exact::smaller(exact::larger(interval * 1e3, 1.0), 100.0));
}

/// Whether another task plans for the group.
inline bool isPlannedAside(const GroupRef &group) noexcept { return group.pPlanning != nullptr; }

/// The parts of a cycle of a group: planning, or taking what has been planned; going on. The third
/// one makes ways smaller, by its result. [u]
void planGroup(GroupRef &group, const GroupArm &arm, const group::GroupCommand &command) noexcept;
void goOnGroup(GroupRef &group, const GroupArm &arm, const group::GroupCommand &command) noexcept;
double finishCycle(GroupRef &group, const GroupArm &arm,
                   const group::GroupCommand &command) noexcept;

/// Why a group that is planned in another task cannot have a kinematics, or 0: a program's own
/// would be called in both tasks at the same time.
int16_t whyNotAside(const GroupRef &group, const kinematics::KinematicsOf &kinematics) noexcept;

} // namespace stride::robotics

#endif // STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_PLANNING_HPP
