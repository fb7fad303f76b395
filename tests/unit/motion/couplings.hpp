#ifndef STRIDE_TESTS_UNIT_MOTION_COUPLINGS_HPP
#define STRIDE_TESTS_UNIT_MOTION_COUPLINGS_HPP
// A slave with a gear, and commands that wait for it.

#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_PLCopen/MC_GearIn.h"
#include "st/SM_PLCopen/MC_GearInPos.h"
#include "st/SM_PLCopen/MC_MoveAbsolute.h"
#include "st/SM_PLCopen/MC_MoveVelocity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stride::test {

namespace pl = ::st::SM_PLCopen;
namespace basic = ::st::SM_DriveBasic;

/// A master that moves with 10 u/s, and a slave in power.
class Couplings : public testing::Test {
protected:
  Couplings() {
    rig.axis.fSWMaxDeceleration = 100;
    master.iMovementType = 1;
    master.fTaskCycle = 0.001;
    master.bRegulatorOn = 1;
    master.fSetVelocity = 10;
    rig.powerUp();
    gear = coupled<pl::MC_GearIn>();
    gear.Acceleration = gear.Deceleration = 50;
    sync = coupled<pl::MC_GearInPos>();
    move = rig.move(20, 20, 50, 50);
    velocity = fresh<pl::MC_MoveVelocity>();
    velocity.Axis = &rig.axis;
    velocity.Velocity = 5;
    velocity.Acceleration = velocity.Deceleration = 50;
    velocity.Direction = basic::MC_Direction__positive;
  }

  template <class Block> Block coupled() {
    auto block = fresh<Block>();
    block.Master = &master;
    block.Slave = &rig.axis;
    return block;
  }

  /// One cycle: the master, then `program`. Nothing may jump, and no axis may be left alone.
  template <class Program> void cycle(Program program) {
    const double before = rig.axis.fSetPosition;
    const double velocityBefore = rig.axis.fSetVelocity;
    rig.cycle([&] {
      master.fSetPosition += master.fSetVelocity * 0.001;
      program();
    });
    ASSERT_LE(std::fabs(rig.axis.fSetVelocity - velocityBefore), 0.06);
    ASSERT_NEAR(rig.axis.fSetPosition - before,
                0.5 * (rig.axis.fSetVelocity + velocityBefore) * 0.001, 3e-5);
  }

  template <class Block> void call(Block &block, bool execute) { rig.call(block, execute); }

  AxisRig rig;
  stride::axis::AxisRef master = fresh<stride::axis::AxisRef>();
  pl::MC_GearIn gear{};           ///< 1 : 1, ready in 0.2 s from rest.
  pl::MC_GearInPos sync{};        ///< 1 : 1.
  pl::MC_MoveAbsolute move{};     ///< To 20 with 20 u/s.
  pl::MC_MoveVelocity velocity{}; ///< 5 u/s.
};

} // namespace stride::test

#endif // STRIDE_TESTS_UNIT_MOTION_COUPLINGS_HPP
