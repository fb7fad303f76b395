// Corners between legs, judged by products of turns in numbers, by differences, and by the legs
// that they join.
#include "group_machines.hpp"
#include "motion_problems.hpp"

#include "runtime/numeric/group/arc.hpp"
#include "runtime/numeric/group/corner.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace {

using namespace stride::group;
using namespace stride::test;
using Turn = Eigen::Matrix3d;
using Point = Eigen::Vector3d;

/// How both legs of a corner turn the tool.
enum class Turns { Neither, FirstOnly, SecondOnly, AboutOneAxis, ThereAndBack, AboutTwoAxes };

Point randomDirection(Random &random) {
  const Point direction{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1, 1)};
  return direction.normalized();
}

Turn turnBy(double angle, const Point &about) {
  return Eigen::AngleAxisd(angle, about).toRotationMatrix();
}

Pose poseAt(const Point &place, const Turn &turn) {
  Pose pose{};
  pose.place = {place.x(), place.y(), place.z()};
  for (int i = 0; i < 9; ++i)
    pose.turn[i] = turn(i / 3, i % 3);
  return pose;
}

/// Two lines that meet, and the corner between them.
struct Scene {
  Leg before, after;
  double cutBefore, cutAfter;
  Corner corner;
  Turn middle;     ///< How the tool is turned where the lines meet.
  Point about[2];  ///< What it turns about on each.
  double angle[2]; ///< By how much. [rad]
};

Scene makeScene(Random &random, Turns turns) {
  Scene scene{};
  scene.middle = turnBy(random.uniform(-3, 3), randomDirection(random));
  scene.about[0] = turns == Turns::AboutOneAxis || turns == Turns::ThereAndBack
                       ? Point::UnitZ()
                       : randomDirection(random);
  scene.about[1] = turns == Turns::AboutTwoAxes ? randomDirection(random) : scene.about[0];
  scene.angle[0] = random.uniform(0.05, 1.5);
  scene.angle[1] = random.uniform(0.05, 1.5);
  if (turns == Turns::AboutOneAxis || turns == Turns::ThereAndBack)
    scene.middle = turnBy(random.uniform(-3, 3), Point::UnitZ());
  if (turns == Turns::ThereAndBack)
    scene.angle[1] = -scene.angle[1];
  if (turns == Turns::Neither || turns == Turns::SecondOnly)
    scene.angle[0] = 0;
  if (turns == Turns::Neither || turns == Turns::FirstOnly)
    scene.angle[1] = 0;
  const Point meet = 300 * randomDirection(random);
  const double lengths[] = {random.uniform(20, 200), random.uniform(20, 200)};
  const Point from = meet - lengths[0] * randomDirection(random);
  const Point to = meet + lengths[1] * randomDirection(random);
  const Turn first = turnBy(-scene.angle[0], scene.about[0]) * scene.middle;
  const Turn last = turnBy(scene.angle[1], scene.about[1]) * scene.middle;
  const MoreAxes more{{1, 2, 3, 4}, {1, 5, -7, 4.5}};
  const MoreAxes then{{1, 5, -7, 4.5}, {2, 5, -9, 4}};
  scene.before = lineLeg(poseAt(from, first), poseAt(meet, scene.middle), more);
  scene.after = lineLeg(poseAt(meet, scene.middle), poseAt(to, last), then);
  scene.cutBefore = random.uniform(0.05, 0.5) * scene.before.length;
  scene.cutAfter = random.uniform(0.05, 0.5) * scene.after.length;
  scene.corner = toolCorner(scene.before, scene.cutBefore, scene.after, scene.cutAfter);
  return scene;
}

PathPlace at(const Corner &corner, double way) {
  PathPlace place;
  placeAt(corner, growing(way, 1.0), place);
  return place;
}
PathPlace at(const Leg &leg, double way) {
  PathPlace place;
  placeAt(leg, growing(way, 1.0), place);
  return place;
}

Turn turnAt(const PathPlace &place) {
  Turn turn;
  for (int i = 0; i < 9; ++i)
    turn(i / 3, i % 3) = place.tool.turn(i / 3, i % 3).c[0];
  return turn;
}

