// Curves of cams in every form against a plain implementation, and what must hold for each.
#include "random_curves.hpp"

#include "motion_problems.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <utility>

namespace {

namespace cam = stride::cam;
using stride::test::casesOf;
using stride::test::MadeCurve;
using stride::test::Plain;
using stride::test::Random;

/// Scales of a piece, to which errors are relative.
struct Scales {
  double y, v, a, j;
};

Scales scalesOf(const MadeCurve &made, uint32_t piece, bool periodic) {
  const cam::Segment segment = cam::pieceOf(made.curve, piece, periodic);
  const double h = segment.end - segment.start;
  double size = std::fabs(segment.stroke) * 10;
  double degree = 1;
  for (const double c : segment.coefficients)
    size += std::fabs(c) * degree, degree += 1;
  // What rounding of x does: as large as the places are.
  const double place = 1.0 + std::fmax(std::fabs(segment.start), std::fabs(segment.end)) / h;
  size *= place;
  return {size, 8 * size / h, 100 * size / h / h, 2000 * size / h / h / h};
}

void expectSame(const cam::Point &point, const Plain &plain, const Scales &scales) {
  constexpr double kRelative = 2e-14;
  EXPECT_NEAR(point.y, static_cast<double>(plain.y), kRelative * scales.y);
  EXPECT_NEAR(point.v, static_cast<double>(plain.v), kRelative * scales.v);
  EXPECT_NEAR(point.a, static_cast<double>(plain.a), kRelative * scales.a);
  EXPECT_NEAR(point.j, static_cast<double>(plain.j), kRelative * scales.j);
}

bool sameBits(const cam::Point &a, const cam::Point &b) {
  return std::bit_cast<uint64_t>(a.y) == std::bit_cast<uint64_t>(b.y) &&
         std::bit_cast<uint64_t>(a.v) == std::bit_cast<uint64_t>(b.v) &&
         std::bit_cast<uint64_t>(a.a) == std::bit_cast<uint64_t>(b.a) &&
         std::bit_cast<uint64_t>(a.j) == std::bit_cast<uint64_t>(b.j);
}

} // namespace

TEST(CamCurves, AreWhatThePlainImplementationSays) {
  Random random(1);
  for (int i = 0; i < casesOf(3000); ++i) {
    const MadeCurve made = stride::test::randomCurve(random, 20);
    ASSERT_EQ(cam::checkCurve(made.curve), cam::CurveError::None);
    const bool periodic = random.chance(0.5);
    uint32_t index = 0;
    for (int k = 0; k < 20; ++k) {
      const double x = random.uniform(made.curve.start, made.curve.end);
      const cam::Point point = cam::evaluateCurve(made.curve, x, periodic, index);
      const cam::Segment piece = cam::pieceOf(made.curve, index, periodic);
      ASSERT_LE(piece.start, x);
      ASSERT_LE(x, std::nextafter(piece.end, INFINITY));
      if (piece.law != cam::Law::Polynomial && std::fabs(point.j) > 0.0) {
        // Not where the jerk jumps: which side it is there is a matter of rounding.
        const double s = piece.lawBegin + (piece.lawEnd - piece.lawBegin) * (x - piece.start) /
                                              (piece.end - piece.start);
        const cam::LawShape shape{piece.law, piece.parameter, piece.inflexion};
        if (std::fabs(cam::evaluateLaw(shape, s - 1e-9).j - cam::evaluateLaw(shape, s + 1e-9).j) >
            1e-3)
          continue;
      }
      const Scales scales = scalesOf(made, index, periodic);
      expectSame(point, stride::test::plainPiece(made, index, x, periodic), scales);
      expectSame(cam::evaluateSegment(piece, x), stride::test::plainPiece(made, index, x, periodic),
                 scales);
    }
  }
}

