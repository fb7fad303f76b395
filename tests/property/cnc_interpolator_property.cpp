// Random programs through the whole chain, objects, corner blends, velocity check, queue and
// interpolator, judged by an independent description of the path and by finite differences: on the
// path, within all limits, never back, to the very end; whatever the cycle, the queue, the override
// and the stops are.
#include "cnc_course_judge.hpp"
#include "motion_problems.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

namespace {

using namespace stride::test;
using stride::oracle::Place;
using stride::path::LawKind;

/// More cases by hand: STRIDE_PATH_CASES=10000.
int wanted(int cases) {
  const char *const more = std::getenv("STRIDE_PATH_CASES");
  return more != nullptr ? std::atoi(more) : casesOf(cases);
}

void forEachSeed(uint64_t first, int cases, const std::function<void(uint64_t)> &test) {
  for (int i = 0; i < cases && !testing::Test::HasFailure(); ++i) {
    const uint64_t seed = first + static_cast<uint64_t>(i);
    SCOPED_TRACE("seed " + std::to_string(seed));
    test(seed);
  }
}

TEST(CncInterpolator, KeepsPathAndLimitsAtTheCycleAndWithinIt) {
  PrintedFigures figures;
  forEachSeed(0, wanted(50), [&](uint64_t seed) {
    const Problem problem = randomCourse(seed);
    for (const double cycle : {problem.cycle, problem.cycle / 16}) {
      Drive drive(problem, LawKind::Jerk, cycle);
      drive.fill();
      drive.begin();
      EXPECT_GE(drive.finish(), leastTime(problem, drive.command.law) * (1 - 1e-9) - cycle);
      judge(problem, drive, figures);
    }
  });
}

/// Steps of planning in a cycle that hardly ever are too few.
constexpr int32_t kAmple = 6000;

/// How many stops the path has, at most.
int stopsOf(const Problem &problem) {
  return static_cast<int>(
      std::count_if(problem.objects.begin(), problem.objects.end(),
                    [](const auto &object) { return !(object.velocityEnd > 0); }));
}

/// Which part of its duration a program takes longer or shorter with cycles of another length,
/// beyond what stops make of it.
double apartWithCycles(uint64_t seed, Figures &figures) {
  const Problem problem = randomCourse(seed);
  double times[2];
  for (const bool fine : {false, true}) {
    Drive drive(problem, LawKind::Jerk, fine ? problem.cycle / 3.7 : problem.cycle);
    drive.command.budget = kAmple;
    drive.fill();
    drive.begin();
    times[fine ? 1 : 0] = drive.finish();
    judge(problem, drive, figures);
  }
  // After a stop the motion goes on with a cycle; and a plan needs some, where the next stop is
  // near.
  const double atStops = 3.0 * (1 + stopsOf(problem)) * problem.cycle;
  return std::max(std::fabs(times[0] - times[1]) - atStops, 0.0) / times[1];
}

/// As a rule. With other cycles plans begin and end elsewhere, and where the path has to be gone
/// over very slowly at some places, a plan that ends beyond them has coarser cells than one that
/// ends before.
TEST(CncInterpolator, TakesTheSameTimeWhateverTheCycleIs) {
  PrintedFigures figures;
  double worst = 0;
  int apart = 0;
  const int cases = wanted(50);
  const auto look = [&](uint64_t seed) {
    const double part = apartWithCycles(seed, figures);
    apart += part > 0.005 ? 1 : 0;
    worst = std::max(worst, part);
  };
  forEachSeed(70'000'000, cases, look);
  EXPECT_LE(apart, 2 + cases / 25);
  look(70'000'065); // 0.8 %
  look(70'000'137); // 11 %
  EXPECT_LE(worst, 0.25);
  std::printf("durations of different cycles: 3 cycles for each stop and %.5f of it apart; %d more "
              "than 0.005\n",
              worst, apart);
}

/// Overrides and stops at any moment.
void disturb(Random &random, Drive &drive, int &hold) {
  stride::cnc::Command &command = drive.command;
  if (random.chance(1.0 / 60))
    command.override = random.chance(0.2) ? 1 : random.uniform(0, 2);
  if (hold > 0 && --hold == 0) {
    command.slowStop = command.quickStop = false;
    if (command.override < 0.1)
      command.override = 1;
  } else if (hold == 0 && random.chance(1.0 / 120)) {
    hold = 1 + random.below(150);
    (random.chance(0.5) ? command.slowStop : command.quickStop) = true;
  }
}

TEST(CncInterpolator, KeepsThemWithOverridesAndStops) {
  PrintedFigures figures;
  forEachSeed(10'000'000, wanted(50), [&](uint64_t seed) {
    const Problem problem = randomCourse(seed);
    Random random(seed);
    Drive drive(problem, LawKind::Jerk, problem.cycle);
    drive.command.quickDeceleration = problem.objects.front().deceleration * random.uniform(0.5, 3);
    drive.fill();
    drive.begin();
    int hold = 0;
    drive.finish([&] {
      if (drive.cycles % 1000 == 999)
        drive.command.override = 1; // else it may creep
      disturb(random, drive, hold);
    });
    judge(problem, drive, figures);
  });
}

TEST(CncInterpolator, GoesTheSameWayWithQueuesThatAreSmallAndOftenEmpty) {
  PrintedFigures figures;
  forEachSeed(20'000'000, wanted(50), [&](uint64_t seed) {
    const Problem problem = randomCourse(seed);
    Random random(seed);
    const auto law = static_cast<LawKind>(random.below(3));
    const auto places = static_cast<size_t>(5 + random.below(30));
    Drive drive(problem, law, problem.cycle, places);
    const double supply = random.magnitude(-1.5, 0.5); // objects per cycle
    drive.fill();
    drive.begin();
    double ready = 0;
    drive.finish([&] {
      ready = random.chance(0.01) ? ready + 5 : ready + supply;
      const double whole = std::floor(ready);
      drive.fill(static_cast<size_t>(whole));
      ready -= whole;
    });
    judge(problem, drive, figures);
  });
}

/// How many objects span twice the way to stop, wherever they are in the program.
size_t objectsForStops(const Problem &problem) {
  const auto stop = [&](const stride::cnc::PathObject &object) {
    const double v = object.velocity;
    double a = std::min(object.acceleration, object.deceleration);
    for (const double limit : problem.axes.acceleration)
      if (limit > 0)
        a = std::min(a, 0.1 * limit); // what curves leave
    return v * (0.5 * v / a + a / problem.jerk + std::sqrt(v / problem.jerk));
  };
  const std::vector<stride::cnc::PathObject> &objects = problem.objects;
  size_t most = 0;
  for (size_t i = 0; i < objects.size(); ++i) {
    double span = 0;
    size_t k = i;
    while (k < objects.size() && span < 2 * stop(objects[i]))
      span += objects[k++].length;
    most = std::max(most, k - i);
  }
  return most;
}

/// The plan of a queue's part ends in rest, and in some programs that costs a few percent.
TEST(CncInterpolator, TakesHardlyLongerWithQueuesThatHoldTwiceTheWayToStop) {
  PrintedFigures figures;
  double worst = 0;
  int shorter = 0;
  forEachSeed(30'000'000, wanted(30), [&](uint64_t seed) {
    const Problem problem = randomCourse(seed);
    const size_t places = objectsForStops(problem) + 8;
    shorter += places < problem.objects.size() ? 1 : 0;
    double times[2];
    for (const bool small : {false, true}) {
      Drive drive(problem, LawKind::Jerk, problem.cycle, small ? places : 0);
      drive.command.budget = kAmple;
      drive.fill();
      drive.begin();
      times[small ? 1 : 0] = drive.finish([&] { drive.fill(); });
      judge(problem, drive, figures);
    }
    const double apart = times[1] - times[0] - 2 * problem.cycle;
    worst = std::max(worst, apart / times[0]);
    EXPECT_LE(apart, 0.1 * times[0] + 2 * problem.cycle) << times[1] << " instead of " << times[0];
  });
  std::printf("%d queues shorter than the program; duration longer by %.5f at most\n", shorter,
              worst);
}

TEST(CncInterpolator, KeepsLimitsByTrapezoidsAndSines) {
  PrintedFigures figures;
  forEachSeed(40'000'000, wanted(50), [&](uint64_t seed) {
    const Problem problem = randomCourse(seed);
    Drive drive(problem, seed % 2 == 0 ? LawKind::Trapezoid : LawKind::Sigmoid, problem.cycle);
    drive.fill();
    drive.begin();
    const double time = drive.finish();
    judge(problem, drive, figures);
    EXPECT_GE(time, leastTime(problem, drive.command.law) * (1 - 1e-9) - problem.cycle);
  });
}

TEST(CncInterpolator, TakesTheTimeOfTheClosedFormByATrapezoid) {
  forEachSeed(50'000'000, wanted(300), [&](uint64_t seed) {
    Random random(seed);
    Problem problem;
    stride::oracle::ProgramMove move{};
    move.end = {random.magnitude(-2, 2), random.uniform(-9, 9), random.uniform(-9, 9)};
    move.velocity = random.magnitude(0, 2);
    move.acceleration = move.velocity * random.magnitude(-0.5, 1.5);
    move.deceleration = move.velocity * random.magnitude(-0.5, 1.5);
    problem.chain = stride::oracle::chainOf({move});
    problem.objects = {objectOf(move, problem.chain.elements()[0], 0)};
    problem.cycle = random.magnitude(-3, -2);
    checkAll(problem.objects);
    Drive drive(problem, LawKind::Trapezoid, problem.cycle);
    drive.fill();
    drive.begin();
    const double length = problem.chain.length();
    const double both = 1 / move.acceleration + 1 / move.deceleration;
    const double peak = std::min(move.velocity, std::sqrt(2 * length / both));
    const double expected = peak * both + (length - 0.5 * peak * peak * both) / peak;
    EXPECT_NEAR(drive.finish(), expected, 1.01 * problem.cycle);
  });
}

/// To and fro; how far it was from the path at most. [u]
double goThereAndBack(uint64_t seed) {
  double worst = 0;
  const Problem problem = randomCourse(seed);
  if (problem.tolerance > 0)
    return worst;
  Random random(seed);
  Drive drive(problem, static_cast<LawKind>(random.below(3)), problem.cycle);
  drive.command.twoWays = true;
  drive.fill();
  drive.begin();
  const double exact = 1e-9 * sizeOf(problem);
  const auto &phase = drive.interpolator->phase;
  for (int turn = 0; turn < 6 && !testing::Test::HasFailure(); ++turn) {
    const bool toEnd = turn >= 4 || random.chance(0.3); // to an end of the path; else anywhere
    drive.command.override = turn % 2 == 0 ? random.uniform(0.3, 2) : -random.uniform(0.3, 2);
    const int most = toEnd ? 300'000 : 1 + random.below(1500);
    for (int i = 0; i < most && phase != stride::cnc::Phase::Failed; ++i) {
      const stride::cnc::Progress &progress = drive.step();
      const double way = std::clamp(drive.way, 0.0, problem.chain.length());
      const double apart =
          stride::oracle::distance(drive.samples.back().place, problem.chain.at(way), 3);
      EXPECT_LE(apart, exact) << "turn " << turn << " at way " << drive.way;
      worst = std::max(worst, apart);
      // Before it turns round it may come to the other end.
      const bool turned = drive.interpolator->backwards == (drive.command.override < 0);
      if ((turned && progress.atEnd && progress.waits) || testing::Test::HasFailure())
        break;
    }
    if (toEnd) {
      const Place end = turn % 2 == 0 ? problem.chain.end() : problem.chain.at(0);
      EXPECT_TRUE(drive.samples.back().place == end) << "turn " << turn;
    }
  }
  return worst;
}

TEST(CncInterpolator, GoesThereAndBackOverTheSamePoints) {
  double worst = 0;
  forEachSeed(60'000'000, wanted(40),
              [&](uint64_t seed) { worst = std::max(worst, goThereAndBack(seed)); });
  std::printf("there and back: %.2g from the path at most\n", worst);
}

TEST(CncInterpolator, GoesThereAndBackWhereItOnceDidNot) {
  goThereAndBack(60'000'104); // it turned round at the border of two objects
  goThereAndBack(60'000'073);
  goThereAndBack(60'000'078);
}

} // namespace
