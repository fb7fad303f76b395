// A path that follows the X of a workpiece.
#include "runtime/numeric/cnc/x_interpolator.hpp"

#include "tests/support/cases.hpp"
#include "tests/support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace {

using namespace stride::cnc;

PathObject line(double x0, double y0, double x1, double y1) {
  PathObject o{};
  o.moveType = MoveType::Line;
  o.start.axes = o.end.axes = 7 | 1 << kAxisP;
  o.start.coordinate[kAxisX] = x0;
  o.start.coordinate[kAxisY] = y0;
  o.end.coordinate[kAxisX] = x1;
  o.end.coordinate[kAxisY] = y1;
  o.start.coordinate[kAxisP] = 10 * x0;
  o.end.coordinate[kAxisP] = 10 * x1;
  o.sourceLine = static_cast<int32_t>(std::lround(x0));
  return o;
}

/// A half circle upwards around (15, 0): from x = 20 to 10 or from 10 to 20.
PathObject halfCircle(bool forward) {
  PathObject o = line(forward ? 10 : 20, 0, forward ? 20 : 10, 0);
  o.moveType = forward ? MoveType::Clockwise : MoveType::Counterclockwise;
  o.shape[0] = 15;
  o.shape[2] = 5;
  o.parameterRange[0] = forward ? 180 : 0;
  o.parameterRange[1] = forward ? 180 : -180;
  return o;
}

struct Rig {
  explicit Rig(const std::vector<PathObject> &path, bool complete = true) : memory(20) {
    queue.structId = kQueueStructId;
    queue.buffer = reinterpret_cast<uint8_t *>(memory.data());
    queue.size = static_cast<uint32_t>(memory.size() * sizeof(PathObject));
    for (const PathObject &object : path)
      append(&queue, &object);
    queue.endOfList = complete;
    startFollowing(follower);
  }
  XPhase at(double x, bool forward = true) {
    follow(follower, &queue, x, forward);
    return follower.phase;
  }
  double y() const { return follower.position.coordinate[kAxisY]; }
  std::vector<PathObject> memory;
  Queue queue{};
  XFollower follower{};
};

TEST(XInterpolator, IsWhereTheWorkpieceIs) {
  Rig rig({line(0, 0, 10, 0), halfCircle(true), line(20, 0, 30, 5)});
  EXPECT_EQ(rig.at(-3), XPhase::Waiting);
  EXPECT_EQ(rig.follower.position.coordinate[kAxisX], 0);
  double way = 0;
  for (int i = 0; i <= 29; ++i) {
    const double x = i + 0.25 * std::sin(i);
    const XPhase phase = rig.at(x);
    way += rig.follower.length;
    if (i == 0)
      continue;
    EXPECT_EQ(phase, XPhase::Following) << x;
    const double y = x <= 10 ? 0 : x <= 20 ? std::sqrt(25 - (x - 15) * (x - 15)) : 0.5 * (x - 20);
    EXPECT_NEAR(rig.follower.position.coordinate[kAxisX], x, 1e-9);
    EXPECT_NEAR(rig.y(), y, 1e-7) << x;
    EXPECT_EQ(rig.follower.source, x < 10 ? 0 : x < 20 ? 10 : 20);
    if (x < 10) {
      EXPECT_NEAR(rig.follower.position.coordinate[kAxisP], 10 * x, 1e-9);
    }
  }
  EXPECT_EQ(rig.at(31), XPhase::Done);
  way += rig.follower.length;
  EXPECT_EQ(rig.y(), 5);
  EXPECT_NEAR(way, 10 + 5 * M_PI + std::sqrt(125), 1e-6);
  EXPECT_EQ(countOf(&rig.queue), 0U);
}

TEST(XInterpolator, GoesTheOtherWay) {
  Rig rig({line(30, 5, 20, 0), halfCircle(false), line(10, 0, 0, 0)});
  EXPECT_EQ(rig.at(33, false), XPhase::Waiting);
  for (double x = 29.5; x > 0; x -= 0.75) {
    ASSERT_EQ(rig.at(x, false), XPhase::Following) << x;
    const double y = x <= 10 ? 0 : x <= 20 ? std::sqrt(25 - (x - 15) * (x - 15)) : 0.5 * (x - 20);
    EXPECT_NEAR(rig.y(), y, 1e-7) << x;
    EXPECT_LT(rig.follower.tangent.x, 0);
  }
  EXPECT_EQ(rig.at(0, false), XPhase::Done);
}