TEST(CamCurves, DependOnNothingButTheCurveAndThePlace) {
  Random random(2);
  for (int i = 0; i < casesOf(1000); ++i) {
    const MadeCurve made = stride::test::randomCurve(random, 60);
    const double length = made.curve.end - made.curve.start;
    std::vector<std::pair<double, cam::Point>> course;
    uint32_t moving = static_cast<uint32_t>(random.below(1 << 30));
    double x = random.uniform(made.curve.start, made.curve.end);
    const double step = length * random.magnitude(-4, -0.5);
    for (int k = 0; k < 100; ++k) { // there, also beyond the ends …
      const cam::Point point = cam::evaluateCurve(made.curve, x, false, moving);
      uint32_t fresh = 0;
      EXPECT_TRUE(sameBits(point, cam::evaluateCurve(made.curve, x, false, fresh)));
      EXPECT_EQ(moving, fresh);
      fresh = 0xFFFFFFFFU;
      EXPECT_TRUE(sameBits(point, cam::evaluateCurve(made.curve, x, false, fresh)));
      course.emplace_back(x, point);
      x += step * random.uniform(-0.3, 1.0);
    }
    for (size_t k = course.size(); k-- > 0;) // … and back, to the bit
      EXPECT_TRUE(sameBits(course[k].second,
                           cam::evaluateCurve(made.curve, course[k].first, false, moving)));
  }
}

TEST(CamCurves, OfNodesAndLawsAreSmoothAtTheJoints) {
  Random random(3);
  for (int i = 0; i < casesOf(3000); ++i) {
    const bool nodes = random.chance(0.5);
    const MadeCurve made =
        nodes ? stride::test::randomNodes(random, 12) : stride::test::randomSegments(random, 12);
    for (uint32_t piece = 1; piece < cam::pieceCount(made.curve); ++piece) {
      const cam::Segment left = cam::pieceOf(made.curve, piece - 1, false);
      const cam::Segment right = cam::pieceOf(made.curve, piece, false);
      if (left.law == cam::Law::Harmonic || right.law == cam::Law::Harmonic)
        continue; // its acceleration is its own
      if ((left.law == cam::Law::ModifiedSine && left.parameter < 0.02) ||
          (right.law == cam::Law::ModifiedSine && right.parameter < 0.02))
        continue; // nearly harmonic: a jerk of 1e3 within the last digits of x
      uint32_t index = piece;
      const double x = right.start;
      const cam::Point behind = cam::evaluateCurve(made.curve, x, false, index);
      ASSERT_EQ(index, piece);
      const cam::Point before = cam::evaluateSegment(left, x);
      const double h = std::fmin(left.end - left.start, right.end - right.start);
      const double size = std::fabs(behind.y) + std::fabs(left.coefficients[0]) +
                          std::fabs(left.stroke) + std::fabs(right.stroke) +
                          (std::fabs(behind.v) + std::fabs(behind.a) * h) * h;
      EXPECT_NEAR(before.y, behind.y, 1e-12 * size);
      EXPECT_NEAR(before.v, behind.v, 1e-12 * size / h * 10);
      EXPECT_NEAR(before.a, behind.a, 1e-12 * size / h / h * 100);
    }
  }
}

TEST(CamCurves, CubicTablesHaveNoJumpsOfVelocityAlsoRoundTheCorner) {
  Random random(4);
  int around = 0;
  for (int i = 0; i < casesOf(3000); ++i) {
    MadeCurve made = stride::test::randomTable(random, random.chance(0.5), 2 + random.below(20));
    made.curve.cubic = true;
    const bool periodic = random.chance(0.5);
    const uint32_t pieces = cam::pieceCount(made.curve);
    for (uint32_t piece = periodic ? 0 : 1; piece < pieces; ++piece) {
      const cam::Segment left =
          cam::pieceOf(made.curve, piece == 0 ? pieces - 1 : piece - 1, periodic);
      const cam::Segment right = cam::pieceOf(made.curve, piece, periodic);
      const double before = cam::evaluateSegment(left, left.end).v;
      const double behind = cam::evaluateSegment(right, right.start).v;
      const double size = std::fabs(left.coefficients[0]) + std::fabs(left.coefficients[1]) +
                          std::fabs(left.coefficients[2]) + std::fabs(left.coefficients[3]) +
                          std::fabs(right.coefficients[0]);
      EXPECT_NEAR(before, behind,
                  1e-11 * size / (left.end - left.start) *
                      (1 + std::fabs(left.end) / (left.end - left.start)));
      around += piece == 0 ? 1 : 0;
    }
  }
  EXPECT_GT(around, casesOf(3000) / 4);
}

