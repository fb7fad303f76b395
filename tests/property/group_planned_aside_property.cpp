// One axis of a group that is planned in another task: when stops and overrides act, and what
// happens when nobody plans.
#include "group_tasks.hpp"

#include "runtime/numeric/group/trigger.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace {

using namespace stride::group;
using namespace stride::test;

/// A way of one axis at speed: 3 axes with known limits.
class LongWay {
public:
  explicit LongWay(double length = 5000)
      : machine_(gantry()), tasks_(longMotion(length), machine_, kCycle) {}

  static constexpr double kCycle = 0.001;
  static constexpr double kSpeed = 200;

  GroupMotion &group() { return tasks_.group(); }
  double speed() { return std::fabs(group().velocity[0]); }

  /// Drives for so many cycles; the other task plans in every 10th of them, or not at all.
  void drive(int cycles, bool plans, bool stop = false, bool atOnce = false) {
    for (int n = 0; n < cycles; ++n, ++now_) {
      const GroupCommand command = tasks_.command(override_, stop, keep_, atOnce, allowance_);
      tasks_.follow(command);
      tasks_.goOnAndPost(command);
      if (plans && now_ % 10 == 0 && tasks_.takeJob()) {
        tasks_.doJob(10 * kCycle);
        tasks_.answerJob();
      }
    }
  }

