// Cut objects: both parts together are the curve that the whole was, as their shapes and as their
// parameters say; what goes along stays where it was; ends are the same bit by bit.
#include "runtime/numeric/cnc/object_cut.hpp"

#include "runtime/numeric/cnc/object_shape.hpp"

#include "motion_problems.hpp"
#include "random_objects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace {

using namespace stride::test;

/// Something that moves, of any kind, with other axes and everything else that it can have.
struct Whole {
  PathObject object;
  double size;
};

void chooseLine(Random &random, PathObject &o, double size) {
  o.moveType = random.chance(0.8) ? MoveType::Line : MoveType::Positioning;
  choosePlane(random, o);
  const bool moves = random.chance(0.8); // else other axes alone
  for (int i = 0; i < 3; ++i) {
    o.start.coordinate[i] = size * random.uniform(-5, 5);
    o.end.coordinate[i] = moves ? size * random.uniform(-5, 5) : o.start.coordinate[i];
  }
}

void chooseQuintic(Random &random, PathObject &o, double size) {
  o.moveType = MoveType::Spline3d;
  choosePlane(random, o);
  for (int k = 0; k < 18; ++k)
    (k < 8 ? o.shape[k] : o.moreShape[k - 8]) =
        size * (random.uniform(-5, 5) + (k == 7 ? 100 : 0)); // does not stand still
  o.parameterRange[0] = random.uniform(-0.5, 0.5);
  o.parameterRange[1] = o.parameterRange[0] + random.uniform(0.2, 1);
  EXPECT_EQ(calculateStart(o), ShapeError::None);
  EXPECT_EQ(calculateEnd(o), ShapeError::None);
}

Whole randomWhole(Random &random) {
  Whole whole{};
  PathObject &o = whole.object;
  const int kind = random.below(4);
  if (kind < 2) {
    const Problem p = randomCurve(random);
    o = p.object;
    whole.size = p.size;
  } else {
    whole.size = random.magnitude(-2, 3);
    kind == 2 ? chooseLine(random, o, whole.size) : chooseQuintic(random, o, whole.size);
  }
  o.planar = random.chance(0.2) ? 1 : 0;
  o.start.axes = o.end.axes = 0x0FFF;
  for (int i = kAxisA; i < kAxes; ++i) {
    o.start.coordinate[i] = random.uniform(-90, 90);
    o.end.coordinate[i] = random.chance(0.3) ? o.start.coordinate[i] : random.uniform(-90, 90);
  }
  o.velocity = 17;
  o.velocityEnd = 3;
  o.marks = static_cast<uint8_t>(random.below(256));
  for (int i = 0; i <= kMostSwitches; ++i) {
    o.switchId[i] = static_cast<int16_t>(random.below(4) == 0 ? 0 : random.below(60) - 30);
    o.switchPosition[i] = random.uniform(0, 1);
  }
  return whole;
}

/// Of planar objects in their plane: their curves lie in the plane of their start.
double distanceOf(const PathObject &o, const Vector3 &a, const Vector3 &b) {
  Vector3 d = a - b;
  if (o.planar != 0)
    d = d - o.normal * stride::numeric::dot(d, o.normal);
  return std::hypot(d.x, d.y, d.z);
}

Vector3 onShape(const ObjectShape &shape, double way) {
  return stride::path::overParameter(shape.shape, stride::path::parameterAt(shape.shape, way)).p;
}

bool moves(const ObjectShape &shape) {
  return shape.measure == Measure::Space || shape.measure == Measure::Plane;
}

void expectSamePlaces(const Position &a, const Position &b) {
  for (int i = 0; i < kAxes; ++i)
    ASSERT_EQ(a.coordinate[i], b.coordinate[i]) << "axis " << i;
}

