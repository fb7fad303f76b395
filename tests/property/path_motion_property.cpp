// Motions along random courses that become known piece by piece, with overrides, stops and cycles
// of any length: they keep every limit, never go back, always arrive, and never take more steps of
// planning in a call than they may.
#include "runtime/numeric/path/motion.hpp"

#include "motion_problems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace stride::path;
using stride::test::casesOf;
using stride::test::Random;

constexpr double kVelocity = 250;
constexpr double kAcceleration = 1750;
constexpr double kJerk = 50000;

/// Strips of any length, with limits that jump from each to the next.
std::vector<Strip> randomCourse(Random &random) {
  const double length = random.magnitude(-2, 1.7);
  const double step = length * random.magnitude(-3, 0);
  const bool simple = random.chance(0.3);
  std::vector<Strip> course;
  for (double way = 0; way < length && course.size() < 3000;) {
    way += step * random.magnitude(-1, 1);
    Strip strip{};
    strip.end = way;
    strip.feed = simple ? kVelocity : kVelocity * random.magnitude(-2, 0);
    strip.endFeed = strip.feed;
    strip.ceiling = strip.endCeiling = stride::exact::kInfinity;
    strip.acceleration = simple ? kAcceleration : kAcceleration * random.magnitude(-1, 0);
    strip.deceleration = simple ? kAcceleration : kAcceleration * random.magnitude(-1, 0);
    if (!simple && random.chance(0.5)) {
      strip.along = random.magnitude(-0.5, 0.5) / kAcceleration;
      strip.across = random.uniform(0.01, 0.9) / (strip.feed * strip.feed);
      strip.ceiling = 0.9 / strip.across;
    }
    if (!simple && random.chance(0.1))
      strip.endCeiling = strip.feed * strip.feed * random.uniform(1e-6, 1);
    strip.stop = random.chance(0.03);
    course.push_back(strip);
  }
  course.back().stop = true;
  return course;
}

/// What happens to a motion from outside.
struct Scene {
  std::vector<Strip> course;
  LawKind kind;
  double jerk;
  double cycle;
  bool disturbed; ///< By overrides and stops.
  double supply;  ///< Strips per cycle that become known.
  bool changing;  ///< Its law changes under way.
  bool lean;      ///< By plans that cost little.
};

Scene randomScene(Random &random, LawKind kind) {
  Scene scene{randomCourse(random), kind, kJerk, random.magnitude(-3, -2),
              random.chance(0.5),   0,    false, false};
  if (random.chance(0.2)) // up to none to speak of
    scene.jerk *= random.magnitude(-1, 9);
  scene.supply = random.chance(0.5) ? 1e9 : random.magnitude(-0.7, 1);
  return scene;
}

/// Drives a scene cycle by cycle and looks at each.
class Drive {
public:
  Drive(Scene scene, Random &random)
      : scene_(std::move(scene)), random_(random), motion_(std::make_unique<Motion>()) {
    reset(*motion_, {scene_.kind, scene_.jerk, 1, scene_.lean});
    budget_ = 64 * std::max(1, static_cast<int>(scene_.cycle * 1000));
  }

  /// How long it took; 0: it did not arrive. [s]
  double run() {
    const double end = scene_.course.back().end;
    for (int64_t cycle = 1; cycle < 2'000'000; ++cycle) {
      supply();
      disturb();
      const int32_t used = think(*motion_, budget_);
      EXPECT_LE(used, budget_);
      relocate();
      const WayState state = move(*motion_, scene_.cycle, true);
      look(state);
      forgetBefore(motion_->course, motion_->way);
      if (isAtRest(*motion_) && motion_->way == end)
        return static_cast<double>(cycle) * scene_.cycle;
      if (testing::Test::HasFailure())
        return 0;
    }
    ADD_FAILURE() << "stuck at " << motion_->way << " of " << end;
    return 0;
  }

private:
  void supply() {
    supplied_ += scene_.supply;
    while (known_ < scene_.course.size() && static_cast<double>(known_) < supplied_ &&
           roomIn(motion_->course) > 0 && extend(*motion_, scene_.course[known_]))
      ++known_;
  }

  void disturb() {
    Wish &wish = motion_->wish;
    if (scene_.changing && random_.chance(1.0 / 200))
      wish.settings = {static_cast<LawKind>(random_.below(3)), kJerk * random_.magnitude(-1, 1),
                       random_.chance(0.5) ? 1 : 2 / M_PI, scene_.lean};
    if (!scene_.disturbed)
      return;
    if (random_.chance(1.0 / 300))
      wish.override = random_.chance(0.3) ? 1.0 : random_.uniform(0.1, 2);
    most_ = std::max(most_, wish.override);
    if (hold_ > 0 && --hold_ == 0)
      wish.stop = false;
    else if (hold_ == 0 && random_.chance(1.0 / 500)) {
      hold_ = 200;
      wish.stop = true;
    }
  }

