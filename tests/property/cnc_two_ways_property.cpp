// A path that is gone over to and fro at random, with stops of each kind, single steps, M functions
// and dwells: nothing jumps, limits hold, and both ends are reached exactly.
#include "tests/property/cnc_chain_rig.hpp"
#include "tests/support/cases.hpp"

#include "runtime/numeric/cnc/interpolator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace {

using namespace stride::test;
namespace cnc = stride::cnc;
namespace path = stride::path;

/// More cases by hand: STRIDE_PATH_CASES=10000.
int wanted(int cases) {
  const char *const more = std::getenv("STRIDE_PATH_CASES");
  return more != nullptr ? std::atoi(more) : casesOf(cases);
}

/// A whole path in a queue, its velocities checked.
std::unique_ptr<Chain> wholePath(std::string text, const std::string &names) {
  for (size_t at = text.find("G75\n"); at != std::string::npos; at = text.find("G75\n"))
    text.erase(at, 4); // the decoder would wait for the end of the path so far
  auto chain = std::make_unique<Chain>(text, names, std::vector<size_t>(names.size() + 1, 300));
  for (int cycle = 0; cycle < 600; ++cycle) {
    chain->decode(true);
    for (size_t i = 0; i < chain->processors.size(); ++i)
      chain->process(i, true);
    chain->checkVelocities(true);
  }
  EXPECT_NE(chain->last()->bEndOfList, 0);
  return chain;
}

struct Trip {
  Random &random;
  cnc::Queue *queue;
  std::unique_ptr<cnc::Interpolator> interpolator = std::make_unique<cnc::Interpolator>();
  cnc::Command command{};
  double steepest = 0, x = 0, y = 0, velocity = 0;
  int cycles = 0;

  Trip(Random &theRandom, cnc::Queue *theQueue) : random(theRandom), queue(theQueue) {
    command.queue = queue;
    command.cycle = 0.002;
    command.override = 1;
    command.quickDeceleration = 4000;
    command.jerk = random.magnitude(3.5, 5);
    command.law = static_cast<path::LawKind>(random.below(3));
    command.share = 1;
    command.budget = 128;
    command.twoWays = true;
    command.limitKinks = true;
    steepest = 4000;
    for (uint32_t i = 0; i < cnc::countOf(queue); ++i) {
      const PathObject &o = *cnc::objectAt(queue, i);
      steepest = std::max({steepest, o.acceleration, o.deceleration});
    }
    if (command.law == path::LawKind::Sigmoid)
      steepest *= M_PI / 2;
    cnc::start(*interpolator, command);
  }

  void step() {
    const bool first = cycles++ == 0;
    cnc::cycle(*interpolator, command);
    const cnc::Progress &p = interpolator->progress;
    const double *at = p.position.coordinate;
    ASSERT_NE(interpolator->phase, cnc::Phase::Failed) << interpolator->error;
    const double now = p.length / command.cycle;
    ASSERT_GE(p.length, 0);
    if (!first) {
      ASSERT_LE(std::hypot(at[0] - x, at[1] - y), p.length * (1 + 1e-9) + 1e-9)
          << "cycle " << cycles << " at " << at[0] << ", " << at[1];
      ASSERT_LE((now - velocity) / command.cycle, steepest * (1 + 1e-6) + 1e-6);
      if (!command.emergencyStop) {
        ASSERT_GE((now - velocity) / command.cycle, -steepest * (1 + 1e-6) - 1e-6) << cycles;
      }
    }
    x = at[0];
    y = at[1];
    velocity = now;
  }

  void disturb() {
    const auto change = [this](bool &flag, double on, double off) {
      flag = flag ? !random.chance(off) : random.chance(on);
    };
    change(command.slowStop, 0.01, 0.05);
    change(command.quickStop, 0.01, 0.05);
    change(command.emergencyStop, 0.005, 0.1);
    change(command.waitAtNextStop, 0.01, 0.05);
    change(command.singleStep, 0.01, 0.05);
    command.acknowledge = random.chance(0.2);
    if (random.chance(0.02))
      command.override = random.uniform(-1.5, 1.5);
  }

  /// To one end, without more ado.
  void goToEnd(double override) {
    command.slowStop = command.quickStop = command.emergencyStop = false;
    command.waitAtNextStop = command.singleStep = false;
    command.acknowledge = true;
    command.override = override;
    const bool back = override < 0;
    for (int i = 0; i < 60000; ++i) {
      step();
      const bool there = interpolator->progress.atEnd && interpolator->backwards == back;
      if (testing::Test::HasFatalFailure() || (there && velocity == 0))
        break;
    }
    ASSERT_TRUE(interpolator->progress.atEnd)
        << "override " << override << " at " << x << ", " << y;
    const cnc::Position &end =
        back ? cnc::objectAt(queue, 0)->start : cnc::objectAt(queue, cnc::countOf(queue) - 1)->end;
    EXPECT_EQ(x, end.coordinate[0]);
    EXPECT_EQ(y, end.coordinate[1]);
  }
};

void goCase(uint64_t seed) {
  Random random(seed);
  const char *const chains[] = {"", "s", "r", "x", "m"};
  const std::string names = chains[random.below(5)];
  const std::string text = randomPath(random, false);
  SCOPED_TRACE("seed " + std::to_string(seed) + ", processors \"" + names + "\"\n" + text);
  const auto chain = wholePath(text, names);
  Trip trip(random, cnc::queueOf(chain->last()));
  const int disturbed = 200 + random.below(1500);
  for (int i = 0; i < disturbed && !testing::Test::HasFatalFailure(); ++i) {
    if (i > 0)
      trip.disturb();
    trip.step();
  }
  const double first = random.sign();
  for (const double override : {first, -first, first})
    if (!testing::Test::HasFatalFailure())
      trip.goToEnd(override);
}

} // namespace

TEST(CncTwoWays, GoesToAndFroWithinLimitsToBothEnds) {
  for (int i = 0; i < wanted(60) && !HasFailure(); ++i)
    goCase(1000 + static_cast<uint64_t>(i));
}

TEST(CncTwoWays, GoesToAndFroWhereItOnceDidNot) {
  goCase(1013); // turned where an M function was next: it moved before it waited
  goCase(1120);
}
