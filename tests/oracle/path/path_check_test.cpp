// The judge of motions: what keeps its limits passes, what exceeds one of them by 0.1 % does not.
#include "tests/oracle/path/path_check.hpp"

#include "tests/oracle/path/s_curve.hpp"
#include "tests/support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace {

using namespace stride::oracle;
using stride::test::Random;

constexpr double kVelocity = 40;
constexpr double kAcceleration = 700;
constexpr double kJerk = 30000;
constexpr double kRadius = 5;

/// A line along X, a quarter of an arc, a line along Y, tangential to each other.
PathChain corner() {
  PathChain chain({3, 2});
  chain.addLine({23, 2});
  chain.addArc({28, 7}, {23, 7, 0}, {0, 0, 1});
  chain.addLine({28, 19});
  return chain;
}

/// From rest to rest along a chain, 16 samples per millisecond.
std::vector<Sample> motionAlong(const PathChain &chain, double velocity, double acceleration,
                                double jerk) {
  std::vector<Phase> phases = changePhases(0, 0, velocity, acceleration, jerk);
  const double ramp = changeWay(0, velocity, acceleration, jerk);
  const double even = (chain.length() - 2 * ramp) / velocity;
  phases.push_back({even, 0, ramp, velocity, 0});
  for (const Phase &phase : changePhases(chain.length() - ramp, velocity, 0, acceleration, jerk))
    phases.push_back(phase);
  std::vector<Sample> samples;
  double start = 0;
  size_t at = 0;
  for (size_t i = 0; at < phases.size(); ++i) {
    const double time = static_cast<double>(i) / 16000.0;
    while (at < phases.size() && time > start + phases[at].duration)
      start += phases[at++].duration;
    if (at == phases.size())
      break;
    const double way = after(phases[at], time - start).way;
    samples.push_back({time, way, chain.at(way)});
  }
  samples.push_back({start, chain.length(), chain.end()});
  return samples;
}

MotionLimits limitsOfCorner() {
  MotionLimits limits;
  limits.velocity = kVelocity;
  limits.acceleration = limits.deceleration = kAcceleration;
  limits.jerk = kJerk;
  limits.axisVelocity.fill(kVelocity);
  limits.axisAcceleration.fill(kAcceleration);
  limits.tolerance = 1e-6;
  return limits;
}

TEST(PathCheck, PassesWhatKeepsItsLimits) {
  const PathChain chain = corner();
  const MotionReport report =
      checkMotion(motionAlong(chain, kVelocity, kAcceleration, kJerk), limitsOfCorner(), &chain);
  EXPECT_TRUE(report.within(1e-9)) << report.text();
  EXPECT_TRUE(report.exactEnd);
  EXPECT_LT(report.distance.value, 1e-13);
  for (const Worst *worst : {&report.velocity, &report.acceleration, &report.deceleration,
                             &report.pathVelocity, &report.axisVelocity, &report.axisAcceleration})
    EXPECT_GT(worst->use, 1 - 1e-6) << report.text();
  EXPECT_GT(report.jerk.use, 1 - 1e-5) << report.text();
}

/// Each limit in turn 0.1 % lower than what the motion needs: that one fails, and says where.
TEST(PathCheck, FindsEachLimitThatIsExceeded) {
  const PathChain chain = corner();
  const std::vector<Sample> samples = motionAlong(chain, kVelocity, kAcceleration, kJerk);
  const double end = samples.back().time;
  const auto failed = [&](double MotionLimits::*limit, Worst MotionReport::*worst) {
    MotionLimits limits = limitsOfCorner();
    limits.*limit /= 1.001;
    const MotionReport report = checkMotion(samples, limits, &chain);
    EXPECT_FALSE(report.within());
    EXPECT_NEAR((report.*worst).use, 1.001, 2e-5) << report.text();
    return report.*worst;
  };
  EXPECT_GT(failed(&MotionLimits::velocity, &MotionReport::velocity).time, 0.07);
  failed(&MotionLimits::velocity, &MotionReport::pathVelocity);
  EXPECT_LT(failed(&MotionLimits::acceleration, &MotionReport::acceleration).time, 0.1);
  EXPECT_GT(failed(&MotionLimits::deceleration, &MotionReport::deceleration).time, end - 0.1);
  EXPECT_NEAR(failed(&MotionLimits::jerk, &MotionReport::jerk).value, kJerk, kJerk * 1e-4);
  EXPECT_LT(failed(&MotionLimits::acceleration, &MotionReport::acceleration).value,
            kAcceleration * 1.000001);
}

