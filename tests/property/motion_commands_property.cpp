// Random programs of motion commands on one axis with a drive: every positioning and velocity
// block, buffer mode, ramp type, overrides, superimposed motions, stops. Whatever they ask for, the
// axis moves steadily within what was allowed, and every command ends once.

#include "tests/support/kinematics.hpp"
#include "tests/support/random.hpp"
#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_PLCopen/MC_Halt.h"
#include "st/SM_PLCopen/MC_MoveAdditive.h"
#include "st/SM_PLCopen/MC_MoveRelative.h"
#include "st/SM_PLCopen/MC_MoveSuperImposed.h"
#include "st/SM_PLCopen/MC_MoveVelocity.h"
#include "st/SM_PLCopen/MC_ReadStatus.h"
#include "st/SM_PLCopen/MC_SetOverride.h"
#include "st/SM_PLCopen/SMC_MoveContinuousAbsolute.h"
#include "st/SM_PLCopen/SMC_MoveContinuousRelative.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace {

using stride::test::AxisRig;
using stride::test::fresh;
using stride::test::Random;
namespace axis = stride::axis;
namespace state = stride::axis::state;
namespace pl = ::st::SM_PLCopen;

/// A block instance behind what all have in common.
struct Instance {
  std::string name;
  std::function<void(bool)> call;     ///< With Execute.
  std::function<void(Random &)> draw; ///< New inputs.
  std::function<bool()> done, aborted, failed, busy, active;
  bool execute = false;
  bool endless = false;
  bool wasBusy = false;
  int buffered = 0; ///< BufferMode of the last command.
};

struct Limits {
  double length, velocity, acceleration, jerk;
};

class Scenario {
public:
  Scenario(uint64_t seed, int16_t ramp) : random_(seed), ramp_(ramp), rig_(cycle()) {
    const double seconds = rig_.cycleSeconds * random_.magnitude(1, 2.5);
    limits_.length = random_.magnitude(-1, 3);
    limits_.velocity = limits_.length / seconds;
    limits_.acceleration = limits_.velocity / seconds * random_.magnitude(0, 1);
    limits_.jerk = limits_.acceleration / seconds * random_.magnitude(0, 1);
    rotary_ = random_.chance(0.4);
    rig_.axis.dwRatioTechUnitsDenom = 1000000;
    rig_.axis.iRatioTechUnitsNum = 1;
    if (rotary_)
      rig_.makeRotary(limits_.length);
    rig_.axis.eRampType = ramp;
    rig_.axis.fJerk = limits_.jerk;
    add<pl::MC_MoveAbsolute>("MoveAbsolute", [this](auto &b, Random &r) {
      b.Position = place(r);
      b.Direction = static_cast<int16_t>(r.below(5) - 1);
      limit(b, r);
    });
    add<pl::MC_MoveAbsolute>("MoveAbsolute2", [this](auto &b, Random &r) {
      b.Position = place(r);
      b.Direction = static_cast<int16_t>(r.below(5) - 1);
      limit(b, r);
    });
    add<pl::MC_MoveRelative>("MoveRelative", [this](auto &b, Random &r) {
      b.Distance = place(r);
      limit(b, r);
    });
    add<pl::MC_MoveAdditive>("MoveAdditive", [this](auto &b, Random &r) {
      b.Distance = place(r);
      limit(b, r);
    });
    add<pl::MC_MoveVelocity>("MoveVelocity", [this](auto &b, Random &r) {
      limit(b, r);
      if (r.chance(0.1))
        b.Velocity = 0;
      b.Direction = static_cast<int16_t>(r.chance(0.3) ? 2 : r.chance(0.5) ? 1 : -1);
    });
    add<pl::SMC_MoveContinuousAbsolute>("ContinuousAbsolute", [this](auto &b, Random &r) {
      b.Position = place(r);
      b.Direction = static_cast<int16_t>(r.below(4) - 1);
      limit(b, r);
      b.EndVelocity = r.chance(0.2) ? 0 : r.uniform(0, b.Velocity);
      b.EndVelocityDirection = static_cast<int16_t>(r.chance(0.5) ? 2 : r.chance(0.5) ? 1 : -1);
    });
    add<pl::SMC_MoveContinuousRelative>("ContinuousRelative", [this](auto &b, Random &r) {
      b.Distance = place(r);
      limit(b, r);
      b.EndVelocity = r.chance(0.2) ? 0 : r.uniform(0, b.Velocity);
      b.EndVelocityDirection = static_cast<int16_t>(r.chance(0.5) ? 2 : r.chance(0.5) ? 1 : -1);
    });
    add<pl::MC_Halt>("Halt", [this](auto &b, Random &r) {
      b.Deceleration = limits_.acceleration * r.magnitude(-1, 0);
      b.BufferMode = 0;
    });
    override_.Axis = &rig_.axis;
    superimposed_.Axis = &rig_.axis;
    status_.Axis = &rig_.axis;
    status_.Enable = 1;
  }

