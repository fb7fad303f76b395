// MC_SetPosition in the middle of random programs of one axis: two axes get the same program, and
// the zero point of one of them is shifted at any time. Their drives and blocks do the same. The
// software limits, where they are active, move along by SMC_SetSoftwareLimits.

#include "tests/property/command_block.hpp"
#include "tests/support/kinematics.hpp"
#include "tests/support/random.hpp"
#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_DriveBasic/SMC_SetControllerMode.h"
#include "st/SM_DriveBasic/SMC_SetSoftwareLimits.h"
#include "st/SM_PLCopen/MC_AccelerationProfile.h"
#include "st/SM_PLCopen/MC_Halt.h"
#include "st/SM_PLCopen/MC_HaltSuperImposed.h"
#include "st/SM_PLCopen/MC_Jog.h"
#include "st/SM_PLCopen/MC_MoveAdditive.h"
#include "st/SM_PLCopen/MC_MoveRelative.h"
#include "st/SM_PLCopen/MC_MoveSuperImposed.h"
#include "st/SM_PLCopen/MC_MoveVelocity.h"
#include "st/SM_PLCopen/MC_PositionProfile.h"
#include "st/SM_PLCopen/MC_Reset.h"
#include "st/SM_PLCopen/MC_SetOverride.h"
#include "st/SM_PLCopen/MC_SetPosition.h"
#include "st/SM_PLCopen/MC_TA_REF.h"
#include "st/SM_PLCopen/MC_TP_REF.h"
#include "st/SM_PLCopen/MC_TV_REF.h"
#include "st/SM_PLCopen/MC_VelocityProfile.h"
#include "st/SM_PLCopen/SMC_MoveContinuousAbsolute.h"
#include "st/SM_PLCopen/SMC_MoveContinuousRelative.h"
#include "st/SM_PLCopen/SMC_SetTorque.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace {

using stride::test::AxisRig;
using stride::test::CommandBlock;
using stride::test::commandBlock;
using stride::test::fresh;
using stride::test::Random;
namespace state = stride::axis::state;
namespace basic = ::st::SM_DriveBasic;
namespace pl = ::st::SM_PLCopen;

constexpr double kVelocity = 50;
constexpr double kAcceleration = 400;
constexpr double kPeriod = 37;
constexpr double kLimit = 40; ///< Of a linear axis, where its limits are active.

/// One of the two axes with its program. `shift` is how far its zero point has been moved.
class Twin {
public:
  Twin(double cycle, bool rotary, int16_t ramp) : rig(cycle), isRotary_(rotary) {
    rig.axis.dwRatioTechUnitsDenom = 1 << 20;
    if (rotary)
      rig.makeRotary(kPeriod);
    rig.axis.eRampType = ramp;
    rig.axis.fJerk = 6000;
    rig.axis.fSWMaxDeceleration = kAcceleration;
    add<pl::MC_MoveAbsolute>("MoveAbsolute", [this](auto &b, Random &r) {
      b.Position = place(r);
      b.Direction = static_cast<int16_t>(r.below(5) - 1);
      limit(b, r);
    });
    add<pl::MC_MoveAbsolute>("MoveAbsolute2", [this](auto &b, Random &r) {
      b.Position = place(r);
      limit(b, r);
    });
    add<pl::MC_MoveRelative>("MoveRelative", [](auto &b, Random &r) {
      b.Distance = r.uniform(-20, 20);
      limit(b, r);
    });
    add<pl::MC_MoveAdditive>("MoveAdditive", [](auto &b, Random &r) {
      b.Distance = r.uniform(-20, 20);
      limit(b, r);
    });
    add<pl::MC_MoveVelocity>("MoveVelocity", [](auto &b, Random &r) {
      limit(b, r);
      b.Direction = static_cast<int16_t>(r.chance(0.5) ? 1 : -1);
    });
    add<pl::SMC_MoveContinuousAbsolute>("ContinuousAbsolute", [this](auto &b, Random &r) {
      b.Position = place(r);
      limit(b, r);
      b.EndVelocity = r.uniform(0, b.Velocity);
      b.EndVelocityDirection = static_cast<int16_t>(r.chance(0.5) ? 1 : -1);
    });
    add<pl::SMC_MoveContinuousRelative>("ContinuousRelative", [](auto &b, Random &r) {
      b.Distance = r.uniform(-20, 20);
      limit(b, r);
      b.EndVelocity = r.uniform(0, b.Velocity);
      b.EndVelocityDirection = static_cast<int16_t>(r.chance(0.5) ? 1 : -1);
    });
    add<pl::MC_MoveSuperImposed>("SuperImposed", [](auto &b, Random &r) {
      b.Distance = r.uniform(-5, 5);
      b.VelocityDiff = kVelocity * r.magnitude(-1, 0);
      b.Acceleration = b.Deceleration = kAcceleration;
    });
    add<pl::MC_HaltSuperImposed>("HaltSuperImposed", [](auto &b, Random &r) {
      b.Deceleration = kAcceleration * r.magnitude(-1, 0);
    });
    add<pl::MC_Stop>(
        "Stop", [](auto &b, Random &r) { b.Deceleration = kAcceleration * r.magnitude(-1, 0); });
    add<pl::MC_Halt>(
        "Halt", [](auto &b, Random &r) { b.Deceleration = kAcceleration * r.magnitude(-1, 0); });
    add<pl::MC_Reset>("Reset", [](auto &, Random &) {});
    addCourse<pl::MC_PositionProfile, pl::MC_TP_REF>("PositionProfile");
    addCourse<pl::MC_VelocityProfile, pl::MC_TV_REF>("VelocityProfile");
    addCourse<pl::MC_AccelerationProfile, pl::MC_TA_REF>("AccelerationProfile");
    addJog();
    override_.Axis = setPosition_.Axis = limits_.Axis = mode_.Axis = torque_.Axis = &rig.axis;
  }