/// All numbers of a place: the point, the orientation, the axes that go along.
constexpr int kNumbers = 12 + kMoreAxes;
const Series &numberOf(const PathPlace &place, int i) {
  if (i < 3)
    return place.tool.place(i);
  return i < 12 ? place.tool.turn((i - 3) / 3, (i - 3) % 3) : place.axes[kArmAxes + i - 12];
}

/// The polynomial of degree 5 between two lines: with their directions, and bent at neither end.
/// Its place over u, and how fast that goes.
struct Curve {
  Point start, end;
  Point first, last; ///< Derivatives at the ends.

  Point speedAt(double u) const {
    // The derivative has no slope at the ends, and brings the place from start to end.
    const double v = 1 - u;
    const Point missing = end - start - 0.5 * (first + last);
    return first * (v * v * (1 + 2 * u)) + last * (u * u * (1 + 2 * v)) +
           missing * (30 * u * u * v * v);
  }
  /// By Simpson's rule.
  double lengthTo(double u) const {
    constexpr int kParts = 2000;
    double sum = 0;
    for (int i = 0; i < kParts; ++i)
      sum += speedAt(u * i / kParts).norm() + 4 * speedAt(u * (i + 0.5) / kParts).norm() +
             speedAt(u * (i + 1) / kParts).norm();
    return sum * u / (6 * kParts);
  }
};

Point pointOf(const PathPlace &place) {
  return {place.tool.place(0).c[0], place.tool.place(1).c[0], place.tool.place(2).c[0]};
}
Point directionOf(const Leg &leg) { return {leg.first.x, leg.first.y, leg.first.z}; }

Curve curveOf(const Scene &scene) {
  return {pointOf(at(scene.before, scene.before.length - scene.cutBefore)),
          pointOf(at(scene.after, scene.cutAfter)), directionOf(scene.before) / scene.corner.first,
          directionOf(scene.after) / scene.corner.last};
}

/// A way that comes to rest at 0 from `begin` with `speed`, over a parameter from 0 to 1.
double comingToRest(double begin, double speed, double u) {
  const double v = 1 - u; // seen from the end: v^3 (a + b v + c v^2), with no change of speed at 1
  const double a = 10 * begin + 4 * speed;
  const double b = -15 * begin - 7 * speed;
  const double c = 6 * begin + 3 * speed;
  return v * v * v * (a + v * (b + v * c));
}

class GroupCorner : public ::testing::TestWithParam<Turns> {};

TEST_P(GroupCorner, TurnsByTheProductOfWhatItsLegsTurn) {
  Random random(7101U + static_cast<unsigned>(GetParam()) * 10U);
  for (int i = 0; i < 200; ++i) {
    const Scene scene = makeScene(random, GetParam());
    ASSERT_GT(scene.corner.length, 0);
    const Curve curve = curveOf(scene);
    EXPECT_NEAR(curve.lengthTo(1), scene.corner.length, 1e-9 * scene.corner.length);
    for (const double u : {0.0, 0.11, 0.5, 0.83, 1.0}) {
      const double left = comingToRest(-scene.cutBefore, 1 / scene.corner.first, u);
      const double entered = -comingToRest(-scene.cutAfter, 1 / scene.corner.last, 1 - u);
      const double angles[] = {scene.angle[0] * left / scene.before.length,
                               scene.angle[1] * entered / scene.after.length};
      const Turn wanted =
          turnBy(angles[1], scene.about[1]) * turnBy(angles[0], scene.about[0]) * scene.middle;
      const double way = u < 1 ? curve.lengthTo(u) : scene.corner.length;
      const Turn turn = turnAt(at(scene.corner, way));
      EXPECT_LT((turn - wanted).norm(), 1e-9) << "parameter " << u;
      EXPECT_LT((turn.transpose() * turn - Turn::Identity()).norm(), 1e-14);
    }
  }
}