  /// Moves everything to other memory.
  void relocate() {
    if (!random_.chance(0.01))
      return;
    auto copy = std::make_unique<Motion>();
    std::memcpy(copy.get(), motion_.get(), sizeof(Motion));
    std::memset(motion_.get(), 0xA5, sizeof(Motion));
    motion_ = std::move(copy);
  }

  void look(const WayState &state) {
    const double t = scene_.cycle;
    // The most on the way of this cycle, which may begin as good as at the end of a strip.
    const bool passing = strip_ > 0 && last_.velocity * t < 1e-9 * last_.way;
    double jerk = jerkIn(scene_.course[passing ? strip_ - 1 : strip_], scene_.jerk);
    jerk = std::max(jerk, jerkIn(scene_.course[strip_], scene_.jerk));
    while (strip_ + 1 < scene_.course.size() && scene_.course[strip_].end <= state.way) {
      ++strip_;
      jerk = std::max(jerk, jerkIn(scene_.course[strip_], scene_.jerk));
    }
    EXPECT_GE(state.way, last_.way);
    EXPECT_LE(state.velocity, scene_.course[strip_].feed * most_ * (1 + 1e-6));
    if (scene_.kind != LawKind::Sigmoid && !scene_.changing) {
      const double a = kAcceleration * (1 + 1e-6);
      EXPECT_LE(std::fabs(state.velocity - last_.velocity), a * t + 1e-9);
      EXPECT_LE(state.way - last_.way,
                std::max(state.velocity, last_.velocity) * t + a * t * t + 1e-9);
    }
    if (scene_.kind == LawKind::Jerk && !scene_.changing) {
      EXPECT_LE(std::fabs(state.acceleration - last_.acceleration), jerk * t * (1 + 1e-6) + 1e-4);
    }
    last_ = state;
  }

  Scene scene_;
  Random &random_;
  std::unique_ptr<Motion> motion_;
  WayState last_{};
  double supplied_ = 0;
  double most_ = 1;
  size_t known_ = 0;
  size_t strip_ = 0;
  int32_t budget_ = 64;
  int hold_ = 0;
};

/// More cases by hand: STRIDE_PATH_CASES=100000. Case n has the seed 1,000,000 * law + n.
int wanted(int cases) {
  const char *const more = std::getenv("STRIDE_PATH_CASES");
  return more != nullptr ? std::atoi(more) : casesOf(cases);
}

void driveOne(LawKind kind, int number) {
  Random random(1'000'000 * static_cast<unsigned>(kind) + static_cast<unsigned>(number));
  SCOPED_TRACE("case " + std::to_string(number));
  Drive(randomScene(random, kind), random).run();
}

void driveChanging(int number) {
  Random random(5'000'000 + static_cast<unsigned>(number));
  SCOPED_TRACE("changing, case " + std::to_string(number));
  Scene scene = randomScene(random, LawKind::Jerk);
  scene.changing = true;
  Drive(scene, random).run();
}

/// Strips with jerks of their own, some of them greater than the law's.
void driveOwnJerks(int number) {
  Random random(6'000'000 + static_cast<unsigned>(number));
  SCOPED_TRACE("own jerks, case " + std::to_string(number));
  Scene scene = randomScene(random, LawKind::Jerk);
  for (Strip &strip : scene.course)
    if (random.chance(0.7))
      strip.jerk = static_cast<float>(kJerk * random.magnitude(-1.5, 0.5));
  Drive(scene, random).run();
}

TEST(PathMotion, KeepsJerksOfStrips) {
  const int cases = wanted(300);
  for (int i = 0; i < cases && !HasFailure(); ++i)
    driveOwnJerks(i);
}

/// Lean plans, of the same courses as others, some of them with jerks of their own.
void driveLean(int number) {
  Random random(1'000'000 * static_cast<unsigned>(LawKind::Jerk) + static_cast<unsigned>(number));
  SCOPED_TRACE("lean, case " + std::to_string(number));
  Scene scene = randomScene(random, LawKind::Jerk);
  scene.lean = true;
  for (Strip &strip : scene.course)
    if (number % 3 == 2 && random.chance(0.7))
      strip.jerk = static_cast<float>(kJerk * random.magnitude(-1.5, 0.5));
  Drive(scene, random).run();
}

