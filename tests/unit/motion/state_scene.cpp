#include "tests/unit/motion/state_scene.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace stride::test {
namespace {

/// Cycles until a block called by take() is well under way: accelerating, or at its velocity.
constexpr int kUnderWay = 200;
constexpr int kAtVelocity = 700;

} // namespace

const std::vector<std::string> &axisStates() {
  static const std::vector<std::string> names{
      "power_off",         "errorstop",           "stopping", "standstill", "discrete_motion",
      "continuous_motion", "synchronized_motion", "homing"};
  return names;
}

int16_t axisState(const std::string &name) {
  const auto &names = axisStates();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw std::invalid_argument("no state " + name);
  return static_cast<int16_t>(found - names.begin());
}

std::vector<std::string> waysInto(const std::string &state) {
  static const std::map<std::string, std::vector<std::string>> ways{
      {"power_off", {"never switched on", "switched off"}},
      {"errorstop", {"drive error", "block not called, braking", "block not called, at rest"}},
      {"stopping", {"braking", "braking, Execute = FALSE", "at rest"}},
      {"standstill", {"switched on", "after a move"}},
      {"discrete_motion",
       {"MC_MoveAbsolute", "MC_MoveRelative", "MC_MoveAdditive", "MC_Halt", "MC_PositionProfile"}},
      {"continuous_motion",
       {"MC_MoveVelocity", "MC_MoveVelocity in velocity", "SMC_MoveContinuousAbsolute",
        "SMC_MoveContinuousRelative", "MC_VelocityProfile", "MC_AccelerationProfile", "MC_Jog"}},
      {"synchronized_motion",
       {"SMC_FollowPosition", "SMC_FollowPositionVelocity", "SMC_FollowVelocity",
        "SMC_FollowSetValues", "SMC_ControlAxisByPos", "SMC_ControlAxisByPosVel",
        "SMC_ControlAxisByVel", "MC_GearIn", "MC_GearInPos", "MC_Phasing", "MC_CamIn",
        "SMC_TrackAxis", "SMC_BacklashCompensation"}},
      {"homing", {"SMC_Homing", "MC_Home"}}};
  return ways.at(state);
}

void StateScene::run(int cycles) {
  for (int i = 0; i < cycles; ++i)
    cycle();
}

void StateScene::take(const std::string &block, int cycles) {
  owner = makeActor(rig, block);
  execute = true;
  run(cycles);
}

StateScene::StateScene(const std::string &state, const std::string &way) {
  rig.start();
  rig.drive->bindData(0, &sim_);
  rig.power.bRegulatorOn = way == "never switched on" ? 0 : 1;
  rig.idle(20);
  if (way == "switched off") {
    rig.power.bRegulatorOn = 0;
    rig.idle(20);
  } else if (way == "drive error") {
    rig.drive->raiseError(0, 77);
    rig.idle(5);
  } else if (state == "errorstop") {
    take("MC_MoveRelative", kUnderWay);
    owner.reset();
    run(way == "block not called, at rest" ? 1000 : 3);
  } else if (state == "stopping") {
    take("MC_MoveVelocity", kAtVelocity);
    take("MC_Stop", 1);
    execute = way != "braking, Execute = FALSE";
    run(way == "at rest" ? 1000 : 20);
  } else if (way == "after a move") {
    take("MC_MoveRelative", 5000);
    execute = false;
    run(2);
    owner.reset();
  } else if (way == "MC_Halt") {
    take("MC_MoveVelocity", kAtVelocity);
    take("MC_Halt", 20);
  } else if (way == "MC_MoveVelocity in velocity") {
    take("MC_MoveVelocity", kAtVelocity);
  } else if (state != "standstill" && state != "power_off") {
    take(way, kUnderWay);
  }
}

ModeScene::ModeScene(uint8_t mode) {
  bus::GroupSetup setup(dummy::kSchema, rig.cycleSeconds);
  auto &drive = setup.addDrive("X", 1).parameters;
  drive.add({"wControlType", "", 0});
  drive.add({"wCyclicDataS1", "", 1100});
  drive.add({"wCyclicDataS2", "", 1110});
  drive.add({"wCyclicDataS3", "", 1160});
  drive.add({"wCyclicDataR1", "", 1101});
  drive.add({"physics.model", "second_order", 2});
  drive.add({"physics.inertia", "", 0.5});
  drive.add({"physics.torque_limit", "", 1000});
  drive.add({"dwRatioTechUnitsDenom", "", 10000});
  rig.start(setup);
  rig.drive->bindData(0, &sim_);
  rig.axis.byControllerMode = mode;
  rig.powerUp();
  rig.idle(5);
}

} // namespace stride::test
