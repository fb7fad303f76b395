// How long movements of a group take, and that those that come in time are blended.
#include "group_problems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace {

using namespace stride::group;
using namespace stride::test;

/// The shortest time from rest to rest with limits of velocity, acceleration and jerk.
double shortestTime(double length, double v, double a, double j) {
  const auto ramp = [a, j](double speed) {
    return speed >= a * a / j ? speed / a + a / j : 2 * std::sqrt(speed / j);
  };
  if (v * ramp(v) <= length)
    return 2 * ramp(v) + (length - v * ramp(v)) / v;
  double low = 0;
  double high = v;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (middle * ramp(middle) <= length ? low : high) = middle;
  }
  return 2 * ramp(low);
}

/// A movement of the axes takes as long as it must when all go together.
TEST(GroupMotion, MovesAxesInTheShortestTime) {
  constexpr double kCycle = 0.001;
  for (int i = 0; i < casesOf(200) && !HasFailure(); ++i) {
    Random random(5000U + static_cast<unsigned>(i));
    const Machine machine = randomMachine(random);
    double to[kAxes] = {};
    double perTime[kAxes];
    double v = INFINITY;
    double a = INFINITY;
    double j = INFINITY;
    for (int k = 0; k < kAxes; ++k) {
      perTime[k] = machine.limits[k].velocity;
      if (!isOfMachine(machine, k))
        continue;
      to[k] = machine.home[k] + random.uniform(-1, 1) * random.magnitude(-2, 2.5);
      const double far = std::fabs(to[k] - machine.home[k]);
      v = std::min(v, machine.limits[k].velocity / far);
      a = std::min(a, machine.limits[k].acceleration / far);
      j = std::min(j, machine.limits[k].jerk / far);
    }
    auto group = std::make_unique<GroupMotion>();
    reset(*group, machine.home);
    Order order{};
    order.velocityFactor = order.accelerationFactor = order.jerkFactor = 1;
    append(*group, drawId(*group), axesLeg(machine.home, to, perTime, 100), order);
    const Arm arm = machine.arm();
    int64_t cycles = 0;
    while (group->first < group->next && cycles < 1'000'000) {
      cycle(*group, arm, {kCycle, 1, false, 0, 64, 64});
      ++cycles;
    }
    const double time = shortestTime(1, v, a, j);
    const double taken = static_cast<double>(cycles) * kCycle;
    EXPECT_GE(taken, time) << "case " << i;
    // The end of a long one is planned later, so that a corner is still possible.
    EXPECT_LE(taken, (time < 0.3 ? 1 : 1.03) * time + 3 * kCycle) << "case " << i;
  }
}

/// However short for their velocity lines are that come one by one, three of them ahead, each is
/// blended with the next one: the end of the last that is known is not decided before it has to be.
TEST(GroupMotion, ShortLinesThatComeInTimeAreBlended) {
  for (const double length : {40.0, 73.0, 200.0}) {
    Machine machine = gantry();
    for (AxisLimits &limits : machine.limits)
      limits = {300, 3000, 60000, -1e4, 1e4};
    const auto group = std::make_unique<GroupMotion>();
    reset(*group, machine.home);
    Pose last{};
    stride::group::setRows(last.turn, Matrix<double>::Identity());
    uint64_t seen = 0;
    for (int n = 0; n < 6000; ++n) {
      while (group->next - group->first < 4) {
        Pose to = last;
        const double angle = 1.3 * static_cast<double>(group->next);
        to.place = last.place + Vector3{length * std::cos(angle), length * std::sin(angle), 0};
        Order order{};
        order.path = {400, 4000, 4000, 80000};
        order.velocityFactor = order.accelerationFactor = order.jerkFactor = 1;
        order.transition = Transition::Distance;
        order.transitionValue = 0.2 * length;
        append(*group, drawId(*group), lineLeg(last, to, {}), order);
        last = to;
      }
      cycle(*group, machine.arm(), {0.001, 1, false, 0, 64, 24});
      const Movement *const active = activeOf(*group);
      if (active == nullptr || active->id == seen)
        continue;
      seen = active->id;
      EXPECT_TRUE(seen == 1 || active->corner.length > 0) << "line " << seen << " of " << length;
    }
    EXPECT_GT(seen, 8U) << length;
  }
}

} // namespace
