// Shapes of path objects: their length against closed forms and a plain sum in long double, their
// derivatives over the arc length against differences, and the way back from length to parameter.
#include "runtime/numeric/path/shape.hpp"
#include "runtime/numeric/path/way_table.hpp"

#include "motion_problems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace {

using namespace stride::path;
using stride::test::casesOf;
using stride::test::Random;

Vector3 randomVector(Random &random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

double sizeOf(const Vector3 &v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

/// Two vectors of length `radius` at a right angle.
void randomPlane(Random &random, double radius, Vector3 &first, Vector3 &second, Vector3 &normal) {
  do {
    first = randomVector(random, 1);
    second = randomVector(random, 1);
    normal = {first.y * second.z - first.z * second.y, first.z * second.x - first.x * second.z,
              first.x * second.y - first.y * second.x};
  } while (sizeOf(normal) < 0.1 || sizeOf(first) < 0.1);
  normal = normal * (1 / sizeOf(normal));
  first = first * (1 / sizeOf(first));
  second = {normal.y * first.z - normal.z * first.y, normal.z * first.x - normal.x * first.z,
            normal.x * first.y - normal.y * first.x};
  first = first * radius;
  second = second * radius;
}

Shape randomShape(Random &random) {
  const double size = random.magnitude(-5, 5);
  Vector3 first{};
  Vector3 second{};
  Vector3 normal{};
  randomPlane(random, size, first, second, normal);
  const Vector3 centre = randomVector(random, 10 * size);
  const double angle = random.uniform(-7, 7);
  const double sweep = random.sign() * random.magnitude(-2, 1.2);
  const Vector3 climb = normal * (random.chance(0.5) ? 0.0 : size * random.uniform(-2, 2));
  switch (random.below(4)) {
  case 0:
    return lineShape(centre, centre + randomVector(random, size));
  case 1:
    return arcShape(centre, first, second, angle, sweep, climb);
  case 2:
    return ellipseShape(centre, first, second * random.magnitude(-2, 0), angle, sweep, climb);
  default:
    break;
  }
  return quinticShape({centre, randomVector(random, size), randomVector(random, size), {}},
                      {centre + randomVector(random, size),
                       randomVector(random, size),
                       randomVector(random, size),
                       {}});
}

/// Chords over 2^k parts, by Richardson's extrapolation (the error has even powers only).
long double plainLength(const Shape &shape) {
  long double last = 0;
  for (int parts = 8;; parts *= 2) {
    long double sum = 0;
    Vector3 before = overParameter(shape, 0).p;
    for (int i = 1; i <= parts; ++i) {
      const Vector3 now = overParameter(shape, static_cast<double>(i) / parts).p;
      sum += std::hypot(static_cast<long double>(now.x) - before.x,
                        static_cast<long double>(now.y) - before.y,
                        static_cast<long double>(now.z) - before.z);
      before = now;
    }
    if (std::fabs(sum - last) < 1e-7L * sum || parts >= 65536)
      return sum + (sum - last) / 3;
    last = sum;
  }
}

TEST(PathShape, HasTheLengthOfItsChords) {
  for (int i = 0; i < casesOf(600) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const Shape shape = randomShape(random);
    const auto length = static_cast<double>(plainLength(shape));
    ASSERT_NEAR(shape.length, length, 2e-9 * length) << static_cast<int>(shape.kind);
  }
}

/// The integral of the speed of a polynomial by Gauss's rule of three points, in long double, from
/// its start to a parameter.
long double speedIntegral(const Shape &shape, int parts, long double to = 1) {
  const auto speed = [&shape](long double u) {
    long double d[3] = {};
    for (int k = 5; k >= 1; --k) {
      const Vector3 &c = shape.v[k];
      const long double axes[] = {c.x, c.y, c.z};
      for (int axis = 0; axis < 3; ++axis)
        d[axis] = d[axis] * u + k * axes[axis];
    }
    return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  };
  const long double place = std::sqrt(0.6L);
  long double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const long double middle = to * (i + 0.5L) / parts;
    const long double off = to * place / (2 * parts);
    sum += 8 * speed(middle) + 5 * (speed(middle - off) + speed(middle + off));
  }
  return to * sum / (18 * parts);
}

/// A polynomial as corners have them, or a wild one.
Shape randomQuintic(Random &random) {
  const double size = random.magnitude(-4, 4);
  const Vector3 begin = randomVector(random, size);
  const double wild = random.chance(0.5) ? 0.3 : 3;
  const Vector3 end = begin + randomVector(random, wild * size);
  const Vector3 place = begin + randomVector(random, 0.5 * wild * size);
  const Vector3 lastBend = randomVector(random, wild * size);
  const Vector3 bend = randomVector(random, wild * size);
  return quinticShape({{}, begin, bend, {}}, {place, end, lastBend, {}});
}

TEST(PathShape, APolynomialHasItsLengthToTheLastDigits) {
  int checked = 0;
  for (int i = 0; i < casesOf(1500); ++i) {
    Random random(static_cast<uint64_t>(i));
    const Shape shape = randomQuintic(random);
    const long double length = speedIntegral(shape, 800);
    if (std::fabs(speedIntegral(shape, 400) - length) > 1e-14L * length)
      continue; // nearly a cusp
    ++checked;
    ASSERT_NEAR(shape.length, static_cast<double>(length), 1e-14 * shape.length) << "seed " << i;
  }
  EXPECT_GT(checked, casesOf(1500) / 2);
}

TEST(PathShape, AnEllipseHasTheLengthOfTheEllipticIntegral) {
  // The whole of it: 2 pi a (1 - sum of 2^(n-1) c_n^2) / M, M the arithmetic-geometric mean of 1
  // and b/a.
  for (int i = 0; i < casesOf(2000); ++i) {
    Random random(static_cast<uint64_t>(i));
    const double a = random.magnitude(-3, 3);
    const double ratio = i == 0 ? 1.0 : random.magnitude(-3, 0);
    long double x = 1;
    long double y = ratio;
    long double sum = (1 - y * y) / 2;
    for (long double power = 0.5L; x - y > 1e-18L;) {
      const long double c = (x - y) / 2;
      const long double mean = (x + y) / 2;
      y = std::sqrt(x * y);
      x = mean;
      power *= 2;
      sum += power * c * c;
    }
    const auto length = static_cast<double>(2 * M_PIl * a * (1 - sum) / x);
    const Shape shape = ellipseShape({5, 6, 7}, {a, 0, 0}, {0, 0, a * ratio}, random.uniform(-3, 3),
                                     random.sign() * 2 * M_PI, {});
    ASSERT_NEAR(shape.length, length, 2e-13 * length) << ratio;
  }
}

TEST(PathShape, AHelixHasItsLengthInClosedForm) {
  Random random(1);
  for (int i = 0; i < casesOf(2000); ++i) {
    const double r = random.magnitude(-3, 3);
    const double sweep = random.sign() * random.magnitude(-3, 2);
    const double climb = random.magnitude(-3, 3);
    const Shape shape = arcShape({1, 2, 3}, {0, r, 0}, {0, 0, r}, 0.3, sweep, {climb, 0, 0});
    const double length = std::sqrt(r * r * sweep * sweep + climb * climb);
    ASSERT_NEAR(shape.length, length, 1e-15 * length);
    const Derivatives d = overLength(overParameter(shape, random.uniform(0, 1)));
    const double perLength = sweep / length; // radians
    ASSERT_NEAR(sizeOf(d.d2), r * perLength * perLength, 1e-14 * sizeOf(d.d2));
    ASSERT_NEAR(d.d1.x, climb / length, 1e-14);
    ASSERT_NEAR(sizeOf(d.d3), std::fabs(r * perLength * perLength * perLength),
                1e-13 * sizeOf(d.d3));
  }
}

TEST(PathShape, DerivativesOverTheLengthAreThoseOfItsPlaces) {
  int checked = 0;
  for (int i = 0; i < casesOf(1000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const Shape shape = randomShape(random);
    const double u = random.uniform(0.05, 0.95);
    const double way = lengthBetween(shape, 0, u);
    const Derivatives here = overLength(overParameter(shape, u));
    ASSERT_NEAR(sizeOf(here.d1), 1, 1e-14);
    const double curvature = sizeOf(here.d2);
    ASSERT_LE(std::fabs(here.d1.x * here.d2.x + here.d1.y * here.d2.y + here.d1.z * here.d2.z),
              1e-13 * curvature + 1e-300);
    // Differences over a step in which the curve does not turn far.
    const double bend = curvature + std::sqrt(sizeOf(here.d3));
    const double h = std::min(0.02 * shape.length, 1e-3 / (bend + 1e-300));
    const Derivatives before = overLength(overParameter(shape, parameterAt(shape, way - h)));
    const Derivatives after = overLength(overParameter(shape, parameterAt(shape, way + h)));
    const double wild = sizeOf(after.d3 - here.d3) + sizeOf(before.d3 - here.d3);
    if (wild > 0.1 * (sizeOf(here.d3) + 1e-3 * bend * bend))
      continue; // near a cusp
    ++checked;
    const double haze = 1e-15 * sizeOf(here.p) / h;
    ASSERT_LE(sizeOf((after.p - before.p) * (0.5 / h) - here.d1), 1e-6 + haze);
    ASSERT_LE(sizeOf((after.d1 - before.d1) * (0.5 / h) - here.d2), 1e-5 * bend + 1e-10 / h);
    ASSERT_LE(sizeOf((after.d2 - before.d2) * (0.5 / h) - here.d3),
              0.02 * bend * bend + 1e-10 / h * bend);
  }
  EXPECT_GT(checked, casesOf(1000) / 2);
}

TEST(PathShape, TheParameterAtALengthIsTheInverseOfTheLength) {
  for (int i = 0; i < casesOf(2000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const Shape shape = randomShape(random);
    const double part = random.uniform(0, 1);
    const double u = parameterAt(shape, part * shape.length);
    ASSERT_NEAR(lengthBetween(shape, 0, u), part * shape.length, 1e-13 * shape.length);
    ASSERT_NEAR(lengthBetween(shape, u, 1), (1 - part) * shape.length, 3e-13 * shape.length);
    ASSERT_EQ(parameterAt(shape, 0), 0);
    ASSERT_EQ(parameterAt(shape, shape.length), 1);
    ASSERT_EQ(parameterAt(shape, -1), 0);
  }
}

TEST(PathShape, ATableHasTheParameterAtAWay) {
  int checked = 0;
  for (int i = 0; i < casesOf(200) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const Shape shape = randomQuintic(random);
    const WayTable table = tableOf(shape);
    ASSERT_EQ(parameterAt(shape, table, 0), 0);
    ASSERT_NEAR(parameterAt(shape, table, shape.length), 1, 1e-12);
    if (std::fabs(speedIntegral(shape, 400) - speedIntegral(shape, 800)) > 1e-14L * shape.length)
      continue; // nearly a cusp
    ++checked;
    for (int part = 0; part < 20; ++part) {
      // At the ends of the table's parts, near to them, anywhere.
      const double border = wayAt(shape, table, random.below(17) / 16.0);
      const double near = border * (1 + random.uniform(-1e-9, 1e-9));
      const double any = random.uniform(0, shape.length);
      const double way = std::min(part < 5 ? border : part < 10 ? near : any, shape.length);
      const double u = parameterAt(shape, table, way);
      const auto reached = static_cast<double>(speedIntegral(shape, 800, u));
      ASSERT_NEAR(reached, way, 2e-13 * shape.length) << u; // what parts may be uneven
      ASSERT_NEAR(wayAt(shape, table, u), way, 1e-14 * shape.length) << u;
    }
  }
  EXPECT_GT(checked, casesOf(200) / 2);
}

TEST(PathShape, AQuinticHasTheEndsThatWereAskedFor) {
  for (int i = 0; i < casesOf(5000) && !HasFailure(); ++i) {
    Random random(static_cast<uint64_t>(i));
    const double size = random.magnitude(-5, 5);
    const auto any = [&] { return randomVector(random, size); };
    const Derivatives begin{any(), any(), any(), {}};
    const Derivatives end{any(), any(), any(), {}};
    const Shape shape = quinticShape(begin, end);
    const Derivatives first = overParameter(shape, 0);
    const Derivatives last = overParameter(shape, 1);
    ASSERT_LE(sizeOf(first.p - begin.p), 0);
    ASSERT_LE(sizeOf(first.d1 - begin.d1), 0);
    ASSERT_LE(sizeOf(first.d2 - begin.d2), 0);
    ASSERT_LE(sizeOf(last.p - end.p), 1e-13 * size);
    ASSERT_LE(sizeOf(last.d1 - end.d1), 1e-12 * size);
    ASSERT_LE(sizeOf(last.d2 - end.d2), 2e-12 * size);
  }
}

TEST(PathShape, LinesOfAnySizeHaveALength) {
  for (const double size : {1e-300, 1e-160, 1e-9, 1.0, 1e160, 1e300}) {
    const Shape shape = lineShape({0, 0, 0}, {3 * size, -4 * size, 12 * size});
    EXPECT_DOUBLE_EQ(shape.length, 13 * size);
    EXPECT_DOUBLE_EQ(overLength(overParameter(shape, 0.5)).d1.z, 12.0 / 13);
  }
  EXPECT_EQ(lineShape({1, 2, 3}, {1, 2, 3}).length, 0);
}

} // namespace
