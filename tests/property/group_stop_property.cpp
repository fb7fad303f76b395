// Groups that are stopped softly: on a straight way no axis brakes harder than the part of its
// limits that the stop may take, nor begins or ends to do so more suddenly, as long as the way is
// long enough for that.
#include "group_jobs.hpp"

#include <cstdlib>

namespace {

using namespace stride::group;
using namespace stride::test;

/// The way to rest from a velocity, at first with an acceleration `from` that ends with the jerk.
double softWay(double v, double from, double a, double j) {
  const double time = std::max(from, 0.0) / j;
  const double peak = v + 0.5 * std::max(from, 0.0) * time;
  const double ramp = peak >= a * a / j ? peak / a + a / j : 2 * std::sqrt(peak / j);
  return (v + from * time / 3) * time + 0.5 * peak * ramp;
}

/// One movement of the axes that is stopped anywhere.
class SoftStop {
public:
  explicit SoftStop(unsigned seed)
      : random_(seed), machine_(randomMachine(random_)), group_(std::make_unique<GroupMotion>()),
        cycle_(random_.magnitude(-3.3, -2.7)) {
    reset(*group_, machine_.home);
    order_.velocityFactor = random_.uniform(0.3, 1);
    order_.accelerationFactor = random_.uniform(0.3, 1);
    order_.jerkFactor = random_.uniform(0.3, 1);
    order_.configuration = machine_.arm().configuration;
    command_ = {cycle_, 1, false, 0, std::max(1, static_cast<int>(cycle_ * 64000)), 64};
    append(*group_, drawId(*group_), leg(), order_);
  }

  /// Whether the way was long enough.
  bool run() {
    const double length = group_->movement[0].leg.length;
    const double at = random_.uniform(0.02, 0.7) * length;
    for (int n = 0; n < 100'000 && group_->motion.way < at; ++n)
      cycle(*group_, machine_.arm(), command_);
    command_.stop = true;
    command_.accelerationPart = random_.uniform(0.1, 1);
    command_.jerkPart = random_.uniform(0.1, 1);
    const double needed = neededWay();
    const bool isEnough = group_->motion.way + 1.3 * needed < length;
    abandon(*group_);
    brake(isEnough);
    return isEnough && !testing::Test::HasFailure();
  }

  /// The greatest part of what an axis may do that has been seen.
  double hardest() const { return hardest_; }

private:
  Leg leg() {
    double to[kAxes] = {};
    double perTime[kAxes];
    for (int k = 0; k < kAxes; ++k) {
      perTime[k] = machine_.limits[k].velocity * order_.velocityFactor;
      to[k] = machine_.home[k];
      if (isOfMachine(machine_, k))
        to[k] += random_.uniform(-1, 1) * random_.magnitude(1, 3);
    }
    return axesLeg(machine_.home, to, perTime, 300);
  }

  /// On the way of the stop, by the axes' limits.
  double neededWay() const {
    const Leg &leg = group_->movement[0].leg;
    double a = INFINITY;
    double j = INFINITY;
    double v = 0;
    double from = 0;
    for (int k = 0; k < kAxes; ++k) {
      const double d = std::fabs(leg.delta[k]) / leg.length;
      if (!isOfMachine(machine_, k) || !(d > 1e-9))
        continue;
      a = std::min(a, mostOf(k) / d);
      j = std::min(j, jerkOf(k) / d);
      v = group_->velocity[k] * leg.length / leg.delta[k];
      from = group_->acceleration[k] * leg.length / leg.delta[k];
    }
    return softWay(v, from, a, j);
  }

  double mostOf(int k) const {
    return machine_.limits[k].acceleration * order_.accelerationFactor * command_.accelerationPart;
  }
  double jerkOf(int k) const {
    return machine_.limits[k].jerk * order_.jerkFactor * command_.jerkPart;
  }

  void brake(bool isEnough) {
    bool brakes = false; // an acceleration ends as it was planned
    double start[kAxes];
    for (int k = 0; k < kAxes; ++k)
      start[k] = std::fabs(group_->acceleration[k]);
    for (int n = 0; n < 200'000 && !isAtRest(*group_); ++n) {
      double before[kAxes];
      std::copy(std::begin(group_->acceleration), std::end(group_->acceleration), before);
      cycle(*group_, machine_.arm(), command_);
      for (int k = 0; k < kAxes && isEnough; ++k)
        if (isOfMachine(machine_, k))
          look(k, start[k], before[k], brakes);
      brakes = brakes || isBraking();
    }
    EXPECT_TRUE(isAtRest(*group_));
  }

  bool isBraking() const {
    for (int k = 0; k < kAxes; ++k)
      if (group_->acceleration[k] * group_->velocity[k] > 0)
        return false;
    return true;
  }

  void look(int k, double start, double before, bool brakes) {
    const double now = group_->acceleration[k];
    hardest_ = std::max(hardest_, brakes ? std::fabs(now) / mostOf(k) : 0);
    const bool good =
        std::fabs(now) <= std::max(mostOf(k), start) * (1 + 1e-6) &&
        (!brakes || std::fabs(now - before) <= jerkOf(k) * cycle_ * (1 + 1e-4) + 1e-6 * mostOf(k));
    if (!good)
      ADD_FAILURE() << "axis " << k << " at way " << group_->motion.way << ": acceleration " << now
                    << " after " << before << " of " << mostOf(k) << ", jerk "
                    << (now - before) / cycle_ << " of " << jerkOf(k);
  }

  Random random_;
  Machine machine_;
  std::unique_ptr<GroupMotion> group_;
  double cycle_;
  Order order_{};
  GroupCommand command_{};
  double hardest_ = 0;
};

TEST(GroupStop, KeepsThePartOfTheAxesLimitsThatItMayTake) {
  const int cases = casesOf(400);
  int enough = 0;
  int hard = 0;
  for (int i = 0; i < cases && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i);
    SoftStop stop(7000U + static_cast<unsigned>(i));
    enough += stop.run() ? 1 : 0;
    hard += stop.hardest() > 0.99 ? 1 : 0;
  }
  printf("%d of %d had enough way, %d took all that they may\n", enough, cases, hard);
  EXPECT_GE(enough, cases / 3);
  EXPECT_GE(hard, cases / 20);
}

} // namespace
