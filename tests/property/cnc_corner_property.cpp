// Blends of corners between lines and arcs: by an independent measure of distances they keep their
// tolerances, they meet both neighbours with tangent and curvature, and cut no more than they may.
#include "runtime/numeric/cnc/corner.hpp"

#include "runtime/numeric/cnc/object_shape.hpp"

#include "tests/oracle/path/path_chain.hpp"

#include "motion_problems.hpp"
#include "random_objects.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace stride::test;
using stride::exact::kInfinity;
using stride::oracle::PathChain;

constexpr double kMostTurn = 170 * M_PI / 180;

struct Pair {
  PathObject before, after;
  double size;
};

stride::oracle::Place chainPlace(const Position &p) {
  stride::oracle::Place place{};
  for (size_t i = 0; i < 3; ++i)
    place[i] = p.coordinate[i];
  return place;
}

/// A line or an arc from a place on, in any direction.
PathObject randomPiece(Random &random, const Place &from, double size) {
  PathObject o{};
  choosePlane(random, o);
  o.start.axes = o.end.axes = 0x000F;
  o.velocity = random.uniform(1, 9);
  o.velocityEnd = o.velocity;
  o.acceleration = random.uniform(10, 90);
  o.deceleration = random.uniform(10, 90);
  if (random.chance(0.5)) {
    o.moveType = MoveType::Line;
    const double length = size * random.magnitude(-1, 1);
    put(o.start, from);
    put(o.end, {from[0] + length * random.uniform(-1, 1), from[1] + length * random.uniform(-1, 1),
                from[2] + length * random.uniform(-1, 1)});
  } else {
    const bool clockwise = random.chance(0.5);
    o.moveType = clockwise ? MoveType::Clockwise : MoveType::Counterclockwise;
    o.shape[2] = size * random.magnitude(-1, 1);
    o.parameterRange[0] = random.uniform(0, 360);
    o.parameterRange[1] = (clockwise ? 1 : -1) * random.uniform(5, 300);
    // The circle is put where its start is the place.
    const Place off = described(o, 0, 0, 0);
    const Vector3 centre = {from[0] - off[0], from[1] - off[1], from[2] - off[2]};
    o.shape[0] = stride::numeric::dot(centre, o.planeX);
    o.shape[1] = stride::numeric::dot(centre, o.planeY);
    const double height = stride::numeric::dot(centre, o.normal);
    put(o.start, from);
    put(o.end, described(o, 1, height, height));
  }
  for (int i = kAxisA; i < kAxes; ++i)
    o.end.coordinate[i] = o.start.coordinate[i] = 7;
  EXPECT_EQ(calculateLength(o), ShapeError::None);
  return o;
}

void add(PathChain &chain, const PathObject &o) {
  if (o.moveType == MoveType::Line) {
    chain.addLine(chainPlace(o.end));
    return;
  }
  const double height = stride::numeric::dot(
      {o.start.coordinate[0], o.start.coordinate[1], o.start.coordinate[2]}, o.normal);
  const Place centre = inSpace(o, o.shape[0], o.shape[1], height);
  const double sense = o.moveType == MoveType::Clockwise ? -1 : 1;
  chain.addArc(chainPlace(o.end), centre,
               {sense * o.normal.x, sense * o.normal.y, sense * o.normal.z});
}

Pair randomPair(Random &random) {
  Pair pair{};
  pair.size = random.magnitude(-3, 3);
  const Place at = {pair.size * random.uniform(-3, 3), pair.size * random.uniform(-3, 3), 0};
  pair.before = randomPiece(random, at, pair.size);
  pair.after = randomPiece(random, placeAt(pair.before.end), pair.size);
  for (int i = 0; i < 3; ++i)
    pair.after.start.coordinate[i] = pair.before.end.coordinate[i];
  return pair;
}

BlendRules randomRules(Random &random, double size) {
  const auto some = [&](double chance) {
    return random.chance(chance) ? size * random.magnitude(-4, 0) : kInfinity;
  };
  BlendRules rules{};
  rules.cut = some(0.4);
  rules.cornerTolerance = some(0.5);
  rules.pathTolerance = some(0.4);
  rules.acceleration = kInfinity;
  rules.leastTurn = 1e-6;
  return rules;
}

double turnOf(const Pair &pair) {
  ObjectShape first{};
  ObjectShape second{};
  EXPECT_EQ(shapeOf(pair.before, first), ShapeError::None);
  EXPECT_EQ(shapeOf(pair.after, second), ShapeError::None);
  const Vector3 a = tangentAtEnd(first);
  const Vector3 b = tangentAtStart(second);
  return 2 * std::asin(std::min(1.0, stride::numeric::norm(a - b) / 2));
}

