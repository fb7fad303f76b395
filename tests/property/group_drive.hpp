// Drives random movements with random arms, for tests: every axis keeps its limits in every cycle,
// nothing jumps, lines are straight, movements end where they should, and all of them end.
#ifndef STRIDE_TESTS_PROPERTY_GROUP_DRIVE_HPP
#define STRIDE_TESTS_PROPERTY_GROUP_DRIVE_HPP

#include "group_problems.hpp"

#include "runtime/numeric/group/arc.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <vector>

namespace stride::test {

using namespace stride::group;

/// How fast something is, and how fast that changes: by `count` numbers over time.
struct ToolRate {
  double speed = 0;
  double change = 0;
};
inline ToolRate rateOf(const Series *series, int count, double unit) {
  double square = 0;
  double product = 0;
  for (int i = 0; i < count; ++i) {
    square += series[i].c[1] * series[i].c[1];
    product += 2 * series[i].c[1] * series[i].c[2];
  }
  const double speed = std::sqrt(square);
  return {speed * unit, speed > 0 ? product / speed * unit : 0};
}

/// Drives random movements.
class GroupDrive {
  static constexpr int kParts = 16; ///< Of a cycle, between which limits are looked at.

public:
  /// `rarely`: of so many cycles one is looked at in parts. `corners`: movements mostly lead
  /// through corners. `givesAxes`: on most legs the tool axes go evenly.
  GroupDrive(unsigned seed, int rarely, bool corners, bool givesAxes = false)
      : random_(seed),
        machine_(givesAxes ? randomMachineWithToolAxes(random_) : randomMachine(random_)),
        group_(std::make_unique<GroupMotion>()), cycle_(random_.magnitude(-3.3, -2.7)),
        arm_(machine_.arm()), given_(givesAxes ? toolAxesOf(machine_) : 0), corners_(corners),
        keep_(seed % 3 == 0 ? 0.03 * (seed % 8) : 0), atOnce_(seed % 2 == 0), rarely_(rarely),
        stopJerk_(seed % 5 < 2 ? 1e12 : 0) {
    reset(*group_, machine_.home);
    std::copy(std::begin(machine_.home), std::end(machine_.home), planned_);
  }

  /// Movements that are commanded all at once, or one by one.
  void run(int movements) {
    left_ = movements;
    const bool atOnce = corners_ || random_.chance(0.5);
    if (atOnce)
      while (left_ > 0)
        order();
    for (int64_t n = 0; n < 400'000; ++n) {
      if (!atOnce && left_ > 0 && hasRoom(*group_) && random_.chance(0.005))
        order();
      if (left_ == 0 && group_->first == group_->next && isAtRest(*group_)) {
        arrived();
        return;
      }
      step();
      if (testing::Test::HasFailure() || failed_)
        return;
    }
    ADD_FAILURE() << "stuck at " << group_->motion.way << ", movement " << group_->first << " of "
                  << group_->next;
  }

  bool hasFailed() const { return failed_; }

  /// At how many places the tool's path has been looked at.
  int64_t looked() const { return looked_; }
  int64_t cornersLooked() const { return cornersLooked_; }

  /// How many legs have begun on which the tool axes go, and how often a wrist has been in line.
  int64_t givenLooked() const { return givenLooked_; }
  int64_t inLine() const { return inLine_; }

private:
  void randomAxes(double (&axes)[kAxes]) {
    for (int k = 0; k < kAxes; ++k) {
      const bool wide = k >= kArmAxes || isGiven(given_, k);
      axes[k] = !isOfMachine(machine_, k)
                    ? 0
                    : machine_.home[k] + random_.uniform(-1, 1) * (wide ? 100 : machine_.spread);
    }
  }

  Pose poseAt(const double (&axes)[kAxes]) {
    Frame<double> frame;
    EXPECT_EQ(arm_.kinematics.forward(axes, frame), kinematics::Outcome::Done);
    return poseOf(frame);
  }