TEST(PathMotion, KeepsItsLimitsWithLeanPlans) {
  const int cases = wanted(1000);
  for (int i = 0; i < cases && !HasFailure(); ++i)
    driveLean(i);
}

TEST(PathMotion, ArrivesWithALawThatChangedWhereItOnceDidNot) {
  driveChanging(7853); // stopped by the law that was to come
  driveChanging(9678); // began at the greatest velocity and braked less hard than it had to
}

void driveMany(LawKind kind, int cases) {
  for (int i = 0; i < cases && !testing::Test::HasFailure(); ++i)
    driveOne(kind, i);
}

TEST(PathMotion, KeepsItsLimitsWhereItOnceDidNot) {
  driveOne(LawKind::Trapezoid, 24528); // a strip changed while it was being planned with
  driveOne(LawKind::Sigmoid, 92421);   // the end of a piece was rounded up
  driveOne(LawKind::Jerk, 1349);       // slowing down, it was too fast for the next strip
  driveOne(LawKind::Jerk, 5638);       // likewise, within the first cell
}

TEST(PathMotion, KeepsItsLimitsWithLimitedJerk) { driveMany(LawKind::Jerk, wanted(1000)); }
TEST(PathMotion, KeepsItsLimitsByTrapezoids) { driveMany(LawKind::Trapezoid, wanted(300)); }
TEST(PathMotion, KeepsItsLimitsBySines) { driveMany(LawKind::Sigmoid, wanted(300)); }

/// Accelerations of sines are up to pi / 2 times those of the path.
TEST(PathMotion, ArrivesWithLawsThatChangeUnderWay) {
  const int cases = wanted(300);
  for (int i = 0; i < cases && !HasFailure(); ++i)
    driveChanging(i);
}

/// The quickest motion from rest to rest on a straight line.
double closedForm(double length) {
  const auto time = [](double v) {
    return v >= kAcceleration * kAcceleration / kJerk ? v / kAcceleration + kAcceleration / kJerk
                                                      : 2 * std::sqrt(v / kJerk);
  };
  if (kVelocity * time(kVelocity) <= length)
    return 2 * time(kVelocity) + (length - kVelocity * time(kVelocity)) / kVelocity;
  double low = 0;
  double high = kVelocity;
  for (int i = 0; i < 200; ++i) {
    const double v = 0.5 * (low + high);
    (v * time(v) <= length ? low : high) = v;
  }
  return 2 * time(low);
}

/// The time of a plan over one strip, or over two with the same limits.
double plannedTime(double length, bool parted) {
  auto course = std::make_unique<Course>();
  auto plan = std::make_unique<Plan>();
  Strip strip{};
  strip.end = 0.37 * length;
  strip.feed = strip.endFeed = kVelocity;
  strip.ceiling = strip.endCeiling = stride::exact::kInfinity;
  strip.acceleration = strip.deceleration = kAcceleration;
  if (parted)
    append(*course, strip, 0.0);
  strip.end = length;
  strip.stop = true;
  append(*course, strip, 0.0);
  PlanTask task{};
  task.end = stride::exact::kInfinity;
  task.jerk = kJerk;
  task.cellTime = 0.002;
  task.override = 1;
  task.cells = kCells;
  begin(*plan, *course, task);
  work(*plan, *course, 1'000'000);
  EXPECT_EQ(plan->state, PlanState::Done);
  EXPECT_EQ(plan->end, length);
  double time = 0;
  for (int32_t i = 0; i < plan->count; ++i)
    time += pieceOf(*plan, i).duration;
  return time;
}

TEST(PathMotion, IsNearlyAsQuickAsTheClosedFormOnALine) {
  Random random(77);
  for (int i = 0; i < casesOf(2000) && !HasFailure(); ++i) {
    const double length = random.magnitude(-6, 1.8);
    const double ratio = plannedTime(length, true) / closedForm(length);
    EXPECT_GE(ratio, 1 - 1e-9) << length;
    EXPECT_LE(ratio, 1.01) << length;
    EXPECT_NEAR(plannedTime(length, false) / closedForm(length), 1, 1e-9) << length;
  }
}

/// A course of two strips of the same limits, the second of which ends in a stop.
std::unique_ptr<Course> simpleCourse(double length) {
  auto course = std::make_unique<Course>();
  Strip strip{};
  strip.feed = strip.endFeed = kVelocity;
  strip.ceiling = strip.endCeiling = stride::exact::kInfinity;
  strip.acceleration = strip.deceleration = kAcceleration;
  for (const double part : {0.37, 1.0}) {
    strip.end = part * length;
    strip.stop = part == 1.0;
    append(*course, strip, 0.0);
  }
  return course;
}

