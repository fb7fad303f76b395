// Objects of CNC paths against what SMC_GEOINFO's members mean, written down again: places along
// the curve, ends that do not quite fit, lengths in closed form or by many chords, tangents by
// differences.
#include "runtime/numeric/cnc/object_shape.hpp"

#include "motion_problems.hpp"
#include "random_objects.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

namespace {

using namespace stride::test;

Place placeOn(const ObjectShape &shape, double u) {
  const Vector3 p = stride::path::overParameter(shape.shape, u).p;
  return {p.x, p.y, p.z};
}

TEST(CncObjectShape, CurvesGoWhereTheirParametersSay) {
  for (int i = 0; i < casesOf(3000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    Problem p = randomCurve(random);
    p.object.planar = random.chance(0.3) ? 1 : 0;
    ObjectShape shape{};
    ASSERT_EQ(shapeOf(p.object, shape), ShapeError::None);
    ASSERT_EQ(shape.measure, p.object.planar != 0 ? Measure::Plane : Measure::Space);
    const double high = p.object.planar != 0 ? p.low : p.high;
    const double scale = 100 * p.size;
    double chords = 0;
    Place before = placeOn(shape, 0);
    constexpr int kParts = 512;
    for (int k = 1; k <= kParts; ++k) {
      const double u = static_cast<double>(k) / kParts;
      const Place now = described(p.object, u, p.low, high);
      ASSERT_LT(distance(placeOn(shape, u), now), 1e-12 * scale) << u;
      chords += distance(before, now);
      before = now;
    }
    ASSERT_LE(chords, shape.length * (1 + 1e-12));
    ASSERT_NEAR(chords, shape.length, 4e-4 * shape.length);
    PathObject measured = p.object;
    ASSERT_EQ(calculateLength(measured), ShapeError::None);
    ASSERT_EQ(measured.length, shape.length);
  }
}

TEST(CncObjectShape, TangentsPointAlongTheMotion) {
  for (int i = 0; i < casesOf(3000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const Problem p = randomCurve(random);
    ObjectShape shape{};
    ASSERT_EQ(shapeOf(p.object, shape), ShapeError::None);
    const Vector3 ends[] = {tangentAtStart(shape), tangentAtEnd(shape)};
    ObjectShape outline{};
    ASSERT_EQ(outlineOf(p.object, outline), ShapeError::None);
    const Vector3 same[] = {tangentAtStart(outline), tangentAtEnd(outline)};
    for (int end = 0; end < 2; ++end) {
      const double step = end == 0 ? 1e-5 : -1e-5;
      const Place here = described(p.object, end, p.low, p.high);
      const Place there = described(p.object, end + step, p.low, p.high);
      const double way = distance(here, there) * (end == 0 ? 1 : -1);
      const Place tangent = {ends[end].x, ends[end].y, ends[end].z};
      const Place difference = {(there[0] - here[0]) / way, (there[1] - here[1]) / way,
                                (there[2] - here[2]) / way};
      ASSERT_LT(distance(tangent, difference), 1e-3);
      ASSERT_EQ(tangent, (Place{same[end].x, same[end].y, same[end].z}));
    }
  }
}

TEST(CncObjectShape, ComputesTheEndsThatTheParametersDescribe) {
  for (int i = 0; i < casesOf(3000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    Problem p = randomCurve(random);
    PathObject object = p.object;
    // Something else in the plane; the way out of it stays.
    put(object.start, inSpace(object, 7 * p.size, -3 * p.size, p.low));
    put(object.end, inSpace(object, -9 * p.size, 5 * p.size, p.high));
    object.end.coordinate[kAxisW] = 17;
    ASSERT_EQ(calculateStart(object), ShapeError::None);
    ASSERT_EQ(calculateEnd(object), ShapeError::None);
    const double scale = 100 * p.size;
    ASSERT_LT(distance(placeAt(object.start), placeAt(p.object.start)), 1e-13 * scale);
    ASSERT_LT(distance(placeAt(object.end), placeAt(p.object.end)), 1e-13 * scale);
    ASSERT_EQ(object.end.coordinate[kAxisW], 17);
  }
}

TEST(CncObjectShape, BeginsAndEndsAtTheEndsWhereTheseAreRounded) {
  int refused = 0;
  for (int i = 0; i < casesOf(3000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    Problem p = randomCurve(random);
    PathObject &o = p.object;
    // A full turn is closed, or open by what rounding leaves.
    const bool turns = o.moveType != MoveType::Spline && std::fmod(o.parameterRange[1], 360) == 0;
    const double off = p.size * (turns ? random.magnitude(-14, -8) : random.magnitude(-14, -5));
    for (Position *end : {&o.start, &o.end}) {
      const Place was = placeAt(*end);
      const Place away = inSpace(o, off * random.uniform(-1, 1), off * random.uniform(-1, 1), 0);
      put(*end, {was[0] + away[0], was[1] + away[1], was[2] + away[2]});
    }
    ObjectShape shape{};
    const ShapeError error = shapeOf(o, shape);
    refused += error == ShapeError::Ends;
    if (error != ShapeError::None)
      continue;
    ASSERT_LT(distance(placeOn(shape, 0), placeAt(o.start)), 1e-12 * 100 * p.size);
    ASSERT_LT(distance(placeOn(shape, 1), placeAt(o.end)), 1e-12 * 100 * p.size);
    for (int k = 0; k <= 16; ++k)
      ASSERT_LT(distance(placeOn(shape, k / 16.0), described(o, k / 16.0, p.low, p.high)),
                2000 * off + 1e-12 * p.size);
  }
  // Only arcs that are nearly closed, whose ends are further apart than rounding explains.
  EXPECT_LT(refused, casesOf(3000) / 50);
}

TEST(CncObjectShape, RefusesEndsBesideTheCurve) {
  for (int i = 0; i < casesOf(1000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    Problem p = randomCurve(random);
    PathObject &o = p.object;
    ObjectShape exact{};
    ASSERT_EQ(shapeOf(o, exact), ShapeError::None);
    Position &end = random.chance(0.5) ? o.start : o.end;
    const Place was = placeAt(end);
    const Place away = inSpace(o, exact.length * 0.5, exact.length * 0.3, 0);
    put(end, {was[0] + away[0], was[1] + away[1], was[2] + away[2]});
    ObjectShape shape{};
    ASSERT_EQ(shapeOf(o, shape), ShapeError::Ends);
    ASSERT_NEAR(shape.length, exact.length, 1e-9 * exact.length); // as the parameters say
  }
}

TEST(CncObjectShape, QuinticsGoThroughSpace) {
  for (int i = 0; i < casesOf(1000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    PathObject o{};
    o.moveType = MoveType::Spline3d;
    double c[3][6];
    for (int k = 0; k < 18; ++k) {
      c[k / 6][k % 6] = random.uniform(-5, 5) + (k == 7 ? 100 : 0);
      (k < 8 ? o.shape[k] : o.moreShape[k - 8]) = c[k / 6][k % 6];
    }
    const bool unit = random.chance(0.3); // 0 and 0 mean 0 to 1
    const double from = unit ? 0 : random.uniform(-0.5, 0.5);
    const double to = unit ? 1 : from + random.uniform(0.2, 1);
    if (!unit) {
      o.parameterRange[0] = from;
      o.parameterRange[1] = to;
    }
    const auto at = [&](double t) {
      Place place{};
      for (size_t axis = 0; axis < 3; ++axis)
        for (int k = 5; k >= 0; --k)
          place[axis] = place[axis] * t + c[axis][k];
      return place;
    };
    ASSERT_EQ(calculateStart(o), ShapeError::None);
    ASSERT_EQ(calculateEnd(o), ShapeError::None);
    ASSERT_LT(distance(placeAt(o.start), at(from)), 1e-11);
    ASSERT_LT(distance(placeAt(o.end), at(to)), 1e-11);
    ObjectShape shape{};
    ASSERT_EQ(shapeOf(o, shape), ShapeError::None);
    for (int k = 0; k <= 8; ++k)
      ASSERT_LT(distance(placeOn(shape, k / 8.0), at(from + (to - from) * k / 8.0)), 1e-10);
  }
}

} // namespace
