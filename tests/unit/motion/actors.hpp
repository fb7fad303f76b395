// Blocks of all kinds behind one interface, for tests that try every one of them.
#ifndef STRIDE_TESTS_UNIT_MOTION_ACTORS_HPP
#define STRIDE_TESTS_UNIT_MOTION_ACTORS_HPP

#include "tests/unit/axis/axis_rig.hpp"

#include <functional>
#include <string>

namespace stride::test {

/// What a block shows.
struct Shown {
  bool done = false; ///< Done, InVelocity, InEndVelocity, InGear, InSync, Enabled: what it has.
  bool busy = false;
  bool active = false;
  bool aborted = false;
  bool error = false;
  int errorId = 0;
  bool hasBusy = false;
  bool hasAborted = false;
};

/// One instance of a block, bound to the axis of a rig, which must outlive it.
struct Actor {
  std::function<void(bool execute)> call;
  std::function<Shown()> show;
  std::function<void(axis::AxisRef &)> bind; ///< Another axis (slave) from the next call on.
};

/// A block by name, with inputs that suit a linear axis near 0 with the limits of AxisRig: moves of
/// some 10 u that take seconds. "MC_Power off" is MC_Power with bRegulatorOn = FALSE.
Actor makeActor(AxisRig &rig, const std::string &block);

} // namespace stride::test

#endif
