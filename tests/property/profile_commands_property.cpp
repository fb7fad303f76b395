// Random programs of the blocks that follow courses in time (MC_PositionProfile,
// MC_VelocityProfile, MC_AccelerationProfile), keys, homing and stops among moves, on one axis with
// a drive. Whatever they ask for: one state, steady set values, every command ends once and in one
// way, and each course is where its points say at their times.
#include "tests/property/command_block.hpp"
#include "tests/support/kinematics.hpp"
#include "tests/support/random.hpp"
#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_PLCopen/MC_AccelerationProfile.h"
#include "st/SM_PLCopen/MC_Halt.h"
#include "st/SM_PLCopen/MC_HaltSuperImposed.h"
#include "st/SM_PLCopen/MC_Home.h"
#include "st/SM_PLCopen/MC_Jog.h"
#include "st/SM_PLCopen/MC_MoveRelative.h"
#include "st/SM_PLCopen/MC_MoveSuperImposed.h"
#include "st/SM_PLCopen/MC_MoveVelocity.h"
#include "st/SM_PLCopen/MC_PositionProfile.h"
#include "st/SM_PLCopen/MC_ReadStatus.h"
#include "st/SM_PLCopen/MC_SetOverride.h"
#include "st/SM_PLCopen/MC_TA_REF.h"
#include "st/SM_PLCopen/MC_TP_REF.h"
#include "st/SM_PLCopen/MC_TV_REF.h"
#include "st/SM_PLCopen/MC_TorqueControl.h"
#include "st/SM_PLCopen/MC_VelocityProfile.h"
#include "st/SM_PLCopen/SMC_MoveContinuousAbsolute.h"
#include "st/SM_PLCopen/SMC_MoveContinuousRelative.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace {

using stride::test::Asked;
using stride::test::AxisRig;
using stride::test::CommandBlock;
using stride::test::commandBlock;
using stride::test::fresh;
using stride::test::Random;
namespace state = stride::axis::state;
namespace pl = ::st::SM_PLCopen;

constexpr double kVelocity = 50;
constexpr double kAcceleration = 400;
constexpr double kJerk = 6000;
constexpr double kPeriod = 37;

enum class What : uint8_t { Position, Velocity, Acceleration };

class CoursesAndKeys {
public:
  CoursesAndKeys(uint64_t seed, int16_t ramp) : random_(seed), rig_(cycle()) {
    rig_.axis.dwRatioTechUnitsDenom = 1000000;
    rig_.axis.iRatioTechUnitsNum = 1;
    rotary_ = random_.chance(0.4);
    if (rotary_)
      rig_.makeRotary(kPeriod);
    rig_.axis.eRampType = ramp;
    rig_.axis.fJerk = kJerk;
    addCourse<pl::MC_PositionProfile, pl::MC_TP_REF>("PositionProfile");
    addCourse<pl::MC_VelocityProfile, pl::MC_TV_REF>("VelocityProfile");
    addCourse<pl::MC_AccelerationProfile, pl::MC_TA_REF>("AccelerationProfile");
    addCourse<pl::MC_PositionProfile, pl::MC_TP_REF>("PositionProfile2");
    addMoves();
    superimposed_.Axis = haltSuper_.Axis = override_.Axis = status_.Axis = &rig_.axis;
    status_.Enable = 1;
  }

  void run(int steps) {
    ASSERT_GT(rig_.powerUp(), 0);
    for (int step = 0; step < steps && !::testing::Test::HasFailure(); ++step) {
      act();
      const int cycles = static_cast<int>(random_.magnitude(0, 2.3));
      for (int i = 0; i < cycles && !::testing::Test::HasFailure(); ++i)
        cycleOnce();
    }
  }

  [[nodiscard]] int commands() const { return commands_; }
  [[nodiscard]] int ended() const { return ended_; }
  [[nodiscard]] int judged() const { return judged_; }

private:
  /// Mostly whole milliseconds, so that points of courses fall on cycles.
  double cycle() {
    constexpr double kWhole[] = {0.001, 0.002, 0.004, 0.005, 0.01};
    return random_.chance(0.6) ? kWhole[random_.below(5)] : random_.magnitude(-3.3, -1.8);
  }

  template <class Block> CommandBlock &common(const std::string &name, std::shared_ptr<Block> b) {
    b->Axis = &rig_.axis;
    return blocks_.emplace_back(commandBlock(name, std::move(b)));
  }

