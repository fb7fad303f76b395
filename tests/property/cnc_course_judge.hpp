// What judges a drive of cnc_course_drive.hpp: an independent description of the path, finite
// differences of its samples, and the shortest time that its limits permit.
#ifndef STRIDE_TESTS_PROPERTY_CNC_COURSE_JUDGE_HPP
#define STRIDE_TESTS_PROPERTY_CNC_COURSE_JUDGE_HPP

#include "cnc_course_drive.hpp"

#include "tests/oracle/path/s_curve.hpp"

#include <cstdio>

namespace stride::test {

/// What was worst in all cases of a test, for its log.
struct Figures {
  double velocity = 0, acceleration = 0, jerk = 0, axisVelocity = 0, axisAcceleration = 0;
  double distance = 0; ///< From the path, without blends. [u]
  int cases = 0;

  void add(const oracle::MotionReport &report) {
    velocity = std::max(velocity, report.velocity.use);
    acceleration = std::max({acceleration, report.acceleration.use, report.deceleration.use});
    jerk = std::max(jerk, report.jerk.use);
    axisVelocity = std::max(axisVelocity, report.axisVelocity.use);
    axisAcceleration = std::max(axisAcceleration, report.axisAcceleration.use);
    ++cases;
  }
  void print() const {
    std::printf("%d cases; worst uses: velocity %.7f, acceleration %.7f, jerk %.7f, axes' velocity "
                "%.7f, axes' acceleration %.7f; distance %.2g\n",
                cases, velocity, acceleration, jerk, axisVelocity, axisAcceleration, distance);
  }
};

/// Figures that are printed when the test is over.
struct PrintedFigures : Figures {
  PrintedFigures() = default;
  ~PrintedFigures() { print(); }
  PrintedFigures(const PrintedFigures &) = delete;
  PrintedFigures &operator=(const PrintedFigures &) = delete;
};

inline double sizeOf(const Problem &problem) {
  double size = 1;
  for (const cnc::PathObject &object : problem.objects)
    for (size_t axis = 0; axis < 3; ++axis)
      size = std::max(size, std::fabs(object.end.coordinate[axis]));
  return size;
}

inline oracle::MotionLimits limitsOf(const Problem &problem, const Drive &drive) {
  oracle::MotionLimits limits;
  limits.velocity = limits.acceleration = limits.deceleration = 0;
  for (const cnc::PathObject &object : problem.objects) {
    limits.velocity = std::max(limits.velocity, object.velocity * drive.mostOverride);
    limits.acceleration = std::max(limits.acceleration, object.acceleration);
    limits.deceleration = std::max(limits.deceleration, object.deceleration);
  }
  const double slack = drive.command.law == path::LawKind::Sigmoid ? M_PI / 2 : 1;
  limits.deceleration = std::max(limits.deceleration, drive.command.quickDeceleration) * slack;
  limits.acceleration *= slack;
  if (drive.command.law == path::LawKind::Jerk)
    limits.jerk = problem.jerk;
  for (size_t axis = 0; axis < 3; ++axis) {
    // Corners of up to the least angle are none.
    const double kink = limits.velocity * cnc::kLeastAngle / drive.sampleTime();
    if (problem.axes.velocity[axis] > 0)
      limits.axisVelocity[axis] = problem.axes.velocity[axis];
    if (problem.axes.acceleration[axis] > 0)
      limits.axisAcceleration[axis] = slack * problem.axes.acceleration[axis] + kink;
  }
  return limits;
}

/// A blend is near one of the two moves that it joins.
inline void expectNearPath(const Problem &problem, const Drive &drive) {
  const auto &elements = problem.chain.elements();
  const double most = 1.02 * problem.tolerance + 1e-9 * sizeOf(problem);
  for (size_t i = 0; i < drive.samples.size(); ++i) {
    const auto move = static_cast<size_t>(drive.sources[i]);
    const size_t next = std::min(move + 1, elements.size() - 1);
    const double apart = problem.chain
                             .nearest(drive.samples[i].place, elements[move].startWay,
                                      elements[next].startWay + elements[next].length)
                             .distance;
    ASSERT_LE(apart, most) << "sample " << i << ", move " << move;
  }
  EXPECT_TRUE(drive.samples.back().place == problem.chain.end());
}

/// Without blends, where the way says; with them, near the program.
inline void expectOnPath(const Problem &problem, const Drive &drive, Figures &figures) {
  if (problem.tolerance > 0) {
    expectNearPath(problem, drive);
    return;
  }
  const double exact = 1e-9 * sizeOf(problem);
  for (const oracle::Sample &sample : drive.samples) {
    const double apart = oracle::distance(sample.place, problem.chain.at(sample.way), 3);
    ASSERT_LE(apart, exact) << "at " << sample.time << " s, way " << sample.way;
    figures.distance = std::max(figures.distance, apart);
  }
  EXPECT_TRUE(drive.samples.back().place == problem.chain.end());
  EXPECT_NEAR(drive.way, problem.chain.length(), exact);
}

/// All that every drive must keep.
inline void judge(const Problem &problem, const Drive &drive, Figures &figures) {
  const oracle::MotionReport report =
      oracle::checkMotion(drive.samples, limitsOf(problem, drive), nullptr, {.rounding = 16});
  EXPECT_TRUE(report.within()) << report.text();
  figures.add(report);
  expectOnPath(problem, drive, figures);
}

/// The shortest time from rest to rest over a way with nothing in it. [s]
inline double emptyTime(double way, double velocity, double acceleration, double jerk,
                        path::LawKind law) {
  if (law == path::LawKind::Jerk)
    return oracle::restToRestTime(way, velocity, acceleration, jerk);
  const double peak = std::min(velocity, std::sqrt(way * acceleration));
  return peak / acceleration + way / peak;
}

/// No way is gone over more quickly than with its feed, and no run between two stops more quickly
/// than an empty way with the greatest limits of its objects. [s]
inline double leastTime(const Problem &problem, path::LawKind law) {
  double least = 0;
  double byFeed = 0;
  double way = 0;
  double velocity = 0;
  double acceleration = 0;
  for (const cnc::PathObject &object : problem.objects) {
    byFeed += object.length / object.velocity;
    way += object.length;
    velocity = std::max(velocity, object.velocity);
    acceleration = std::max({acceleration, object.acceleration, object.deceleration});
    if (object.velocityEnd > 0 && &object != &problem.objects.back())
      continue;
    if (way > 0)
      least += std::max(byFeed, emptyTime(way, velocity, acceleration, problem.jerk, law));
    byFeed = way = velocity = acceleration = 0;
  }
  return least;
}

} // namespace stride::test

#endif // STRIDE_TESTS_PROPERTY_CNC_COURSE_JUDGE_HPP
