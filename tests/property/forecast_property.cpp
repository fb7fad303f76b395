// What a forecast says comes true: random programs of commands that wait for each other, on linear
// and rotary axes, with every ramp type and overrides.
#include "runtime/axis/forecast.hpp"

#include "tests/support/kinematics.hpp"
#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_DriveBasic/SMC_GetTravelTime.h"
#include "st/SM_PLCopen/MC_Halt.h"
#include "st/SM_PLCopen/MC_MoveRelative.h"
#include "st/SM_PLCopen/MC_MoveVelocity.h"
#include "st/SM_PLCopen/MC_SetOverride.h"
#include "st/SM_PLCopen/SMC_MoveContinuousRelative.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace {

using stride::motion::Forecast;
using stride::motion::State;
using stride::test::AxisRig;
using stride::test::fresh;
namespace pl = ::st::SM_PLCopen;

class Scenario {
public:
  Scenario(uint64_t seed, int16_t ramp) : engine_(seed), rig_(0.002) {
    rotary_ = below(2) == 0;
    rig_.axis.dwRatioTechUnitsDenom = 1000000;
    if (rotary_)
      rig_.makeRotary(360);
    rig_.axis.eRampType = ramp;
    rig_.axis.fJerk = 20000;
    rig_.axis.fForecast = 0.2;
    for (auto &block : absolute_)
      block.Axis = &rig_.axis;
    for (auto &block : relative_)
      block.Axis = &rig_.axis;
    velocity_.Axis = &rig_.axis;
    continuous_.Axis = &rig_.axis;
    halt_.Axis = &rig_.axis;
    override_.Axis = &rig_.axis;
    travel_.Axis = &rig_.axis;
    travel_.Enable = 1;
  }

  void run(int rounds) {
    ASSERT_GT(rig_.powerUp(), 0);
    for (int round = 0; round < rounds && !::testing::Test::HasFailure(); ++round) {
      command();
      const int wait = below(60);
      for (int i = 0; i < wait; ++i)
        step();
      look();
    }
  }

  [[nodiscard]] int compared() const { return compared_; }
  [[nodiscard]] int unknown() const { return unknown_; }
  [[nodiscard]] int found() const { return found_; }

private:
  static constexpr int kAhead = 100;