TEST(XInterpolator, AWorkpieceThatGoesBackStaysInItsObject) {
  Rig rig({line(0, 0, 10, 5), line(10, 5, 20, 0)});
  EXPECT_EQ(rig.at(6), XPhase::Following);
  EXPECT_EQ(rig.at(4), XPhase::Following);
  EXPECT_NEAR(rig.y(), 2, 1e-12);
  EXPECT_EQ(rig.at(12), XPhase::Following);
  EXPECT_NEAR(rig.y(), 4, 1e-12);
  EXPECT_EQ(rig.at(9), XPhase::Waiting); // the first object is gone
  EXPECT_EQ(rig.y(), 5);
}

TEST(XInterpolator, PassesSwitchPoints) {
  PathObject object = line(0, 0, 10, 0);
  object.switchId[0] = 3;
  object.switchPosition[0] = 0.2;
  object.switchId[1] = 4;
  object.switchPosition[1] = 0.3;
  object.switchId[2] = -3;
  object.switchPosition[2] = 1;
  Rig rig({object, line(10, 0, 20, 0)});
  rig.at(1.9);
  EXPECT_EQ(rig.follower.switches, 0U);
  rig.at(3.5);
  EXPECT_EQ(rig.follower.switches, 12U);
  EXPECT_EQ(rig.follower.lastSwitch, 4);
  rig.at(4);
  EXPECT_EQ(rig.follower.lastSwitch, 0);
  rig.at(11);
  EXPECT_EQ(rig.follower.lastSwitch, -3);
  EXPECT_EQ(rig.follower.switches, 8U);
}

TEST(XInterpolator, WaitsForObjectsThatCome) {
  Rig rig({line(0, 0, 10, 0)}, false);
  EXPECT_EQ(rig.at(12), XPhase::Waiting);
  EXPECT_EQ(rig.follower.position.coordinate[kAxisX], 10);
  const PathObject more = line(10, 0, 20, 5);
  append(&rig.queue, &more);
  EXPECT_EQ(rig.at(12), XPhase::Following);
  EXPECT_NEAR(rig.y(), 1, 1e-12);
}

TEST(XInterpolator, PassesOverWhatDoesNotMove) {
  PathObject m = line(10, 0, 10, 0);
  m.moveType = MoveType::Function;
  Rig rig({line(0, 0, 10, 0), m, line(10, 0, 10, 0), line(10, 0, 20, 5)});
  EXPECT_EQ(rig.at(12), XPhase::Following);
  EXPECT_NEAR(rig.y(), 1, 1e-12);
}

TEST(XInterpolator, AnXWithoutOnePlaceIsAnError) {
  const auto error = [](const PathObject &object, double x, bool forward = true) {
    Rig rig({object});
    EXPECT_EQ(rig.at(x, forward), XPhase::Failed);
    return rig.follower.error;
  };
  EXPECT_EQ(error(line(0, 0, 0, 5), 0), XError::NoIntersection);
  EXPECT_EQ(error(line(10, 0, 0, 5), 5), XError::NoIntersection);
  EXPECT_EQ(error(line(0, 0, 10, 5), 5, false), XError::NoIntersection);
  EXPECT_EQ(error(line(0, 0, 10, 5), std::nan("")), XError::NoIntersection);
  PathObject broken = line(0, 0, 10, 5);
  broken.end.coordinate[kAxisY] = std::nan("");
  EXPECT_EQ(error(broken, 5), XError::Shape);
  Rig rig({});
  rig.queue.structId = 0;
  EXPECT_EQ(rig.at(0), XPhase::Failed);
  EXPECT_EQ(rig.follower.error, XError::NoQueue);
}

TEST(XInterpolator, WaitsWhenSomebodyElseEmptiesTheQueue) {
  Rig rig({line(0, 0, 10, 5), line(10, 5, 20, 0)}, false);
  EXPECT_EQ(rig.at(4), XPhase::Following);
  clear(&rig.queue);
  EXPECT_EQ(rig.at(6), XPhase::Waiting);
  const PathObject other = line(5, 1, 15, 11);
  append(&rig.queue, &other);
  EXPECT_EQ(rig.at(7), XPhase::Following);
  EXPECT_NEAR(rig.y(), 3, 1e-12);
}