TEST_P(GroupCorner, ItsSeriesAreThoseOfDifferences) {
  Random random(7102U + static_cast<unsigned>(GetParam()) * 10U);
  for (int i = 0; i < 200; ++i) {
    const Scene scene = makeScene(random, GetParam());
    const double length = scene.corner.length;
    const double way = random.uniform(0.01, 0.99) * length;
    const PathPlace place = at(scene.corner, way);
    // Corners whose cuts differ much bend within a small part of their way.
    const auto bend = [&place](int k) { return 2 * place.tool.place(k).c[2]; };
    const double scale = std::min(length, 1 / Point{bend(0), bend(1), bend(2)}.norm());
    const double step = std::min({1e-3 * scale, 0.4 * way, 0.4 * (length - way)});
    const PathPlace places[] = {at(scene.corner, way - 2 * step), at(scene.corner, way - step),
                                at(scene.corner, way + step), at(scene.corner, way + 2 * step)};
    for (int k = 0; k < kNumbers; ++k)
      for (int order = 0; order < 3; ++order) {
        const auto value = [&](int n) { return numberOf(places[n], k).c[order]; };
        const double slope = (8 * (value(2) - value(1)) - (value(3) - value(0))) / (12 * step);
        const double unit = std::pow(scale, order + 1);
        const bool isTurn = k >= 3 && k < 12;
        EXPECT_NEAR((order + 1) * numberOf(place, k).c[order + 1] * unit, slope * unit,
                    1e-6 * std::max(1.0, std::fabs(slope * unit)) * (isTurn ? 1 : 1 + length))
            << "number " << k << " order " << order;
      }
  }
}

TEST_P(GroupCorner, JoinsItsLegsWithoutAJumpOfVelocityAndAcceleration) {
  Random random(7103U + static_cast<unsigned>(GetParam()) * 10U);
  for (int i = 0; i < 200; ++i) {
    const Scene scene = makeScene(random, GetParam());
    const PathPlace ends[2][2] = {
        {at(scene.before, scene.before.length - scene.cutBefore), at(scene.corner, 0)},
        {at(scene.corner, scene.corner.length), at(scene.after, scene.cutAfter)}};
    for (const auto &end : ends)
      for (int k = 0; k < kNumbers; ++k)
        for (int order = 0; order < 3; ++order)
          EXPECT_NEAR(numberOf(end[0], k).c[order], numberOf(end[1], k).c[order],
                      order == 0 ? 1e-12 * 1000 : 1e-11)
              << "number " << k << " order " << order;
  }
}

/// Where the axes lead, the way does not go evenly with the parameter.
TEST(GroupCornerOfAxes, ItsSeriesAreThoseOfDifferences) {
  Random random(7104);
  for (int i = 0; i < 200; ++i) {
    AxesEnd ends[2];
    for (AxesEnd &end : ends) {
      end.cut = random.uniform(1, 20);
      for (Series &axis : end.axes)
        for (double &c : axis.c)
          c = random.uniform(-1, 1) / end.cut;
    }
    const Corner corner = axesCorner(ends[0], ends[1]);
    const double step = 1e-4 * corner.length;
    const double way = random.uniform(0.01, 0.99) * corner.length;
    const PathPlace before = at(corner, way - step);
    const PathPlace place = at(corner, way);
    const PathPlace after = at(corner, way + step);
    for (int k = 0; k < kAxes; ++k)
      for (int order = 0; order < 3; ++order) {
        const double slope = (after.axes[k].c[order] - before.axes[k].c[order]) / (2 * step);
        const double unit = std::pow(corner.length, order + 1);
        EXPECT_NEAR((order + 1) * place.axes[k].c[order + 1] * unit, slope * unit, 2e-3)
            << "axis " << k << " order " << order;
      }
  }
}

/// A portal that goes along two lines with a corner by distance, cycle by cycle.
struct TwoLines {
  Point start, middle, end;
  double distance; ///< Of the command. [u]

  /// How far a place is beside a line of the given direction through the middle.
  double beside(const Point &place, const Point &direction) const {
    const Point way = place - middle;
    return (way - direction * way.dot(direction)).norm();
  }
  Point first() const { return (middle - start).normalized(); }
  Point second() const { return (end - middle).normalized(); }
  /// The corner takes half of a line at most.
  double cut() const {
    return std::min({distance, 0.5 * (middle - start).norm(), 0.5 * (end - middle).norm()});
  }
};