  double uniform(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(engine_);
  }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine_); }

  template <class Block> void start(Block &block) {
    block.Acceleration = uniform(200, 5000);
    block.Deceleration = below(2) == 0 ? block.Acceleration : uniform(200, 5000);
    block.BufferMode = static_cast<int16_t>(below(6));
    rig_.call(block, false);
    pending_.push_back([this, &block] { rig_.call(block, true); });
  }

  /// One to three commands, which are given in the next cycle.
  void command() {
    if (below(4) == 0) {
      override_.Enable = 1;
      override_.VelFactor = below(8) == 0 ? 0.0 : uniform(0.2, 1);
      override_.AccFactor = uniform(0.3, 1);
      override_.JerkFactor = uniform(0.3, 1);
    }
    const int count = 1 + below(3);
    for (int i = 0; i < count; ++i) {
      switch (below(6)) {
      case 0:
      case 1: {
        auto &block = absolute_[static_cast<size_t>(below(3))];
        block.Position = uniform(-400, 400);
        block.Velocity = uniform(50, 400);
        block.Direction = static_cast<int16_t>(below(5) - 1);
        start(block);
        break;
      }
      case 2:
      case 3: {
        auto &block = relative_[static_cast<size_t>(below(2))];
        block.Distance = uniform(-100, 100);
        block.Velocity = uniform(50, 400);
        start(block);
        break;
      }
      case 4:
        velocity_.Velocity = below(5) == 0 ? 0.0 : uniform(0, 300);
        velocity_.Direction = static_cast<int16_t>(below(2) == 0 ? 1 : -1);
        start(velocity_);
        break;
      default:
        if (below(3) == 0) {
          halt_.Deceleration = uniform(200, 5000);
          rig_.call(halt_, false);
          pending_.push_back([this] { rig_.call(halt_, true); });
          break;
        }
        continuous_.Distance = uniform(-100, 100);
        continuous_.Velocity = uniform(50, 400);
        continuous_.EndVelocity = uniform(0, 50);
        continuous_.EndVelocityDirection = static_cast<int16_t>(below(2) == 0 ? 1 : 2);
        start(continuous_);
        break;
      }
    }
  }

  /// One cycle; `watch` is called before and after the blocks.
  template <class Look> void step(Look watch) {
    rig_.cycle([&] {
      watch(false);
      override_.body__(rig_.ctx);
      for (auto &block : absolute_)
        rig_.call(block, block.Execute != 0);
      for (auto &block : relative_)
        rig_.call(block, block.Execute != 0);
      rig_.call(velocity_, velocity_.Execute != 0);
      rig_.call(continuous_, continuous_.Execute != 0);
      rig_.call(halt_, halt_.Execute != 0);
      for (auto &one : pending_)
        one();
      pending_.clear();
      watch(true);
    });
  }
  void step() {
    step([](bool) {});
  }

  /// The deviation of two positions.
  double apart(double a, double b) const {
    if (!rotary_)
      return std::fabs(a - b);
    return std::fabs(stride::test::shortWay(a - b, 360));
  }

  /// Takes a forecast, then lets the axis go on and compares.
  void look() {
    if (below(2) == 0)
      step(); // settled, or in the cycle with the commands
    const bool behind = below(2) == 0 || !pending_.empty();
    std::vector<State> expected(kAhead + 1);
    std::vector<bool> known(kAhead + 1, false);
    step([&](bool late) {
      if (late != behind)
        return;
      Forecast forecast(rig_.axis);
      double jerk = 0;
      for (int k = 0; k <= kAhead; ++k)
        known[static_cast<size_t>(k)] =
            forecast.at(k * rig_.cycleSeconds, expected[static_cast<size_t>(k)], jerk);
      lookForPlace(expected, known);
    });
    ASSERT_TRUE(known[0]);
    for (int k = 1; k <= kAhead; ++k) {
      if (k > 1)
        step();
      const auto i = static_cast<size_t>(k);
      if (!known[i]) { // it depends on the order of calls: see Forecast
        ++unknown_;
        break;
      }
      const State &state = expected[i];
      ASSERT_LE(apart(state.position, rig_.axis.fSetPosition), 1e-9) << k << " behind " << behind;
      ASSERT_NEAR(state.velocity, rig_.axis.fSetVelocity, 1e-7) << k;
      // In one cycle the position does not jump, also not over the start of a turn.
      ASSERT_LE(std::fabs(state.position - expected[i - 1].position), 10.0) << k;
      ++compared_;
    }
  }

  /// SMC_GetTravelTime against the forecast's positions.
  void lookForPlace(const std::vector<State> &expected, const std::vector<bool> &known) {
    const double from = expected[0].position;
    travel_.Position = from + uniform(-10, 10);
    travel_.body__(rig_.ctx);
    ASSERT_EQ(travel_.Error, 0);
    int first = -1; // the cycle before whose end the place is passed
    for (int k = 1; k <= kAhead && first < 0; ++k) {
      const auto i = static_cast<size_t>(k);
      if (!known[i])
        break;
      const double a = expected[i - 1].position - travel_.Position;
      const double b = expected[i].position - travel_.Position;
      const bool another = rotary_ && std::floor(a / 360) != std::floor(b / 360);
      if (another || (a <= 0) != (b <= 0))
        first = k;
    }
    if (first > 0) {
      ASSERT_EQ(travel_.Valid, 1) << travel_.Position;
      ASSERT_LE(travel_.Duration, (first + 1e-6) * rig_.cycleSeconds);
    }
    if (travel_.Valid == 0)
      return;
    ++found_;
    Forecast forecast(rig_.axis);
    State there{};
    double jerk = 0;
    ASSERT_TRUE(forecast.at(travel_.Duration, there, jerk));
    ASSERT_LE(apart(there.position, travel_.Position), 1e-6) << travel_.Duration;
    if (first > 0) {
      // Earlier only where it turns back between two ends of cycles.
      const double early = (first - 1 - 1e-6) * rig_.cycleSeconds;
      if (travel_.Duration < early) {
        const auto i = static_cast<size_t>(travel_.Duration / rig_.cycleSeconds);
        ASSERT_LE(expected[i].velocity * expected[i + 1].velocity, 1e-9) << travel_.Duration;
      }
    }
  }

  std::mt19937_64 engine_;
  AxisRig rig_;
  bool rotary_ = false;
  std::vector<std::function<void()>> pending_;
  pl::MC_MoveAbsolute absolute_[3] = {fresh<pl::MC_MoveAbsolute>(), fresh<pl::MC_MoveAbsolute>(),
                                      fresh<pl::MC_MoveAbsolute>()};
  pl::MC_MoveRelative relative_[2] = {fresh<pl::MC_MoveRelative>(), fresh<pl::MC_MoveRelative>()};
  pl::MC_MoveVelocity velocity_ = fresh<pl::MC_MoveVelocity>();
  pl::SMC_MoveContinuousRelative continuous_ = fresh<pl::SMC_MoveContinuousRelative>();
  pl::MC_Halt halt_ = fresh<pl::MC_Halt>();
  pl::MC_SetOverride override_ = fresh<pl::MC_SetOverride>();
  ::st::SM_DriveBasic::SMC_GetTravelTime travel_ = fresh<::st::SM_DriveBasic::SMC_GetTravelTime>();
  int compared_ = 0;
  int unknown_ = 0;
  int found_ = 0;
};

class ForecastProperty : public ::testing::TestWithParam<int> {};

TEST_P(ForecastProperty, ComesTrue) {
  int compared = 0;
  int found = 0;
  int unknown = 0;
  for (uint64_t run = 0; run < 400 && !HasFailure(); ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    Scenario scenario(run * 104729 + 5, static_cast<int16_t>(GetParam()));
    scenario.run(20);
    compared += scenario.compared();
    found += scenario.found();
    unknown += scenario.unknown();
  }
  EXPECT_GE(compared, 600000);
  EXPECT_GE(found, 800);
  EXPECT_LE(unknown, 160) << "of 8000 forecasts";
}

INSTANTIATE_TEST_SUITE_P(Ramps, ForecastProperty, ::testing::Values(0, 1, 2, 3),
                         [](const auto &info) { return "Ramp" + std::to_string(info.param); });

} // namespace