  /// `by` [u], before or after the blocks of this cycle; without effect on `shift` when refused.
  void move(double by) {
    setPosition_.Execute = 0;
    setPosition_.body__(rig.ctx);
    setPosition_.Execute = 1;
    setPosition_.Mode = 1;
    setPosition_.Position = by;
    setPosition_.body__(rig.ctx);
    ASSERT_EQ(setPosition_.Done, 1);
    shift += by;
    if (hasLimits_)
      setLimits();
  }

  void setLimits() {
    hasLimits_ = true;
    limits_.bExecute = 0;
    limits_.body__(rig.ctx);
    limits_.bExecute = limits_.SWL_Activated = 1;
    limits_.SWL_Negative = shift - kLimit;
    limits_.SWL_Positive = shift + kLimit;
    limits_.body__(rig.ctx);
    ASSERT_EQ(limits_.bDone, 1);
  }

  void setOverride(double velocity, double acceleration) {
    override_.Enable = 1;
    override_.VelFactor = velocity;
    override_.AccFactor = override_.JerkFactor = acceleration;
  }

  void setMode(int16_t mode, double torque) {
    mode_.bExecute = 0;
    mode_.body__(rig.ctx);
    mode_.bExecute = 1;
    mode_.nControllerMode = mode;
    torque_.bEnable = 1;
    torque_.fTorque = torque;
  }

  /// `before`, `after`: the zero point is moved by that before or after the blocks are called.
  void cycle(double before, double after) {
    rig.cycle([&] {
      if (before != 0)
        move(before);
      override_.body__(rig.ctx);
      mode_.body__(rig.ctx);
      for (auto &block : blocks)
        block.call(block.execute);
      torque_.body__(rig.ctx);
      if (after != 0)
        move(after);
    });
  }

  AxisRig rig;
  double shift = 0;
  std::vector<CommandBlock> blocks;

private:
  double place(Random &r) const {
    return r.uniform(0, kPeriod) + (isRotary_ ? std::remainder(shift, kPeriod) : shift);
  }

  template <class Block> static void limit(Block &b, Random &r) {
    b.Velocity = kVelocity * r.magnitude(-1, 0);
    b.Acceleration = kAcceleration * r.magnitude(-1, 0);
    b.Deceleration = kAcceleration * r.magnitude(-1, 0);
    b.BufferMode = static_cast<int16_t>(r.chance(0.5) ? 0 : r.below(6));
  }

  template <class Block, class Draw> void add(const std::string &name, Draw draw) {
    auto b = std::make_shared<Block>(fresh<Block>());
    b->Axis = &rig.axis;
    CommandBlock &i = blocks.emplace_back();
    i.name = name;
    i.call = [this, b](bool execute) { rig.call(*b, execute); };
    i.draw = [b, draw](Random &r) { draw(*b, r); };
    i.busy = [b] { return b->Busy != 0; };
    i.failed = [b] { return b->Error != 0; };
    i.done = i.aborted = [] { return false; };
    if constexpr (requires { b->Done; })
      i.done = [b] { return b->Done != 0; };
    if constexpr (requires { b->CommandAborted; })
      i.aborted = [b] { return b->CommandAborted != 0; };
    i.error = [b] { return static_cast<int>(b->ErrorID); };
  }