  void order() {
    --left_;
    double to[kAxes];
    randomAxes(to);
    Order order{};
    const double speed = random_.magnitude(1.7, 3);
    order.path = {speed, speed * random_.magnitude(0, 1.5), speed * random_.magnitude(0, 1.5), 0};
    order.path.jerk = order.path.acceleration * random_.magnitude(0.5, 2);
    order.velocityFactor = random_.chance(0.5) ? 1 : random_.uniform(0.3, 1);
    order.accelerationFactor = random_.chance(0.5) ? 1 : random_.uniform(0.3, 1);
    order.jerkFactor = random_.chance(0.5) ? 1 : random_.uniform(0.3, 1);
    order.configuration = arm_.configuration;
    order.transition = static_cast<Transition>(corners_ ? 1 + random_.below(2) : random_.below(3));
    order.transitionValue = order.transition == Transition::Distance ? random_.magnitude(0, 2)
                                                                     : random_.uniform(0.1, 2);
    order.cornerSpeed = static_cast<CornerSpeed>(random_.below(4));
    if (!corners_ && random_.chance(0.1)) {
      order.dwell = random_.uniform(0.001, 0.1);
      append(*group_, drawId(*group_), Leg{}, order);
      return;
    }
    Leg leg{};
    MoreAxes more{};
    for (int k = 0; k < kMoreAxes; ++k) {
      more.from[k] = planned_[kArmAxes + k];
      more.to[k] = to[kArmAxes + k];
    }
    if (given_ != 0 && random_.chance(0.9)) {
      leg = givenLeg(to, more);
      order.configuration = arm_.kinematics.placingConfigurationOf(planned_);
    } else if (given_ == 0 ? random_.chance(corners_ ? 0.95 : 0.7)
                           : turnsLittle(machine_, given_, planned_, to)) {
      order.configuration = arm_.kinematics.configurationOf(planned_);
      if (corners_ && random_.chance(0.2) && turnOnTheSpot(to))
        leg = lineLeg(poseAt(planned_), turnedHere(to), more);
      else
        leg = toolLeg(poseAt(planned_), poseAt(to), more);
    } else {
      double perTime[kAxes];
      for (int k = 0; k < kAxes; ++k)
        perTime[k] = machine_.limits[k].velocity;
      leg = axesLeg(planned_, to, perTime, 300);
    }
    if (!(leg.length > 0))
      return;
    const uint64_t id = drawId(*group_);
    append(*group_, id, leg, order);
    before_[id] = last_;
    last_ = order.path;
    std::copy(std::begin(to), std::end(to), planned_);
    factors_.push_back(order);
  }

  /// The tool where it is, but turned as it is where the axes say.
  Pose turnedHere(const double (&axes)[kAxes]) {
    Pose pose = poseAt(axes);
    pose.place = poseAt(planned_).place;
    return pose;
  }

  /// The axes where the tool is turned as they say, but its point is where it is. False: there is
  /// no such place.
  bool turnOnTheSpot(double (&to)[kAxes]) {
    PathPlace place;
    place.byTool = true;
    place.alsoTurns = false;
    place.tool = seriesOf(frameOf(turnedHere(to)));
    for (int k = kArmAxes; k < kAxes; ++k)
      place.axes[k] = Series(to[k]);
    Series axes[kAxes]{};
    const Obstacle obstacle = axesAt(arm_, place, planned_, axes);
    if (obstacle != Obstacle::None && obstacle != Obstacle::Singular)
      return false;
    for (int k = 0; k < machine_.joints; ++k)
      to[k] = axes[k].c[0];
    return true;
  }

  /// A leg on which tool axes go evenly; sometimes the tool's point stays, as `to` will say. No
  /// length: the placing axes would have to change their configuration.
  Leg givenLeg(double (&to)[kAxes], const MoreAxes &more) {
    const kinematics::Configuration placing = arm_.kinematics.placingConfigurationOf(planned_);
    const Pose from = poseAt(planned_);
    Pose end = poseAt(to);
    if (corners_ && random_.chance(0.2)) {
      end.place = from.place;
      if (arm_.kinematics.place(vectorOf(end.place), placing, planned_, to) !=
          kinematics::Outcome::Done)
        return {};
    }
    if (!(arm_.kinematics.placingConfigurationOf(to) == placing))
      return {};
    Leg leg = toolLeg(from, end, more);
    giveToolAxes(leg, given_, planned_, to);
    return leg;
  }

