#include "runtime/blocks/SM3_Robotics/overrides.hpp"

#include "runtime/axis/axis_ref.hpp"
#include "runtime/blocks/SM3_Robotics/frames.hpp"
#include "runtime/blocks/SM3_Robotics/group_block.hpp"

#include "st/SM3_Robotics/MC_GroupSetOverride.h"
#include "st/SM3_Robotics/SMC_AXIS_GROUP_STATE.h"
#include "st/SM3_Robotics/SMC_GroupReadAxisLimitFactors.h"
#include "st/SM3_Robotics/SMC_GroupSetAncillaryAxisLimits.h"
#include "st/SM3_Robotics/SMC_GroupSetAncillaryPathLimits.h"
#include "st/SM3_Robotics/SMC_GroupSetAxisLimitFactors.h"

namespace stride::robotics {

using exact::smaller;

namespace {

/// Which part of a command's velocity an ancillary limit leaves.
double shareOf(const GroupRef &group, const group::Movement &movement) noexcept {
  const auto &limits = group.stOverride;
  return limits.bPathLimits != 0
             ? smaller(1.0, limits.stPathLimits.fVelMax / movement.order.path.velocity)
             : 1.0;
}

/// Whether an ancillary limit of an axis counts.
bool isCapped(const GroupRef &group, int32_t axis) noexcept {
  return group.stOverride.bAxisLimits != 0 && group.stOverride.astAxisLimits.v[axis].fVelMax > 0.0;
}

/// Which part of all velocities the axes' ancillary limits leave of a movement that was planned
/// without them.
double axisShareOf(const GroupRef &group, const group::Order &order) noexcept {
  double share = 1.0;
  for (int32_t i = 0; i < group.uiAxes; ++i) {
    if (!isCapped(group, i))
      continue;
    const double shares = order.isShared ? order.shares.velocity[placeOf(group, i)] : 1.0;
    const double most = group.apAxis.v[i]->fSWMaxVelocity * order.velocityFactor * shares;
    share = smaller(share, group.stOverride.astAxisLimits.v[i].fVelMax / most);
  }
  return share;
}

} // namespace

double overrideOf(const GroupRef &group) noexcept {
  const group::GroupMotion &motion = stateOf(group).motion;
  double factor = group.stOverride.fVelFactor;
  double share = 1.0;
  for (int64_t k = motion.first; k < motion.next && k <= motion.looked; ++k) {
    const group::Movement &movement = motion.movement[static_cast<uint64_t>(k) % group::kMovements];
    if (group::leadsTool(movement.leg) && movement.leg.length > 0.0)
      factor = smaller(factor, group.stOverride.fPathVelFactor * shareOf(group, movement));
    if (motion.motion.way < stateOf(group).uncapped)
      share = smaller(share, axisShareOf(group, movement.order));
  }
  return factor * share;
}

group::Allowance allowanceOf(const GroupRef &group) noexcept {
  const auto &factors = group.stOverride;
  group::Allowance allowance = group::kAllAllowed;
  allowance.axisAcceleration = factors.fAccFactor;
  allowance.axisJerk = factors.fJerkFactor;
  allowance.pathAcceleration = factors.fPathAccFactor;
  allowance.pathJerk = factors.fPathJerkFactor;
  if (factors.bPathLimits != 0) {
    allowance.acceleration = factors.stPathLimits.fAccMax;
    allowance.deceleration = factors.stPathLimits.fDecMax;
    allowance.jerk = factors.stPathLimits.fJerkMax;
  }
  for (int32_t i = 0; i < group.uiAxes; ++i) {
    if (!isCapped(group, i))
      continue;
    const auto &limits = factors.astAxisLimits.v[i];
    allowance.axis[placeOf(group, i)] = {limits.fVelMax, smaller(limits.fAccMax, limits.fDecMax),
                                         limits.fJerkMax};
  }
  return allowance;
}

group::AxisShares sharesOf(const GroupRef &group) noexcept {
  group::AxisShares shares;
  for (int32_t k = 0; k < kAxes; ++k)
    shares.velocity[k] = shares.acceleration[k] = shares.jerk[k] = 1.0;
  for (int32_t i = 0; i < group.uiAxes; ++i) {
    const auto &factors = group.astFactors.v[i];
    const int32_t k = placeOf(group, i);
    shares.velocity[k] = factors.fVel;
    shares.acceleration[k] = factors.fAcc;
    shares.jerk[k] = factors.fJerk;
  }
  return shares;
}

void resetShares(GroupRef &group, int32_t axis) noexcept {
  group.astFactors.v[axis] = {1.0, 1.0, 1.0, 1.0};
  group.stOverride.astAxisLimits.v[axis] = {};
}

void removeShares(GroupRef &group, int32_t axis) noexcept {
  auto &limits = group.stOverride.astAxisLimits;
  for (int32_t i = axis; i + 1 < kAxes; ++i) {
    group.astFactors.v[i] = group.astFactors.v[i + 1];
    limits.v[i] = limits.v[i + 1];
  }
  resetShares(group, kAxes - 1);
}

} // namespace stride::robotics