  template <class Block, class Draw> CommandBlock &add(const std::string &name, Draw draw) {
    auto b = std::make_shared<Block>(fresh<Block>());
    CommandBlock &i = common(name, b);
    i.call = [this, b](bool execute) { rig_.call(*b, execute); };
    i.draw = [b, draw](Random &r) { draw(*b, r); };
    return i;
  }

  template <class Block> void limit(Block &b, Random &r) {
    b.Velocity = kVelocity * r.magnitude(-1, 0);
    b.Acceleration = kAcceleration * r.magnitude(-1, 0);
    b.Deceleration = kAcceleration * r.magnitude(-1, 0);
    b.BufferMode = static_cast<int16_t>(r.chance(0.5) ? 0 : r.below(6));
  }

  void addMoves() {
    add<pl::MC_MoveAbsolute>("MoveAbsolute", [this](auto &b, Random &r) {
      b.Position = r.uniform(0, kPeriod);
      limit(b, r);
    });
    add<pl::MC_MoveRelative>("MoveRelative", [this](auto &b, Random &r) {
      b.Distance = r.uniform(-20, 20);
      limit(b, r);
    });
    add<pl::MC_MoveVelocity>("MoveVelocity", [this](auto &b, Random &r) {
      limit(b, r);
      b.Direction = static_cast<int16_t>(r.chance(0.5) ? 1 : -1);
    });
    add<pl::SMC_MoveContinuousAbsolute>("ContinuousAbsolute", [this](auto &b, Random &r) {
      b.Position = r.uniform(0, kPeriod);
      limit(b, r);
      b.EndVelocity = r.chance(0.2) ? 0 : r.uniform(0, b.Velocity);
      b.EndVelocityDirection = static_cast<int16_t>(r.chance(0.5) ? 1 : -1);
    });
    add<pl::SMC_MoveContinuousRelative>("ContinuousRelative", [this](auto &b, Random &r) {
      b.Distance = r.uniform(-20, 20);
      limit(b, r);
      b.EndVelocity = r.chance(0.2) ? 0 : r.uniform(0, b.Velocity);
      b.EndVelocityDirection = static_cast<int16_t>(r.chance(0.5) ? 1 : -1);
    });
    add<pl::MC_Halt>(
        "Halt", [](auto &b, Random &r) { b.Deceleration = kAcceleration * r.magnitude(-1, 0); });
    add<pl::MC_Stop>(
        "Stop", [](auto &b, Random &r) { b.Deceleration = kAcceleration * r.magnitude(-1, 0); });
    add<pl::MC_Home>("Home", [](auto &b, Random &r) {
      b.Position = r.uniform(0, kPeriod);
      b.Deceleration = kAcceleration;
    });
    add<pl::MC_TorqueControl>("TorqueControl",
                              [](auto &b, Random &r) { b.Torque = r.uniform(-1, 1); });
    auto jog = std::make_shared<pl::MC_Jog>(fresh<pl::MC_Jog>());
    CommandBlock &i = common("Jog", jog);
    auto backward = std::make_shared<bool>(false);
    i.call = [this, jog, backward](bool press) {
      jog->JogForward = press && !*backward ? 1 : 0;
      jog->JogBackward = press && *backward ? 1 : 0;
      jog->body__(rig_.ctx);
    };
    i.draw = [jog, backward](Random &r) {
      *backward = r.chance(0.5);
      jog->Velocity = kVelocity * r.magnitude(-1, 0);
      jog->Acceleration = jog->Deceleration = kAcceleration * r.magnitude(-1, 0);
    };
  }

  static auto &pointsOf(pl::MC_TP_REF &ref) { return ref.MC_TP_Array; }
  static auto &pointsOf(pl::MC_TV_REF &ref) { return ref.MC_TV_Array; }
  static auto &pointsOf(pl::MC_TA_REF &ref) { return ref.MC_TA_Array; }
  template <class Point> static double &valueOf(Point &point) {
    if constexpr (requires { point.position; })
      return point.position;
    else if constexpr (requires { point.velocity; })
      return point.velocity;
    else
      return point.acceleration;
  }