/// Both parts go where the whole goes.
void expectSameCurve(const Whole &whole, const ObjectShape &shape, const PathObject &first,
                     const PathObject &second, double way) {
  ObjectShape parts[2];
  ASSERT_EQ(shapeOf(first, parts[0]), ShapeError::None);
  ASSERT_EQ(shapeOf(second, parts[1]), ShapeError::None);
  ASSERT_EQ(parts[0].measure, shape.measure);
  ASSERT_EQ(parts[1].measure, shape.measure);
  ASSERT_NEAR(parts[0].length, way, 1e-11 * shape.length);
  ASSERT_NEAR(parts[0].length + parts[1].length, shape.length, 1e-11 * shape.length);
  ASSERT_EQ(first.length, way);
  ASSERT_EQ(second.length, shape.length - way);
  if (!moves(shape))
    return;
  // Where the parameter nearly stands still, the place at a way is not sharp.
  const double slack = 1e-10 * (100 * whole.size + shape.length);
  for (int k = 0; k <= 24; ++k) {
    const double at = shape.length * k / 24;
    const Vector3 here = at < way ? onShape(parts[0], at) : onShape(parts[1], at - way);
    ASSERT_LT(distanceOf(whole.object, here, onShape(shape, at)), slack) << at;
  }
}

/// The parameters of a part lead from its start to its end by themselves.
void expectDescribed(const Whole &whole, const PathObject &part) {
  if (part.moveType == MoveType::Line || part.moveType == MoveType::Positioning)
    return;
  PathObject again = part;
  ASSERT_EQ(calculateStart(again), ShapeError::None);
  ASSERT_EQ(calculateEnd(again), ShapeError::None);
  if (part.planar != 0)
    return; // the parameters do not say what is out of the plane
  const double slack = 1e-11 * 100 * whole.size;
  ASSERT_LT(distance(placeAt(again.start), placeAt(part.start)), slack);
  ASSERT_LT(distance(placeAt(again.end), placeAt(part.end)), slack);
}

