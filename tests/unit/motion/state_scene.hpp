// An axis brought into a state, by every way that leads there.
#ifndef STRIDE_TESTS_UNIT_MOTION_STATE_SCENE_HPP
#define STRIDE_TESTS_UNIT_MOTION_STATE_SCENE_HPP

#include "tests/unit/motion/actors.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stride::test {

/// One axis, and the block that owns it, which is called in every cycle.
class StateScene {
public:
  /// Brings the axis into a state, in one of the ways that waysInto() lists.
  StateScene(const std::string &state, const std::string &way);

  /// A cycle in which only the owner is called.
  void cycle() {
    cycle([] {}, [] {});
  }

  /// A cycle with calls before and after the owner's.
  template <class Before, class After> void cycle(Before before, After after) {
    rig.cycle([&] {
      before();
      if (owner)
        owner->call(execute);
      after();
    });
  }

  AxisRig rig;
  std::optional<Actor> owner;
  bool execute = true; ///< That the owner is called with.

private:
  void run(int cycles);
  void take(const std::string &block, int cycles);

  dummy::DriveSim sim_ = fresh<dummy::DriveSim>();
};

/// An axis that stands, with power, and whose drive regulates `mode` (AXIS_REF.byControllerMode).
class ModeScene {
public:
  explicit ModeScene(uint8_t mode);
  AxisRig rig;

private:
  dummy::DriveSim sim_ = fresh<dummy::DriveSim>();
};

/// The states of the table, as it spells them.
const std::vector<std::string> &axisStates();

/// The number of a state.
int16_t axisState(const std::string &name);

/// The ways into a state that a scene can take.
std::vector<std::string> waysInto(const std::string &state);

} // namespace stride::test

#endif