  /// Points some hundred milliseconds apart, of values that the axis could follow.
  template <class Reference> void drawPoints(Reference &ref, int count, double size, Random &r) {
    ref.Number_of_pairs = static_cast<int16_t>(r.chance(0.5) ? 0 : count);
    ref.IsAbsolute = r.chance(0.5) ? 1 : 0;
    double time = 0;
    for (int i = 0; i < count; ++i) {
      auto &point = pointsOf(ref).v[i];
      constexpr bool isPosition = requires { point.position; };
      // A place that asks for another velocity at once would be overshot far.
      point.delta_time = static_cast<decltype(point.delta_time)>(
          r.magnitude(isPosition && i == 0 ? 2.3 : 1.3, 2.7));
      time += static_cast<double>(point.delta_time) / 1000;
      valueOf(point) = r.uniform(-size, size);
      if constexpr (isPosition)
        valueOf(point) +=
            rig_.axis.fSetVelocity * time + (ref.IsAbsolute != 0 ? rig_.axis.fSetPosition : 0.0);
    }
    if (r.chance(0.3) && !(requires { pointsOf(ref).v[0].position; }))
      valueOf(pointsOf(ref).v[count - 1]) = 0;
  }

  template <class Block, class Reference> void addCourse(const std::string &name) {
    auto b = std::make_shared<Block>(fresh<Block>());
    auto ref = std::make_shared<Reference>(fresh<Reference>());
    CommandBlock &i = common(name, b);
    i.asked = std::make_shared<Asked>();
    auto asked = i.asked;
    constexpr What kWhat = requires { b->TimePosition; }
    ? What::Position : requires { b->TimeVelocity; }
    ? What::Velocity : What::Acceleration;
    i.call = [this, b, ref, asked](bool execute) {
      if constexpr (requires { b->TimePosition; })
        b->TimePosition = ref.get();
      else if constexpr (requires { b->TimeVelocity; })
        b->TimeVelocity = ref.get();
      else
        b->TimeAcceleration = ref.get();
      if (asked->fresh && execute)
        begin(*asked, ref->IsAbsolute == 0, kWhat);
      rig_.call(*b, execute);
    };
    i.draw = [this, b, ref, asked](Random &r) {
      const int count = 1 + r.below(6);
      constexpr bool isPosition = requires { b->TimePosition; };
      constexpr bool isVelocity = requires { b->TimeVelocity; };
      drawPoints(*ref, count, isPosition ? 5 : isVelocity ? kVelocity : kAcceleration / 4, r);
      b->ArraySize = static_cast<int16_t>(count);
      b->Scale = r.chance(0.5) ? 1 : r.uniform(-1, 1);
      b->Offset = r.chance(0.5) ? 0 : r.uniform(-1, 1);
      asked->times.clear();
      asked->values.clear();
      asked->fresh = true;
      double time = 0;
      for (int k = 0; k < count; ++k) {
        auto &point = pointsOf(*ref).v[k];
        time += static_cast<double>(point.delta_time) / 1000;
        asked->times.push_back(time);
        asked->values.push_back(valueOf(point) * b->Scale + b->Offset);
      }
    };
    i.steepest = [b] {
      double most = 0;
      const auto &course = b->stCourse;
      for (int k = 0; k < course.uiCount; ++k) {
        const auto &piece = course.aPiece.v[k];
        const double end =
            k + 1 < course.uiCount ? course.aPiece.v[k + 1].fStart : course.fDuration;
        most = std::max({most, std::fabs(piece.fAcceleration),
                         std::fabs(piece.fAcceleration + piece.fJerk * (end - piece.fStart))});
      }
      return most;
    };
    i.judge = [this](const Asked &of) { return offCourse<Block>(of); };
  }

  /// At the edge: what the values are relative to, and when time begins. If a block has moved the
  /// axis in this cycle, the course begins there, a cycle later.
  void begin(Asked &asked, bool relative, What what) {
    const auto &axis = rig_.axis;
    const double base = !relative                ? 0
                        : what == What::Position ? axis.fSetPosition
                        : what == What::Velocity ? axis.fSetVelocity
                                                 : axis.fSetAcceleration;
    for (double &value : asked.values)
      value += base;
    for (double &time : asked.times)
      time += axis.bMovedInThisCycle != 0 ? rig_.cycleSeconds : 0;
    asked.fresh = false;
    if (axis.stSuperimposed.ulOwner != 0)
      asked.times.clear(); // what is added goes on for the rest of the cycle
  }