  /// Runs random commands for so many steps; every violated property is a test failure.
  void run(int steps) {
    ASSERT_GT(rig_.powerUp(), 0);
    for (int step = 0; step < steps && !::testing::Test::HasFailure(); ++step) {
      act();
      const int cycles = static_cast<int>(random_.magnitude(0, 2.5));
      for (int i = 0; i < cycles && !::testing::Test::HasFailure(); ++i)
        cycleOnce();
    }
    // In the end everything comes to rest by itself or by a stop.
    for (auto &block : blocks_)
      block.execute = false;
    override_.VelFactor = override_.AccFactor = override_.JerkFactor = 1;
    superExecute_ = false;
    cycleOnce();
    auto &halt = blocks_.back();
    halt.draw(random_);
    log("halt at the end");
    halt.execute = true;
    cycleOnce();
    for (int i = 0; i < 100000 && !::testing::Test::HasFailure() && !halt.done(); ++i)
      cycleOnce();
    EXPECT_TRUE(halt.done()) << history_;
    EXPECT_EQ(rig_.axis.fSetVelocity, 0.0);
    EXPECT_EQ(rig_.axis.nAxisState, state::kStandstill);
  }

  [[nodiscard]] int commands() const { return commands_; }
  [[nodiscard]] int handedOver() const { return handedOver_; }

private:
  double cycle() { return random_.magnitude(-3.5, -1.5); }
  double place(Random &r) {
    return rotary_ ? r.uniform(-1, 2) * limits_.length : r.uniform(-1, 1) * limits_.length;
  }
  template <class Block> void limit(Block &b, Random &r) {
    b.Velocity = limits_.velocity * r.magnitude(-1, 0);
    b.Acceleration = limits_.acceleration * r.magnitude(-1, 0);
    b.Deceleration = r.chance(0.3) ? b.Acceleration : limits_.acceleration * r.magnitude(-1, 0);
    b.Jerk = r.chance(0.5) ? 0 : limits_.jerk * r.magnitude(-1, 0);
    b.BufferMode = static_cast<int16_t>(r.chance(0.4) ? 0 : r.below(6));
  }

  template <class Block, class Draw> void add(const std::string &name, Draw draw) {
    auto block = std::make_shared<Block>(fresh<Block>());
    block->Axis = &rig_.axis;
    Instance i;
    i.name = name;
    i.call = [this, block](bool execute) { rig_.call(*block, execute); };
    i.draw = [block, draw](Random &r) { draw(*block, r); };
    if constexpr (requires { block->InVelocity; }) {
      i.done = [block] { return block->InVelocity != 0; };
      i.endless = true;
    } else if constexpr (requires { block->InEndVelocity; }) {
      i.done = [block] { return block->InEndVelocity != 0; };
      i.endless = true;
    } else {
      i.done = [block] { return block->Done != 0; };
    }
    i.aborted = [block] { return block->CommandAborted != 0; };
    i.failed = [block] { return block->Error != 0; };
    i.busy = [block] { return block->Busy != 0; };
    i.active = [block] { return block->Active != 0; };
    blocks_.push_back(i);
    auto &stored = blocks_.back();
    (void)stored;
    modes_.push_back([block] { return static_cast<int>(block->BufferMode); });
  }

  void log(const std::string &text) { history_ += std::to_string(cycles_) + ": " + text + "\n"; }

  /// One event: a command, an override, a superimposed motion.
  void act() {
    const double what = random_.uniform(0, 1);
    if (what < 0.12) {
      override_.Enable = 1;
      override_.VelFactor = random_.chance(0.2) ? 0 : random_.uniform(0.1, 1);
      override_.AccFactor = random_.uniform(0.3, 1);
      override_.JerkFactor = random_.uniform(0.3, 1);
      if (random_.chance(0.5))
        override_.VelFactor = override_.AccFactor = override_.JerkFactor = 1;
      log("override " + std::to_string(override_.VelFactor));
      return;
    }
    if (what < 0.25) {
      superExecute_ = false;
      cycleOnce();
      superimposed_.Distance = place(random_) * 0.3;
      superimposed_.VelocityDiff = limits_.velocity * random_.magnitude(-1, 0);
      superimposed_.Acceleration = limits_.acceleration * random_.magnitude(-1, 0);
      superimposed_.Deceleration = limits_.acceleration * random_.magnitude(-1, 0);
      superExecute_ = true;
      log("superimpose " + std::to_string(superimposed_.Distance));
      return;
    }
    const auto index = static_cast<size_t>(random_.below(static_cast<int>(blocks_.size())));
    auto &block = blocks_[index];
    if (block.execute || block.busy()) {
      block.execute = false;
      cycleOnce();
    }
    block.draw(random_);
    block.buffered = modes_[index]();
    block.execute = true;
    ++commands_;
    log(block.name + " mode " + std::to_string(block.buffered));
  }