TEST(CamCurves, MeetTheirPlacesExactly) {
  Random random(5);
  for (int i = 0; i < casesOf(3000); ++i) {
    const MadeCurve made = random.chance(0.5)
                               ? stride::test::randomTable(random, random.chance(0.5), 20)
                               : stride::test::randomNodes(random, 20);
    for (uint32_t piece = 0; piece < cam::pieceCount(made.curve); ++piece) {
      const double x = stride::test::beginOf(made, piece);
      uint32_t index = 7;
      const cam::Point point = cam::evaluateCurve(made.curve, x, false, index);
      EXPECT_EQ(index, piece);
      EXPECT_EQ(point.y, cam::pieceOf(made.curve, piece, false).coefficients[0]);
      if (piece > 0) {
        EXPECT_EQ(point.y, cam::endOfPiece(made.curve, piece - 1));
      }
    }
  }
}

TEST(CamCurves, OfTablesScaleAsTheirScalingSays) {
  Random random(6);
  for (int i = 0; i < casesOf(2000); ++i) {
    // Twice the scaling is twice the curve, to the bit; a shift moves it.
    MadeCurve made = stride::test::randomTable(random, random.chance(0.5), 15);
    made.curve.slave.base = 0.0;
    made.curve.rise = 0.0;
    MadeCurve doubled = made;
    doubled.curve.data = doubled.memory.data();
    doubled.curve.slave.factor *= 2.0;
    MadeCurve moved = made;
    moved.curve.data = moved.memory.data();
    moved.curve.slave.base = 64.0;
    for (int k = 0; k < 20; ++k) {
      const double x = random.uniform(made.curve.start, made.curve.end);
      uint32_t index = 0;
      const cam::Point point = cam::evaluateCurve(made.curve, x, true, index);
      const cam::Point twice = cam::evaluateCurve(doubled.curve, x, true, index);
      EXPECT_TRUE(sameBits(twice, {2 * point.y, 2 * point.v, 2 * point.a, 2 * point.j}));
      const cam::Point higher = cam::evaluateCurve(moved.curve, x, true, index);
      EXPECT_NEAR(higher.y, point.y + 64.0, 1e-11 * (100 + std::fabs(point.y)));
    }
  }
}

TEST(CamCurves, GarbageIsSeenAndNeverCrashes) {
  Random random(7);
  int good = 0;
  for (int i = 0; i < casesOf(30000); ++i) {
    MadeCurve made = stride::test::randomCurve(random, 6);
    // Some bytes become others.
    for (int k = random.below(3); k >= 0; --k)
      made.memory[static_cast<size_t>(random.below(static_cast<int>(made.memory.size())))] =
          static_cast<unsigned char>(random.below(256));
    if (random.chance(0.2))
      made.curve.slave.factor = random.chance(0.5) ? 0.0 : NAN;
    if (random.chance(0.1))
      made.curve.start = INFINITY;
    if (random.chance(0.1))
      made.curve.form = static_cast<cam::Form>(random.chance(0.5) ? 0 : 5 + random.below(251));
    if (random.chance(0.1) && made.curve.form != cam::Form::EvenTable &&
        made.curve.form != cam::Form::PairTable)
      made.curve.element = static_cast<cam::Element>(random.below(256));
    if (cam::checkCurve(made.curve) != cam::CurveError::None)
      continue;
    ++good;
    uint32_t index = static_cast<uint32_t>(random.below(1 << 30));
    for (int k = 0; k < 5; ++k) {
      const double x = random.uniform(made.curve.start, made.curve.end);
      (void)cam::evaluateCurve(made.curve, x, random.chance(0.5), index);
      EXPECT_LT(index, cam::pieceCount(made.curve));
    }
  }
  EXPECT_GT(good, casesOf(30000) / 10);
}