/// Tangent and curvature at one end, by the formulas of differential geometry.
struct EndOf {
  Vector3 tangent, curvature;
};
EndOf endOf(const PathObject &object, double u) {
  ObjectShape shape{};
  EXPECT_EQ(shapeOf(object, shape), ShapeError::None);
  const stride::path::Derivatives d = stride::path::overParameter(shape.shape, u);
  const double speed = stride::numeric::norm(d.d1);
  const Vector3 t = d.d1 * (1 / speed);
  return {t, (d.d2 - t * stride::numeric::dot(d.d2, t)) * (1 / (speed * speed))};
}

void expectMeet(const PathObject &before, const PathObject &after) {
  for (int i = 0; i < kAxes; ++i)
    ASSERT_EQ(before.end.coordinate[i], after.start.coordinate[i]);
  const EndOf a = endOf(before, 1);
  const EndOf b = endOf(after, 0);
  ASSERT_LT(stride::numeric::norm(a.tangent - b.tangent), 1e-7);
  const double bend =
      stride::numeric::norm(a.curvature) + 1 / std::min(before.length, after.length);
  ASSERT_LT(stride::numeric::norm(a.curvature - b.curvature), 1e-5 * bend);
}

TEST(CncCorner, BlendsKeepTheirTolerancesAndMeetBothNeighbours) {
  int blended = 0;
  for (int i = 0; i < casesOf(1500) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const Pair pair = randomPair(random);
    const BlendRules rules = randomRules(random, pair.size);
    const double rooms[] = {pair.before.length * random.uniform(0.1, 0.5),
                            pair.after.length * random.uniform(0.1, 0.5)};
    Pair cut = pair;
    PathObject blend{};
    const Corner corner = blendCorner(cut.before, cut.after, rules, rooms[0], rooms[1], blend);
    if (turnOf(pair) > kMostTurn) {
      ASSERT_EQ(corner, Corner::Kept);
      continue;
    }
    ASSERT_EQ(corner, Corner::Blended);
    ++blended;
    const double least = 1e-12 * (pair.before.length + pair.after.length);
    const double most = std::min({rules.cut, rooms[0], rooms[1]}) + least;
    ASSERT_LE(pair.before.length - cut.before.length, most);
    ASSERT_LE(pair.after.length - cut.after.length, most);
    ASSERT_GT(cut.before.length, 0.49 * pair.before.length);
    ASSERT_NO_FATAL_FAILURE(expectMeet(cut.before, blend));
    ASSERT_NO_FATAL_FAILURE(expectMeet(blend, cut.after));
    ASSERT_EQ(blend.velocity, std::min(pair.before.velocity, pair.after.velocity));
    ASSERT_EQ(blend.acceleration, std::min(pair.before.acceleration, pair.after.acceleration));
    ASSERT_EQ(blend.deceleration, std::min(pair.before.deceleration, pair.after.deceleration));

    PathChain chain(chainPlace(pair.before.start));
    add(chain, pair.before);
    add(chain, pair.after);
    const stride::oracle::Place apex = chainPlace(pair.before.end);
    ObjectShape shape{};
    ASSERT_EQ(shapeOf(blend, shape), ShapeError::None);
    double fromCorner = kInfinity;
    double fromPath = 0;
    for (int k = 0; k <= 200; ++k) {
      const Vector3 p = stride::path::overParameter(shape.shape, k / 200.0).p;
      const stride::oracle::Place place = {p.x, p.y, p.z};
      fromCorner = std::min(fromCorner, stride::oracle::distance(place, apex, 3));
      fromPath = std::max(fromPath, chain.nearest(place, 0, chain.length()).distance);
    }
    // The nearest of the samples is not quite the nearest place; nor the furthest.
    const double step = blend.length / 200;
    ASSERT_LE(fromCorner, std::hypot(rules.cornerTolerance, step) + 1e-9 * pair.size);
    ASSERT_LE(fromPath, 1.02 * rules.pathTolerance + 1e-9 * pair.size);
  }
  EXPECT_GT(blended, casesOf(1500) * 3 / 4);
}

/// Two lines of 10 with a right angle between them.
Pair rightAngle() {
  Pair pair{};
  for (PathObject *o : {&pair.before, &pair.after}) {
    o->moveType = MoveType::Line;
    o->start.axes = o->end.axes = 0x000F;
    o->velocity = 5;
    o->acceleration = o->deceleration = 100;
    o->length = 10;
  }
  pair.before.start.coordinate[kAxisX] = -10;
  pair.after.end.coordinate[kAxisY] = 10;
  return pair;
}

constexpr BlendRules kOnlyCut = {2, kInfinity, kInfinity, kInfinity, 1e-6};