  void cycleOnce() {
    auto &axis = rig_.axis;
    const double s0 = axis.fSetPosition;
    const double v0 = axis.fSetVelocity;
    const double a0 = axis.fSetAcceleration;
    const int16_t owners0 = axis.iNoOwner;
    int active = 0;
    rig_.cycle([&] {
      override_.body__(rig_.ctx);
      for (auto &block : blocks_) {
        block.wasBusy = block.busy();
        block.call(block.execute);
      }
      rig_.call(superimposed_, superExecute_);
      status_.body__(rig_.ctx);
    });
    ASSERT_EQ(status_.Errorstop + status_.Stopping + status_.StandStill + status_.DiscreteMotion +
                  status_.ContinuousMotion + status_.SynchronizedMotion + status_.Homing,
              1)
        << "one state\n"
        << history_;
    ASSERT_EQ(status_.StandStill != 0, axis.iOwner == 0) << "who moves owns\n" << history_;
    ASSERT_GE(axis.iNoOwner, owners0) << history_;
    ASSERT_TRUE(axis.iOwner == 0 || axis.iOwner == axis.iNoOwner) << history_;
    ++cycles_;
    ASSERT_NE(axis.nAxisState, state::kErrorStop) << axis.wFBErrorID << "\n" << history_;
    for (auto &block : blocks_) {
      active += block.active() ? 1 : 0;
      ASSERT_FALSE(block.done() && block.aborted()) << block.name << "\n" << history_;
      if (block.failed()) {
        ASSERT_NE(block.buffered, 0) << block.name << " error " << axis.wFBErrorID << "\n"
                                     << history_;
      }
      if (block.wasBusy && !block.busy()) {
        ASSERT_TRUE(block.done() || block.aborted() || block.failed()) << block.name << "\n"
                                                                       << history_;
        if (block.done() && axis.iOwner != 0)
          ++handedOver_;
      }
    }
    ASSERT_LE(active, 2) << history_; // two in the cycle of a change
    const double T = rig_.cycleSeconds;
    const double v1 = axis.fSetVelocity;
    const double a1 = axis.fSetAcceleration;
    // A sine-shaped ramp in the manual's flavour exceeds its acceleration; a superimposed motion
    // adds its own.
    const double peak = (ramp_ == 1 ? 1.5708 : 1.0) * 2.0 * limits_.acceleration * (1 + 1e-9);
    double top = 2.0 * limits_.velocity;
    // With limited jerk an acceleration of the motion before cannot vanish at once.
    if (ramp_ != 0)
      top += peak * peak / (2.0 * 0.03 * limits_.jerk);
    top *= 1 + 1e-9;
    ASSERT_LE(std::fabs(v1), top) << "velocity\n" << history_;
    ASSERT_LE(std::fabs(a1), peak) << "acceleration\n" << history_;
    ASSERT_LE(std::fabs(v1 - v0), peak * T + 1e-12 * top) << "velocity jumps\n" << history_;
    double way = axis.fSetPosition - s0;
    const double expected = 0.5 * (v0 + v1) * T;
    if (rotary_) {
      way = expected + stride::test::shortWay(way - expected, axis.fPositionPeriod);
    }
    ASSERT_LE(std::fabs(way - expected), 0.5 * peak * T * T + 1e-9 * limits_.length)
        << "position jumps\n"
        << history_;
    if (ramp_ == 2) {
      ASSERT_LE(std::fabs(a1 - a0), 2.0 * limits_.jerk * T * (1 + 1e-9) + 1e-9 * peak)
          << "acceleration jumps\n"
          << history_;
    }
  }

  Random random_;
  int16_t ramp_;
  AxisRig rig_;
  Limits limits_{};
  bool rotary_ = false;
  std::vector<Instance> blocks_;
  std::vector<std::function<int()>> modes_;
  pl::MC_SetOverride override_ = fresh<pl::MC_SetOverride>();
  pl::MC_ReadStatus status_ = fresh<pl::MC_ReadStatus>();
  pl::MC_MoveSuperImposed superimposed_ = fresh<pl::MC_MoveSuperImposed>();
  bool superExecute_ = false;
  int cycles_ = 0;
  int commands_ = 0;
  int handedOver_ = 0;
  std::string history_;
};

class MotionCommands : public ::testing::TestWithParam<int> {};

TEST_P(MotionCommands, AnyProgramMovesSteadily) {
  int commands = 0;
  int handedOver = 0;
#if defined(__SANITIZE_ADDRESS__)
  constexpr int kRuns = 100; // slow there, and the release build does them all
#else
  constexpr int kRuns = 400;
#endif
  for (uint64_t run = 0; run < kRuns && !HasFailure(); ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    Scenario scenario(run * 7919 + 17, static_cast<int16_t>(GetParam()));
    scenario.run(40);
    commands += scenario.commands();
    handedOver += scenario.handedOver();
  }
  EXPECT_GE(commands, 20 * kRuns);
  EXPECT_GE(handedOver, kRuns);
  std::cout << commands << " commands, " << handedOver << " followed by another\n";
}

INSTANTIATE_TEST_SUITE_P(Ramps, MotionCommands, ::testing::Values(0, 1, 2, 3),
                         [](const auto &info) { return "Ramp" + std::to_string(info.param); });

} // namespace