TwoLines randomLines(Random &random, int number) {
  TwoLines lines{};
  const double length = random.uniform(20, 60);
  lines.start = {random.uniform(-50, 50), random.uniform(-50, 50), 7};
  lines.middle = lines.start + length * randomDirection(random);
  lines.end = lines.middle + length * random.uniform(0.7, 1.6) * randomDirection(random);
  const double half = 0.5 * std::min(length, (lines.end - lines.middle).norm());
  // Below, at and above what the lines have for it.
  lines.distance = half * (number % 3 == 0 ? random.uniform(0.05, 0.95) : number % 3);
  return lines;
}

/// Places of the tool: how many of them are on the lines and in the corner.
struct Seen {
  int onLines = 0;
  int inCorner = 0;
};

/// Before the distance from the middle the tool is on the first line, after it on the second one,
/// and in between beside both.
void look(const TwoLines &lines, const Point &place, Seen &seen) {
  const double before = -(place - lines.middle).dot(lines.first());
  const double after = (place - lines.middle).dot(lines.second());
  const double besideFirst = lines.beside(place, lines.first());
  const double besideSecond = lines.beside(place, lines.second());
  const double cut = lines.cut();
  if (before >= cut || after >= cut) { // where the path turns back, both
    const double beside = std::min(before >= cut ? besideFirst : 1e9, // [u]
                                   after >= cut ? besideSecond : 1e9);
    EXPECT_LE(beside, 1e-9) << before << " before the middle, " << after << " after, cut " << cut;
    ++seen.onLines;
  } else if (before < 0.97 * cut && after < 0.97 * cut) {
    EXPECT_GT(std::min(besideFirst, besideSecond), 1e-9) << before << ", " << after;
    ++seen.inCorner;
  }
}

TEST(GroupCornerDistance, IsKeptAsCommanded) {
  Random random(4711);
  Seen seen;
  for (int i = 0; i < casesOf(150) && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i);
    Machine machine = gantry();
    for (AxisLimits &limits : machine.limits)
      limits = {300, 3000, 60000, -1e4, 1e4};
    const TwoLines lines = randomLines(random, i);
    const Pose poses[] = {poseAt(lines.start, Turn::Identity()),
                          poseAt(lines.middle, Turn::Identity()),
                          poseAt(lines.end, Turn::Identity())};
    const auto group = std::make_unique<GroupMotion>();
    const double home[kAxes] = {lines.start.x(), lines.start.y(), lines.start.z()};
    reset(*group, home);
    for (int k = 0; k < 2; ++k) {
      Order order{};
      order.path = {random.uniform(50, 400), 4000, 3000, 80000};
      order.velocityFactor = order.accelerationFactor = order.jerkFactor = 1;
      order.transition = Transition::Distance;
      order.transitionValue = lines.distance;
      append(*group, drawId(*group), lineLeg(poses[k], poses[k + 1], {}), order);
    }
    for (int n = 0; n < 20'000 && group->first < group->next; ++n) {
      cycle(*group, machine.arm(), {0.001, 1, false, 0, 64, 64});
      look(lines, {group->axes[0], group->axes[1], group->axes[2]}, seen);
    }
    EXPECT_EQ(group->first, group->next);
  }
  EXPECT_GT(seen.onLines, casesOf(5000));
  EXPECT_GT(seen.inCorner, casesOf(3000));
}

INSTANTIATE_TEST_SUITE_P(AllTurns, GroupCorner,
                         ::testing::Values(Turns::Neither, Turns::FirstOnly, Turns::SecondOnly,
                                           Turns::AboutOneAxis, Turns::ThereAndBack,
                                           Turns::AboutTwoAxes));

/// Two lines, or a line and a circle, and the corner between them: of any cuts.
struct Bend {
  Leg before, after;
  double cutBefore, cutAfter;
};

Leg randomLeg(Random &random, const Pose &from, const Pose &to, bool round) {
  using namespace stride::numeric;
  const Vector3 chord = to.place - from.place;
  const Vector3 side = cross(chord, {random.uniform(-1, 1), random.uniform(-1, 1), 1});
  const Vector3 border =
      from.place + chord * 0.5 + side * (random.uniform(0.05, 0.4) * norm(chord) / norm(side));
  Arc arc{};
  if (round && arcThrough(from.place, border, to.place, arc) == ArcFault::None)
    return circleLeg(from, arc, to, {});
  return lineLeg(from, to, {});
}

