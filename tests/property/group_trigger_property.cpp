// Triggers of groups that drive random movements: what is foreseen is what comes, to a nanosecond,
// and does not change once it is within the forecast. The oracle goes on with copies of the motion
// by parts of a cycle, and halves.
#include "group_problems.hpp"
#include "runtime/numeric/group/trigger.hpp"
#include "tests/support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

namespace {

using namespace stride::group;
namespace kinematics = stride::kinematics;
using namespace stride::test;

constexpr Vector3 kZeroPlace{0, 0, 0};
constexpr double kNanosecond = 1e-9;
constexpr double kSlow = 0.01; // where a nanosecond is within what ways are rounded to [u/s]

Machine portalOrScara(Random &random) {
  Machine machine = random.chance(0.5) ? gantry() : scara();
  setRandomLimits(machine, random);
  return machine;
}

/// A movement as the test knows it.
struct Known {
  uint64_t id;
  bool byTool;
  double from[kAxes], to[kAxes];
  Vector3 start, end;
  double length;
};

struct Trigger {
  uint64_t movement;
  double part;     ///< Of the movement, 0 to 1.
  double foretold; ///< Absolute; negative: not yet. [s]
  bool reached;
  double way; ///< Of the motion; negative: not known. [u]
};

class TriggeredDrive {
public:
  explicit TriggeredDrive(unsigned seed)
      : random_(seed), machine_(portalOrScara(random_)), group_(std::make_unique<GroupMotion>()),
        copy_(std::make_unique<GroupMotion>()), cycle_(random_.magnitude(-3, -2.3)),
        keep_(random_.chance(0.3) ? 0 : random_.magnitude(-2, -0.3)), arm_(machine_.arm()) {
    reset(*group_, machine_.home);
    std::copy(std::begin(machine_.home), std::end(machine_.home), planned_);
  }

  void run(int movements) {
    int left = movements;
    const bool atOnce = random_.chance(0.5);
    while (atOnce && left > 0 && hasRoom(*group_))
      left -= order() ? 1 : 0;
    for (int64_t n = 0; n < 200'000 && !failed_; ++n, now_ += cycle_) {
      if (left > 0 && hasRoom(*group_) && (atOnce || random_.chance(0.02)))
        left -= order() ? 1 : 0;
      if (left == 0 && group_->first == group_->next && isAtRest(*group_))
        break;
      step();
      if (testing::Test::HasFailure())
        return;
    }
    for (const Trigger &trigger : triggers_)
      EXPECT_TRUE(failed_ || trigger.reached) << trigger.part << " of " << trigger.movement;
    reached_ = failed_ ? 0 : static_cast<int>(triggers_.size());
  }

  int reached() const { return reached_; }
  int inCorners() const { return inCorners_; }
  int bisected() const { return bisected_; }

private:
  Vector3 toolAt(const double (&axes)[kAxes]) const {
    Frame<double> frame;
    EXPECT_EQ(arm_.kinematics.forward(axes, frame), kinematics::Outcome::Done);
    return plain(frame.place);
  }

  /// False: it would go nowhere.
  bool order() {
    double to[kAxes] = {};
    for (int k = 0; k < machine_.joints; ++k)
      to[k] = machine_.home[k] + random_.uniform(-1, 1) * machine_.spread;
    Order order{};
    const double speed = random_.magnitude(1.7, 3);
    order.path = {speed, speed * random_.magnitude(0, 1.5), speed * random_.magnitude(0, 1.5), 0};
    order.path.jerk = order.path.acceleration * random_.magnitude(0.5, 2);
    order.velocityFactor = order.accelerationFactor = order.jerkFactor = 1;
    order.configuration = arm_.configuration;
    order.transition = static_cast<Transition>(random_.below(3));
    order.transitionValue = order.transition == Transition::Distance ? random_.magnitude(0, 2)
                                                                     : random_.uniform(0.1, 2);
    Known known{};
    known.byTool = random_.chance(0.7);
    std::copy(std::begin(planned_), std::end(planned_), known.from);
    std::copy(std::begin(to), std::end(to), known.to);
    known.start = toolAt(planned_);
    known.end = toolAt(to);
    Leg leg{};
    if (known.byTool) {
      Frame<double> from;
      Frame<double> target;
      (void)arm_.kinematics.forward(planned_, from);
      (void)arm_.kinematics.forward(to, target);
      leg = lineLeg(poseOf(from), poseOf(target), MoreAxes{});
    } else {
      double perTime[kAxes];
      for (int k = 0; k < kAxes; ++k)
        perTime[k] = machine_.limits[k].velocity;
      leg = axesLeg(planned_, to, perTime, 300);
    }
    if (!(leg.length > 0))
      return false;
    known.length = leg.length;
    known.id = drawId(*group_);
    append(*group_, known.id, leg, order);
    std::copy(std::begin(to), std::end(to), planned_);
    known_.push_back(known);
    for (int n = random_.below(4); n > 0; --n) {
      const int kind = random_.below(6);
      const double part = kind == 0 ? 0.0 : (kind == 1 ? 1.0 : random_.uniform(0, 1));
      triggers_.push_back(Trigger{known.id, part, -1.0, false, -1.0});
    }
    return true;
  }

