// Corners between legs, judged by products of turns in numbers, by differences, and by the legs
// that they join.
#include "group_machines.hpp"
#include "motion_problems.hpp"

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

/// How far the parameter of a corner is at a part of its way: from both ends' speeds.
double parameterAt(const Corner &corner, double part) {
  const double change = corner.last - corner.first;
  return corner.length *
         (corner.first * part + change * (std::pow(part, 3) - std::pow(part, 4) / 2));
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
    for (const double part : {0.0, 0.11, 0.5, 0.83, 1.0}) {
      const double u = parameterAt(scene.corner, part);
      const double left = comingToRest(-scene.cutBefore, 1 / scene.corner.first, u);
      const double entered = -comingToRest(-scene.cutAfter, 1 / scene.corner.last, 1 - u);
      const double angles[] = {scene.angle[0] * left / scene.before.length,
                               scene.angle[1] * entered / scene.after.length};
      const Turn wanted =
          turnBy(angles[1], scene.about[1]) * turnBy(angles[0], scene.about[0]) * scene.middle;
      const Turn turn = turnAt(at(scene.corner, part * scene.corner.length));
      EXPECT_LT((turn - wanted).norm(), 1e-13) << "part " << part;
      EXPECT_LT((turn.transpose() * turn - Turn::Identity()).norm(), 1e-14);
    }
  }
}

TEST_P(GroupCorner, ItsSeriesAreThoseOfDifferences) {
  Random random(7102U + static_cast<unsigned>(GetParam()) * 10U);
  for (int i = 0; i < 200; ++i) {
    const Scene scene = makeScene(random, GetParam());
    const double length = scene.corner.length;
    const double step = 1e-4 * length;
    const double way = random.uniform(0.01, 0.99) * length;
    const PathPlace before = at(scene.corner, way - step);
    const PathPlace place = at(scene.corner, way);
    const PathPlace after = at(scene.corner, way + step);
    for (int k = 0; k < kNumbers; ++k)
      for (int order = 0; order < 3; ++order) {
        const double slope =
            (numberOf(after, k).c[order] - numberOf(before, k).c[order]) / (2 * step);
        const double unit = std::pow(length, order + 1);
        const bool isTurn = k >= 3 && k < 12;
        EXPECT_NEAR((order + 1) * numberOf(place, k).c[order + 1] * unit, slope * unit,
                    1e-5 * (isTurn ? 1 : 1 + length))
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

/// Along a corner between two lines the tool is about as fast as the motion along its way, so that
/// a seam is welded, or glue laid, evenly.
TEST(GroupCornerOfLines, IsGoneThroughEvenly) {
  using stride::numeric::norm;
  double worst = 0;
  for (int i = 0; i < casesOf(500); ++i) {
    Random random(9000U + static_cast<unsigned>(i));
    const double turn = random.uniform(0, 0.5 * M_PI);
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
    const double cut = 0.5 * std::min(first, second) * random.uniform(0.01, 1);
    const Corner corner =
        toolCorner(lineLeg(poses[0], poses[1], {}), cut, lineLeg(poses[1], poses[2], {}), cut);
    for (int n = 0; n <= 200; ++n) {
      PathPlace place;
      placeAt(corner, growing(corner.length * n / 200, 1.0), place);
      const double speed =
          norm({place.tool.place(0).c[1], place.tool.place(1).c[1], place.tool.place(2).c[1]});
      worst = std::max(worst, std::fabs(speed - 1));
      EXPECT_NEAR(speed, 1, 0.0025) << "case " << i << ", turn " << turn << ", at " << n;
    }
  }
  printf("the tool's velocity changes by %.5f at most\n", worst);
}

} // namespace
