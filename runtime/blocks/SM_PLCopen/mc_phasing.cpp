// MC_Phasing: one to one with the master, and a shift on top.
#include "runtime/axis/catch_up.hpp"
#include "runtime/axis/gear.hpp"
#include "runtime/axis/plan_axis.hpp"
#include "runtime/axis/run_follower.hpp"

#include "st/SM_PLCopen/MC_Phasing.h"

namespace {

namespace axis = ::stride::axis;
namespace exact = ::stride::exact;
namespace motion = ::stride::motion;
using Block = ::st::SM_PLCopen::MC_Phasing;
using motion::AxisRef;
using motion::MasterMotion;

bool hasNoPeriod(const AxisRef &ref) noexcept {
  return ref.iMovementType == 0 && !(ref.fPositionPeriod > 0.0);
}

/// Looks at the inputs and, if they are good, keeps them. An SMC_ERROR.
int16_t readInputs(Block &block) noexcept {
  if (!exact::isPositive(block.Velocity) || !exact::isfinite(block.PhaseShift) ||
      motion::checkLimits(*block.Slave, block.Acceleration, block.Deceleration, block.Jerk) !=
          motion::LimitError::None)
    return ::st::SM_Error::SMC_ERROR__SMC_PH_INVALID_VELACCDEC;
  if (hasNoPeriod(*block.Master) || hasNoPeriod(*block.Slave))
    return ::st::SM_Error::SMC_ERROR__SMC_PH_ROTARYAXIS_PERIOD0;
  block.stCatchUp.fAcceleration = block.Acceleration;
  block.stCatchUp.fDeceleration = block.Deceleration;
  block.stCatchUp.fJerk = block.Jerk;
  block.fShift = block.PhaseShift;
  block.fVelocity = block.Velocity;
  return axis::error::kNone;
}

/// Starts the shift from a motion in relation to the master.
bool planShift(Block &block, const AxisRef &slave, double velocity, double acceleration) noexcept {
  const auto &limits = block.stCatchUp;
  motion::Profile profile;
  // Overrides do not count for couplings.
  if (motion::planMove(profile, {0.0, velocity, acceleration}, block.fShift, 0.0,
                       motion::plainDynamics(slave, {block.fVelocity, limits.fAcceleration,
                                                     limits.fDeceleration, limits.fJerk})) !=
      motion::PlanError::None)
    return false;
  motion::loadPlan(block.stPlan, profile, slave.fTaskCycle);
  block.fShifted = 0.0;
  block.fShiftVelocity = velocity;
  block.fShiftAcceleration = acceleration;
  block.bShifted = 0;
  return true;
}

/// The shift one cycle later.
stride::numeric::MotionState nextShift(Block &block) noexcept {
  auto &plan = block.stPlan;
  if (block.bShifted != 0)
    return {block.fShifted, 0.0, 0.0};
  ++plan.ulCycle;
  const double t = axis::planTime(plan);
  const stride::numeric::MotionState now = axis::planState(plan, t);
  block.bShifted = axis::isPlanOver(plan, t);
  block.fShifted = now.position;
  block.fShiftVelocity = now.velocity;
  block.fShiftAcceleration = now.acceleration;
  return now;
}

/// Writes this cycle's set values. False if the shift cannot be planned.
bool move(Block &block, AxisRef &slave, const MasterMotion &master) noexcept {
  auto &gear = block.stGear;
  auto &follow = block.stFollow;
  motion::alignFollowing(follow, slave);
  if (gear.bEngaged == 0) {
    if (!motion::catchUpToGear(block.stCatchUp, gear, follow, slave, block.stMaster, master))
      return true;
    if (!planShift(block, slave, 0.0, 0.0))
      return false;
    motion::turnGear(gear, follow, slave, master);
    return true;
  }
  motion::turnGear(gear, follow, slave, master, nextShift(block));
  return true;
}

/// The first cycle. `running`: the block was coupled to this master before, so that the slave has
/// its velocity already, and what was left of a shift.
bool begin(Block &block, AxisRef &slave, bool running, double before) noexcept {
  auto &gear = block.stGear;
  auto &follow = block.stFollow;
  const bool moved = slave.bMovedInThisCycle != 0;
  if (running) {
    MasterMotion master{};
    double travel = 0.0;
    if (moved) {
      master = motion::beginMaster(block.stMaster, *block.Master);
    } else {
      master = motion::readMaster(block.stMaster, *block.Master);
      travel = master.travel;
    }
    // A superimposed motion has become part of the slave's.
    if (!planShift(block, slave, block.fShiftVelocity + (follow.fVelocity - before),
                   block.fShiftAcceleration))
      return false;
    motion::engageGear(gear, slave, ::stride::detail::add(master.position, {-travel, 0.0}),
                       {follow.fPosition, 0.0}, {follow.fPosition, 0.0});
    return moved || move(block, slave, master);
  }
  gear.bEngaged = 0;
  gear.fNumerator = 1.0;
  gear.fDenominator = 1.0;
  const MasterMotion master = motion::beginMaster(block.stMaster, *block.Master);
  motion::beginCatchUp(
      block.stCatchUp,
      motion::demandOf(gear, block.stMaster, moved ? master : motion::cycleBefore(slave, master)));
  return moved || move(block, slave, motion::sinceCycleBefore(slave, master));
}

void run(Block &block) noexcept {
  auto &state = block.stBlock;
  AxisRef *slave = block.Slave;
  const bool running = state.bRunning != 0 && block.stGear.bEngaged != 0 && slave != nullptr &&
                       slave == state.pAxis && axis::ownsAxis(*slave, state.ulOwner) &&
                       block.Master == block.stMaster.pAxis;
  const double before = block.stFollow.fVelocity;
  const motion::Turn turn = motion::callFollower(
      state, block.stMaster, block.stFollow, block.Execute != 0, block.Master, slave,
      ::st::SM_DriveBasic::MC_BUFFER_MODE__Aborting, [&block] { return readInputs(block); });
  if (turn == motion::Turn::None)
    return;
  bool good = true;
  if (turn == motion::Turn::Begin)
    good = begin(block, *slave, running, before);
  else if (slave->bMovedInThisCycle == 0)
    good = move(block, *slave, motion::readMaster(block.stMaster, *block.Master));
  if (good)
    motion::showReached(state, *slave, block.stGear.bEngaged != 0 && block.bShifted != 0);
  else
    motion::fail(state, slave, ::st::SM_Error::SMC_ERROR__SMC_PH_INVALID_VELACCDEC);
}

} // namespace

void st::SM_PLCopen::MC_Phasing::body__(::stride::Ctx & /*ctx__*/) {
  run(*this);
  Done = stBlock.bDone;
  motion::showOutcome(*this);
}