  /// How far the axis is from the point whose time is now; 0 between points.
  template <class Block> double offCourse(const Asked &of) {
    for (size_t k = 0; k < of.times.size(); ++k)
      if (std::fabs(of.times[k] - judgedAge_) < 1e-9) {
        ++judged_;
        const auto &axis = rig_.axis;
        if constexpr (requires(Block & b) { b.TimePosition; }) {
          const double off = axis.fSetPosition - of.values[k];
          return rotary_ ? stride::test::shortWay(off, kPeriod) : off;
        } else if constexpr (requires(Block & b) { b.TimeVelocity; }) {
          return axis.fSetVelocity - of.values[k];
        } else {
          return k + 1 < of.times.size() ? axis.fSetAcceleration - of.values[k] : 0.0;
        }
      }
    return 0;
  }

  void log(const std::string &text) { history_ += std::to_string(cycles_) + ": " + text + "\n"; }

  bool superimpose() {
    const double what = random_.uniform(0, 1);
    if (what < 0.1) {
      override_.Enable = 1;
      override_.VelFactor = random_.chance(0.2) ? 0 : random_.uniform(0.1, 1);
      override_.AccFactor = override_.JerkFactor = 1;
      log("override " + std::to_string(override_.VelFactor));
      return true;
    }
    if (what < 0.2) {
      superExecute_ = haltExecute_ = false;
      cycleOnce();
      superimposed_.Distance = random_.uniform(-5, 5);
      superimposed_.VelocityDiff = kVelocity * random_.magnitude(-1, 0);
      superimposed_.Acceleration = superimposed_.Deceleration = kAcceleration;
      superExecute_ = true;
      log("superimpose");
      return true;
    }
    if (what < 0.25) {
      haltExecute_ = false;
      cycleOnce();
      haltSuper_.Deceleration = kAcceleration * random_.magnitude(-1, 0);
      haltExecute_ = true;
      log("halt superimposed");
      return true;
    }
    return false;
  }

  /// One event.
  void act() {
    if (superimpose())
      return;
    const bool isFast = std::fabs(rig_.axis.fSetVelocity) > 3 * kVelocity;
    auto &block =
        isFast ? blocks_[halt_]
               : blocks_[static_cast<size_t>(random_.below(static_cast<int>(blocks_.size())))];
    if (block.execute && random_.chance(0.4)) {
      block.execute = false; // the command goes on, or a stop and a key let go
      log(block.name + " released");
      return;
    }
    if (block.execute) {
      block.execute = false;
      cycleOnce();
    }
    block.draw(random_);
    block.execute = true;
    block.age = 0;
    ++commands_;
    log(block.name + (block.mode ? " mode " + std::to_string(block.mode()) : std::string()));
  }

  void cycleOnce() {
    auto &axis = rig_.axis;
    const double s0 = axis.fSetPosition;
    const double v0 = axis.fSetVelocity;
    const double a0 = axis.fSetAcceleration;
    const int16_t state0 = axis.nAxisState;
    rig_.cycle([&] {
      override_.body__(rig_.ctx);
      for (auto &block : blocks_) {
        block.wasBusy = block.busy();
        block.call(block.execute);
        block.age += rig_.cycleSeconds;
      }
      rig_.call(superimposed_, superExecute_);
      rig_.call(haltSuper_, haltExecute_);
      status_.body__(rig_.ctx);
    });
    ++cycles_;
    judgeStates();
    if (::testing::Test::HasFailure())
      return;
    for (auto &block : blocks_)
      judgeBlock(block);
    if (state0 != state::kHoming && axis.nAxisState != state::kHoming)
      judgeMotion(s0, v0, a0);
  }

  void judgeStates() {
    auto &axis = rig_.axis;
    ASSERT_EQ(status_.Errorstop + status_.Stopping + status_.StandStill + status_.DiscreteMotion +
                  status_.ContinuousMotion + status_.SynchronizedMotion + status_.Homing,
              1)
        << history_;
    ASSERT_EQ(status_.StandStill != 0, axis.iOwner == 0) << "who moves owns\n" << history_;
    ASSERT_NE(axis.nAxisState, state::kErrorStop) << axis.wFBErrorID << "\n" << history_;
  }

