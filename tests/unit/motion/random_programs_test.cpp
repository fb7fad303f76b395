// Random programs of blocks of all kinds on one axis, judged by what PLCopen and the manual say of
// every block: how its outputs go together, that each command ends in one way, that set positions
// and velocities fit together and change no faster than anybody asked for, and that after MC_Stop
// nobody moves the axis any more. STRIDE_PROGRAMS=FIRST:COUNT takes other seeds.
#include "tests/support/cases.hpp"
#include "tests/unit/motion/state_scene.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace {

using stride::test::Actor;
using stride::test::AxisRig;
using stride::test::axisState;
using stride::test::makeActor;
using stride::test::Shown;

constexpr std::array<const char *, 20> kBlocks = {
    "MC_MoveAbsolute",
    "MC_MoveRelative",
    "MC_MoveAdditive",
    "MC_MoveSuperImposed",
    "MC_MoveVelocity",
    "SMC_MoveContinuousAbsolute",
    "SMC_MoveContinuousRelative",
    "MC_Halt",
    "MC_Stop",
    "MC_GearIn",
    "MC_GearInPos",
    "MC_Phasing",
    "MC_CamIn",
    "MC_GearOut",
    "MC_CamOut",
    "MC_PositionProfile",
    "MC_VelocityProfile",
    "MC_AccelerationProfile",
    "MC_HaltSuperImposed",
    "MC_Jog",
};

/// What a block of the program has shown.
struct Member {
  std::string name;
  Actor actor;
  Shown before;
  bool execute = false;
};

class RandomProgram {
public:
  explicit RandomProgram(unsigned seed) : random(seed) {
    rig.axis.fSWMaxDeceleration = kSteepest;
    if (seed % 4 == 1)
      rig.makeRotary(20);
    rig.axis.eRampType = static_cast<int16_t>(seed % 3 == 0 ? 0 : seed % 3);
    rig.axis.fJerk = 2000;
    EXPECT_GT(rig.powerUp(), 0);
    const unsigned count = 2 + static_cast<unsigned>(random() % 5);
    for (unsigned i = 0; i < count; ++i) {
      const std::string name = kBlocks[random() % kBlocks.size()];
      members.push_back({name, makeActor(rig, name), {}, false});
      told += " " + name;
      free = free || name == "MC_GearInPos";
    }
    members.push_back({"MC_Stop", makeActor(rig, "MC_Stop"), {}, false}); // the last one's end
  }

  /// One cycle, and how it was.
  void cycle() {
    const auto &axis = rig.axis;
    const double position = axis.fSetPosition;
    const double velocity = axis.fSetVelocity;
    rig.cycle([&] {
      for (Member &one : members)
        one.actor.call(one.execute);
    });
    for (Member &one : members)
      judge(one);
    if (!stride::axis::isPowered(axis)) // it is where the drive is
      return;
    const double change = axis.fSetVelocity - velocity;
    const double most = free ? HUGE_VAL : kChange;
    ASSERT_LE(std::fabs(change), most) << "velocity " << velocity;
    double way = axis.fSetPosition - position;
    if (axis.iMovementType == 0)
      way -= axis.fPositionPeriod * std::round(way / axis.fPositionPeriod);
    const double mean = 0.5 * (velocity + axis.fSetVelocity) * rig.cycleSeconds;
    ASSERT_LE(std::fabs(way - mean), most * rig.cycleSeconds) << "way at " << velocity;
  }

  /// Some blocks get an edge.
  void draw() {
    for (size_t i = 0; i + 1 < members.size(); ++i)
      if (random() % 400 == 0)
        members[i].execute = !members[i].execute;
    if (rig.power.bRegulatorOn == 0)
      rig.power.bRegulatorOn = random() % 20 == 0 ? 1 : 0;
    else if (powerFails && random() % 3000 == 0)
      rig.power.bRegulatorOn = 0;
  }

