// Random programs of motion commands on a drive that is switched between torque, velocity and
// position control meanwhile. Whatever they do, nothing is done that has not been reached, what the
// drive does not regulate is refused, and when control returns nothing leaps.

#include "tests/support/random.hpp"
#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_DriveBasic/SMC_FollowVelocity.h"
#include "st/SM_DriveBasic/SMC_SetControllerMode.h"
#include "st/SM_PLCopen/MC_Halt.h"
#include "st/SM_PLCopen/MC_MoveRelative.h"
#include "st/SM_PLCopen/MC_MoveSuperImposed.h"
#include "st/SM_PLCopen/MC_MoveVelocity.h"
#include "st/SM_PLCopen/SMC_MoveContinuousAbsolute.h"
#include "st/SM_PLCopen/SMC_SetTorque.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace {

using stride::axis::Regulated;
using stride::test::AxisRig;
using stride::test::fresh;
using stride::test::Random;
namespace axis = stride::axis;
namespace basic = ::st::SM_DriveBasic;
namespace bus = stride::bus;
namespace dummy = stride::dummy;
namespace pl = ::st::SM_PLCopen;

constexpr double kVelocity = 80;
constexpr double kAcceleration = 400;
constexpr double kTorque = 12; ///< 600 u/s² on kInertia.
constexpr double kInertia = 0.02;
constexpr double kPeriod = 360;
constexpr double kWrongMode = 21;

/// A drive with a mass that regulates positions, velocities and torques. Set values take `deadTime`
/// cycles longer to it.
bus::GroupSetup makeSetup(bool rotary, int deadTime, double cycle) {
  bus::GroupSetup setup(dummy::kSchema, cycle);
  auto &drive = setup.addDrive("X", 1).parameters;
  drive.add({"wControlType", "", 0});
  drive.add({"wCyclicDataS1", "", 1100});
  drive.add({"wCyclicDataS2", "", 1110});
  drive.add({"wCyclicDataS3", "", 1160});
  drive.add({"wCyclicDataR1", "", 1101});
  drive.add({"wCyclicDataR2", "", 1111});
  drive.add({"dwRatioTechUnitsDenom", "", 10000});
  drive.add({"physics.model", "second_order", 2});
  drive.add({"physics.inertia", "", kInertia});
  drive.add({"physics.dead_time", "", static_cast<double>(deadTime)});
  drive.add({"physics.torque_limit", "", 100});
  drive.add({"physics.viscous_friction", "", 0.04});
  drive.add({"physics.position_gain", "", 50});
  drive.add({"physics.velocity_gain", "", 20});
  drive.add({"physics.velocity_feedforward", "", 1});
  if (rotary) {
    drive.add({"iMovementType", "rotary", 0});
    drive.add({"fPositionPeriod", "", kPeriod});
  }
  return setup;
}

/// The nearer one of the ways between two places.
double apart(double a, double b, bool rotary) {
  return std::fabs(rotary ? std::remainder(a - b, kPeriod) : a - b);
}

/// One block.
struct Instance {
  std::string name;
  std::function<void(bool)> call;
  std::function<void(Random &)> draw;
  std::function<bool()> done, busy;
  std::function<int()> error;
  std::function<void()> expectReached; ///< When it has become Done.
  bool execute = false;
  bool needsPosition = true;
  bool wasDone = false;
};

class Scenario {
public:
  Scenario(uint64_t seed, int16_t ramp) : random_(seed), rig_(0.001) {
    rotary_ = random_.chance(0.4);
    if (rotary_)
      rig_.makeRotary(kPeriod);
    rig_.axis.eRampType = ramp;
    rig_.axis.fJerk = 20 * kAcceleration;
    rig_.axis.fSWMaxDeceleration = kAcceleration;
    deadTime_ = random_.chance(0.5) ? 0 : random_.below(4);
    rig_.axis.fSetActTimeLagCycles = deadTime_;
    lag_ = 0.4 + 1.3 * deadTime_ * rig_.cycleSeconds * kVelocity;
    rig_.start(makeSetup(rotary_, deadTime_, rig_.cycleSeconds));
    rig_.drive->bindData(0, &sim_);
    mode_.Axis = &rig_.axis;
    torque_.Axis = &rig_.axis;
    addMoves();
    addVelocities();
  }

  void run(int steps) {
    ASSERT_GT(rig_.powerUp(), 0);
    for (int step = 0; step < steps && !::testing::Test::HasFailure(); ++step) {
      act();
      const double size = random_.chance(0.25) ? 3.2 : random_.uniform(0, 2.7);
      const int cycles = static_cast<int>(random_.magnitude(size - 0.1, size));
      for (int i = 0; i < cycles && !::testing::Test::HasFailure(); ++i)
        cycleOnce();
    }
  }

