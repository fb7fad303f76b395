// SMC_BacklashCompensation: one to one with the master, on that side of the backlash to which it
// moves, or always on the same one.
#include "runtime/axis/catch_up.hpp"
#include "runtime/axis/gear.hpp"
#include "runtime/axis/plan_axis.hpp"
#include "runtime/axis/run_follower.hpp"

#include "st/SM_PLCopen/SMC_BacklashCompensation.h"

namespace {

namespace axis = ::stride::axis;
namespace exact = ::stride::exact;
namespace motion = ::stride::motion;
namespace pl = ::st::SM_PLCopen;
using Backlash = pl::SMC_BACKLASH_STATE;
using Block = pl::SMC_BacklashCompensation;
using motion::AxisRef;
using motion::MasterMotion;
using stride::numeric::MotionState;

/// Looks at the inputs and, if they are good, keeps them. An SMC_ERROR.
int16_t readInputs(Block &block) noexcept {
  auto &state = block.stBacklash;
  const bool good =
      exact::isfinite(block.fBacklash) && block.fBacklash >= 0.0 &&
      exact::isPositive(block.fCompensationVel) &&
      motion::checkLimits(*block.Slave, block.fCompensationAcc, block.fCompensationDec,
                          block.fCompensationJerk) == motion::LimitError::None &&
      block.eBacklashMode >= pl::SMC_BACKLASH_MODE__SMC_BL_NEGATIVE &&
      block.eBacklashMode <= pl::SMC_BACKLASH_MODE__SMC_BL_AUTO &&
      block.eBacklashStartState >= pl::SMC_BACKLASH_STARTSTATE__SMC_BL_START_NEGATIVE &&
      block.eBacklashStartState <= pl::SMC_BACKLASH_STARTSTATE__SMC_BL_START_POSITIVE;
  if (!good)
    return axis::error::kInvalidParameter;
  state.fBacklash = block.fBacklash;
  state.fMostVelocity = block.fCompensationVel;
  state.fMostAcceleration = block.fCompensationAcc;
  state.fMostDeceleration = block.fCompensationDec;
  state.fMostJerk = block.fCompensationJerk;
  state.eMode = block.eBacklashMode;
  state.eStart = block.eBacklashStartState;
  return axis::error::kNone;
}

/// Where the slave belongs, seen from the master. [u]
double sideOf(const Backlash &state) noexcept {
  // SMC_BL_NEGATIVE and SMC_BL_POSITIVE are -1 and 1, and do not wait for a motion of the master.
  const bool automatic = state.eMode == pl::SMC_BACKLASH_MODE__SMC_BL_AUTO;
  const int16_t direction = automatic ? state.nDirection : state.eMode;
  return direction == 0 ? 0.0 : (direction - state.eStart) * state.fBacklash;
}

/// Plans the way to where the slave belongs now.
bool planWay(Backlash &state, const AxisRef &slave) noexcept {
  state.fTarget = sideOf(state);
  motion::Profile profile;
  if (motion::planMove(profile, {state.fOffset, state.fVelocity, state.fAcceleration},
                       state.fTarget, 0.0,
                       motion::plainDynamics(slave, {state.fMostVelocity, state.fMostAcceleration,
                                                     state.fMostDeceleration, state.fMostJerk})) !=
      motion::PlanError::None)
    return false;
  motion::loadPlan(state.stPlan, profile, slave.fTaskCycle);
  state.bThere = 0;
  return true;
}

/// The offset one cycle later.
MotionState nextOffset(Backlash &state) noexcept {
  if (state.bThere != 0)
    return {state.fTarget, 0.0, 0.0};
  auto &plan = state.stPlan;
  ++plan.ulCycle;
  const double t = axis::planTime(plan);
  MotionState now = axis::planState(plan, t);
  state.bThere = axis::isPlanOver(plan, t);
  if (state.bThere != 0)
    now = {state.fTarget, 0.0, 0.0};
  return now;
}

/// Writes this cycle's set values. False if the way to the other side cannot be planned.
bool move(Block &block, AxisRef &slave, const MasterMotion &master) noexcept {
  auto &state = block.stBacklash;
  motion::alignFollowing(block.stFollow, slave);
  const int16_t direction = master.velocity > 0.0   ? int16_t{1}
                            : master.velocity < 0.0 ? int16_t{-1}
                                                    : state.nDirection;
  if (direction != state.nDirection) {
    state.nDirection = direction;
    if (sideOf(state) != state.fTarget && !planWay(state, slave))
      return false;
  }
  const MotionState offset = nextOffset(state);
  state.fOffset = offset.position;
  state.fVelocity = offset.velocity;
  state.fAcceleration = offset.acceleration;
  motion::turnGear(state.stGear, block.stFollow, slave, master, offset);
  return true;
}

/// The first cycle: the slave has been taken.
bool begin(Block &block, AxisRef &slave) noexcept {
  auto &state = block.stBacklash;
  auto &gear = state.stGear;
  const auto &follow = block.stFollow;
  gear.fNumerator = 1.0;
  gear.fDenominator = 1.0;
  const MasterMotion master = motion::beginMaster(state.stMaster, *block.Master);
  const double ahead = -motion::wayTo(follow, slave, master.position.hi);
  motion::engageGear(gear, slave, master.position,
                     ::stride::detail::add({follow.fPosition, 0.0}, {-ahead, 0.0}),
                     {follow.fPosition, 0.0});
  state.nDirection = 0;
  const bool moved = slave.bMovedInThisCycle != 0;
  const MasterMotion before = moved ? master : motion::cycleBefore(slave, master);
  const MasterMotion now = motion::sinceCycleBefore(slave, master);
  state.fOffset = moved ? ahead : ahead + now.travel;
  state.fVelocity = follow.fVelocity - before.velocity;
  state.fAcceleration = follow.fAcceleration - before.acceleration;
  if (!planWay(state, slave))
    return false;
  return moved || move(block, slave, now);
}

void run(Block &block) noexcept {
  AxisRef *slave = block.Slave;
  const motion::Turn turn = motion::callFollower(
      block.stBlock, block.stBacklash.stMaster, block.stFollow, block.bExecute != 0, block.Master,
      slave, ::st::SM_DriveBasic::MC_BUFFER_MODE__Aborting, [&block] { return readInputs(block); });
  bool good = true;
  if (turn == motion::Turn::Begin)
    good = begin(block, *slave);
  else if (turn == motion::Turn::Move && slave->bMovedInThisCycle == 0)
    good = move(block, *slave, motion::readMaster(block.stBacklash.stMaster, *block.Master));
  if (!good)
    motion::fail(block.stBlock, slave, axis::error::kInvalidParameter);
}

} // namespace

void st::SM_PLCopen::SMC_BacklashCompensation::body__(::stride::Ctx & /*ctx__*/) {
  run(*this);
  bCompensating = stBlock.bRunning != 0 && stBacklash.bThere == 0;
}
