// Slaves of follower groups of a TSX CSY 85: where they are, against closed forms.
#include "gear_scene.hpp"
#include "motion_problems.hpp"

#include "st/CSY/CSY_CAM.h"
#include "st/CSY/CSY_CamPlace.h"
#include "st/CSY/CSY_FOLLOWER_MASTER.h"
#include "st/CSY/CSY_FOLLOWER_SLAVE.h"
#include "st/CSY/CSY_MODULE.h"
#include "st/CSY/CSY_SLAVE.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace {

using stride::Ctx;
using stride::test::casesOf;
using stride::test::fresh;
using stride::test::kGearCycle;
using stride::test::poweredAxis;
using stride::test::Random;
namespace csy = ::st::CSY;

constexpr int64_t kBudget = 1000000; ///< of iterations
constexpr int kChannel = 10;
constexpr int kCamChannel = 27;
constexpr int kGroup = 22;
enum Start { kImmediate = 0, kFalling = 1, kRising = 2, kAbove = 3, kBelow = 4 };

/// A table that closes, and what is between its points.
struct Table {
  std::vector<double> x, y;
  bool cubic = false;

  Table(Random &random, bool isCubic) : cubic(isCubic) {
    double at = random.uniform(-50, 50);
    const int points = 2 + random.below(20);
    for (int i = 0; i < points; ++i) {
      x.push_back(at);
      y.push_back(random.uniform(-30, 30));
      at += random.magnitude(-0.5, 1.2);
    }
    y.back() = y.front();
  }

  [[nodiscard]] double length() const { return x.back() - x.front(); }

  /// Slope of the line from the point before point i to the one after it.
  [[nodiscard]] double slope(size_t i) const {
    const size_t last = x.size() - 1;
    if (i == 0 || i == last) // the table goes on with its other end
      return (y[1] - y[last - 1]) / (x[1] + length() - x[last - 1]);
    return (y[i + 1] - y[i - 1]) / (x[i + 1] - x[i - 1]);
  }

  [[nodiscard]] double at(double master) const {
    const double turns = std::floor((master - x.front()) / length());
    const double place = master - turns * length();
    size_t i = 0;
    while (i + 2 < x.size() && x[i + 1] < place)
      ++i;
    const double h = x[i + 1] - x[i];
    const double t = (place - x[i]) / h;
    if (!cubic)
      return y[i] * (1 - t) + y[i + 1] * t;
    // Bernstein's form
    const double inner1 = y[i] + slope(i) * h / 3;
    const double inner2 = y[i + 1] - slope(i + 1) * h / 3;
    const double s = 1 - t;
    return y[i] * s * s * s + 3 * inner1 * s * s * t + 3 * inner2 * s * t * t +
           y[i + 1] * t * t * t;
  }
};

/// A slave, and a master that goes anywhere.
struct Scene {
  Random random;
  stride::axis::AxisRef axis = poweredAxis(0);
  csy::CSY_MODULE module = fresh<csy::CSY_MODULE>();
  csy::CSY_CAM cam = fresh<csy::CSY_CAM>();
  csy::CSY_SLAVE slave = fresh<csy::CSY_SLAVE>();
  csy::CSY_FOLLOWER_MASTER master = fresh<csy::CSY_FOLLOWER_MASTER>();
  csy::CSY_FOLLOWER_SLAVE block = fresh<csy::CSY_FOLLOWER_SLAVE>();
  Table table;
  std::vector<double> course; ///< of the master, without turns being taken away
  double period;              ///< of the master; 0: none
  double begin;               ///< where the slave was