  [[nodiscard]] int arrived() const { return arrived_; }
  [[nodiscard]] int refused() const { return refused_; }
  [[nodiscard]] int returned() const { return returned_; }

private:
  void addMoves() {
    auto &absolute = add<pl::MC_MoveAbsolute>("MoveAbsolute", [](auto &b, Random &r) {
      b.Position = r.uniform(-60, 60);
      b.Direction = 0;
    });
    expectThere(absolute);
    auto &relative = add<pl::MC_MoveRelative>(
        "MoveRelative", [](auto &b, Random &r) { b.Distance = r.uniform(-30, 30); });
    expectThere(relative);
    auto &added = add<pl::MC_MoveSuperImposed>("MoveSuperImposed", [](auto &b, Random &r) {
      b.Distance = r.uniform(-20, 20);
      b.VelocityDiff = r.uniform(5, 20);
    });
    added.expectReached = [] {};
    auto &continuous =
        add<pl::SMC_MoveContinuousAbsolute>("ContinuousAbsolute", [](auto &b, Random &r) {
          b.Position = r.uniform(-60, 60);
          b.Direction = 0;
          b.EndVelocity = r.uniform(1, 10);
          b.EndVelocityDirection = 1;
        });
    continuous.expectReached = [] {};
  }

  void addVelocities() {
    auto &velocity = add<pl::MC_MoveVelocity>("MoveVelocity", [this](auto &b, Random &r) {
      b.Direction = static_cast<int16_t>(r.chance(0.5) ? 1 : -1);
      wanted_ = b.Direction * b.Velocity;
    });
    velocity.needsPosition = false;
    velocity.expectReached = [this] {
      const auto &ref = rig_.axis;
      // … but for a motion on top, or the next one that has begun in this cycle.
      if (ref.stSuperimposed.ulOwner == 0 && ref.stPlanner.bReached != 0) {
        EXPECT_NEAR(ref.fSetVelocity, wanted_, 1e-9) << history_;
      }
    };
    auto &halt = add<pl::MC_Halt>("Halt", [](auto & /*b*/, Random & /*r*/) {});
    halt.needsPosition = false;
    halt.expectReached = [this] {
      if (rig_.axis.iOwner == 0 && rig_.axis.stSuperimposed.ulOwner == 0) {
        EXPECT_EQ(rig_.axis.fSetVelocity, 0) << history_;
      }
    };
    auto &follow = add<basic::SMC_FollowVelocity>(
        "FollowVelocity", [this](auto &b, Random &) { b.fSetVelocity = rig_.axis.fSetVelocity; });
    follow.needsPosition = false;
    follow.expectReached = [] {};
  }

  /// Done: the set position is the target, and the drive is there but for what it lags behind.
  void expectThere(Instance &instance) {
    instance.expectReached = [this] {
      const auto &ref = rig_.axis;
      if (ref.iOwner != 0 || ref.stSuperimposed.ulOwner != 0)
        return; // the next one has begun, or another motion is still on top
      const double target = ref.fAimPosition + ref.stSuperimposed.fPosition;
      EXPECT_LT(apart(ref.fSetPosition, target, rotary_), 1e-9) << history_;
      EXPECT_LT(apart(place(), target, rotary_), lag_) << history_;
      ++arrived_;
    };
  }

  template <class Block, class Draw> Instance &add(const std::string &name, Draw draw) {
    auto block = std::make_shared<Block>(fresh<Block>());
    block->Axis = &rig_.axis;
    Instance i;
    i.name = name;
    i.call = [this, block](bool execute) {
      if constexpr (requires { block->Execute; })
        block->Execute = execute;
      else
        block->bExecute = execute;
      block->body__(rig_.ctx);
    };
    i.draw = [block, draw](Random &r) {
      if constexpr (requires { block->Velocity; })
        block->Velocity = r.uniform(30, kVelocity);
      if constexpr (requires { block->Acceleration; })
        block->Acceleration = r.uniform(0.3, 1) * kAcceleration;
      if constexpr (requires { block->Deceleration; })
        block->Deceleration = r.uniform(0.3, 1) * kAcceleration;
      if constexpr (requires { block->BufferMode; })
        block->BufferMode = static_cast<int16_t>(r.chance(0.7) ? 0 : 1);
      draw(*block, r);
    };
    if constexpr (requires { block->InVelocity; })
      i.done = [block] { return block->InVelocity != 0; };
    else if constexpr (requires { block->InEndVelocity; })
      i.done = [block] { return block->InEndVelocity != 0; };
    else if constexpr (requires { block->Done; })
      i.done = [block] { return block->Done != 0; };
    else
      i.done = [] { return false; };
    if constexpr (requires { block->Busy; })
      i.busy = [block] { return block->Busy != 0; };
    else
      i.busy = [block] { return block->bBusy != 0; };
    if constexpr (requires { block->ErrorID; })
      i.error = [block] { return static_cast<int>(block->ErrorID); };
    else
      i.error = [block] { return static_cast<int>(block->iErrorID); };
    return blocks_.emplace_back(std::move(i));
  }

  double place() const { return sim_.fPosition; }

  void log(const std::string &text) { history_ += std::to_string(cycles_) + ": " + text + "\n"; }