TEST(CncCorner, CutsWhatTheRulesSay) {
  const auto cutBy = [](BlendRules rules, double room = 5) {
    Pair pair = rightAngle();
    PathObject blend{};
    EXPECT_EQ(blendCorner(pair.before, pair.after, rules, room, 5, blend), Corner::Blended);
    EXPECT_NEAR(-pair.before.end.coordinate[kAxisX], pair.after.start.coordinate[kAxisY], 1e-12);
    return -pair.before.end.coordinate[kAxisX];
  };
  BlendRules rules = kOnlyCut;
  EXPECT_NEAR(cutBy(rules), 2, 1e-12);
  EXPECT_NEAR(cutBy(rules, 1.5), 1.5, 1e-12);
  rules.acceleration = 100; // v = 5: curvature 0.5 * 100 / 25 = 2, times the cut 1.170
  EXPECT_NEAR(cutBy(rules), 1.170 / 2, 1e-3);
  rules = {kInfinity, 0.369, kInfinity, kInfinity, 1e-6};
  EXPECT_NEAR(cutBy(rules), 1, 1e-2);
  rules = {kInfinity, kInfinity, 0.261, kInfinity, 1e-6};
  EXPECT_NEAR(cutBy(rules), 1, 2e-2);
}

TEST(CncCorner, KeepsWhatIsNoCorner) {
  PathObject blend{};
  Pair pair = rightAngle();
  pair.after.moveType = MoveType::Positioning;
  EXPECT_EQ(blendCorner(pair.before, pair.after, kOnlyCut, 5, 5, blend), Corner::Kept);
  pair = rightAngle();
  pair.before.probe = 1;
  EXPECT_EQ(blendCorner(pair.before, pair.after, kOnlyCut, 5, 5, blend), Corner::Kept);
  pair = rightAngle();
  pair.before.end.coordinate[kAxisA] = pair.after.start.coordinate[kAxisA] = 9;
  pair.before.start.sProfile = 1 << kAxisA;
  EXPECT_EQ(blendCorner(pair.before, pair.after, kOnlyCut, 5, 5, blend), Corner::Kept);
  for (const double degrees : {169.9, 170.1}) {
    pair = rightAngle();
    pair.after.end.coordinate[kAxisX] = 10 * std::cos(degrees / 180 * M_PI);
    pair.after.end.coordinate[kAxisY] = 10 * std::sin(degrees / 180 * M_PI);
    EXPECT_EQ(blendCorner(pair.before, pair.after, kOnlyCut, 5, 5, blend),
              degrees < 170 ? Corner::Blended : Corner::Kept);
  }
  pair = rightAngle();
  pair.after.end.coordinate[kAxisX] = 10;
  pair.after.end.coordinate[kAxisY] = 1e-6;
  EXPECT_EQ(blendCorner(pair.before, pair.after, kOnlyCut, 5, 5, blend), Corner::Smooth);
  EXPECT_EQ(pair.before.end.coordinate[kAxisX], 0);
}

TEST(CncCorner, MarksStayAndSwitchPointsKeepTheirDistanceFromTheNearerEnd) {
  Pair pair = rightAngle();
  pair.before.marks = kSmooth;
  pair.before.sourceLine = 11;
  pair.after.sourceLine = 12;
  const double places[] = {0.1, 0.45, 0.6, 0.95}; // of 10; 8 are left
  for (int i = 0; i < 4; ++i) {
    pair.before.switchId[i] = static_cast<int16_t>(i + 1);
    pair.before.switchPosition[i] = places[i];
  }
  PathObject blend{};
  ASSERT_EQ(blendCorner(pair.before, pair.after, kOnlyCut, 5, 5, blend), Corner::Blended);
  const double now[] = {1.0 / 8, 4.0 / 8, 4.0 / 8, 7.5 / 8}; // 4.5 and 6 would leave their halves
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(pair.before.switchId[i], i + 1);
    EXPECT_NEAR(pair.before.switchPosition[i], now[i], 1e-12);
    EXPECT_EQ(blend.switchId[i], 0);
  }
  EXPECT_EQ(pair.before.marks, kSmooth);
  EXPECT_EQ(blend.marks, 0);
  EXPECT_EQ(blend.sourceLine, 11);
}

TEST(CncCorner, PathsStayInOnePiece) {
  for (int i = 0; i < casesOf(300) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    Blender blender{};
    blender.rules = {kInfinity, 0.3, kInfinity, kInfinity, 1e-6};
    std::vector<PathObject> path;
    Place at = {1, 2, 3};
    PathObject ready[2];
    const int count = 1 + random.below(8);
    for (int k = 0; k < count; ++k) {
      const PathObject object = randomPiece(random, at, 1);
      at = placeAt(object.end);
      for (int n = blendNext(blender, object, ready), j = 0; j < n; ++j)
        path.push_back(ready[j]);
    }
    ASSERT_EQ(blendEnd(blender, ready[0]), 1);
    path.push_back(ready[0]);
    ASSERT_EQ(blendEnd(blender, ready[0]), 0);
    ASSERT_EQ(placeAt(path.front().start), (Place{1, 2, 3}));
    ASSERT_EQ(placeAt(path.back().end), at);
    for (size_t k = 1; k < path.size(); ++k)
      ASSERT_EQ(placeAt(path[k - 1].end), placeAt(path[k].start));
    for (const PathObject &object : path)
      ASSERT_GT(object.length, 0);
  }
}

} // namespace