  explicit Scene(uint64_t seed)
      : random(seed), table(random, random.chance(0.5)),
        period(random.chance(0.4) ? random.uniform(40, 400) : 0), begin(random.uniform(-100, 100)) {
    csy::CSY_AXIS_DATA &data = dataOf();
    data.bConfigured = data.bReady = 1;
    data.pAxis = &axis;
    data.fScale = random.magnitude(-2, 2);
    data.fReference = random.magnitude(-2, 2);
    data.stActive.POSITION_UNIT = 4; // of another type than the cam: it counts in the axis's unit
    axis.fSetPosition = begin * data.fScale;
    module.fCycle = kGearCycle;
    cam.pMaster = table.x.data();
    cam.pSlave = table.y.data();
    cam.diUsed = static_cast<int32_t>(table.x.size());
    cam.iInterpolation = table.cubic ? 1 : 0;
    cam.bValid = 1;
    module.apCam.v[kCamChannel - 25] = &cam;
    slave.iChannel = kChannel;
    slave.iCam = kCamChannel;
    slave.bCam = random.chance(0.5) ? 1 : 0;
    slave.bSetpoint = random.chance(0.5) ? 1 : 0;
    slave.bBiasRemains = random.chance(0.7) ? 1 : 0;
    slave.fNumerator = static_cast<float>(random.sign() * random.magnitude(-2, 2));
    slave.fDenominator = static_cast<float>(random.sign() * random.magnitude(-2, 2));
    slave.fOffset = static_cast<float>(random.uniform(-80, 80));
    slave.iStart = static_cast<int16_t>(random.below(5));
    slave.fTrigger = static_cast<float>(period > 0 ? random.uniform(0.02, 0.98) * period
                                                   : random.uniform(-60, 60));
    master.fPeriod = period;
    master.fReference = random.magnitude(-2, 2);
    master.iUnit = 4;
    wander();
    block.iGroup = kGroup;
    block.Module = &module;
    block.Slave = &slave;
    block.Master = &master;
  }

  csy::CSY_AXIS_DATA &dataOf() { return module.astAxis.v[kChannel - 1]; }
  [[nodiscard]] double scale() { return dataOf().fScale; }

  void wander() {
    const double fastest = period > 0 ? 0.3 * period : 20;
    double at = period > 0 ? random.uniform(0, 1) * period : random.uniform(-60, 60);
    double velocity = random.uniform(-1, 1) * fastest;
    for (int i = 0; i < 120; ++i) {
      course.push_back(at);
      if (random.chance(0.2))
        velocity = random.chance(0.2) ? 0.0 : random.uniform(-1, 1) * fastest;
      at += velocity;
    }
  }

  [[nodiscard]] double turned(double place) const {
    return period > 0 ? std::floor(place / period) * period : 0.0;
  }

  /// One cycle, the i-th, which leads the master from course[i - 1] to course[i].
  void step(size_t i, bool start, bool allowed) {
    // What it does not follow shows somewhere else.
    for (const int other : {0, 1}) {
      const double astray = other == slave.bSetpoint ? 0.0 : 1e6 + static_cast<double>(i);
      master.afNow.v[other] = course[i] + astray;
      master.afBefore.v[other] = course[i - 1] + astray;
      master.afTurned.v[other] = turned(course[i]) + astray;
      master.afTurnedBefore.v[other] = turned(course[i - 1]) + astray;
      master.afVelocity.v[other] = (course[i] - course[i - 1]) / kGearCycle + astray;
    }
    axis.bMovedInThisCycle = 0;
    axis.bTravelGiven = 0;
    call(start, allowed);
  }
  void call(bool start, bool allowed) {
    Ctx ctx{};
    ctx.loopBudget = kBudget;
    block.bStart = start ? 1 : 0;
    block.bAllowed = allowed ? 1 : 0;
    block.body__(ctx);
  }

  [[nodiscard]] double offset() const {
    return slave.bCam != 0 ? static_cast<double>(slave.fOffset) : 0.0;
  }
  /// Where the link alone has the slave.
  [[nodiscard]] double place(double at) {
    if (slave.bCam != 0)
      return table.at(at + offset());
    return at * master.fReference * static_cast<double>(slave.fNumerator) /
           static_cast<double>(slave.fDenominator) / dataOf().fReference;
  }

  [[nodiscard]] bool beyond(double at) const {
    const double shown = at - turned(at) + offset();
    const auto threshold = static_cast<double>(slave.fTrigger);
    return slave.iStart == kAbove ? shown >= threshold : shown <= threshold;
  }