  /// Where the motion is after a part of the cycle that is planned.
  double wayAfter(double time) {
    std::memcpy(copy_.get(), group_.get(), sizeof(GroupMotion));
    GroupCommand command = command_;
    command.cycle = time;
    goOn(*copy_, arm_, command);
    return copy_->motion.way;
  }

  /// When the motion comes to a way in this cycle.
  double found(double way) {
    double low = 0;
    double high = cycle_;
    for (int n = 0; n < 80; ++n) {
      const double middle = (low + high) / 2;
      (wayAfter(middle) < way ? low : high) = middle;
    }
    return high;
  }

  const Known &knownOf(uint64_t id) const {
    return *std::find_if(known_.begin(), known_.end(),
                         [id](const Known &known) { return known.id == id; });
  }

  /// On the movement itself, outside of corners, the machine is where the part says.
  void comparePlace(const Trigger &trigger, double time) {
    const Known &known = knownOf(trigger.movement);
    const double along = trigger.part * known.length;
    for (int64_t k = group_->first; k < group_->next; ++k) {
      const Movement &movement = group_->movement[k % kMovements];
      if (movement.id != trigger.movement)
        continue;
      if (along < movement.entry || along > movement.exit) {
        ++inCorners_;
        (void)wayAfter(time);
        uint64_t id = 0;
        const double place = positionInMovement(*copy_, id);
        // The end of one movement is the start of the next one.
        EXPECT_NEAR(place + static_cast<double>(id),
                    trigger.part + static_cast<double>(trigger.movement), 1e-6);
        return;
      }
      (void)wayAfter(time);
      if (known.byTool) {
        const Vector3 at = toolAt(copy_->axes);
        const Vector3 wanted = known.start + (known.end - known.start) * trigger.part;
        EXPECT_LT(stride::numeric::norm(at - wanted), 1e-6);
      } else {
        for (int j = 0; j < machine_.joints; ++j)
          EXPECT_NEAR(copy_->axes[j], known.from[j] + (known.to[j] - known.from[j]) * trigger.part,
                      1e-6);
      }
    }
  }

  void look(Trigger &trigger, double planned) {
    if (trigger.reached)
      return;
    if (trigger.way < 0)
      trigger.way =
          wayOf(*group_, trigger.movement, trigger.part * knownOf(trigger.movement).length);
    const double way = trigger.way;
    if (way < 0)
      return;
    const double time = timeTo(*group_, way);
    if (!(time <= std::max(planned, cycle_ * (1 + 1e-9))) || holds(*group_)) {
      EXPECT_LT(trigger.foretold, 0) << "no longer known at " << now_;
      return;
    }
    if (trigger.foretold < 0)
      trigger.foretold = now_ + time;
    const bool atEnd = trigger.part == 0.0 || trigger.part == 1.0; // where it may rest
    // Beside rest a way that is rounded by 1e-13 u is a cube root, 5e-6 s, of time.
    EXPECT_NEAR(trigger.foretold, now_ + time, atEnd ? 5e-6 : kNanosecond)
        << "forecast " << keep_ << " of " << trigger.part;
    if (time >= cycle_)
      return;
    trigger.reached = true;
    // Where the motion begins or ends, many times are of one way, but for rounding.
    const bool slow = wayAfter(std::min(time + 1e-6, cycle_)) - way < 1e-6 * kSlow;
    if (wayAfter(cycle_) > way && time > 0 && !slow) {
      EXPECT_NEAR(found(way), time, kNanosecond);
      ++bisected_;
    } else if (time > 0) {
      EXPECT_NEAR(wayAfter(time), way, 1e-12 * std::max(1.0, way));
    }
    comparePlace(trigger, time);
  }

