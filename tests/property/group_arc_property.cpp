// Arcs of circular movements, judged by geometry: every place of them is as far from the centre, in
// the plane, and where they must pass they do; they begin and end where they should.
#include "motion_problems.hpp"

#include "runtime/numeric/group/arc.hpp"
#include "runtime/numeric/kinematics/orientation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace stride::group;
using namespace stride::test;
using stride::numeric::cross;
using stride::numeric::dot;
using stride::numeric::norm;

Vector3 randomPlace(Random &random) {
  return {random.uniform(-500, 500), random.uniform(-500, 500), random.uniform(-500, 500)};
}

/// Where a leg along the arc is after a part of it.
Vector3 placeOn(const Arc &arc, double part) {
  Pose pose{};
  pose.place = arc.centre + arc.first;
  pose.turn[0] = pose.turn[4] = pose.turn[8] = 1;
  const Leg leg = circleLeg(pose, arc, pose, {});
  PathPlace place;
  placeAt(leg, Series(part * leg.length), place);
  return {place.tool.place(0).c[0], place.tool.place(1).c[0], place.tool.place(2).c[0]};
}

constexpr double kTurn = 6.283185307179586;

/// All places of the arc are on the circle, and it leads from start to end.
void lookAt(const Arc &arc, const Vector3 &start, const Vector3 &end, double size) {
  const Vector3 normal = cross(arc.first, arc.second);
  const double radius = norm(arc.first);
  EXPECT_NEAR(norm(arc.second), radius, 1e-12 * size);
  EXPECT_NEAR(dot(arc.first, arc.second), 0, 1e-11 * radius * radius);
  EXPECT_GT(arc.sweep, 0);
  EXPECT_LT(arc.sweep, kTurn);
  EXPECT_LE(norm(placeOn(arc, 0) - start), 1e-12 * size);
  EXPECT_LE(norm(placeOn(arc, 1) - end), 1e-12 * size);
  for (int i = 1; i < 16; ++i) {
    const Vector3 out = placeOn(arc, i / 16.0) - arc.centre;
    EXPECT_NEAR(norm(out), radius, 1e-12 * size);
    EXPECT_NEAR(dot(out, normal) / norm(normal), 0, 1e-12 * size);
  }
}

/// How far an arc passes by a place, at least.
double missBy(const Arc &arc, const Vector3 &place) {
  const Vector3 out = place - arc.centre;
  const double radius = norm(arc.first);
  double angle = std::atan2(dot(out, arc.second), dot(out, arc.first));
  angle = angle < 0 ? angle + kTurn : angle;
  EXPECT_LE(angle, arc.sweep + 1e-12);
  return norm(placeOn(arc, std::fmin(angle / arc.sweep, 1)) - place) / (radius > 0 ? 1 : 0);
}

TEST(GroupArc, PassesThroughTheBorder) {
  for (int i = 0; i < casesOf(1000) && !HasFailure(); ++i) {
    Random random(100U + static_cast<unsigned>(i));
    const Vector3 start = randomPlace(random);
    const Vector3 border = start + randomPlace(random) * random.magnitude(-4, 0);
    const Vector3 end = start + randomPlace(random) * random.magnitude(-4, 0);
    Arc arc{};
    const ArcFault fault = arcThrough(start, border, end, arc);
    if (fault == ArcFault::Collinear) // one of both is much nearer to the start, or by chance
      continue;
    const double size = norm(start) + 20 * norm(arc.first);
    lookAt(arc, start, end, size);
    EXPECT_LE(missBy(arc, border), 1e-12 * size);
  }
}

TEST(GroupArc, GoesAboutTheCentreByBothWays) {
  for (int i = 0; i < casesOf(1000) && !HasFailure(); ++i) {
    Random random(5000U + static_cast<unsigned>(i));
    const Vector3 centre = randomPlace(random);
    const Vector3 out = randomPlace(random) * random.magnitude(-3, 0);
    Vector3 side = cross(out, randomPlace(random));
    side = side * (norm(out) / norm(side));
    const double angle = random.uniform(0.001, 3.14);
    const Vector3 start = centre + out;
    const Vector3 end = centre + out * std::cos(angle) + side * std::sin(angle);
    Arc near{};
    Arc far{};
    ASSERT_EQ(arcAbout(start, centre, end, ArcWay::CounterClockwise, near), ArcFault::None);
    ASSERT_EQ(arcAbout(start, centre, end, ArcWay::Clockwise, far), ArcFault::None);
    const double size = norm(centre) + norm(out);
    lookAt(near, start, end, size * 10);
    lookAt(far, start, end, size * 10);
    const double rounding = 1e-11 * size / norm(out);
    EXPECT_NEAR(near.sweep, angle, rounding);
    EXPECT_NEAR(far.sweep, kTurn - angle, rounding);
  }
}