  /// A line, or a flat arc, which stays within reach.
  Leg toolLeg(const Pose &from, const Pose &to, const MoreAxes &more) {
    using namespace stride::numeric;
    Arc arc{};
    const Vector3 chord = to.place - from.place;
    const Vector3 side = cross(chord, {random_.uniform(-1, 1), random_.uniform(-1, 1), 1});
    const Vector3 border = from.place + chord * random_.uniform(0.3, 0.7) +
                           side * (random_.uniform(0.01, 0.3) * norm(chord) / norm(side));
    const bool goes = norm(chord) > 1e-6 && machine_.joints >= 3;
    if (goes && random_.chance(0.4) &&
        arcThrough(from.place, border, to.place, arc) == ArcFault::None)
      return circleLeg(from, arc, to, more);
    return lineLeg(from, to, more);
  }

  /// One cycle. Now and then it is gone through in parts before, each of which is looked at.
  void step() {
    disturb();
    GroupCommand command{
        cycle_, override_, stopped_ > 0, 0, std::max(1, static_cast<int>(cycle_ * 64000)), 64};
    command.keep = keep_;
    command.atOnce = atOnce_;
    command.jerk = stopJerk_;
    plan(*group_, arm_, command);
    if (random_.chance(1.0 / rarely_))
      lookAtParts(command);
    goOnBy(command);
    (void)rebase(*group_);
    relocate();
  }

  /// A copy goes through the cycle in parts, and ends where the group will be.
  void lookAtParts(GroupCommand command) {
    auto copy = std::make_unique<GroupMotion>();
    std::memcpy(copy.get(), group_.get(), sizeof(GroupMotion));
    std::swap(group_, copy);
    onPath_ = nullptr;
    command.cycle = cycle_ / kParts;
    for (int part = 0; part < kParts && !failed_; ++part) {
      goOnBy(command);
      lookAtPath(command.cycle);
    }
    std::swap(group_, copy);
  }

  void goOnBy(const GroupCommand &command) {
    const GroupMotion &now = *group_;
    double axes[kAxes];
    double velocity[kAxes];
    double acceleration[kAxes];
    std::copy(std::begin(now.axes), std::end(now.axes), axes);
    std::copy(std::begin(now.velocity), std::end(now.velocity), velocity);
    std::copy(std::begin(now.acceleration), std::end(now.acceleration), acceleration);
    goOn(*group_, arm_, command);
    failed_ = now.obstacle != Obstacle::None; // a line that the arm cannot follow
    if (failed_)
      return;
    lookAtTool();
    lookAtAxes(axes, velocity, acceleration, command.cycle);
  }

  void lookAtAxes(const double (&axes)[kAxes], const double (&velocity)[kAxes],
                  const double (&acceleration)[kAxes], double t) {
    for (int k = 0; k < kAxes; ++k) {
      if (!isOfMachine(machine_, k))
        continue;
      const AxisLimits &limits = machine_.limits[k];
      const double change = group_->acceleration[k] - acceleration[k];
      const double moved = group_->axes[k] - axes[k];
      const double by = 0.5 * t * (velocity[k] + group_->velocity[k]);
      const bool good =
          std::fabs(group_->velocity[k]) <= limits.velocity * (1 + 1e-6) &&
          std::fabs(group_->acceleration[k]) <= limits.acceleration * (1 + 1e-6) &&
          std::fabs(change) <= limits.jerk * t * (1 + 1e-4) + 1e-6 * limits.acceleration &&
          std::fabs(moved - by) <= limits.jerk * t * t * t / 6 + 1e-9;
      if (!good) // texts are dear
        ADD_FAILURE() << "axis " << k << " at way " << group_->motion.way << ", movement "
                      << group_->first << ": velocity " << group_->velocity[k] << " of "
                      << limits.velocity << ", acceleration " << group_->acceleration[k] << " of "
                      << limits.acceleration << ", jerk " << change / t << " of " << limits.jerk
                      << ", moved " << moved << " instead of " << by;
    }
  }

  /// The tool's point along its path [u], and how the tool turns [°]: through the arm, from the
  /// axes.
  void measureTool(ToolRate (&rates)[2]) const {
    Series axes[kAxes]{};
    for (int k = 0; k < machine_.joints; ++k) {
      axes[k].c[0] = group_->axes[k];
      axes[k].c[1] = group_->velocity[k];
      axes[k].c[2] = 0.5 * group_->acceleration[k];
    }
    Frame<Series> tool;
    EXPECT_EQ(arm_.kinematics.forward(axes, tool), kinematics::Outcome::Done);
    rates[0] = rateOf(&tool.place(0), 3, 1);
    rates[1] = rateOf(tool.turn.data(), 9, 180 / M_PI / std::sqrt(2));
    Series given[kArmAxes];
    int count = 0;
    for (int k = 0; k < kArmAxes; ++k)
      if (isGiven(activeGiven(), k))
        given[count++] = axes[k];
    if (count > 0)
      rates[1] = rateOf(given, count, 1);
  }