TEST(PathCheck, NamesTheAxisThatExceedsItsLimit) {
  const PathChain chain = corner();
  const std::vector<Sample> samples = motionAlong(chain, kVelocity, kAcceleration, kJerk);
  MotionLimits limits = limitsOfCorner();
  limits.axisVelocity[0] /= 1.001;
  MotionReport report = checkMotion(samples, limits, &chain);
  EXPECT_FALSE(report.within());
  EXPECT_NEAR(report.axisVelocity.use, 1.001, 1e-6);
  EXPECT_EQ(report.axisVelocity.axis, 0U);
  // On the arc, v^2 / r = 320; along the lines up to 700.
  limits = limitsOfCorner();
  limits.axisAcceleration[1] = kAcceleration / 1.001; // of Y, at the end only
  report = checkMotion(samples, limits, &chain);
  EXPECT_FALSE(report.within());
  EXPECT_EQ(report.axisAcceleration.axis, 1U);
  EXPECT_GT(report.axisAcceleration.time, samples.back().time - 0.1);
  EXPECT_EQ(report.axisAcceleration.sample,
            static_cast<size_t>(std::lround(report.axisAcceleration.time * 16000)));
}

/// Centripetal acceleration: a full circle at even velocity, v^2 / r = 320.
TEST(PathCheck, SeesTheAccelerationOfACurve) {
  PathChain circle({kRadius, 0});
  circle.addArc({kRadius, 0}, {0, 0, 0}, {0, 0, 1});
  std::vector<Sample> samples;
  for (size_t i = 0; i < 12000; ++i) {
    const double time = static_cast<double>(i) / 16000;
    samples.push_back({time, kVelocity * time, circle.at(kVelocity * time)});
  }
  MotionLimits limits;
  limits.axisAcceleration.fill(320);
  EXPECT_TRUE(checkMotion(samples, limits).within(1e-9));
  EXPECT_NEAR(checkMotion(samples, limits).axisAcceleration.use, 1, 1e-5);
  limits.axisAcceleration.fill(320 / 1.001);
  EXPECT_FALSE(checkMotion(samples, limits).within());
}

TEST(PathCheck, SeesJumpsOfVelocityAndPlace) {
  const PathChain chain = corner();
  std::vector<Sample> samples = motionAlong(chain, kVelocity, kAcceleration, kJerk);
  // From a sample on 2 um further: a jump of the place.
  for (size_t i = 3000; i < samples.size(); ++i)
    samples[i].place[2] += 2e-6;
  MotionLimits limits = limitsOfCorner();
  limits.tolerance = kNone;
  MotionReport report = checkMotion(samples, limits, nullptr);
  EXPECT_GT(report.axisAcceleration.use, 0.6);
  EXPECT_EQ(report.axisAcceleration.use > 1, false);
  for (size_t i = 3000; i < samples.size(); ++i)
    samples[i].place[2] += 2e-6; // 4 um / (1/16 ms)^2 = 1024
  report = checkMotion(samples, limits, nullptr);
  EXPECT_GT(report.axisAcceleration.use, 1.4);
  EXPECT_NEAR(static_cast<double>(report.axisAcceleration.sample), 3000, 1.01);
}