  /// Where on the way from course[i - 1] to course[i] the link begins, if it does.
  std::optional<double> beginning(size_t i) {
    const double from = course[i - 1];
    const double to = course[i];
    if (slave.iStart == kImmediate)
      return from;
    // All thresholds and ends of turns in between, in their order.
    std::vector<double> thresholds;
    std::vector<double> places{from};
    const double first = static_cast<double>(slave.fTrigger) - offset();
    const double low = std::min(from, to);
    const double high = std::max(from, to);
    for (int turn = -100; turn <= 100; ++turn) {
      if (period == 0 && turn != 0)
        continue;
      for (const double edge : {first + turn * period, turn * period})
        if (edge > low && edge < high && (period > 0 || edge == first))
          places.push_back(edge);
      if (first + turn * period >= low && first + turn * period <= high)
        thresholds.push_back(first + turn * period);
    }
    if (slave.iStart == kRising || slave.iStart == kFalling) {
      const bool up = slave.iStart == kRising;
      std::sort(thresholds.begin(), thresholds.end());
      if (!up)
        std::reverse(thresholds.begin(), thresholds.end());
      if (up ? to > from : to < from)
        for (const double threshold : thresholds)
          if (threshold != from)
            return threshold;
      return std::nullopt;
    }
    places.push_back(to);
    std::sort(places.begin(), places.end());
    if (to < from)
      std::reverse(places.begin(), places.end());
    if (beyond(from))
      return from;
    if (!beyond(to)) // looked at once a cycle: what was only in between does not count
      return std::nullopt;
    for (size_t k = 0; k + 1 < places.size(); ++k)
      if (beyond((places[k] + places[k + 1]) / 2))
        return places[k];
    return std::nullopt;
  }
};

double sizeOf(Scene &scene, double place) {
  return 1 + std::fabs(place) + std::fabs(scene.begin) +
         std::fabs(scene.place(1) - scene.place(0)) * 1e3;
}

TEST(CsyFollowerProperty, IsWhereItWereHadItBeenLinkedAtTheCrossing) {
  int linked = 0;
  int waiting = 0;
  int starts[5] = {};
  for (int seed = 0; seed < casesOf(4000); ++seed) {
    SCOPED_TRACE(seed);
    Scene scene(static_cast<uint64_t>(seed));
    std::optional<double> bias;
    const size_t armed = 1 + static_cast<size_t>(scene.random.below(20));
    for (size_t i = 1; i < scene.course.size(); ++i) {
      scene.step(i, i == armed, true);
      ASSERT_EQ(scene.block.bFailed, 0);
      if (i >= armed && !bias)
        if (const auto begin = scene.beginning(i))
          bias = scene.slave.bBiasRemains != 0 ? scene.begin - scene.place(*begin) : 0.0;
      ASSERT_EQ(scene.block.iState, bias         ? 2
                                    : i >= armed ? 1
                                                 : 0)
          << "cycle " << i << ", start " << scene.slave.iStart << " at " << scene.slave.fTrigger
          << " from " << scene.course[i - 1] << " to " << scene.course[i] << ", offset "
          << scene.offset() << ", period " << scene.period;
      ASSERT_EQ(scene.dataOf().iLinkedBy, bias ? kGroup : 0);
      const double should = bias ? scene.place(scene.course[i]) + *bias : scene.begin;
      ASSERT_NEAR(scene.axis.fSetPosition / scene.scale(), should, 1e-9 * sizeOf(scene, should))
          << "cycle " << i;
    }
    linked += bias ? 1 : 0;
    waiting += bias ? 0 : 1;
    starts[scene.slave.iStart] += bias ? 1 : 0;
  }
  EXPECT_GT(waiting, linked / 100);
  for (const int count : starts)
    EXPECT_GT(count, linked / 10);
}

