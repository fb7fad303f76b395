// Properties of MC_MoveAbsolute on an axis with a drive, observed cycle by cycle: random moves,
// interrupts by another instance, by a new edge and by MC_Stop, on linear and rotary axes.

#include "tests/support/kinematics.hpp"
#include "tests/support/random.hpp"
#include "tests/unit/axis/axis_rig.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <vector>

namespace {

using stride::test::AxisRig;
using stride::test::Random;
namespace state = stride::axis::state;

/// Watches the set values of one axis.
class Watch {
public:
  Watch(AxisRig &rig, double scale) : rig_(rig), scale_(scale) {}

  /// A command with these limits is active from the next cycle on.
  void command(double velocity, double acceleration, double deceleration) {
    limit_ = velocity;
    ceiling_ = std::max(ceiling_, limit_); // until the change has happened
    previousAcceleration_ = acceleration_;
    acceleration_ = std::max(acceleration, deceleration);
    switching_ = true;
  }

  template <class Program>::testing::AssertionResult cycle(Program program) {
    const double s0 = rig_.axis.fSetPosition;
    const double v0 = rig_.axis.fSetVelocity;
    rig_.cycle(program);
    const auto &axis = rig_.axis;
    const double v1 = axis.fSetVelocity;
    // In the cycle of a change either command may have moved the axis.
    const double a = switching_ ? std::max(acceleration_, previousAcceleration_) : acceleration_;
    const double top = ceiling_;
    const double T = rig_.cycleSeconds;
    const double tiny = 1e-12 * (ceiling_ + std::fabs(v0));
    std::ostringstream what;
    if (std::fabs(v1) > top * (1 + 1e-9))
      what << "velocity " << v1 << " above " << top << "; ";
    if (!switching_ && std::fabs(v0) > limit_ * (1 + 1e-12) && std::fabs(v1) > std::fabs(v0))
      what << "velocity rises outside its limit; ";
    if (std::fabs(axis.fSetAcceleration) > a * (1 + 1e-9))
      what << "acceleration " << axis.fSetAcceleration << " above " << a << "; ";
    if (std::fabs(v1 - v0) > a * T * (1 + 1e-9) + tiny)
      what << "velocity jumps from " << v0 << " to " << v1 << "; ";
    double way = axis.fSetPosition - s0;
    if (axis.iMovementType == 0) {
      const double expected = 0.5 * (v0 + v1) * T;
      way = expected + stride::test::shortWay(way - expected, axis.fPositionPeriod);
    }
    // The mean velocity lies between those reachable from both ends.
    if (std::fabs(way - 0.5 * (v0 + v1) * T) > 0.25 * a * T * T * (1 + 1e-9) + 1e-12 * scale_)
      what << "position jumps by " << way << " at " << v0 << ", " << v1 << "; ";
    if (switching_)
      ceiling_ = std::max(limit_, std::fabs(v1));
    switching_ = false;
    if (what.str().empty())
      return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << what.str();
  }

private:
  AxisRig &rig_;
  double scale_;
  double limit_ = 0;
  double ceiling_ = 0;
  double acceleration_ = 0;
  double previousAcceleration_ = 0;
  bool switching_ = false;
};

struct Command {
  double position, velocity, acceleration, deceleration;
  int16_t direction;
};

Command randomCommand(Random &random, double length, double T, bool rotary) {
  const double seconds = T * random.magnitude(0, 2.5);
  Command c{};
  c.position = rotary ? random.uniform(-1, 2) * length : random.uniform(-1, 1) * length;
  c.velocity = length / seconds * random.magnitude(-0.5, 1);
  c.acceleration = length / (seconds * seconds) * random.magnitude(-1, 1.5);
  c.deceleration = random.chance(0.3) ? c.acceleration : c.acceleration * random.magnitude(-1, 1);
  c.direction = static_cast<int16_t>(std::floor(random.uniform(-1, 4)));
  return c;
}

void apply(const Command &c, AxisRig::MoveAbsolute &block) {
  block.Position = c.position;
  block.Velocity = c.velocity;
  block.Acceleration = c.acceleration;
  block.Deceleration = c.deceleration;
  block.Direction = c.direction;
}

TEST(MoveAbsoluteProperty, RandomMovesAndInterrupts) {
  Random random(20090416);
  int moves = 0;
  int interrupts = 0;
  int64_t cycles = 0;
  for (int run = 0; run < 1500; ++run) {
    const double T = random.magnitude(-3.5, -1.5);
    const double length = random.magnitude(-2, 5);
    const bool rotary = random.chance(0.4);
    AxisRig rig(T);
    rig.axis.dwRatioTechUnitsDenom = rotary ? 65536U : 10000U;
    rig.axis.iRatioTechUnitsNum =
        static_cast<int16_t>(rotary ? 360 * (1 + int(length)) % 32767 + 1 : 7);
    if (rotary)
      rig.makeRotary(length);
    if (rig.powerUp() < 0)
      continue; // period below one increment
    Watch watch(rig, length * 10);
    AxisRig::MoveAbsolute blocks[2] = {rig.move(0), rig.move(0)};
    int active = 0;
    for (int k = 0; k < 5; ++k) {
      SCOPED_TRACE("run " + std::to_string(run) + " command " + std::to_string(k));
      const Command c = randomCommand(random, length, T, rotary);
      const bool running = blocks[active].Busy != 0;
      const bool retrigger = random.chance(0.3);
      const bool winnerFirst = random.chance(0.5);
      auto &loser = blocks[active];
      if (!retrigger)
        active = 1 - active;
      auto &block = blocks[active];
      const bool wasOther = &loser != &block && running;
      // An edge needs Execute FALSE before.
      ASSERT_TRUE(watch.cycle([&] {
        rig.call(loser, loser.Busy != 0 && &loser != &block);
        if (&loser != &block)
          rig.call(block, false);
      }));
      if (wasOther && loser.Busy != 0)
        ++interrupts;
      const bool loserBusy = loser.Busy != 0;
      apply(c, block);
      watch.command(c.velocity, c.acceleration, c.deceleration);
      ASSERT_TRUE(watch.cycle([&] {
        if (winnerFirst || &loser == &block) {
          rig.call(block, true);
          if (&loser != &block)
            rig.call(loser, loser.Execute != 0);
        } else {
          rig.call(loser, loser.Execute != 0);
          rig.call(block, true);
        }
      }));
      ASSERT_EQ(block.Error, 0);
      ASSERT_TRUE(block.Busy != 0 || block.Done != 0);
      if (loserBusy && &loser != &block && winnerFirst) {
        ASSERT_EQ(loser.CommandAborted, 1) << "in the same cycle";
      }
      // Called first in this cycle, the other command may just have reached its end.
      const bool lost = loserBusy && &loser != &block && (winnerFirst || loser.Done == 0);
      ++moves;
      const bool interrupt = k < 4 && random.chance(0.7);
      int left = interrupt ? static_cast<int>(random.magnitude(0, 2.7)) : 1000000;
      while (block.Busy != 0 && left-- > 0) {
        ASSERT_TRUE(watch.cycle([&] {
          rig.call(block, true);
          rig.call(loser, &loser == &block || loser.Execute != 0);
        }));
        ++cycles;
      }
      ASSERT_EQ(block.Error, 0);
      if (lost) {
        ASSERT_EQ(loser.Busy, 0);
        ASSERT_EQ(loser.Done, 0);
      }
      if (block.Busy != 0)
        continue;
      ASSERT_EQ(block.Done, 1);
      const double target = rotary ? stride::test::onCircle(c.position, length) : c.position;
      ASSERT_EQ(rig.axis.fSetPosition, target) << "exactly";
      ASSERT_EQ(rig.axis.fSetVelocity, 0.0);
      ASSERT_EQ(rig.axis.nAxisState, state::kStandstill);
    }
    // What is still running is stopped.
    if (blocks[active].Busy != 0) {
      auto stop = rig.stop(length / T / T * random.magnitude(-4, -1));
      watch.command(1e-300, stop.Deceleration, stop.Deceleration);
      ASSERT_TRUE(watch.cycle([&] {
        rig.call(stop, true);
        rig.call(blocks[active], true);
      }));
      ASSERT_EQ(blocks[active].CommandAborted, 1);
      for (int i = 0; i < 1000000 && stop.Busy != 0; ++i)
        ASSERT_TRUE(watch.cycle([&] { rig.call(stop, true); }));
      ASSERT_EQ(stop.Done, 1);
    }
    rig.idle();
    const double perIncrement = rig.axis.fScalefactor;
    double off = rig.axis.fActPosition - rig.axis.fSetPosition;
    if (rotary)
      off = stride::test::shortWay(off, length);
    ASSERT_LE(std::fabs(off), 0.5001 * perIncrement + 1e-9 * length) << run;
  }
  EXPECT_GE(moves, 5000);
  EXPECT_GE(interrupts, 800);
  RecordProperty("moves", moves);
  RecordProperty("interrupts", interrupts);
  std::cout << moves << " moves, " << interrupts << " interrupts, " << cycles << " cycles\n";
}

/// A step of a small scenario in whole numbers, which RapidCheck can shrink.
struct Step {
  int position, velocity, acceleration, deceleration, cycles;
  bool retrigger;
};

void showValue(const Step &s, std::ostream &out) {
  out << "to " << s.position << " v " << s.velocity << " a " << s.acceleration << " d "
      << s.deceleration << (s.retrigger ? " same" : " other") << " block, " << s.cycles
      << " cycles";
}

rc::Gen<Step> anyStep() {
  return rc::gen::build<Step>(rc::gen::set(&Step::position, rc::gen::inRange(-500, 500)),
                              rc::gen::set(&Step::velocity, rc::gen::inRange(1, 300)),
                              rc::gen::set(&Step::acceleration, rc::gen::inRange(1, 3000)),
                              rc::gen::set(&Step::deceleration, rc::gen::inRange(1, 3000)),
                              rc::gen::set(&Step::cycles, rc::gen::inRange(1, 300)),
                              rc::gen::set(&Step::retrigger, rc::gen::arbitrary<bool>()));
}

RC_GTEST_PROP(MoveAbsoluteProperty, WholeNumbers, (bool rotary)) {
  const auto steps = *rc::gen::container<std::vector<Step>>(anyStep());
  AxisRig rig(0.01);
  if (rotary)
    rig.makeRotary(360);
  RC_ASSERT(rig.powerUp() > 0);
  Watch watch(rig, 1000);
  AxisRig::MoveAbsolute blocks[2] = {rig.move(0), rig.move(0)};
  int active = 0;
  for (const Step &step : steps) {
    if (!step.retrigger)
      active = 1 - active;
    auto &block = blocks[active];
    auto &other = blocks[1 - active];
    RC_ASSERT(bool(watch.cycle([&] {
      rig.call(block, false);
      rig.call(other, other.Execute != 0);
    })));
    block.Position = step.position;
    block.Velocity = step.velocity;
    block.Acceleration = step.acceleration;
    block.Deceleration = step.deceleration;
    watch.command(step.velocity, step.acceleration, step.deceleration);
    for (int i = 0; i < step.cycles; ++i)
      RC_ASSERT(bool(watch.cycle([&] {
        rig.call(block, true);
        rig.call(other, other.Execute != 0);
      })));
    RC_ASSERT(other.Busy == 0);
    RC_ASSERT(block.Error == 0);
  }
  auto &block = blocks[active];
  for (int i = 0; i < 1000000 && block.Busy != 0; ++i)
    RC_ASSERT(bool(watch.cycle([&] { rig.call(block, true); })));
  if (!steps.empty()) {
    const double target = steps.back().position;
    RC_ASSERT(block.Done != 0);
    RC_ASSERT(rig.axis.fSetPosition == (rotary ? stride::test::onCircle(target, 360) : target));
  }
}

} // namespace
