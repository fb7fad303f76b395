// MC_GearIn: a ratio of velocities, and from then on of positions.
#include "runtime/axis/catch_up.hpp"
#include "runtime/axis/gear.hpp"
#include "runtime/axis/run_follower.hpp"

#include "st/SM_PLCopen/MC_GearIn.h"

namespace {

namespace axis = ::stride::axis;
namespace motion = ::stride::motion;
using Block = ::st::SM_PLCopen::MC_GearIn;
using Errors = ::stride::motion::LimitError;

/// Looks at the inputs and, if they are good, keeps them. An SMC_ERROR.
int16_t readInputs(Block &block, const motion::AxisRef &slave) noexcept {
  if (block.RatioDenominator == 0)
    return ::st::SM_Error::SMC_ERROR__SMC_GI_RATIO_DENOM;
  const Errors problem =
      motion::checkLimits(slave, block.Acceleration, block.Deceleration, block.Jerk);
  if (problem == Errors::Acceleration)
    return ::st::SM_Error::SMC_ERROR__SMC_GI_INVALID_ACC;
  if (problem == Errors::Deceleration)
    return ::st::SM_Error::SMC_ERROR__SMC_GI_INVALID_DEC;
  block.stCatchUp.fAcceleration = block.Acceleration;
  block.stCatchUp.fDeceleration = block.Deceleration;
  block.stCatchUp.fJerk = block.Jerk;
  block.stGear.fNumerator = static_cast<double>(block.RatioNumerator);
  block.stGear.fDenominator = static_cast<double>(block.RatioDenominator);
  return axis::error::kNone;
}

/// Writes this cycle's set values.
void move(Block &block, motion::AxisRef &slave, const motion::MasterMotion &master) noexcept {
  auto &gear = block.stGear;
  auto &follow = block.stFollow;
  motion::alignFollowing(follow, slave);
  if (gear.bEngaged == 0 &&
      !motion::catchUpToGear(block.stCatchUp, gear, follow, slave, block.stMaster, master))
    return;
  motion::turnGear(gear, follow, slave, master);
}

void run(Block &block, motion::Turn turn) noexcept {
  motion::AxisRef &slave = *block.Slave;
  const bool moved = slave.bMovedInThisCycle != 0;
  if (turn == motion::Turn::Begin) {
    block.stGear.bEngaged = 0;
    const motion::MasterMotion master = motion::beginMaster(block.stMaster, *block.Master);
    motion::beginCatchUp(block.stCatchUp,
                         motion::demandOf(block.stGear, block.stMaster,
                                          moved ? master : motion::cycleBefore(slave, master)));
    if (!moved)
      move(block, slave, motion::sinceCycleBefore(slave, master));
  } else if (!moved) {
    move(block, slave, motion::readMaster(block.stMaster, *block.Master));
  }
  motion::showReached(block.stBlock, slave, block.stGear.bEngaged != 0);
}

} // namespace

void st::SM_PLCopen::MC_GearIn::body__(::stride::Ctx & /*ctx__*/) {
  const motion::Turn turn =
      motion::callFollower(stBlock, stMaster, stFollow, Execute != 0, Master, Slave, BufferMode,
                           [this] { return readInputs(*this, *Slave); });
  if (turn != motion::Turn::None)
    run(*this, turn);
  InGear = stBlock.bDone;
  motion::showOutcome(*this);
}