TEST(CsyFollowerProperty, OwnMovesGoOnOverTheLink) {
  for (int seed = 0; seed < casesOf(500); ++seed) {
    SCOPED_TRACE(seed);
    Scene scene(static_cast<uint64_t>(seed));
    Random &random = scene.random;
    csy::CSY_AXIS_DATA &data = scene.dataOf();
    scene.slave.iStart = kImmediate;
    const bool halt = random.chance(0.4);
    scene.slave.bHaltOnFollow = halt ? 1 : 0;
    const double velocity = random.sign() * random.uniform(5, 50);
    const double braking = random.uniform(200, 2000);
    const double way = std::fabs(velocity) * std::fabs(velocity) / (2 * braking);
    const double steady = random.uniform(0, 0.05); // time at the velocity
    const double own = std::copysign(way + std::fabs(velocity) * steady, velocity);
    data.stActive.ACCEL = data.stActive.DECEL = static_cast<float>(braking);
    const auto deceleration = static_cast<double>(data.stActive.DECEL);
    data.fSpeedScale = data.fAccelScale = data.fScale;
    data.fTarget = scene.begin + own;
    data.fSpeed = std::fabs(velocity);
    data.bMoving = 1;
    scene.axis.fSetVelocity = velocity * data.fScale;
    scene.axis.bMovedInThisCycle = 0;
    const double bias =
        scene.slave.bBiasRemains != 0 ? scene.begin - scene.place(scene.course[0]) : 0.0;
    for (size_t i = 1; i < scene.course.size(); ++i) {
      scene.step(i, i == 1, true);
      // v t, then a parabola that ends where the move ends.
      const double t = static_cast<double>(i) * kGearCycle;
      const double stop =
          halt ? std::fabs(velocity) / deceleration
               : (std::fabs(own) - velocity * velocity / (2 * deceleration)) / std::fabs(velocity) +
                     std::fabs(velocity) / deceleration;
      const double left = std::max(stop - t, 0.0);
      const double end =
          halt ? std::copysign(velocity * velocity / (2 * deceleration), velocity) : own;
      const double before = stop - std::fabs(velocity) / deceleration; // when it brakes
      const double should = t <= before
                                ? velocity * t
                                : end - std::copysign(deceleration * left * left / 2, velocity);
      ASSERT_EQ(scene.block.iState, 2);
      ASSERT_NEAR(scene.axis.fSetPosition / scene.scale(),
                  scene.place(scene.course[i]) + bias + should, 1e-9 * sizeOf(scene, 1e3))
          << "cycle " << i << " halt " << halt;
      ASSERT_EQ(data.bMoving != 0, left > 0 && !halt) << "cycle " << i;
    }
  }
}

TEST(CsyFollowerProperty, ComesToRestAfterTheLink) {
  for (int seed = 0; seed < casesOf(500); ++seed) {
    SCOPED_TRACE(seed);
    Scene scene(static_cast<uint64_t>(seed));
    csy::CSY_AXIS_DATA &data = scene.dataOf();
    scene.slave.iStart = kImmediate;
    scene.slave.bCam = 0;
    data.fSpeedScale = data.fAccelScale = data.fScale;
    const size_t last = 2 + static_cast<size_t>(scene.random.below(60));
    for (size_t i = 1; i <= last; ++i)
      scene.step(i, i == 1, true);
    const double at = scene.axis.fSetPosition / scene.scale();
    const double velocity = scene.axis.fSetVelocity / scene.scale();
    // So that it lasts some cycles and a part of one.
    const double cycles = scene.random.uniform(0.5, 60);
    const bool moves = velocity != 0;
    data.stActive.DECEL =
        moves ? static_cast<float>(std::fabs(velocity) / (cycles * kGearCycle)) : 100.0F;
    const auto deceleration = static_cast<double>(data.stActive.DECEL);
    for (int i = 1; i <= 70; ++i) {
      const bool over = scene.block.iState == 0;
      ASSERT_EQ(over, static_cast<double>(i - 1) >= (moves ? cycles : 0) + (moves ? 0 : 1))
          << i << " of " << cycles;
      if (over)
        break;
      scene.step(last + 1, false, false);
      const double left =
          std::max(std::fabs(velocity) / deceleration - static_cast<double>(i) * kGearCycle, 0.0);
      const double rest = at + std::copysign(velocity * velocity / (2 * deceleration), velocity);
      const double should = rest - std::copysign(deceleration * left * left / 2, velocity);
      ASSERT_NEAR(scene.axis.fSetPosition / scene.scale(), should, 1e-9 * sizeOf(scene, should));
    }
    EXPECT_EQ(data.iLinkedBy, 0);
    EXPECT_EQ(data.iMovedBy, 0);
    EXPECT_EQ(scene.axis.nAxisState, stride::axis::state::kStandstill);
  }
}