  static constexpr double kKeep = 0.3;
  void changePlanner() { tasks_.changePlanner(); }
  void set(double override, double keep, const Allowance &allowance = kAllAllowed) {
    override_ = override;
    keep_ = keep;
    allowance_ = allowance;
  }
  /// For how many cycles it goes on as fast as it did.
  int cyclesToAct() {
    const double speed = this->speed();
    int cycles = 0;
    while (cycles < 1000 && std::fabs(this->speed() - speed) < 1e-9) {
      drive(1, true);
      ++cycles;
    }
    return cycles;
  }

private:
  std::unique_ptr<GroupMotion> longMotion(double length) {
    for (AxisLimits &limits : machine_.limits)
      limits = {kSpeed, 2000, 40'000, -1e6, 1e6};
    const double to[kAxes] = {length};
    double perTime[kAxes];
    std::fill(std::begin(perTime), std::end(perTime), kSpeed);
    auto group = std::make_unique<GroupMotion>();
    reset(*group, machine_.home);
    Order order{};
    order.velocityFactor = order.accelerationFactor = order.jerkFactor = 1;
    append(*group, drawId(*group), axesLeg(machine_.home, to, perTime, kSpeed), order);
    return group;
  }

  Machine machine_;
  Tasks tasks_;
  double override_ = 1;
  double keep_ = kKeep;
  Allowance allowance_ = kAllAllowed;
  int now_ = 0;
};

/// What stops at once rests after the shortest time, though nobody plans any more; what does not
/// goes on for as long as has been promised.
TEST(GroupPlanning, StopsAtOnceWhoeverPlans) {
  constexpr int kRamp = 150; // 200 / 2000 + 2000 / 40000 s
  LongWay once;
  once.drive(2000, true);
  ASSERT_NEAR(once.speed(), LongWay::kSpeed, 1e-6);
  once.drive(5, false, true, true);
  EXPECT_LT(once.speed(), LongWay::kSpeed - 1e-3);
  once.drive(kRamp + kRamp / 10, false, true, true);
  EXPECT_EQ(once.speed(), 0);
  EXPECT_TRUE(isAtRest(once.group()));

  LongWay late;
  late.drive(2000, true);
  late.drive(280, true, true, false);
  EXPECT_NEAR(late.speed(), LongWay::kSpeed, 1e-6);
  late.drive(60 + kRamp + kRamp / 10, true, true, false);
  EXPECT_EQ(late.speed(), 0);
}

/// It does not wait for a plan of a task that does not plan for it any more.
TEST(GroupPlanning, BeginsThoughWhoWasAtItIsGone) {
  LongWay way(2); // which takes less than what is kept
  way.drive(1, false);
  way.group().awaits = true; // as after an answer that says that more comes
  way.changePlanner();
  way.drive(300, false);
  EXPECT_EQ(outcomeOf(way.group(), 1), Outcome::Done);
}

/// Where nobody plans any more it rests on its path, with what has been promised kept until then,
/// and goes on when somebody does.
TEST(GroupPlanning, WaitsOnItsPathUntilSomebodyPlans) {
  LongWay way;
  way.drive(2000, true);
  EXPECT_GE(plannedTime(way.group()), LongWay::kKeep - 0.02);
  way.drive(static_cast<int>(1000 * LongWay::kKeep) - 20, false);
  EXPECT_NEAR(way.speed(), LongWay::kSpeed, 1e-6);
  way.drive(20'000, false);
  EXPECT_EQ(way.speed(), 0);
  EXPECT_LT(way.group().axes[0], 4000);
  EXPECT_EQ(outcomeOf(way.group(), 1), Outcome::Active);
  way.drive(200'000 / 8, true);
  EXPECT_EQ(outcomeOf(way.group(), 1), Outcome::Done);
  EXPECT_NEAR(way.group().axes[0], 5000, 1e-9);
}

/// Overrides act as soon as they do without a planning task, to the cycle.
TEST(GroupPlanning, OverridesActAsWithoutIt) {
  for (const double keep : {0.0, 0.1, 0.3})
    for (const double override : {0.9, 0.5, 0.1, 0.0}) {
      SCOPED_TRACE(testing::Message() << "override " << override << ", forecast " << keep);
      LongWay aside;
      LongWay own;
      own.changePlanner();
      int cycles[2] = {};
      for (LongWay *way : {&own, &aside}) {
        way->set(1, keep);
        way->drive(2003, true);
        ASSERT_NEAR(way->speed(), LongWay::kSpeed, 1e-6);
        way->set(override, keep);
        cycles[way == &aside ? 1 : 0] = way->cyclesToAct();
        way->drive(400, true);
        EXPECT_NEAR(way->speed(), override * LongWay::kSpeed, 1e-6);
        way->set(0.7, keep);
        way->drive(1000, true);
        EXPECT_NEAR(way->speed(), 0.7 * LongWay::kSpeed, 1e-6);
      }
      EXPECT_EQ(cycles[1], cycles[0]);
      EXPECT_LE(cycles[1], 1000 * keep + (override > 0 ? 35 : 1) + 1);
    }
}

/// An override that a program changes in every cycle: up and down with random slopes, at times with
/// jumps.
class Slider {
public:
  explicit Slider(unsigned seed) : random_(seed), jumps_(seed % 2 == 0) {}

  double next() {
    if (random_.chance(0.01))
      slope_ = random_.uniform(-1.5, 1.5) * LongWay::kCycle; // the axis can follow 10 / s
    value_ += slope_;
    if (value_ < 0.2 || value_ > 1)
      slope_ = -slope_;
    if (jumps_ && random_.chance(0.002))
      value_ = random_.uniform(0.2, 1);
    value_ = std::clamp(value_, 0.2, 1.0);
    return value_ + random_.uniform(-1, 1) * 1e-6; // never the same twice
  }

private:
  Random random_;
  bool jumps_;
  double value_ = 1;
  double slope_ = 0;
};

/// The velocity is one that the override has asked for within a known time before: that of two
/// plans, each of which begins after the forecast, and of a ramp.
TEST(GroupPlanning, FollowsAnOverrideThatChangesInEveryCycle) {
  for (int i = 0; i < wanted(24); ++i) {
    const bool aside = i % 3 != 0;
    const double keep = i % 4 == 0 ? 0.1 : 0.0;
    SCOPED_TRACE(testing::Message() << "case " << i << ", forecast " << keep);
    const int late = static_cast<int>(2000 * keep) + 300;
    LongWay way(50'000);
    if (!aside)
      way.changePlanner();
    way.set(1, keep);
    way.drive(2003, true);
    Slider slider(static_cast<unsigned>(i));
    std::vector<double> asked(static_cast<size_t>(late), 1.0);
    constexpr double kMore = 0.005; // of all; ramps are not planned with the last bit of it
    int outside = 0;
    double least = 1;
    for (int n = 0; n < 20'000; ++n) {
      const double override = slider.next();
      asked.push_back(override);
      way.set(override, keep);
      way.drive(1, true);
      const auto window = std::minmax_element(asked.end() - late, asked.end());
      const double now = way.speed() / LongWay::kSpeed;
      outside += now < *window.first - kMore || now > *window.second + kMore ? 1 : 0;
      least = std::min(least, now);
    }
    EXPECT_EQ(outside, 0);
    EXPECT_LT(least, 0.6); // it is not that nothing changes
  }
}

} // namespace