namespace {

namespace robotics = ::stride::robotics;
namespace decl = ::st::SM3_Robotics;
namespace error = ::st::SM_Error;

bool isFactor(double factor) noexcept { return factor > 0.0 && factor <= 1.0; }
bool isVelocityFactor(double factor) noexcept { return factor >= 0.0 && factor <= 1.0; }

int16_t setOverride(const decl::MC_GroupSetOverride &block, robotics::GroupRef &group) noexcept {
  if (group.eState == decl::SMC_AXIS_GROUP_STATE__GroupStopping)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  if (!isVelocityFactor(block.VelFactor) || !isVelocityFactor(block.PathVelFactor) ||
      !isFactor(block.AccFactor) || !isFactor(block.JerkFactor) || !isFactor(block.TorqueFactor) ||
      !isFactor(block.PathAccFactor) || !isFactor(block.PathJerkFactor))
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_FACTOR;
  auto &factors = group.stOverride;
  factors.fVelFactor = block.VelFactor;
  factors.fAccFactor = block.AccFactor;
  factors.fJerkFactor = block.JerkFactor;
  factors.fPathVelFactor = block.PathVelFactor;
  factors.fPathAccFactor = block.PathAccFactor;
  factors.fPathJerkFactor = block.PathJerkFactor;
  return 0;
}

int16_t setFactors(const decl::SMC_GroupSetAxisLimitFactors &block,
                   robotics::GroupRef &group) noexcept {
  if (group.eState == decl::SMC_AXIS_GROUP_STATE__GroupDisabled ||
      group.eState == decl::SMC_AXIS_GROUP_STATE__GroupErrorStop)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  for (int32_t i = 0; i < group.uiAxes; ++i)
    if (!isFactor(block.VelFactors.v[i]) || !isFactor(block.AccFactors.v[i]) ||
        !isFactor(block.JerkFactors.v[i]) || !isFactor(block.TorqueFactors.v[i]))
      return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_FACTOR;
  for (int32_t i = 0; i < group.uiAxes; ++i)
    group.astFactors.v[i] = {block.VelFactors.v[i], block.AccFactors.v[i], block.JerkFactors.v[i],
                             block.TorqueFactors.v[i]};
  return 0;
}

int16_t readFactors(decl::SMC_GroupReadAxisLimitFactors &block,
                    const robotics::GroupRef &group) noexcept {
  for (int32_t i = 0; i < robotics::kAxes; ++i) {
    const auto &factors = group.astFactors.v[i];
    block.VelFactors.v[i] = factors.fVel;
    block.AccFactors.v[i] = factors.fAcc;
    block.JerkFactors.v[i] = factors.fJerk;
    block.TorqueFactors.v[i] = factors.fTorque;
  }
  return 0;
}

bool arePositive(const decl::SMC_DYN_LIMITS &limits) noexcept {
  return limits.fVelMax > 0.0 && limits.fAccMax > 0.0 && limits.fDecMax > 0.0 &&
         limits.fJerkMax > 0.0;
}

/// Whether ancillary limits cannot be set now: an SMC_ERROR.
template <class Block>
int16_t whyNotAncillary(const Block &block, const robotics::GroupRef &group) noexcept {
  if (!robotics::takesMovements(group))
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  return block.ExecutionMode == decl::MC_EXECUTION_MODE__Immediately
             ? int16_t{0}
             : error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_PARAMETER;
}

int16_t setPathLimits(const decl::SMC_GroupSetAncillaryPathLimits &block,
                      robotics::GroupRef &group) noexcept {
  if (const int16_t wrong = whyNotAncillary(block, group); wrong != 0)
    return wrong;
  if (!arePositive(block.Limits))
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_DYNAMICS;
  group.stOverride.stPathLimits = block.Limits;
  group.stOverride.bPathLimits = 1;
  return 0;
}

int16_t setAxisLimits(const decl::SMC_GroupSetAncillaryAxisLimits &block,
                      robotics::GroupRef &group) noexcept {
  if (const int16_t wrong = whyNotAncillary(block, group); wrong != 0)
    return wrong;
  for (int32_t i = 0; i < group.uiAxes; ++i)
    if (!arePositive(block.Limits.v[i]))
      return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_DYNAMICS;
  auto &factors = group.stOverride;
  for (int32_t i = 0; i < group.uiAxes; ++i)
    factors.astAxisLimits.v[i] = block.Limits.v[i];
  factors.bAxisLimits = 1;
  robotics::GroupState &state = robotics::stateOf(group);
  state.uncapped = ::stride::path::endOf(state.motion.motion.course);
  return 0;
}

} // namespace

void decl::SMC_GroupSetAncillaryPathLimits::body__(::stride::Ctx &ctx__) {
  robotics::runOnce(ctx__, *this,
                    [this](robotics::GroupRef &group) { return setPathLimits(*this, group); });
}

void decl::SMC_GroupSetAncillaryAxisLimits::body__(::stride::Ctx &ctx__) {
  robotics::runOnce(ctx__, *this,
                    [this](robotics::GroupRef &group) { return setAxisLimits(*this, group); });
}

void decl::SMC_GroupSetAxisLimitFactors::body__(::stride::Ctx &ctx__) {
  robotics::runOnce(ctx__, *this,
                    [this](robotics::GroupRef &group) { return setFactors(*this, group); });
}

void decl::SMC_GroupReadAxisLimitFactors::body__(::stride::Ctx &ctx__) {
  robotics::runOnce(ctx__, *this,
                    [this](robotics::GroupRef &group) { return readFactors(*this, group); });
}

void decl::MC_GroupSetOverride::body__(::stride::Ctx &ctx__) {
  int16_t wrong = 0;
  if (AxisGroup != nullptr)
    robotics::serve(ctx__, *AxisGroup);
  if (Enable != 0)
    wrong = AxisGroup != nullptr ? setOverride(*this, *AxisGroup) : robotics::kNoGroup;
  robotics::setError(*this, wrong);
  Enabled = Enable != 0 && wrong == 0;
  Busy = Enable;
}
