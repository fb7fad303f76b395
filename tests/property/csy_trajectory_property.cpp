// Paths of the module TSX CSY 85, at random: places and directions are continuous, blends keep to
// their corners, ways are those of an integration, speeds are the greatest that the axes allow,
// moves keep the limits of the master, and no table of words breaks anything.
#include "motion_problems.hpp"
#include "runtime/numeric/csy/modulated_move.hpp"
#include "runtime/numeric/csy/trajectory_speeds.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace {

using namespace stride::csy;
using stride::test::casesOf;
using stride::test::Random;

struct Path {
  std::unique_ptr<TrajectoryTable> table = std::make_unique<TrajectoryTable>();
  std::unique_ptr<Trajectory> trajectory = std::make_unique<Trajectory>();
  Problem problem;
};

TablePoint randomPoint(Random &random, uint32_t axes) {
  constexpr std::array<int16_t, 6> kTypes{0, 1, 2, 10, 11, 12};
  TablePoint point{};
  point.position = {random.uniform(-9, 9), random.uniform(-9, 9),
                    axes == 3 ? random.uniform(-9, 9) : 0.0};
  point.type = kTypes[static_cast<size_t>(random.below(axes == 3 ? 3 : 6))];
  const double size = random.magnitude(-1, 1);
  point.parF[0] = point.type == 11 ? 20.0 : size;
  point.parF[1] = size * random.uniform(0.2, 5);
  point.parW[0] = static_cast<int16_t>(1 + random.below(4));
  point.parW[1] = static_cast<int16_t>(1 + random.below(20));
  point.parW[2] = static_cast<int16_t>(random.chance(0.7) ? 100 : 50 + random.below(151));
  point.speed = random.chance(0.3) ? 0.0 : random.uniform(1, 40);
  return point;
}

Path randomPath(Random &random) {
  Path path;
  do {
    path.table->axes = random.chance(0.3) ? 3 : 2;
    path.table->points = static_cast<uint32_t>(2 + random.below(12));
    for (uint32_t i = 0; i < path.table->points; ++i) {
      TablePoint &point = path.table->point[i];
      point = randomPoint(random, path.table->axes);
      if (point.type == 12 && i > 0) { // a centre at the same way from both points
        const Vector3 from = path.table->point[i - 1].position;
        const double part = random.uniform(-2, 2);
        const Vector3 way = point.position - from;
        point.parF[0] = from.x + way.x / 2 - part * way.y;
        point.parF[1] = from.y + way.y / 2 + part * way.x;
      }
    }
    path.table->point[path.table->points - 1].type = 0;
    path.problem = computeTrajectory(*path.table, *path.trajectory);
  } while (path.problem.error != PathError::None);
  return path;
}