  void act() {
    if (random_.chance(0.3)) {
      mode_.bExecute = 0;
      cycleOnce();
      mode_.bExecute = 1;
      mode_.nControllerMode = static_cast<int16_t>(1 + random_.below(3));
      torque_.bEnable = random_.chance(0.8);
      torque_.fTorque = random_.chance(0.3) ? 0 : random_.uniform(-0.2, 0.2) * kTorque;
      log("mode " + std::to_string(mode_.nControllerMode));
      return;
    }
    auto &block = blocks_[static_cast<size_t>(random_.below(static_cast<int>(blocks_.size())))];
    if (block.execute || block.busy()) {
      block.execute = false;
      cycleOnce();
    }
    block.draw(random_);
    block.execute = true;
    starting_ = &block;
    log(block.name);
    cycleOnce();
    starting_ = nullptr;
  }

  void cycleOnce() {
    auto &ref = rig_.axis;
    const double v0 = ref.fSetVelocity;
    const Regulated before = axis::regulated(ref);
    const double real0 = sim_.fVelocity;
    Regulated during = before;
    rig_.cycle([&] {
      during = axis::regulated(ref);
      expectNoLeap(before, during);
      mode_.body__(rig_.ctx);
      for (auto &block : blocks_)
        block.call(block.execute);
      torque_.body__(rig_.ctx);
    });
    ++cycles_;
    if (ref.nAxisState == axis::state::kErrorStop) {
      ADD_FAILURE() << ref.wFBErrorID << "\n" << history_;
      return;
    }
    // The motor's torque and the friction are the only forces.
    EXPECT_LE(std::fabs(sim_.fVelocity - real0), 2.5 * 600 * 0.001) << "the drive\n" << history_;
    if (during == Regulated::Force) {
      EXPECT_EQ(ref.fSetVelocity, 0) << history_;
    } else if (before == during) {
      EXPECT_LE(std::fabs(ref.fSetVelocity - v0), 2 * 1.6 * kAcceleration * 0.001)
          << "the set velocity\n"
          << history_;
    }
    for (auto &block : blocks_)
      expectTrue(block, during);
  }

  /// A position that is regulated is near: the set position when control returns, and ever after.
  void expectNoLeap(Regulated before, Regulated now) {
    if (now != Regulated::Position)
      return;
    EXPECT_LT(apart(rig_.axis.fSetPosition, place(), rotary_), lag_) << history_;
    if (before == Regulated::Position)
      return;
    ++returned_;
    const double ahead = deadTime_ * rig_.cycleSeconds * sim_.fVelocity;
    EXPECT_LT(apart(rig_.axis.fSetPosition, place() + ahead, rotary_), 0.02) << history_;
  }

  void expectTrue(Instance &block, Regulated during) {
    const bool done = block.done();
    if (done && !block.wasDone) {
      EXPECT_NE(during, Regulated::Force) << block.name << "\n" << history_;
      EXPECT_TRUE(during == Regulated::Position || !block.needsPosition) << block.name << "\n"
                                                                         << history_;
      block.expectReached();
    }
    block.wasDone = done;
    if (&block != starting_)
      return;
    const bool wrong =
        during == Regulated::Force || (during == Regulated::Velocity && block.needsPosition);
    if (wrong) {
      EXPECT_EQ(block.error(), kWrongMode) << block.name << "\n" << history_;
      ++refused_;
    } else {
      EXPECT_NE(block.error(), kWrongMode) << block.name << "\n" << history_;
    }
  }

  Random random_;
  AxisRig rig_;
  dummy::DriveSim sim_ = fresh<dummy::DriveSim>();
  bool rotary_ = false;
  int deadTime_ = 0;
  double lag_ = 0; ///< The drive follows so closely. [u]
  double wanted_ = 0;
  std::vector<Instance> blocks_ = [] {
    std::vector<Instance> blocks;
    blocks.reserve(16); // add() hands out references
    return blocks;
  }();
  const Instance *starting_ = nullptr;
  basic::SMC_SetControllerMode mode_ = fresh<basic::SMC_SetControllerMode>();
  pl::SMC_SetTorque torque_ = fresh<pl::SMC_SetTorque>();
  int cycles_ = 0;
  int arrived_ = 0;
  int refused_ = 0;
  int returned_ = 0;
  std::string history_;
};

class ControllerMode : public ::testing::TestWithParam<int> {};

TEST_P(ControllerMode, NothingIsDoneUnreachedAndNothingLeaps) {
#if defined(__SANITIZE_ADDRESS__)
  constexpr int kRuns = 8;
#else
  constexpr int kRuns = 20;
#endif
  int arrived = 0;
  int refused = 0;
  int returned = 0;
  for (uint64_t run = 0; run < kRuns && !HasFailure(); ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    Scenario scenario(run * 6151 + 29, static_cast<int16_t>(GetParam()));
    scenario.run(60);
    arrived += scenario.arrived();
    refused += scenario.refused();
    returned += scenario.returned();
  }
  EXPECT_GE(arrived, kRuns / 2);
  EXPECT_GE(refused, 5 * kRuns);
  EXPECT_GE(returned, 3 * kRuns);
}

INSTANTIATE_TEST_SUITE_P(Ramps, ControllerMode, ::testing::Values(0, 1, 2, 3),
                         [](const auto &info) { return "Ramp" + std::to_string(info.param); });

} // namespace