TEST(CsyFollowerProperty, CamsLoopAndHaveTheirSlope) {
  for (int seed = 0; seed < casesOf(2000); ++seed) {
    SCOPED_TRACE(seed);
    Scene scene(static_cast<uint64_t>(seed));
    const Table &table = scene.table;
    Ctx ctx{};
    ctx.loopBudget = kBudget;
    const auto placeAt = [&](double at, double &slope) {
      return csy::CSY_CamPlace(ctx, &scene.cam, at, slope);
    };
    for (int i = 0; i < 50; ++i) {
      double at = scene.random.uniform(table.x.front(), table.x.back());
      if (i < static_cast<int>(table.x.size()))
        at = table.x[static_cast<size_t>(i)];
      double slope = 0;
      double beside = 0;
      const double place = placeAt(at, slope);
      ASSERT_NEAR(place, table.at(at), 1e-11);
      const double turns = scene.random.sign() * std::floor(scene.random.magnitude(0, 4));
      ASSERT_NEAR(placeAt(at + turns * table.length(), beside), place, 1e-7);
      // The slope is what neighbours say, but at corners.
      constexpr double kStep = 1e-5;
      const double ahead = table.at(at + kStep);
      const double behind = table.at(at - kStep);
      const bool corner = std::any_of(table.x.begin(), table.x.end(),
                                      [&](double knot) { return std::fabs(at - knot) <= kStep; });
      if (table.cubic || !corner) {
        ASSERT_NEAR(slope, (ahead - behind) / (2 * kStep), 1e-2 * (1 + std::fabs(slope)));
      }
    }
  }
}

TEST(CsyFollowerProperty, BeginsWhereItArrivesAtTheThresholdNotWhereItLeavesIt) {
  struct Case {
    Start start;
    double period, from, to;
    bool begins;
  };
  constexpr double kTrigger = 30.5;
  const Case cases[] = {
      {kRising, 0, 30.25, 30.5, true},    {kRising, 0, 30.5, 30.75, false},
      {kRising, 0, 30.25, 30.49, false},  {kRising, 0, 30.75, 30.5, false},
      {kFalling, 0, 30.75, 30.5, true},   {kFalling, 0, 30.5, 30.25, false},
      {kFalling, 0, 30.75, 30.51, false}, {kFalling, 0, 30.25, 30.5, false},
      {kRising, 64, 94.25, 94.5, true},   {kRising, 64, 94.5, 94.75, false},
      {kFalling, 64, 94.75, 94.5, true},  {kFalling, 64, 94.5, 94.25, false},
      {kRising, 64, -33.75, -33.5, true}, {kFalling, 64, -33.5, -33.75, false},
      {kAbove, 0, 30.5, 30.25, true},     {kAbove, 0, 30.25, 30.5, true},
      {kAbove, 0, 30.25, 30.49, false},   {kBelow, 0, 30.5, 30.75, true},
      {kBelow, 0, 30.75, 30.5, true},     {kBelow, 0, 30.75, 30.51, false},
  };
  for (const Case &each : cases) {
    SCOPED_TRACE(testing::Message() << each.start << " from " << each.from << " to " << each.to);
    Scene scene(1);
    scene.slave.bCam = 0;
    scene.slave.bBiasRemains = 1;
    scene.slave.iStart = each.start;
    scene.slave.fTrigger = static_cast<float>(kTrigger);
    scene.period = scene.master.fPeriod = each.period;
    scene.course = {each.from, each.to};
    scene.step(1, true, true);
    EXPECT_EQ(scene.block.iState, each.begins ? 2 : 1);
  }
}

} // namespace