double sizeOf(const Vector3 &v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

Vector3 slopeAt(const Piece &piece, double part) {
  return stride::path::overParameter(piece.shape, part).d1 * (1 / piece.length);
}

bool isBlendPiece(const Path &path, uint32_t index) {
  const Piece &piece = path.trajectory->piece[index];
  const int16_t type = path.table->point[piece.point].type;
  return (type == 1 || type == 2 || type == 10) &&
         piece.start >= path.trajectory->endOfLine[piece.point] - 1e-12 &&
         (index + 1 == path.trajectory->pieces ||
          path.trajectory->piece[index + 1].point != piece.point);
}

TEST(CsyTrajectoryProperty, PlacesAndDirectionsAreContinuous) {
  for (int seed = 0; seed < casesOf(2000); ++seed) {
    Random random(seed);
    const Path path = randomPath(random);
    const Trajectory &trajectory = *path.trajectory;
    for (uint32_t i = 1; i < trajectory.pieces; ++i) {
      const Piece &before = trajectory.piece[i - 1];
      const Piece &after = trajectory.piece[i];
      const Vector3 end = stride::path::overParameter(before.shape, 1).p;
      const Vector3 begin = stride::path::overParameter(after.shape, 0).p;
      ASSERT_LT(sizeOf(end - begin), 1e-10) << seed << " piece " << i;
      ASSERT_NEAR(before.start + before.length, after.start, 1e-12) << seed;
      // At a point itself the path may turn, also where a blend ends there.
      if ((!isBlendPiece(path, i) && !isBlendPiece(path, i - 1)) ||
          sizeOf(begin - path.table->point[after.point - 1].position) < 1e-10)
        continue;
      const Vector3 out = slopeAt(before, 1) * (1 / sizeOf(slopeAt(before, 1)));
      const Vector3 in = slopeAt(after, 0) * (1 / sizeOf(slopeAt(after, 0)));
      ASSERT_LT(sizeOf(out - in), 1e-8) << seed << " piece " << i;
    }
  }
}

TEST(CsyTrajectoryProperty, BlendsKeepToTheirCorners) {
  for (int seed = 0; seed < casesOf(2000); ++seed) {
    Random random(seed);
    const Path path = randomPath(random);
    for (uint32_t i = 0; i < path.trajectory->pieces; ++i) {
      const Piece &piece = path.trajectory->piece[i];
      const TablePoint &point = path.table->point[piece.point];
      if (!isBlendPiece(path, i) || point.type == 10 || point.parW[2] != 100)
        continue;
      // A place is A + a * (P - A) + b * (B - P) with 1 >= a >= b >= 0: within the triangle.
      const Vector3 from = stride::path::overParameter(piece.shape, 0).p;
      const Vector3 to = stride::path::overParameter(piece.shape, 1).p;
      const Vector3 first = point.position - from;
      const Vector3 second = to - point.position;
      const double turn = sizeOf(stride::numeric::cross(first, second));
      if (turn < 1e-6 * sizeOf(first) * sizeOf(second))
        continue;
      const Vector3 normal = stride::numeric::cross(first, second) * (1 / (turn * turn));
      const double ratio = sizeOf(first) / sizeOf(second);
      const double most = point.type == 1 ? 2.0 : 1.0 / 0.66;
      ASSERT_LE(std::max(ratio, 1 / ratio), most * (1 + 1e-9)) << seed;
      for (double u = 0; u <= 1; u += 1.0 / 64) {
        const Vector3 way = stride::path::overParameter(piece.shape, u).p - from;
        const double a = stride::numeric::dot(stride::numeric::cross(way, second), normal);
        const double b = stride::numeric::dot(stride::numeric::cross(first, way), normal);
        // 1/0.66 is a little above 1.5, where a quintic begins to go over the lines.
        const double room = point.type == 1 ? 1e-9 : 1e-3;
        ASSERT_LE(a, 1 + room) << seed << " u " << u;
        ASSERT_GE(b, -room) << seed << " u " << u;
      }
    }
  }
}

TEST(CsyTrajectoryProperty, WaysAreThoseOfAnIntegration) {
  for (int seed = 0; seed < casesOf(500); ++seed) {
    Random random(seed);
    const Path path = randomPath(random);
    double whole = 0;
    for (uint32_t i = 0; i < path.trajectory->pieces; ++i) {
      const Piece &piece = path.trajectory->piece[i];
      whole += piece.length;
      if (piece.shape.kind == stride::path::ShapeKind::Polynomial)
        continue; // counts as long as what it takes from the lines, tested above
      double sum = 0;
      constexpr int kParts = 2000;
      Vector3 last = stride::path::overParameter(piece.shape, 0).p;
      for (int k = 1; k <= kParts; ++k) {
        const Vector3 next = stride::path::overParameter(piece.shape, k / double{kParts}).p;
        sum += sizeOf(next - last);
        last = next;
      }
      ASSERT_NEAR(sum, piece.length, 3e-6 * piece.length) << seed;
    }
    ASSERT_NEAR(whole, path.trajectory->length, 1e-10 * whole) << seed;
  }
}

TEST(CsyTrajectoryProperty, SpeedsAreTheGreatestThatTheAxesAllow) {
  for (int seed = 0; seed < casesOf(500); ++seed) {
    Random random(seed);
    const Path path = randomPath(random);
    const SlaveLimits limits{{random.uniform(1, 9), random.uniform(1, 9), random.uniform(1, 9)},
                             {random.uniform(1, 99), random.uniform(1, 99), random.uniform(1, 99)}};
    auto speeds = std::make_unique<Speeds>();
    computeSpeeds(*path.table, *path.trajectory, limits, *speeds);
    for (uint32_t i = 0; i < path.trajectory->pieces; ++i) {
      const Piece &piece = path.trajectory->piece[i];
      const double v = speeds->allowed[i];
      double most = 0; // of what an axis can do
      for (double u = 0; u <= 1; u += 1.0 / 512) {
        const auto at = stride::path::overParameter(piece.shape, u);
        const Vector3 velocity = at.d1 * (v / piece.length);
        const Vector3 acceleration = at.d2 * (v * v / (piece.length * piece.length));
        for (const double part :
             {velocity.x / limits.velocity.x, velocity.y / limits.velocity.y,
              velocity.z / limits.velocity.z, acceleration.x / limits.acceleration.x,
              acceleration.y / limits.acceleration.y, acceleration.z / limits.acceleration.z})
          most = std::max(most, std::fabs(part));
      }
      ASSERT_LE(most, 1 + 1e-9) << seed << " piece " << i;
      ASSERT_GE(most, 1 - 1e-3) << seed << " piece " << i;
      const double asked = path.table->point[piece.point].speed;
      ASSERT_EQ(speeds->computed[i], asked > 0 ? std::min(asked, v) : v);
    }
  }
}

TEST(CsyTrajectoryProperty, MovesKeepTheMastersLimits) {
  auto speeds = std::make_unique<Speeds>();
  auto move = std::make_unique<ModulatedMove>();
  for (int seed = 0; seed < casesOf(500); ++seed) {
    Random random(seed);
    const Path path = randomPath(random);
    computeSpeeds(*path.table, *path.trajectory, {{5, 7, 9}, {20, 30, 40}}, *speeds);
    const MasterLimits limits{random.chance(0.5) ? 0.0 : random.uniform(0.5, 9),
                              random.magnitude(0, 2), random.magnitude(0, 2),
                              random.chance(0.4) ? 1.0 : 1.0 + 0.25 * (1 + random.below(4))};
    const double from = random.chance(0.5) ? 0 : random.uniform(0, path.trajectory->length);
    const double to =
        random.chance(0.5) ? path.trajectory->length : random.uniform(0, path.trajectory->length);
    ASSERT_TRUE(beginMove(*path.trajectory, speeds->computed, limits, from, to, *move));
    const double cycle = 0.004;
    MasterState last{from, 0, false};
    for (int k = 0; k < 1'000'000 && !last.done; ++k) {
      const MasterState now = advance(*move, cycle);
      const double sign = to < from ? -1 : 1;
      ASSERT_GE(sign * (now.position - last.position), -1e-9) << seed;
      const double change = sign * (now.velocity - last.velocity) / cycle;
      if (!now.done) {
        ASSERT_LE(change, limits.shape * limits.acceleration * (1 + 1e-9) + 1e-9) << seed;
        ASSERT_GE(change, -limits.shape * limits.deceleration * (1 + 1e-9) - 1e-9) << seed;
        // Between two pieces either may speak.
        double most = 0;
        for (const double place : {now.position - 1e-7, now.position + 1e-7}) {
          const auto index = &pieceAt(*path.trajectory, place) - path.trajectory->piece;
          most = std::max(most, speeds->computed[index]);
        }
        if (limits.velocity > 0)
          most = std::min(most, limits.velocity);
        ASSERT_LE(sign * now.velocity, most * (1 + 1e-9) + 1e-6) << seed;
      }
      last = now;
    }
    ASSERT_TRUE(last.done) << seed;
    ASSERT_EQ(last.position, to) << seed;
  }
}

/// Cams are linear between their points, so that a slave is on the path at them, and as far from it
/// between as the curvature lets a chord be.
TEST(CsyTrajectoryProperty, CamsAreThePathAtTheirPoints) {
  for (int seed = 0; seed < casesOf(1000); ++seed) {
    Random random(seed);
    const Path path = randomPath(random);
    const Trajectory &trajectory = *path.trajectory;
    CamCursor cursor{};
    CamPoint last = nextCamPoint(trajectory, cursor);
    ASSERT_EQ(last.master, 0.0);
    const Vector3 first = last.slave;
    for (uint32_t i = 1; i < loopPoints(trajectory); ++i) {
      const CamPoint next = nextCamPoint(trajectory, cursor);
      ASSERT_GT(next.master, last.master) << seed << " point " << i;
      if (i < trajectory.camPoints) {
        ASSERT_LT(sizeOf(next.slave - positionAt(trajectory, next.master)), 1e-9) << seed;
        const double middle = 0.5 * (last.master + next.master);
        const Piece &piece = pieceAt(trajectory, middle);
        double bend = 0;
        for (int k = 0; k <= 32; ++k)
          bend = std::max(bend, sizeOf(stride::path::overParameter(piece.shape, k / 32.0).d2));
        const double step = 1.0 / piece.samples;
        const Vector3 chord = (last.slave + next.slave) * 0.5;
        // The greatest second derivative may lie between two of 33 places.
        ASSERT_LE(sizeOf(chord - positionAt(trajectory, middle)),
                  1.05 * bend * step * step / 8 + 1e-9)
            << seed << " point " << i;
      }
      last = next;
    }
    ASSERT_LT(sizeOf(last.slave - first), 1e-12) << seed;
  }
}

TEST(CsyTrajectoryProperty, BrakingKeepsToItsDeceleration) {
  auto speeds = std::make_unique<Speeds>();
  auto move = std::make_unique<ModulatedMove>();
  for (int seed = 0; seed < casesOf(500); ++seed) {
    Random random(seed);
    const Path path = randomPath(random);
    computeSpeeds(*path.table, *path.trajectory, {{5, 7, 9}, {20, 30, 40}}, *speeds);
    const MasterLimits limits{0, random.magnitude(0, 2), random.magnitude(0, 2)};
    const double to = random.uniform(0, path.trajectory->length);
    const double from = random.chance(0.5) ? 0 : path.trajectory->length;
    ASSERT_TRUE(beginMove(*path.trajectory, speeds->computed, limits, from, to, *move));
    const double cycle = random.magnitude(-4, -1);
    for (int k = random.below(400); k > 0; --k)
      advance(*move, cycle);
    const double deceleration = limits.deceleration * random.uniform(1, 3);
    const double sign = to < from ? -1 : 1;
    const double begin = move->position;
    const double speed = sign * move->velocity;
    MasterState state{begin, move->velocity, false};
    double time = 0;
    while (!state.done) {
      const MasterState now = brake(*move, deceleration, cycle);
      ASSERT_GE(sign * (now.position - state.position), 0) << seed;
      ASSERT_GE(sign * (to - now.position), 0) << seed;
      if (!now.done) {
        ASSERT_NEAR(now.velocity, state.velocity - sign * deceleration * cycle, 1e-9) << seed;
      }
      state = now;
      time += cycle;
      ASSERT_LT(time, 1000) << seed;
    }
    ASSERT_NEAR(sign * (state.position - begin), speed * speed / (2 * deceleration), 1e-7) << seed;
  }
}

TEST(CsyTrajectoryProperty, NoTableBreaksAnything) {
  Path path;
  for (int seed = 0; seed < casesOf(20000); ++seed) {
    Random random(seed);
    std::vector<int16_t> words(static_cast<size_t>(random.below(200)));
    for (int16_t &word : words)
      word = static_cast<int16_t>(random.chance(0.6) ? random.below(20) : random.below(65536));
    if (words.size() > 3 && random.chance(0.9)) {
      words[0] = static_cast<int16_t>(random.below(10));
      words[1] = static_cast<int16_t>(2 + random.below(2));
      words[2] = static_cast<int16_t>(words[1] == 2 ? 17 : 19);
    }
    path.problem =
        readTable(words.data(), static_cast<uint32_t>(words.size()), kMostPoints, *path.table);
    if (path.problem.error == PathError::None)
      path.problem = computeTrajectory(*path.table, *path.trajectory);
    const auto code = static_cast<int>(path.problem.error);
    ASSERT_TRUE(code == 0 || (code >= 9501 && code <= 9528)) << seed;
    if (code == 0) {
      ASSERT_TRUE(std::isfinite(path.trajectory->length) && path.trajectory->length > 0) << seed;
    }
  }
}

} // namespace