TEST(PathCheck, MeasuresStepsAtOneTime) {
  std::vector<Sample> samples;
  for (int i = 0; i < 20; ++i)
    samples.push_back({0.001 * i, 0.01 * i, {0.01 * i}});
  Sample joint = samples[9];
  joint.place[1] += 0.5e-9;
  samples.insert(samples.begin() + 10, joint);
  MotionLimits limits;
  limits.velocity = 10.1;
  EXPECT_TRUE(checkMotion(samples, limits).within()) << checkMotion(samples, limits).text();
  samples[10].place[1] += 1e-9;
  const MotionReport report = checkMotion(samples, limits);
  EXPECT_FALSE(report.within());
  EXPECT_NEAR(report.jump.value, 1.5e-9, 1e-15);
  EXPECT_EQ(report.jump.sample, 10U);
  samples[10].time -= 1e-4; // backwards in time
  EXPECT_FALSE(checkMotion(samples, limits).within());
}

TEST(PathCheck, SeesWhatGoesBack) {
  const PathChain chain = corner();
  std::vector<Sample> samples = motionAlong(chain, kVelocity, kAcceleration, kJerk);
  samples[2000].way = samples[1999].way;
  EXPECT_EQ(checkMotion(samples, limitsOfCorner()).backwards.use, 0);
  samples[2000].way = std::nextafter(samples[1999].way, 0.0);
  const MotionReport report = checkMotion(samples, limitsOfCorner());
  EXPECT_EQ(report.backwards.sample, 2000U);
  EXPECT_FALSE(report.within());
}

TEST(PathCheck, WantsTheEndExactly) {
  const PathChain chain = corner();
  std::vector<Sample> samples = motionAlong(chain, kVelocity, kAcceleration, kJerk);
  EXPECT_TRUE(checkMotion(samples, limitsOfCorner(), &chain).exactEnd);
  samples.back().place[1] = std::nextafter(samples.back().place[1], 0.0);
  EXPECT_FALSE(checkMotion(samples, limitsOfCorner(), &chain).within());
  EXPECT_FALSE(checkMotion({}, limitsOfCorner(), &chain).within());
}

/// A corner cut by an arc is off by what is known; what lies beside the motion is missed.
TEST(PathCheck, MeasuresTheDistanceBothWays) {
  const PathChain driven = corner();
  PathChain programmed({3, 2});
  programmed.addLine({28, 2});
  programmed.addLine({28, 19});
  const std::vector<Sample> samples = motionAlong(driven, kVelocity, kAcceleration, kJerk);
  const double missed = kRadius * (std::numbers::sqrt2 - 1);
  const double distance = kRadius * (1 - std::sqrt(0.5));
  MotionLimits limits = limitsOfCorner();
  limits.tolerance = missed;
  MotionReport report = checkMotion(samples, limits, &programmed);
  EXPECT_TRUE(report.within()) << report.text();
  EXPECT_NEAR(report.missed.value, missed, 1e-6);
  EXPECT_NEAR(report.distance.value, distance, 1e-3);
  limits.tolerance = missed / 1.001;
  report = checkMotion(samples, limits, &programmed);
  EXPECT_FALSE(report.within());
  EXPECT_NEAR(report.missed.use, 1.001, 1e-6);
  EXPECT_LT(report.distance.use, 1);
  limits.tolerance = distance / 1.01;
  EXPECT_NEAR(checkMotion(samples, limits, &programmed).distance.use, 1.01, 1e-3);
}

/// A loop that the motion leaves out keeps it near the reference all the time; the loop is missed.
TEST(PathCheck, SeesLoopsThatAreLeftOut) {
  PathChain programmed({0, 0});
  programmed.addLine({10, 0});
  programmed.addArc({10, 0}, {10, 2, 0}, {0, 0, 1});
  programmed.addLine({25, 0});
  PathChain driven({0, 0});
  driven.addLine({25, 0});
  MotionLimits limits;
  limits.tolerance = 1;
  const MotionReport report =
      checkMotion(motionAlong(driven, kVelocity, kAcceleration, kJerk), limits, &programmed);
  EXPECT_NEAR(report.missed.value, 4, 1e-9);
  EXPECT_FALSE(report.within());
}