TEST(CncObjectCut, BothPartsAreTheWhole) {
  for (int i = 0; i < casesOf(1000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const Whole whole = randomWhole(random);
    ObjectShape shape{};
    ASSERT_EQ(shapeOf(whole.object, shape), ShapeError::None);
    const double part =
        random.chance(0.2) ? random.magnitude(-6, -1) : random.uniform(0.001, 0.999);
    const double way = shape.length * (random.chance(0.5) ? part : 1 - part);
    PathObject first{};
    PathObject second{};
    ASSERT_EQ(splitObject(whole.object, way, first, second), CutError::None);
    ASSERT_NO_FATAL_FAILURE(expectSamePlaces(first.start, whole.object.start));
    ASSERT_NO_FATAL_FAILURE(expectSamePlaces(second.end, whole.object.end));
    ASSERT_NO_FATAL_FAILURE(expectSamePlaces(first.end, second.start));
    ASSERT_NO_FATAL_FAILURE(expectSameCurve(whole, shape, first, second, way));
    ASSERT_NO_FATAL_FAILURE(expectDescribed(whole, first));
    ASSERT_NO_FATAL_FAILURE(expectDescribed(whole, second));
    for (int axis = kAxisA; axis < kAxes; ++axis) {
      const double from = whole.object.start.coordinate[axis];
      const double to = whole.object.end.coordinate[axis];
      ASSERT_NEAR(first.end.coordinate[axis], from + (to - from) * way / shape.length, 1e-12 * 90);
    }
    ASSERT_EQ(first.velocityEnd, 17);
    ASSERT_EQ(second.velocityEnd, 3);
  }
}

TEST(CncObjectCut, SwitchPointsAndMarksStayWhereTheyAre) {
  for (int i = 0; i < casesOf(500) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const PathObject whole = randomWhole(random).object;
    ObjectShape shape{};
    ASSERT_EQ(shapeOf(whole, shape), ShapeError::None);
    const double way = shape.length * random.uniform(0.01, 0.99);
    PathObject first{};
    PathObject second{};
    ASSERT_EQ(splitObject(whole, way, first, second), CutError::None);
    for (int k = 0; k <= kMostSwitches; ++k) {
      const double at = whole.switchPosition[k] * shape.length;
      const bool early = at <= way;
      ASSERT_EQ(first.switchId[k], early ? whole.switchId[k] : 0);
      ASSERT_EQ(second.switchId[k], early ? 0 : whole.switchId[k]);
      const double there = early ? first.switchPosition[k] * way
                                 : way + second.switchPosition[k] * (shape.length - way);
      if (whole.switchId[k] != 0) {
        ASSERT_NEAR(there, at, 1e-12 * shape.length);
      }
    }
    constexpr uint8_t kEnds = kEndToolCorrection | kEndSmoothing | kEndAvoidLoops;
    ASSERT_EQ(first.marks, whole.marks & ~kEnds);
    ASSERT_EQ(second.marks, whole.marks & kEnds);
  }
}

TEST(CncObjectCut, WhatIsTakenOffIsThatPart) {
  for (int i = 0; i < casesOf(500) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const PathObject whole = randomWhole(random).object;
    ObjectShape shape{};
    ASSERT_EQ(shapeOf(whole, shape), ShapeError::None);
    const double way = shape.length * random.uniform(0.01, 0.99);
    PathObject first{};
    PathObject second{};
    ASSERT_EQ(splitObject(whole, way, first, second), CutError::None);
    PathObject late = whole;
    ASSERT_EQ(cutStart(late, way), CutError::None);
    ASSERT_NO_FATAL_FAILURE(expectSamePlaces(late.start, second.start));
    ASSERT_NO_FATAL_FAILURE(expectSamePlaces(late.end, whole.end));
    ASSERT_EQ(late.length, second.length);
    PathObject early = whole;
    ASSERT_EQ(cutEnd(early, shape.length - way), CutError::None);
    ASSERT_NO_FATAL_FAILURE(expectSamePlaces(early.start, whole.start));
    ASSERT_NEAR(early.length, way, 1e-12 * shape.length);
    ASSERT_EQ(early.marks, whole.marks);
    ASSERT_EQ(late.marks, whole.marks);
    ASSERT_EQ(early.velocityEnd, whole.velocityEnd);
  }
}

TEST(CncObjectCut, RefusesWhatCannotBeCut) {
  PathObject line{};
  line.moveType = MoveType::Line;
  line.start.axes = line.end.axes = 0x000F;
  line.end.coordinate[kAxisX] = 8;
  line.end.coordinate[kAxisA] = 30;
  PathObject first{};
  PathObject second{};
  for (const double way : {-1.0, 0.0, 8.0, 9.0, std::nan("")})
    EXPECT_EQ(splitObject(line, way, first, second), CutError::Way) << way;
  EXPECT_EQ(splitObject(line, 5e-324, first, second), CutError::Way); // nothing is left
  EXPECT_EQ(splitObject(line, 3, first, second), CutError::None);
  EXPECT_EQ(first.end.coordinate[kAxisA], 11.25);

  PathObject profile = line;
  profile.start.sProfile = 1 << kAxisA;
  EXPECT_EQ(splitObject(profile, 3, first, second), CutError::Profile);
  EXPECT_EQ(cutStart(profile, 3), CutError::Profile);
  EXPECT_EQ(cutEnd(profile, 3), CutError::Profile);
  profile.start.sProfile = 1 << kAxisB; // does not move
  EXPECT_EQ(splitObject(profile, 3, first, second), CutError::None);
  profile.slopes = 2;
  EXPECT_EQ(splitObject(profile, 3, first, second), CutError::None); // B is no axis of it
  profile.slopes = 1;
  EXPECT_EQ(splitObject(profile, 3, first, second), CutError::None); // slopes can be cut
  profile.start.sProfile = 1 << kAxisA;
  EXPECT_EQ(splitObject(profile, 3, first, second), CutError::None); // and count before a profile

  PathObject function{};
  function.moveType = MoveType::Function;
  EXPECT_EQ(splitObject(function, 1, first, second), CutError::Shape);
  PathObject still = line;
  still.end = still.start;
  EXPECT_EQ(cutEnd(still, 1), CutError::Shape);
}

} // namespace