  /// Nobody wants anything, MC_Stop stops, and then all must be at rest.
  void stop() {
    for (Member &one : members)
      one.execute = false;
    rig.power.bRegulatorOn = 1;
    run(60);
    for (int i = 0; i < 30000 && rig.axis.nAxisState == axisState("stopping"); ++i)
      run(1);
    ASSERT_NE(rig.axis.nAxisState, axisState("stopping")) << "for ever";
    if (rig.axis.nAxisState == axisState("errorstop")) {
      run(30000);
      ASSERT_EQ(rig.axis.fSetVelocity, 0);
      return;
    }
    if (free) // it may have left the axis with an acceleration that no jerk takes away in time
      return;
    members.back().execute = true;
    for (int i = 0; i < 30000 && !members.back().actor.show().done; ++i)
      run(1);
    ASSERT_TRUE(members.back().actor.show().done) << "MC_Stop has stopped the axis";
    members.back().execute = false;
    run(3);
    for (const Member &one : members) {
      ASSERT_FALSE(one.actor.show().busy) << one.name << " is busy after MC_Stop";
    }
    ASSERT_EQ(rig.axis.nAxisState, axisState("standstill"));
    ASSERT_EQ(rig.axis.fSetVelocity, 0);
  }

  void run(int cycles) {
    for (int i = 0; i < cycles && !testing::Test::HasFatalFailure(); ++i)
      cycle();
  }

  /// For people.
  [[nodiscard]] std::string shown() const {
    std::string all = "\nstate " + std::to_string(rig.axis.nAxisState) + " error " +
                      std::to_string(rig.axis.wFBErrorID) + " velocity " +
                      std::to_string(rig.axis.fSetVelocity);
    for (const Member &one : members) {
      const Shown s = one.actor.show();
      all += "\n" + one.name + (one.execute ? " execute" : "") + (s.busy ? " busy" : "") +
             (s.done ? " done" : "") + (s.aborted ? " aborted" : "") +
             (s.error ? " error " + std::to_string(s.errorId) : "");
    }
    return all;
  }

  std::mt19937 random;
  AxisRig rig;
  std::vector<Member> members;
  std::string told;
  bool powerFails = false;
  bool free = false; ///< MC_GearInPos has no limits: it is somewhere at a time.

private:
  static constexpr double kSteepest = 200; // u/s^2
  /// Several blocks that move at once add up; nobody stands at once. [u/s]
  static constexpr double kChange = 1.0;

  static void judge(Member &one) {
    const Shown now = one.actor.show();
    ASSERT_LE((now.done ? 1 : 0) + (now.aborted ? 1 : 0) + (now.error ? 1 : 0), 1)
        << one.name << " done " << now.done << " aborted " << now.aborted << " error " << now.error;
    ASSERT_EQ(now.error, now.errorId != 0) << one.name;
    ASSERT_FALSE(now.busy && (now.aborted || now.error)) << one.name;
    const bool ends = now.hasBusy && one.before.busy && !now.busy;
    if (ends && now.hasAborted) {
      ASSERT_TRUE(now.done || now.aborted || now.error || one.name == "MC_Jog")
          << one.name << " ends without a word";
    }
    one.before = now;
  }
};

void runProgram(unsigned seed) {
  RandomProgram program(seed);
  program.powerFails = seed % 5 == 2;
  for (int i = 0; i < 4000; ++i) {
    program.draw();
    program.cycle();
    if (testing::Test::HasFatalFailure())
      FAIL() << "seed " << seed << program.told << " in cycle " << i << program.shown();
  }
  program.stop();
  if (testing::Test::HasFatalFailure())
    FAIL() << "at the end of seed " << seed << program.told << program.shown();
}

TEST(RandomPrograms, KeepTheRulesOfBlocks) {
  unsigned first = 0;
  auto count = static_cast<unsigned>(stride::test::casesOf(100));
  if (const char *const given = std::getenv("STRIDE_PROGRAMS"); given != nullptr) {
    char *end = nullptr;
    first = static_cast<unsigned>(std::strtoul(given, &end, 10));
    count = *end == ':' ? static_cast<unsigned>(std::strtoul(end + 1, nullptr, 10)) : 1;
  }
  for (unsigned seed = first; seed < first + count; ++seed) {
    runProgram(seed);
    if (HasFatalFailure())
      return;
  }
}

} // namespace