  void step() {
    command_ = {cycle_, 1, false, 0, std::max(1, static_cast<int>(cycle_ * 64000)), 64};
    command_.keep = keep_;
    plan(*group_, arm_, command_);
    const double planned = plannedTime(*group_);
    EXPECT_LE(planned, keep_);
    for (Trigger &trigger : triggers_)
      look(trigger, planned);
    goOn(*group_, arm_, command_);
    const double by = rebase(*group_);
    for (Trigger &trigger : triggers_)
      trigger.way -= trigger.way < 0 ? 0 : by;
    if (group_->obstacle != Obstacle::None)
      failed_ = true; // a line that the arm cannot follow
    for (const Known &known : known_) {
      if (outcomeOf(*group_, known.id) != Outcome::Done)
        continue;
      for (Trigger &trigger : triggers_)
        if (trigger.movement == known.id && !trigger.reached && trigger.part == 1.0 &&
            isAtRest(*group_))
          trigger.reached = trigger.foretold >= 0; // with the end, but for rounding
    }
  }

  Random random_;
  Machine machine_;
  std::unique_ptr<GroupMotion> group_;
  std::unique_ptr<GroupMotion> copy_;
  double cycle_;
  double keep_;
  Arm arm_;
  GroupCommand command_{};
  double planned_[kAxes];
  double now_ = 0;
  bool failed_ = false;
  int reached_ = 0;
  int inCorners_ = 0;
  int bisected_ = 0;
  std::vector<Known> known_;
  std::vector<Trigger> triggers_;
};

TEST(GroupTrigger, ComesWhenItIsForetold) {
  int reached = 0;
  int inCorners = 0;
  int bisected = 0;
  for (unsigned seed = 1; seed <= 120; ++seed) {
    SCOPED_TRACE(seed);
    TriggeredDrive drive(seed);
    drive.run(seed % 20 == 0 ? 40 : 8); // also more than are remembered at once
    reached += drive.reached();
    inCorners += drive.inCorners();
    bisected += drive.bisected();
    if (HasFailure())
      return;
  }
  EXPECT_GT(reached, 300);
  EXPECT_GT(inCorners, 30);
  EXPECT_GT(bisected, 200);
}

/// As many movements as there is room for, all the time: also in corners it is known where the
/// group is.
TEST(GroupTrigger, PlacesOnlyGrowWithAFullQueue) {
  constexpr int kAll = 90;
  Random random(7);
  Machine machine = gantry();
  for (AxisLimits &limits : machine.limits)
    limits = {200, 2000, 40000, -1e4, 1e4};
  const Arm arm = machine.arm();
  auto group = std::make_unique<GroupMotion>();
  reset(*group, machine.home);
  Pose from{kZeroPlace, {1, 0, 0, 0, 1, 0, 0, 0, 1}};
  Order order{};
  order.path = {150, 1500, 1500, 30000};
  order.velocityFactor = order.accelerationFactor = order.jerkFactor = 1;
  order.configuration = arm.configuration;
  order.transition = Transition::Distance;
  order.transitionValue = 2;
  double last = 0;
  int inCorners = 0;
  for (int appended = 0, n = 0; n < 100'000 && outcomeOf(*group, kAll) != Outcome::Done; ++n) {
    for (; appended < kAll && hasRoom(*group); ++appended) {
      Pose to = from;
      to.place = from.place + Vector3{random.uniform(4, 9), random.uniform(-6, 6), 0};
      append(*group, drawId(*group), lineLeg(from, to, MoreAxes{}), order);
      from = to;
    }
    cycle(*group, arm, {0.002, 1, false, 0, 128, 64});
    uint64_t id = 0;
    const double place = positionInMovement(*group, id);
    if (id == 0)
      continue;
    const Movement *const active = activeOf(*group);
    inCorners += active != nullptr && active->id != id ? 1 : 0;
    EXPECT_GE(place + static_cast<double>(id), last - 1e-9);
    last = place + static_cast<double>(id);
    if (HasFailure())
      return;
  }
  EXPECT_EQ(outcomeOf(*group, kAll), Outcome::Done);
  EXPECT_GT(inCorners, kAll);
}

Vector3 randomVector(Random &random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// A leg of a portal, and where it is at a part of it, as the test knows it.
struct KnownLeg {
  Leg leg;
  Vector3 start, first, second;
  double sweep; ///< Of a circle; 0: a line. [rad]

  Vector3 at(double part) const {
    if (sweep > 0)
      return start + first * std::cos(part * sweep) + second * std::sin(part * sweep);
    return start + first * part;
  }
};

KnownLeg randomLeg(Random &random) {
  KnownLeg known{};
  known.start = randomVector(random, 100);
  known.first = randomVector(random, 100);
  const Frame<double> from{Matrix<double>::Identity(), vectorOf(known.start)};
  const int kind = random.below(3);
  if (kind == 0) {
    const Frame<double> to{Matrix<double>::Identity(), vectorOf(known.start + known.first)};
    known.leg = lineLeg(poseOf(from), poseOf(to), MoreAxes{});
  } else if (kind == 1) {
    Vector3 across = stride::numeric::cross(known.first, randomVector(random, 1));
    known.second = across * (stride::numeric::norm(known.first) / stride::numeric::norm(across));
    known.sweep = random.uniform(0.1, 6.2);
    const Pose begin{known.start + known.first, {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    known.leg =
        circleLeg(begin, {known.start, known.first, known.second, known.sweep}, begin, MoreAxes{});
  } else {
    const Vector3 to = known.start + known.first;
    known.leg = axesLeg({known.start.x, known.start.y, known.start.z}, {to.x, to.y, to.z},
                        {80, 120, 100, 1, 1, 1, 1, 1, 1, 1}, 70);
  }
  return known;
}

TEST(GroupTrigger, PlanesAreWhereTheToolComesIntoThem) {
  constexpr int kPlaces = 4001;
  Random random(20261124);
  const Machine machine = gantry();
  const Arm arm = machine.arm();
  int crossed = 0;
  for (int n = 0; n < 1500; ++n) {
    SCOPED_TRACE(n);
    const KnownLeg known = randomLeg(random);
    Plane plane{};
    plane.normal = randomVector(random, 1);
    plane.normal = plane.normal * (1 / stride::numeric::norm(plane.normal));
    plane.distance = random.uniform(0, 120);
    const auto height = [&](double part) {
      return stride::numeric::dot(plane.normal, known.at(part)) - plane.distance;
    };
    double expected = -1;
    for (int i = 1; i < kPlaces && expected < 0; ++i) {
      double low = (i - 1.0) / (kPlaces - 1);
      double high = static_cast<double>(i) / (kPlaces - 1);
      if ((height(low) < 0) == (height(high) < 0))
        continue;
      const bool below = height(low) < 0;
      for (int half = 0; half < 60; ++half) {
        const double middle = (low + high) / 2;
        ((height(middle) < 0) == below ? low : high) = middle;
      }
      expected = high * known.leg.length;
    }
    const double way = wayInPlane(arm, known.leg, plane);
    if (expected < 0) { // but for one that is touched between two of the test's places
      EXPECT_LT(way < 0 ? 0 : std::abs(height(way / known.leg.length)), 1e-9);
      continue;
    }
    ++crossed;
    EXPECT_NEAR(way, expected, 1e-9 * known.leg.length);
  }
  EXPECT_GT(crossed, 300);
}

/// A plane through a place; its normal vector is turned so that the distance is not negative.
Plane planeThrough(Random &random, const Vector3 &place) {
  Plane plane{};
  plane.normal = randomVector(random, 1);
  plane.normal = plane.normal * (1 / stride::numeric::norm(plane.normal));
  plane.distance = stride::numeric::dot(plane.normal, place);
  if (plane.distance < 0)
    plane = {plane.normal * -1.0, -plane.distance};
  return plane;
}

TEST(GroupTrigger, EndsOfLegsAreInPlanesThroughThem) {
  Random random(20261128);
  const Machine machine = gantry();
  const Arm arm = machine.arm();
  for (int n = 0; n < 20000 && !::testing::Test::HasFailure(); ++n) {
    SCOPED_TRACE(n);
    const KnownLeg known = randomLeg(random);
    EXPECT_EQ(wayInPlane(arm, known.leg, planeThrough(random, known.at(0))), 0);
    const Plane last = planeThrough(random, known.at(1));
    const double way = wayInPlane(arm, known.leg, last);
    ASSERT_GE(way, 0);
    const double height =
        stride::numeric::dot(last.normal, known.at(way / known.leg.length)) - last.distance;
    EXPECT_LT(std::abs(height), 1e-9);
    if (known.leg.kind == LegKind::Line) {
      EXPECT_NEAR(way, known.leg.length, 1e-9 * known.leg.length);
    }
  }
}

} // namespace