  /// The tool axes that are given where the group is.
  uint8_t activeGiven() const {
    const Movement *const movement = activeOf(*group_);
    if (movement == nullptr)
      return 0;
    return isInCorner(*movement) ? movement->corner.given : movement->leg.given;
  }

  /// The tool keeps what the commands allow along its path, on legs and in corners; where its point
  /// stops or starts in a corner, or stays on a leg, also as it turns.
  void lookAtPath(double t) {
    const Movement *const movement = activeOf(*group_);
    const bool inCorner = movement != nullptr && isInCorner(*movement);
    if (movement == nullptr || !(movement->leg.length > 0) ||
        !(inCorner ? movement->corner.byTool : movement->leg.kind != LegKind::Axes)) {
      onPath_ = nullptr;
      return;
    }
    const PathLimits limits = inCorner ? cornerLimits(*movement) : movement->order.path;
    ToolRate rates[2];
    measureTool(rates);
    const bool looks = onPath_ == movement && wasInCorner_ == inCorner && stopJerk_ == 0;
    const bool turns = inCorner ? !movement->corner.byLength : movement->leg.kind == LegKind::Turn;
    // Between two axes it may nearly turn round: its rate's amount changes in no time then.
    const bool turnsAboutOne =
        !inCorner || (movement->corner.given == 0 &&
                      (movement->corner.before.rate == 0 || movement->corner.after.rate == 0));
    for (int i = 0; i < (turns ? 2 : 1); ++i)
      lookAtRate(i == 0 ? "tool" : "tool's turn", inCorner, limits, rates[i],
                 looks && (i == 0 || turnsAboutOne)
                     ? std::fabs(rates[i].change - rates_[i].change) / t
                     : 0,
                 t);
    onPath_ = movement;
    wasInCorner_ = inCorner;
    std::copy(std::begin(rates), std::end(rates), rates_);
    ++(inCorner ? cornersLooked_ : looked_);
  }

  void lookAtRate(const char *what, bool inCorner, const PathLimits &limits, const ToolRate &rate,
                  double jerk, double t) {
    const bool good = rate.speed <= limits.velocity * (1 + 1e-6) &&
                      rate.change <= limits.acceleration * (1 + 1e-6) &&
                      -rate.change <= limits.deceleration * (1 + 1e-6) &&
                      jerk <= limits.jerk * (1 + 1e-4) + 1e-6 * limits.acceleration / t;
    if (!good)
      ADD_FAILURE() << "the " << what << (inCorner ? " in the corner" : "") << " at way "
                    << group_->motion.way << ", movement " << group_->first << ": velocity "
                    << rate.speed << " of " << limits.velocity << ", acceleration " << rate.change
                    << " of " << limits.acceleration << " and " << limits.deceleration << ", jerk "
                    << jerk << " of " << limits.jerk;
  }

  bool isInCorner(const Movement &movement) const {
    return movement.leg.length > 0 && group_->motion.way < movement.begin + movement.corner.length;
  }

  /// What a command allows of the corner into its movement.
  PathLimits cornerLimits(const Movement &movement) const {
    const PathLimits &before = before_.at(movement.id);
    const PathLimits &after = movement.order.path;
    const auto chosen = [&movement](double first, double second) {
      const double most[] = {std::min(first, second), first, second, std::max(first, second)};
      return most[static_cast<int>(movement.order.cornerSpeed)];
    };
    return {chosen(before.velocity, after.velocity),
            chosen(before.acceleration, after.acceleration),
            chosen(before.deceleration, after.deceleration), chosen(before.jerk, after.jerk)};
  }