Bend randomBend(Random &random, bool round) {
  const double turn = random.uniform(0, 0.94 * M_PI);
  const double side = random.uniform(-M_PI, M_PI);
  Pose poses[3]{};
  for (Pose &pose : poses)
    stride::group::setRows(pose.turn, Matrix<double>::Identity());
  const double first = random.magnitude(1, 2.5);
  const double second = random.magnitude(1, 2.5);
  poses[1].place = {first, 0, 0};
  poses[2].place =
      poses[1].place + Vector3{second * std::cos(turn), second * std::sin(turn) * std::cos(side),
                               second * std::sin(turn) * std::sin(side)};
  const bool which = random.chance(0.5);
  Bend bend{randomLeg(random, poses[0], poses[1], round && which),
            randomLeg(random, poses[1], poses[2], round && !which), 0, 0};
  bend.cutBefore = 0.5 * bend.before.length * random.magnitude(-2, 0);
  bend.cutAfter = 0.5 * bend.after.length * random.magnitude(-2, 0);
  return bend;
}

/// Along a corner the tool is as fast as the motion along its way, so that what a command says of
/// its velocity, acceleration and jerk counts, and a seam is welded, or glue laid, evenly.
TEST(GroupCornerOfLines, IsGoneThroughEvenly) {
  using stride::numeric::norm;
  double worst = 0;
  for (int i = 0; i < casesOf(800) && !HasFailure(); ++i) {
    Random random(9000U + static_cast<unsigned>(i));
    const Bend bend = randomBend(random, i % 2 == 0);
    const Corner corner = toolCorner(bend.before, bend.cutBefore, bend.after, bend.cutAfter);
    Vector3 last = {};
    double length = 0;
    for (int n = 0; n <= 4000; ++n) {
      const PathPlace place = at(corner, corner.length * n / 4000);
      const auto value = [&place](int order) {
        return Vector3{place.tool.place(0).c[order], place.tool.place(1).c[order],
                       place.tool.place(2).c[order]};
      };
      const double speed = norm(value(1));
      const double change = 2 * dot(value(1), value(2)) / speed;
      worst = std::max(worst, std::fabs(speed - 1));
      EXPECT_NEAR(speed, 1, 1e-12) << "case " << i << ", at " << n;
      EXPECT_NEAR(change, 0, 1e-10 * (1 + norm(value(2)))) << "case " << i << ", at " << n;
      length += n > 0 ? norm(value(0) - last) : 0;
      last = value(0);
    }
    EXPECT_LE(length, corner.length * (1 + 1e-9)) << "case " << i;
    EXPECT_GE(length, corner.length * (1 - 1e-3)) << "case " << i;
  }
  printf("the tool's velocity changes by %.2g at most\n", worst);
}

/// However much their cuts differ, a corner of two lines stays within the triangle between them.
TEST(GroupCornerOfLines, StaysInsideTheirTriangle) {
  for (int i = 0; i < casesOf(800) && !HasFailure(); ++i) {
    Random random(9900U + static_cast<unsigned>(i));
    const Bend bend = randomBend(random, false);
    const Corner corner = toolCorner(bend.before, bend.cutBefore, bend.after, bend.cutAfter);
    const Point meet = pointOf(at(bend.before, bend.before.length));
    Eigen::Matrix<double, 3, 2> sides;
    sides << -bend.cutBefore * directionOf(bend.before), bend.cutAfter * directionOf(bend.after);
    for (int n = 0; n <= 400; ++n) {
      // The place by its parts of both sides of the triangle, and what is beside its plane.
      const Point off = pointOf(at(corner, corner.length * n / 400)) - meet;
      const Eigen::Vector2d part = sides.colPivHouseholderQr().solve(off);
      const double slack = 1e-9 / std::sin(0.05);
      EXPECT_GE(part.minCoeff(), -slack) << "case " << i << ", at " << n;
      EXPECT_LE(part.sum(), 1 + slack) << "case " << i << ", at " << n;
    }
  }
}

} // namespace
