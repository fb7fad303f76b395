#ifndef STRIDE_TESTS_PROPERTY_GEAR_BLOCKS_HPP
#define STRIDE_TESTS_PROPERTY_GEAR_BLOCKS_HPP
// Blocks that couple two axes, called without a task.

#include "gear_scene.hpp"

namespace stride::test {

template <class Block> Block bind(axis::AxisRef &master, axis::AxisRef &slave) {
  auto block = fresh<Block>();
  block.Master = &master;
  block.Slave = &slave;
  return block;
}

template <class Block> void call(Block &block, bool execute, axis::AxisRef &slave) {
  Ctx ctx{};
  slave.bMovedInThisCycle = 0;
  slave.bTravelGiven = 0;
  block.Execute = execute ? 1 : 0;
  block.body__(ctx);
}

/// A master with a velocity that changes smoothly or not at all.
struct RunningMaster {
  axis::AxisRef ref = poweredAxis(0);
  double rate = 0;

  void step() {
    const double before = ref.fSetVelocity;
    ref.fSetAcceleration = rate;
    ref.fSetVelocity += rate * kGearCycle;
    ref.fSetPosition += 0.5 * (before + ref.fSetVelocity) * kGearCycle;
  }
};

} // namespace stride::test

#endif // STRIDE_TESTS_PROPERTY_GEAR_BLOCKS_HPP