  /// Along a line or a circle, the tool is on it.
  void lookAtTool() {
    const Movement *const movement = activeOf(*group_);
    if (movement == nullptr || !(movement->leg.length > 0) ||
        group_->motion.way < movement->begin + movement->corner.length)
      return;
    const Leg &leg = movement->leg;
    if (leg.kind != LegKind::Line && leg.kind != LegKind::Circle)
      return;
    Frame<double> tool;
    EXPECT_EQ(arm_.kinematics.forward(group_->axes, tool), kinematics::Outcome::Done);
    const Vector<double> way = tool.place - vectorOf(leg.start);
    const Vector<double> first = vectorOf(leg.first);
    double apart = (way - first * way.dot(first)).norm();
    if (leg.kind == LegKind::Circle) {
      const Vector<double> normal = first.cross(vectorOf(leg.second)).normalized();
      apart = std::hypot(way.dot(normal), (way - normal * way.dot(normal)).norm() - leg.radius);
    }
    if (!(apart <= 1e-9))
      ADD_FAILURE() << "the tool is " << apart << " beside its path, movement " << group_->first;
    if (leg.given != 0)
      lookAtGiven(*movement, way);
  }

  /// Tool axes have gone the same part of their ways as the tool's point, `way` from leg.start.
  void lookAtGiven(const Movement &movement, const Vector<double> &way) {
    const Leg &leg = movement.leg;
    double along = way.dot(vectorOf(leg.first));
    if (leg.kind == LegKind::Circle) {
      along = leg.radius * std::atan2(way.dot(vectorOf(leg.second)), way.dot(vectorOf(leg.first)));
      along += along < -1e-9 ? 2 * M_PI * leg.radius : 0;
    }
    ++givenLooked_;
    for (int k = 0; k < kArmAxes; ++k) {
      if (!isGiven(leg.given, k))
        continue;
      const double gone = leg.delta[k] * along / leg.length;
      EXPECT_NEAR(group_->axes[k] - leg.from[k], gone, 1e-9 * (1 + std::fabs(leg.delta[k]))) << k;
    }
    const double middle = std::sin(group_->axes[machine_.joints > 4 ? 4 : 0] * M_PI / 180);
    inLine_ += machine_.joints > 4 && middle * lastMiddle_ < 0 ? 1 : 0;
    lastMiddle_ = middle;
  }

  void disturb() {
    if (random_.chance(0.002))
      override_ = random_.chance(0.3) ? 1 : random_.uniform(0.3, 1);
    if (stopped_ > 0)
      --stopped_;
    else if (random_.chance(0.001))
      stopped_ = 300;
  }

  /// Moves everything to other memory.
  void relocate() {
    if (!random_.chance(0.01))
      return;
    auto copy = std::make_unique<GroupMotion>();
    std::memcpy(copy.get(), group_.get(), sizeof(GroupMotion));
    std::memset(group_.get(), 0xA5, sizeof(GroupMotion));
    group_ = std::move(copy);
  }

  void arrived() {
    for (int k = 0; k < kAxes; ++k) {
      if (isOfMachine(machine_, k)) {
        EXPECT_NEAR(group_->axes[k], planned_[k], 1e-9) << "axis " << k;
      }
    }
    for (uint64_t id = 1; id <= group_->lastId; ++id)
      EXPECT_EQ(outcomeOf(*group_, id), Outcome::Done) << id;
  }

  Random random_;
  Machine machine_;
  std::unique_ptr<GroupMotion> group_;
  double cycle_;
  Arm arm_;
  uint8_t given_;
  bool corners_;
  double keep_;
  bool atOnce_;
  int rarely_;
  double stopJerk_; ///< What the axes allow, to stop with; 0: what movements allow.
  double planned_[kAxes];
  std::vector<Order> factors_;
  double override_ = 1;
  int stopped_ = 0;
  int left_ = 0;
  bool failed_ = false;
  const Movement *onPath_ = nullptr; ///< Where the tool was in the part before; null: elsewhere.
  bool wasInCorner_ = false;
  ToolRate rates_[2]; ///< See measureTool: in that part.
  int64_t looked_ = 0;
  std::map<uint64_t, PathLimits> before_; ///< Of the movement before, by the one after it.
  PathLimits last_{};
  int64_t cornersLooked_ = 0;
  int64_t givenLooked_ = 0;
  int64_t inLine_ = 0;
  double lastMiddle_ = 0; ///< Sine of the wrist's middle axis.
};

} // namespace stride::test

#endif // STRIDE_TESTS_PROPERTY_GROUP_DRIVE_HPP