TEST(PathCheck, NaNKeepsNothing) {
  const PathChain chain = corner();
  std::vector<Sample> samples = motionAlong(chain, kVelocity, kAcceleration, kJerk);
  samples[500].place[1] = std::nan("");
  EXPECT_FALSE(checkMotion(samples, limitsOfCorner()).within());
  // An unknown way is not measured.
  samples = motionAlong(chain, kVelocity, kAcceleration, kJerk);
  for (Sample &sample : samples)
    sample.way = std::nan("");
  const MotionReport report = checkMotion(samples, limitsOfCorner(), &chain);
  EXPECT_TRUE(report.within());
  EXPECT_EQ(report.jerk.use, 0);
  EXPECT_GT(report.pathVelocity.use, 0.999);
}

/// Feet against the nearest of many places.
TEST(PathChain, NearestPlaceIsThatOfManySamples) {
  for (uint64_t seed = 0; seed < 40 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto place = [&] {
      Place any{};
      for (size_t axis = 0; axis < 4; ++axis)
        any[axis] = random.uniform(-5, 5);
      return any;
    };
    const bool flat = random.chance(0.5);
    PathChain chain(place(), flat ? 3 : 4);
    const int kind = random.below(2);
    if (kind == 0)
      chain.addLine(place());
    else {
      const Place centre = place();
      Place end = place();
      if (flat) // in one plane and of one radius
        end = {2 * centre[0] - chain.end()[0], 2 * centre[1] - chain.end()[1], chain.end()[2]};
      chain.addArc(end, {centre[0], centre[1], centre[2]}, {0, 0, random.sign()});
    }
    const ChainElement &element = chain.elements().front();
    const double from = chain.length() * random.uniform(0, 0.4);
    const double to = chain.length() * random.uniform(0.6, 1);
    const Place point = place();
    double least = 1e300;
    double length = 0;
    for (int i = 0; i <= 20000; ++i) {
      const double part = i / 20000.0;
      if (part * chain.length() >= from && part * chain.length() <= to)
        least = std::min(least, distance(element.at(part), point, chain.axes()));
      if (i > 0)
        length += distance(element.at(part), element.at((i - 1) / 20000.0), chain.axes());
    }
    EXPECT_NEAR(length, chain.length(), 1e-6 * length);
    const Foot foot = chain.nearest(point, from, to);
    EXPECT_LE(foot.distance, least + 1e-12);
    EXPECT_GE(foot.distance, least - 1e-3);
    EXPECT_NEAR(distance(chain.at(foot.way), point, chain.axes()), foot.distance, 1e-9);
    EXPECT_TRUE(foot.way >= from - 1e-12 && foot.way <= to + 1e-12);
  }
}

TEST(PathChain, ArcsTurnAroundTheirNormal) {
  PathChain chain({1, 0, 5});
  chain.addArc({0, 1, 5}, {0, 0, 5}, {0, 0, 1});  // a quarter
  chain.addArc({1, 0, 5}, {0, 0, 5}, {0, 0, 1});  // the other three
  chain.addArc({0, 1, 5}, {0, 0, 5}, {0, 0, -2}); // three quarters, clockwise
  chain.addArc({0, 1, 8}, {0, 0, 5}, {0, 0, 1});  // a turn of a helix
  const double quarter = std::numbers::pi / 2;
  EXPECT_NEAR(chain.elements()[0].length, quarter, 1e-15);
  EXPECT_NEAR(chain.elements()[1].length, 3 * quarter, 1e-15);
  EXPECT_NEAR(chain.elements()[2].length, 3 * quarter, 1e-15);
  EXPECT_NEAR(chain.elements()[3].length, std::hypot(4 * quarter, 3), 1e-14);
  const Place middle = chain.elements()[3].at(0.5);
  EXPECT_NEAR(middle[1], -1, 1e-15);
  EXPECT_NEAR(middle[2], 6.5, 1e-15);
  EXPECT_NEAR(chain.elements()[2].at(1.0 / 3)[1], -1, 1e-15);
}

} // namespace