PlanTask simpleTask(double velocity, double acceleration) {
  PlanTask task{};
  task.velocity = velocity;
  task.acceleration = acceleration;
  task.end = task.limit = stride::exact::kInfinity;
  task.jerk = kJerk;
  task.cellTime = 0.002;
  task.override = task.before = task.rampPart = 1;
  task.cells = kCells;
  return task;
}

/// A plan from a state in which the motion accelerates or brakes goes on from it without a jump,
/// within all limits, to rest.
TEST(PathMotion, PlansFromAnyStateGoOnFromIt) {
  Random random(12);
  auto plan = std::make_unique<Plan>();
  int braking = 0;
  int failed = 0;
  for (int i = 0; i < casesOf(2000) && !HasFailure(); ++i) {
    const auto course = simpleCourse(random.magnitude(0.5, 2));
    const double a = kAcceleration * random.uniform(-1, 1);
    const double v = kVelocity * random.uniform(0.02, 1) - std::max(0.0, 0.5 * a * a / kJerk);
    if (!(v > 0) || (a < 0 && 0.5 * a * a / kJerk > v))
      continue;
    SCOPED_TRACE(testing::Message() << "case " << i << ": from " << v << ", " << a);
    begin(*plan, *course, simpleTask(v, a));
    work(*plan, *course, 1'000'000);
    if (plan->state != PlanState::Done) { // it cannot stop any more, or was not found
      ++failed;
      continue;
    }
    braking += a < 0 ? 1 : 0;
    WayState last{0, v, a, 0};
    for (int32_t k = 0; k < pieceCount(*plan); ++k) {
      const TimePiece piece = pieceOf(*plan, k);
      ASSERT_GT(piece.duration, 0);
      const WayState first = stateAt(piece, 0);
      EXPECT_NEAR(first.velocity, last.velocity, 1e-6 * kVelocity);
      EXPECT_NEAR(first.acceleration, last.acceleration, 1e-5 * kAcceleration);
      for (const double part : {0.0, 0.5, 1.0}) {
        const WayState state = stateAt(piece, part * piece.duration);
        EXPECT_LE(state.velocity, kVelocity * (1 + 1e-6));
        EXPECT_LE(std::fabs(state.acceleration), kAcceleration * (1 + 1e-6));
        EXPECT_LE(std::fabs(state.jerk), kJerk * (1 + 1e-5));
      }
      last = stateAt(piece, piece.duration);
    }
    EXPECT_NEAR(last.way, plan->end, 1e-9 * plan->end);
    EXPECT_NEAR(last.velocity, 0, 1e-6);
  }
  EXPECT_GT(braking, casesOf(2000) / 5);
  EXPECT_LT(failed, casesOf(2000) / 3);
}

/// Whether all that a plan says is a number.
bool isFinite(const Plan &plan) {
  for (int32_t k = 0; k < pieceCount(plan); ++k) {
    const TimePiece piece = pieceOf(plan, k);
    for (const double value : {piece.length, piece.velocity, piece.acceleration, piece.gradient,
                               piece.duration, stateAt(piece, piece.duration).way})
      if (!std::isfinite(value))
        return false;
  }
  return true;
}

/// What is no number never becomes a motion: the plan fails, or does without it.
TEST(PathMotion, NoPlanComesOfWhatIsNoNumber) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  double Strip::*const members[] = {&Strip::feed,       &Strip::endFeed,      &Strip::ceiling,
                                    &Strip::endCeiling, &Strip::acceleration, &Strip::deceleration,
                                    &Strip::along,      &Strip::across};
  auto plan = std::make_unique<Plan>();
  int failed = 0;
  for (double Strip::*const member : members)
    for (const int64_t strip : {0, 1})
      for (const double velocity : {0.0, 100.0}) {
        const auto course = simpleCourse(30);
        stripAt(*course, strip).*member = kNan;
        begin(*plan, *course, simpleTask(velocity, 0));
        work(*plan, *course, 1'000'000);
        EXPECT_NE(plan->state, PlanState::Working);
        failed += plan->state == PlanState::Failed ? 1 : 0;
        EXPECT_TRUE(plan->state == PlanState::Failed || isFinite(*plan));
      }
  EXPECT_GT(failed, 0);
}

} // namespace