  static auto &pointsOf(pl::MC_TP_REF &ref) { return ref.MC_TP_Array; }
  static auto &pointsOf(pl::MC_TV_REF &ref) { return ref.MC_TV_Array; }
  static auto &pointsOf(pl::MC_TA_REF &ref) { return ref.MC_TA_Array; }

  template <class Block, class Reference> void addCourse(const std::string &name) {
    auto ref = std::make_shared<Reference>(fresh<Reference>());
    add<Block>(name, [this, ref](auto &b, Random &r) {
      const int count = 1 + r.below(4);
      ref->Number_of_pairs = static_cast<int16_t>(count);
      // Where a turn more is another position, a shift makes another course of it.
      ref->IsAbsolute = !isRotary_ && r.chance(0.5) ? 1 : 0;
      for (int i = 0; i < count; ++i) {
        auto &point = pointsOf(*ref).v[i];
        point.delta_time = static_cast<decltype(point.delta_time)>(r.magnitude(2.3, 2.7));
        if constexpr (requires { point.position; })
          // A REAL, which has it without rounding.
          point.position = static_cast<float>(std::round(r.uniform(-5, 5) * 8) / 8 +
                                              (ref->IsAbsolute != 0 ? shift : 0));
        else if constexpr (requires { point.velocity; })
          point.velocity = r.uniform(-kVelocity, kVelocity);
        else
          point.acceleration = r.uniform(-100, 100);
      }
      b.ArraySize = static_cast<int16_t>(count);
      b.Scale = 1;
      if constexpr (requires { b.TimePosition; })
        b.TimePosition = ref.get();
      else if constexpr (requires { b.TimeVelocity; })
        b.TimeVelocity = ref.get();
      else
        b.TimeAcceleration = ref.get();
    });
    auto bind = blocks.back().draw;
    Random first(1);
    bind(first); // bound from the first call on
  }

  void addJog() {
    auto jog = std::make_shared<pl::MC_Jog>(fresh<pl::MC_Jog>());
    jog->Axis = &rig.axis;
    CommandBlock &i = blocks.emplace_back(commandBlock("Jog", jog));
    auto backward = std::make_shared<bool>(false);
    i.call = [this, jog, backward](bool press) {
      jog->JogForward = press && !*backward ? 1 : 0;
      jog->JogBackward = press && *backward ? 1 : 0;
      jog->body__(rig.ctx);
    };
    i.draw = [jog, backward](Random &r) {
      *backward = r.chance(0.5);
      jog->Velocity = kVelocity * r.magnitude(-1, 0);
      jog->Acceleration = jog->Deceleration = kAcceleration * r.magnitude(-1, 0);
    };
  }

  bool isRotary_;
  bool hasLimits_ = false;
  pl::MC_SetOverride override_ = fresh<pl::MC_SetOverride>();
  pl::MC_SetPosition setPosition_ = fresh<pl::MC_SetPosition>();
  basic::SMC_SetSoftwareLimits limits_ = fresh<basic::SMC_SetSoftwareLimits>();
  basic::SMC_SetControllerMode mode_ = fresh<basic::SMC_SetControllerMode>();
  pl::SMC_SetTorque torque_ = fresh<pl::SMC_SetTorque>();
};

class Pair {
public:
  Pair(uint64_t seed, int16_t ramp)
      : seed_(seed), random_(seed), isRotary_(random_.chance(0.5)), plain_(0.002, isRotary_, ramp),
        moved_(0.002, isRotary_, ramp) {}

  void run(int steps) {
    ASSERT_GT(plain_.rig.powerUp(), 0);
    ASSERT_GT(moved_.rig.powerUp(), 0);
    if (!isRotary_ && random_.chance(0.3)) {
      plain_.setLimits();
      moved_.setLimits();
    }
    for (int step = 0; step < steps && !::testing::Test::HasFailure(); ++step) {
      act(step);
      const int cycles = static_cast<int>(random_.magnitude(0, 2.3));
      for (int i = 0; i < cycles && !::testing::Test::HasFailure(); ++i)
        cycleOnce();
    }
  }

  [[nodiscard]] int shifts() const { return shifts_; }
  [[nodiscard]] int inMotion() const { return inMotion_; }

private:
  void log(const std::string &text) { history_ += std::to_string(cycles_) + ": " + text + "\n"; }