/// The vector's thumb: counter-clockwise turns right-handed about it, with the centre on the left.
TEST(GroupArc, TurnsAboutItsNormal) {
  for (int i = 0; i < casesOf(1000) && !HasFailure(); ++i) {
    Random random(9000U + static_cast<unsigned>(i));
    const Vector3 start = randomPlace(random);
    const Vector3 chord = randomPlace(random) * random.magnitude(-3, 0);
    const Vector3 end = start + chord;
    Vector3 normal = cross(chord, randomPlace(random));
    const double radius =
        random.chance(0.1) ? 0.5 * norm(chord) : norm(chord) * random.uniform(0.501, 9);
    normal = normal * (radius / norm(normal));
    const double angle = 2 * std::asin(std::fmin(0.5 * norm(chord) / radius, 1));
    const double rounding = 1e-10 * (norm(start) + radius) / norm(chord);
    for (const ArcWay way : {ArcWay::Clockwise, ArcWay::CounterClockwise}) {
      Arc arc{};
      ASSERT_EQ(arcWithNormal(start, normal, end, way, arc), ArcFault::None);
      lookAt(arc, start, end, (norm(start) + radius) * 10);
      const bool right = way == ArcWay::CounterClockwise;
      const Vector3 about = cross(arc.first, arc.second);
      EXPECT_EQ(dot(about, normal) > 0, right);
      EXPECT_GE(dot(arc.centre - start, cross(normal, chord)),
                -1e-9 * radius * radius * norm(chord));
      EXPECT_NEAR(norm(arc.first), radius, 1e-11 * (norm(start) + radius));
      EXPECT_NEAR(arc.sweep, right ? angle : kTurn - angle, std::sqrt(rounding));
    }
  }
}

TEST(GroupArc, RefusesWhatIsNoArc) {
  const Vector3 a{10, 20, 30};
  const Vector3 b{40, 20, 30};
  const Vector3 middle{25, 20, 30};
  Arc arc{};
  EXPECT_EQ(arcThrough(a, middle, b, arc), ArcFault::Collinear);
  EXPECT_EQ(arcThrough(a, b, a, arc), ArcFault::Collinear);
  EXPECT_EQ(arcThrough(a, a, b, arc), ArcFault::Collinear);
  EXPECT_EQ(arcThrough(a, b, b, arc), ArcFault::Collinear);
  EXPECT_EQ(arcThrough(a, {25, 20 + 2e-4, 30}, b, arc), ArcFault::None);
  EXPECT_EQ(arcThrough(a, {25, 20 + 1e-6, 30}, b, arc), ArcFault::Collinear);
  EXPECT_EQ(arcAbout(a, middle, b, ArcWay::Clockwise, arc), ArcFault::Collinear); // which plane?
  EXPECT_EQ(arcAbout(a, {25, 21, 30}, b, ArcWay::Clockwise, arc), ArcFault::None);
  EXPECT_EQ(arcAbout(a, {25.001, 21, 30}, b, ArcWay::Clockwise, arc), ArcFault::OffBisector);
  EXPECT_EQ(arcAbout(a, {25 + 1e-6, 21, 30}, b, ArcWay::Clockwise, arc), ArcFault::None);
  EXPECT_EQ(arcAbout(a, a, b, ArcWay::Clockwise, arc), ArcFault::NoRadius);
  EXPECT_EQ(arcAbout(a, {0, 0, 0}, a, ArcWay::Clockwise, arc), ArcFault::Collinear);
  EXPECT_EQ(arcWithNormal(a, {0, 0, 15}, b, ArcWay::Clockwise, arc), ArcFault::None);
  EXPECT_NEAR(arc.sweep, kTurn / 2, 1e-12);
  EXPECT_EQ(arcWithNormal(a, {0, 0, 14.9999}, b, ArcWay::Clockwise, arc), ArcFault::ChordTooLong);
  EXPECT_EQ(arcWithNormal(a, {0, 0, 0}, b, ArcWay::Clockwise, arc), ArcFault::NoRadius);
  EXPECT_EQ(arcWithNormal(a, {0, 0, 20}, a, ArcWay::Clockwise, arc), ArcFault::SameEnds);
  EXPECT_EQ(arcWithNormal(a, {1, 0, 20}, b, ArcWay::Clockwise, arc), ArcFault::OffBisector);
}

} // namespace
