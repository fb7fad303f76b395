// Objects of CNC paths: the manual's example, lines, and what has no shape.
#include "runtime/numeric/cnc/object_shape.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include <cmath>
#include <limits>

namespace {

using namespace stride::cnc;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

PathObject objectOf(MoveType type) {
  PathObject o{};
  o.moveType = type;
  o.start.axes = o.end.axes = 7;
  o.planeX = {1, 0, 0};
  o.planeY = {0, 1, 0};
  o.normal = {0, 0, 1};
  return o;
}

void put(Position &position, double x, double y, double z) {
  position.coordinate[kAxisX] = x;
  position.coordinate[kAxisY] = y;
  position.coordinate[kAxisZ] = z;
}

/// Three quarters of a circle around (200, 100), from (250, 100).
PathObject arc(MoveType type, double sweep) {
  PathObject o = objectOf(type);
  o.shape[0] = 200;
  o.shape[1] = 100;
  o.shape[2] = 50;
  o.parameterRange[1] = sweep;
  put(o.start, 250, 100, 7);
  put(o.end, 0, 0, 7);
  EXPECT_EQ(calculateEnd(o), ShapeError::None);
  return o;
}

TEST(CncObjectShape, TurnsAsTheTypeSaysWhateverTheSignOfTheSweep) {
  for (const double sweep : {90.0, -90.0}) {
    const PathObject left = arc(MoveType::Counterclockwise, sweep);
    EXPECT_EQ(left.end.coordinate[kAxisX], 200);
    EXPECT_EQ(left.end.coordinate[kAxisY], 150);
    EXPECT_EQ(left.end.coordinate[kAxisZ], 7);
    const PathObject right = arc(MoveType::Clockwise, sweep);
    EXPECT_EQ(right.end.coordinate[kAxisX], 200);
    EXPECT_EQ(right.end.coordinate[kAxisY], 50);
    ObjectShape shape{};
    ASSERT_EQ(shapeOf(right, shape), ShapeError::None);
    EXPECT_NEAR(shape.length, 78.539816339744831, 1e-12);
    const Vector3 start = tangentAtStart(shape);
    const Vector3 end = tangentAtEnd(shape);
    EXPECT_NEAR(start.y, -1, 1e-15);
    EXPECT_NEAR(end.x, -1, 1e-15);
  }
}

TEST(CncObjectShape, AnArcGoesOnBeyondAFullTurn) {
  const PathObject o = arc(MoveType::Counterclockwise, 720 + 90);
  ObjectShape shape{};
  ASSERT_EQ(shapeOf(o, shape), ShapeError::None);
  EXPECT_NEAR(shape.length, 9 * 78.539816339744831, 1e-10);
}

TEST(CncObjectShape, ALineHasTheLengthOfItsWayInSpace) {
  PathObject o = objectOf(MoveType::Line);
  put(o.start, 1, 2, 3);
  put(o.end, 3, 5, 9);
  o.end.coordinate[kAxisP] = 1000;
  ASSERT_EQ(calculateLength(o), ShapeError::None);
  EXPECT_EQ(o.length, 7);
  o.planar = 1;
  ObjectShape shape{};
  ASSERT_EQ(shapeOf(o, shape), ShapeError::None);
  EXPECT_EQ(shape.measure, Measure::Plane);
  EXPECT_NEAR(shape.length, std::sqrt(13.0), 1e-15);
  EXPECT_EQ(tangentAtStart(shape).z, 0);
}

TEST(CncObjectShape, ALineOutOfThePlaneHasItsWayThereForALength) {
  PathObject o = objectOf(MoveType::Positioning);
  o.planar = 1;
  put(o.start, 1, 2, 3);
  put(o.end, 1, 2, -1);
  ObjectShape shape{};
  ASSERT_EQ(shapeOf(o, shape), ShapeError::None);
  EXPECT_EQ(shape.measure, Measure::Normal);
  EXPECT_EQ(shape.length, 4);
  EXPECT_EQ(shape.shape.length, 0);
}

TEST(CncObjectShape, WithoutAWayInSpaceTheAxesThatMoveCount) {
  PathObject o = objectOf(MoveType::Line);
  put(o.start, 1, 2, 3);
  o.end = o.start;
  o.start.axes = o.end.axes = 7 | 1 << kAxisP | 1 << kAxisA;
  o.end.coordinate[kAxisP] = 3;
  o.end.coordinate[kAxisA] = -4;
  o.end.coordinate[kAxisQ] = 100; // not interpolated
  ObjectShape shape{};
  ASSERT_EQ(shapeOf(o, shape), ShapeError::None);
  EXPECT_EQ(shape.measure, Measure::OtherAxes);
  EXPECT_EQ(shape.length, 5);
  o.end = o.start;
  ASSERT_EQ(shapeOf(o, shape), ShapeError::None);
  EXPECT_EQ(shape.measure, Measure::Nothing);
  EXPECT_EQ(shape.length, 0);
  EXPECT_EQ(tangentAtEnd(shape).x, 0);
}

TEST(CncObjectShape, JumpsAndFunctionsHaveAPlace) {
  PathObject jump = objectOf(MoveType::Jump);
  put(jump.start, kNan, kNan, kNan); // wherever the motion stands
  put(jump.end, 4, 5, 6);
  ObjectShape shape{};
  ASSERT_EQ(shapeOf(jump, shape), ShapeError::None);
  EXPECT_EQ(shape.shape.v[0].y, 5);
  EXPECT_EQ(shape.measure, Measure::Nothing);
  PathObject function = objectOf(MoveType::Function);
  function.shape[3] = kNan; // a parameter that means nothing here
  put(function.start, 1, 2, 3);
  EXPECT_EQ(shapeOf(function, shape), ShapeError::None);
  EXPECT_EQ(shape.shape.v[0].z, 3);
}

TEST(CncObjectShape, ACurveThatBeginsAtAStandstillHasTheDirectionNextToIt) {
  PathObject o = objectOf(MoveType::Spline);
  o.shape[2] = 3; // x = 3 t^2, y = -2 t^3
  o.shape[7] = -2;
  ASSERT_EQ(calculateEnd(o), ShapeError::None);
  ObjectShape shape{};
  ASSERT_EQ(shapeOf(o, shape), ShapeError::None);
  EXPECT_EQ(tangentAtStart(shape).x, 1);
  // The same backwards: x = 3 (1 - t)^2, y = -2 (1 - t)^3 ends at a standstill.
  PathObject back = objectOf(MoveType::Spline);
  back.parameterRange[0] = 1;
  back.parameterRange[1] = 0;
  back.shape[2] = 3;
  back.shape[7] = -2;
  ASSERT_EQ(calculateStart(back), ShapeError::None);
  ASSERT_EQ(calculateEnd(back), ShapeError::None);
  ASSERT_EQ(shapeOf(back, shape), ShapeError::None);
  EXPECT_EQ(tangentAtEnd(shape).x, -1);
}

TEST(CncObjectShape, AnAxisThatIsMissingFollowsFromDirectionAndRatio) {
  PathObject o = objectOf(MoveType::EllipseCounterclockwise);
  o.shape[4] = 8;
  o.shape[6] = 90;
  o.shape[7] = 0.25;
  o.parameterRange[1] = 90;
  ASSERT_EQ(calculateStart(o), ShapeError::None);
  ASSERT_EQ(calculateEnd(o), ShapeError::None);
  EXPECT_EQ(o.start.coordinate[kAxisX], 0);
  EXPECT_EQ(o.start.coordinate[kAxisY], 8);
  EXPECT_EQ(o.end.coordinate[kAxisX], -2);
  EXPECT_EQ(o.end.coordinate[kAxisY], 0);
}

TEST(CncObjectShape, RefusesWhatHasNoShape) {
  ObjectShape shape{};
  PathObject o = arc(MoveType::Clockwise, 90);
  const auto errorWith = [&](auto change) {
    PathObject changed = o;
    change(changed);
    const ShapeError error = shapeOf(changed, shape);
    EXPECT_EQ(calculateLength(changed), error);
    EXPECT_EQ(changed.length, 0);
    return error;
  };
  EXPECT_EQ(errorWith([](PathObject &c) { c.shape[2] = 0; }), ShapeError::Radius);
  EXPECT_EQ(errorWith([](PathObject &c) { c.shape[2] = -50; }), ShapeError::Radius);
  EXPECT_EQ(errorWith([](PathObject &c) { c.shape[1] = kNan; }), ShapeError::NotFinite);
  EXPECT_EQ(errorWith([](PathObject &c) { c.parameterRange[1] = HUGE_VAL; }),
            ShapeError::NotFinite);
  EXPECT_EQ(errorWith([](PathObject &c) { c.end.coordinate[kAxisW] = kNan; }),
            ShapeError::NotFinite);
  EXPECT_EQ(errorWith([](PathObject &c) { c.planeX.x = 1.1; }), ShapeError::Frame);
  EXPECT_EQ(errorWith([](PathObject &c) { c.planeY = {0.1, 1, 0}; }), ShapeError::Frame);
  EXPECT_EQ(errorWith([](PathObject &c) { c.normal.z = -1; }), ShapeError::Frame);
  EXPECT_EQ(errorWith([](PathObject &c) { c.moveType = MoveType{4}; }), ShapeError::Kind);
  EXPECT_EQ(errorWith([](PathObject &c) {
              c.moveType = MoveType::EllipseClockwise;
              c.shape[4] = 5;
            }),
            ShapeError::Axis);
  o = objectOf(MoveType::Line);
  EXPECT_EQ(errorWith([](PathObject &c) { c.start.coordinate[kAxisX] = kNan; }),
            ShapeError::NotFinite);
  EXPECT_EQ(errorWith([](PathObject &c) {
              c.start.coordinate[kAxisX] = -1.7e308;
              c.end.coordinate[kAxisX] = 1.7e308;
            }),
            ShapeError::NotFinite);
}

TEST(CncObjectShape, MemoryOfZerosLiesInThePlaneOfXAndY) {
  PathObject o = arc(MoveType::Clockwise, 90);
  o.planeX = o.planeY = o.normal = {0, 0, 0};
  ObjectShape shape{};
  EXPECT_EQ(shapeOf(o, shape), ShapeError::None);
  EXPECT_NEAR(shape.length, 78.539816339744831, 1e-12);
}

/// Its terms are so large that what is left of them is not known: no number of pieces agrees.
TEST(ObjectShape, TheLengthOfACurveWhoseTermsCancelOutComesSoon) {
  PathObject object{};
  object.moveType = MoveType::Spline3d;
  object.shape[1] = 1;
  object.shape[3] = -3e15;
  object.shape[4] = 1e15;
  object.parameterRange[1] = 1;
  object.end.coordinate[0] = 1;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 20; ++i) {
    object.shape[2] = 3e15 + i;
    ObjectShape shape{};
    (void)shapeOf(object, shape);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
}

} // namespace