/// A random path along X, and its place at each X.
struct Along {
  explicit Along(stride::test::Random &random, bool forward) {
    double x = random.uniform(-20, 20);
    double y = random.uniform(-5, 5);
    const double sign = forward ? 1 : -1;
    const int count = 3 + random.below(12);
    for (int i = 0; i < count; ++i) {
      const double way = sign * random.magnitude(-3, 1.3);
      const double rise = random.uniform(-5, 5);
      PathObject o = line(x, y, x + way, y + rise);
      o.sourceLine = i;
      std::function<double(double)> at = [=](double u) { return y + rise * (u - x) / way; };
      const int kind = random.below(5);
      if (kind == 0) { // half a circle up or down
        const bool up = random.chance(0.5);
        o = line(x, y, x + way, y);
        o.sourceLine = i;
        o.moveType = up == forward ? MoveType::Clockwise : MoveType::Counterclockwise;
        o.shape[0] = x + way / 2;
        o.shape[1] = y;
        o.shape[2] = std::fabs(way) / 2;
        o.parameterRange[0] = forward ? 180 : 0;
        o.parameterRange[1] = up == forward ? 180 : -180;
        at = [=](double u) {
          const double square = (u - x) * (x + way - u);
          return y + (up ? 1 : -1) * std::sqrt(std::max(square, 0.0));
        };
      } else if (kind == 1) {
        const double a = random.uniform(-8, 8);
        const double c[8] = {x, way, 0, 0, y, rise + a, -3 * a, 2 * a};
        o.moveType = MoveType::Spline;
        std::copy(std::begin(c), std::end(c), std::begin(o.shape));
        at = [=](double u) {
          const double t = (u - x) / way;
          return y + t * (rise + a + t * (-3 * a + t * 2 * a));
        };
      } else if (kind == 2 && i > 0) {
        PathObject function = line(x, y, x, y);
        function.moveType = MoveType::Function;
        path.push_back(function);
      }
      path.push_back(o);
      places.push_back({x, x + way, at});
      x += way;
      y = o.end.coordinate[kAxisY];
    }
  }
  struct Piece {
    double from, to;
    std::function<double(double)> at;
  };
  std::vector<PathObject> path;
  std::vector<Piece> places; ///< By sourceLine.
};

/// A workpiece that comes, goes back, jumps and stands; objects that come late.
void followCase(uint64_t seed) {
  SCOPED_TRACE(seed);
  stride::test::Random random(seed);
  const bool forward = random.chance(0.5);
  const double sign = forward ? 1 : -1;
  const Along along(random, forward);
  Rig rig({}, false);
  size_t fed = 0;
  double x = along.places.front().from - sign * 2;
  double way = 0;
  int source = -1;
  int done = -1;
  XPhase phase = XPhase::Waiting;
  for (int cycle = 0; cycle < 3000 && phase != XPhase::Done; ++cycle) {
    while (fed < along.path.size() && !isFull(&rig.queue) && random.chance(0.3))
      append(&rig.queue, &along.path[fed++]);
    rig.queue.endOfList = fed == along.path.size() ? 1 : 0;
    x += sign * random.uniform(-0.3, 0.5) * random.magnitude(-3, 1);
    phase = rig.at(x, forward);
    ASSERT_NE(phase, XPhase::Failed);
    way += rig.follower.length;
    if (rig.follower.source < 0)
      continue;
    EXPECT_GE(rig.follower.source, source); // it never goes back to what is done
    source = rig.follower.source;
    const Along::Piece &piece = along.places[static_cast<size_t>(source)];
    const double here = rig.follower.position.coordinate[kAxisX];
    const double wanted =
        forward ? std::clamp(x, piece.from, piece.to) : std::clamp(x, piece.to, piece.from);
    if (sign * x >= sign * piece.to)
      done = source;
    EXPECT_NEAR(here, done == source ? piece.to : wanted, 1e-9);
    EXPECT_NEAR(rig.y(), piece.at(here), 2e-6) << "x " << here << " source " << source;
    const bool waits = sign * x < sign * piece.from || done == source;
    EXPECT_EQ(phase != XPhase::Following, waits);
  }
  EXPECT_EQ(phase, XPhase::Done);
  EXPECT_EQ(rig.y(), along.path.back().end.coordinate[kAxisY]);
  double least = 0;
  for (const PathObject &o : along.path)
    least += std::hypot(o.end.coordinate[kAxisX] - o.start.coordinate[kAxisX],
                        o.end.coordinate[kAxisY] - o.start.coordinate[kAxisY]);
  EXPECT_GE(way, least * (1 - 1e-9));
}

TEST(XInterpolator, IsOnThePathWhateverTheWorkpieceDoes) {
  const int cases = stride::test::casesOf(1000);
  for (int i = 0; i < cases && !HasFailure(); ++i)
    followCase(static_cast<uint64_t>(i));
}

TEST(XInterpolator, IsOnThePathWhereItOnceWasNot) {
  followCase(1157); // Newton's steps went to and fro around a bend, and X was off by 5e-3
}

} // namespace