  void judgeBlock(CommandBlock &block) {
    const int outcomes =
        (block.done() ? 1 : 0) + (block.aborted() ? 1 : 0) + (block.failed() ? 1 : 0);
    ASSERT_LE(outcomes, 1) << block.name << "\n" << history_;
    ASSERT_EQ(block.failed(), block.error() != 0) << block.name << "\n" << history_;
    if (block.failed()) {
      const int error = block.error();
      const std::vector<int> known = {34, 75, 170, 171, 184};
      ASSERT_TRUE(std::count(known.begin(), known.end(), error) > 0)
          << block.name << " error " << error << "\n"
          << history_;
    }
    const bool isKey = block.name == "Jog";
    if (block.wasBusy && !block.busy()) {
      ASSERT_TRUE(outcomes == 1 || isKey) << block.name << "\n" << history_;
      ++ended_;
    }
    if (block.asked && block.busy() && block.wasBusy) {
      if (superimposed_.Busy != 0 || haltSuper_.Busy != 0)
        block.asked->times.clear(); // something has been added to the course
      judgedAge_ = block.age;
      ASSERT_NEAR(block.judge(*block.asked), 0.0, 1e-6) << block.name << "\n" << history_;
    }
  }

  void judgeMotion(double s0, double v0, double a0) {
    auto &axis = rig_.axis;
    const double T = rig_.cycleSeconds;
    // A superimposed motion adds its own; a sine in the manual's flavour exceeds its acceleration.
    const double own = (axis.eRampType == 1 ? 1.5708 : 1.0) * kAcceleration;
    double steep = own;
    for (const auto &block : blocks_)
      steep = std::max(steep, block.steepest());
    steep += own;
    const double v1 = axis.fSetVelocity;
    const double a1 = axis.fSetAcceleration;
    steep = std::max(steep, std::fabs(a0)) * (1 + 1e-9);
    ASSERT_LE(std::fabs(a1), steep) << "acceleration\n" << history_;
    ASSERT_LE(std::fabs(v1 - v0), steep * T + 1e-9) << "velocity jumps\n" << history_;
    const double expected = 0.5 * (v0 + v1) * T;
    double way = axis.fSetPosition - s0;
    if (rotary_)
      way = expected + stride::test::shortWay(way - expected, kPeriod);
    ASSERT_LE(std::fabs(way - expected), 0.5 * steep * T * T + 1e-8) << "position jumps\n"
                                                                     << history_;
  }

  Random random_;
  AxisRig rig_;
  bool rotary_ = false;
  std::vector<CommandBlock> blocks_;
  pl::MC_SetOverride override_ = fresh<pl::MC_SetOverride>();
  pl::MC_ReadStatus status_ = fresh<pl::MC_ReadStatus>();
  pl::MC_MoveSuperImposed superimposed_ = fresh<pl::MC_MoveSuperImposed>();
  pl::MC_HaltSuperImposed haltSuper_ = fresh<pl::MC_HaltSuperImposed>();
  bool superExecute_ = false, haltExecute_ = false;
  size_t halt_ = 0;
  double judgedAge_ = 0;
  int cycles_ = 0, commands_ = 0, ended_ = 0, judged_ = 0;
  std::string history_;
};

class ProfileCommands : public ::testing::TestWithParam<int> {};

TEST_P(ProfileCommands, AnyProgramMovesSteadily) {
  int commands = 0;
  int ended = 0;
  int judged = 0;
#if defined(__SANITIZE_ADDRESS__)
  constexpr int kRuns = 50;
#else
  constexpr int kRuns = 300;
#endif
  for (uint64_t run = 0; run < kRuns && !HasFailure(); ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    CoursesAndKeys scenario(run * 6007 + 5, static_cast<int16_t>(GetParam()));
    scenario.run(40);
    commands += scenario.commands();
    ended += scenario.ended();
    judged += scenario.judged();
  }
  EXPECT_GE(commands, 15 * kRuns);
  EXPECT_GE(ended, 3 * kRuns);
  EXPECT_GE(judged, kRuns / 10);
  std::cout << commands << " commands, " << ended << " ended, " << judged << " points\n";
}

INSTANTIATE_TEST_SUITE_P(Ramps, ProfileCommands, ::testing::Values(0, 1, 2, 3),
                         [](const auto &info) { return "Ramp" + std::to_string(info.param); });

} // namespace