  void act(int step) {
    const double what = random_.uniform(0, 1);
    if (what < 0.1) {
      const double velocity = random_.chance(0.2) ? 0 : random_.uniform(0.1, 1);
      const double acceleration = random_.uniform(0.3, 1);
      plain_.setOverride(velocity, acceleration);
      moved_.setOverride(velocity, acceleration);
      log("override " + std::to_string(velocity));
      return;
    }
    if (what < 0.15) {
      const auto mode = static_cast<int16_t>(random_.chance(0.5) ? 3 : 1 + random_.below(3));
      plain_.setMode(mode, 0);
      moved_.setMode(mode, 0);
      log("mode " + std::to_string(mode));
      return;
    }
    const auto at = static_cast<size_t>(random_.below(static_cast<int>(plain_.blocks.size())));
    const bool releases = random_.chance(0.2);
    if (plain_.blocks[at].execute) {
      plain_.blocks[at].execute = moved_.blocks[at].execute = false;
      log(plain_.blocks[at].name + " released");
      if (releases)
        return;
      cycleOnce();
    }
    const uint64_t seed = seed_ * 1000 + static_cast<uint64_t>(step);
    Random one(seed);
    Random other(seed);
    plain_.blocks[at].draw(one);
    moved_.blocks[at].draw(other);
    plain_.blocks[at].execute = moved_.blocks[at].execute = isBeginning_ = true;
    log(plain_.blocks[at].name);
  }

  /// In eighths, which add up without rounding.
  double someShift() {
    if (!random_.chance(0.01))
      return 0;
    const double by = std::round(random_.uniform(-300, 300) * 8) / 8;
    ++shifts_;
    inMotion_ += moved_.rig.axis.fSetVelocity != 0 ? 1 : 0;
    log("shift by " + std::to_string(by));
    return by;
  }

  void cycleOnce() {
    // Targets are given in the positions of then.
    const double before = isBeginning_ ? 0 : someShift();
    isBeginning_ = false;
    const double after = someShift();
    plain_.cycle(0, 0);
    moved_.cycle(before, after);
    ++cycles_;
    const auto &a = plain_.rig.axis;
    const auto &b = moved_.rig.axis;
    ASSERT_EQ(a.nAxisState, b.nAxisState) << a.wFBErrorID << " " << b.wFBErrorID << "\n"
                                          << history_;
    for (size_t i = 0; i < plain_.blocks.size(); ++i) {
      const auto outputs = [](const CommandBlock &of) {
        return std::vector<int>{of.busy(), of.done(), of.aborted(), of.failed(), of.error()};
      };
      ASSERT_EQ(outputs(plain_.blocks[i]), outputs(moved_.blocks[i]))
          << plain_.blocks[i].name << "\n"
          << history_;
    }
    const auto increments =
        static_cast<int32_t>(moved_.rig.drive->status(0).position -
                             static_cast<uint32_t>(plain_.rig.drive->status(0).position));
    ASSERT_LE(std::abs(increments), 10) << history_;
    ASSERT_NEAR(a.fSetVelocity, b.fSetVelocity, 1e-4) << history_;
    double apart = b.fSetPosition - a.fSetPosition - moved_.shift;
    if (isRotary_)
      apart = stride::test::shortWay(apart, kPeriod);
    ASSERT_NEAR(apart, 0, 1e-5) << history_;
  }

  uint64_t seed_;
  Random random_;
  bool isRotary_;
  Twin plain_;
  Twin moved_;
  bool isBeginning_ = false; ///< A block gets its edge in the next cycle.
  int cycles_ = 0;
  int shifts_ = 0;
  int inMotion_ = 0;
  std::string history_;
};

class SetPosition : public ::testing::TestWithParam<int> {};

TEST_P(SetPosition, NoBlockAndNoDriveNotices) {
  int shifts = 0;
  int inMotion = 0;
#if defined(__SANITIZE_ADDRESS__)
  constexpr int kRuns = 5;
#else
  constexpr int kRuns = 20;
#endif
  for (uint64_t run = 0; run < kRuns && !HasFailure(); ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    Pair pair(run * 4099 + 3, static_cast<int16_t>(GetParam()));
    pair.run(40);
    shifts += pair.shifts();
    inMotion += pair.inMotion();
  }
  EXPECT_GE(shifts, 10 * kRuns);
  EXPECT_GE(inMotion, 3 * kRuns);
  std::cout << shifts << " shifts, " << inMotion << " in motion\n";
}

INSTANTIATE_TEST_SUITE_P(Ramps, SetPosition, ::testing::Values(0, 1, 2, 3),
                         [](const auto &info) { return "Ramp" + std::to_string(info.param); });

} // namespace
