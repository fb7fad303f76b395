// Cams from pieces against oracles: a dense solve for the natural quintic spline, numeric
// minimisation by random changes of what the builder chose, exactness of what was given.
#include "runtime/numeric/cam/builder.hpp"

#include "tests/support/cases.hpp"
#include "tests/support/random.hpp"
#include "tests/unit/cam/built_cam.hpp"

#include <Eigen/Dense>

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace stride::cam;
using namespace stride::test;

namespace {

/// The integral of the squared jerk over all segments, by Gauss-Legendre with five nodes, which is
/// exact up to degree 9; a piece of degree 7 has 8.
double energyOf(const BuiltCam &cam) {
  constexpr double kNodes[] = {0.0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640,
                               -0.9061798459386640};
  constexpr double kWeights[] = {0.5688888888888889, 0.4786286704993665, 0.4786286704993665,
                                 0.2369268850561891, 0.2369268850561891};
  double sum = 0.0;
  for (const Segment &segment : cam.segments) {
    const double half = 0.5 * (segment.end - segment.start);
    for (int i = 0; i < 5; ++i) {
      const double j = evaluateSegment(segment, segment.start + half * (1.0 + kNodes[i])).j;
      sum += half * kWeights[i] * j * j;
    }
  }
  return sum;
}

/// Places of random widths; the first `ends` derivatives of the first and last boundary are given.
std::vector<Piece> chain(Random &random, int pieces, double ratio, bool seventh) {
  std::vector<Piece> result;
  const double size = random.magnitude(-3, 4);
  const double length = random.magnitude(-3, 4);
  const auto place = [&](double x) {
    Boundary b = {x, size * random.uniform(-1, 1), 0, 0, 0, 2};
    b.v = size / length * random.uniform(-1, 1);
    b.a = size / length / length * random.uniform(-1, 1);
    b.j = size / length / length / length * random.uniform(-1, 1);
    if (random.chance(0.3))
      b.given = static_cast<int16_t>(3 + random.below(3));
    return b;
  };
  double x = length * random.uniform(-1, 1);
  Boundary left = place(x);
  for (int i = 0; i < pieces; ++i) {
    x += length * std::exp(random.uniform(-1, 0) * std::log(ratio));
    const Boundary right = place(x);
    result.push_back(seventh && random.chance(0.5) ? poly7(left, right) : poly5(left, right));
    left = implicit();
  }
  return result;
}

/// Position, velocity and acceleration (and the jerk between two of degree 7) go on at every joint.
void expectSmooth(const BuiltCam &cam, double tolerance) {
  for (size_t i = 1; i < cam.segments.size(); ++i) {
    const Segment &left = cam.segments[i - 1];
    const Segment &right = cam.segments[i];
    const double h = std::fmin(left.end - left.start, right.end - right.start);
    double size = std::fabs(right.coefficients[0]);
    for (int k = 0; k < 8; ++k)
      size = std::fmax(
          size, std::fmax(std::fabs(left.coefficients[k]), std::fabs(right.coefficients[k])));
    const Point a = cam.end(i - 1);
    const Point b = cam.start(i);
    EXPECT_NEAR(a.y, b.y, tolerance * size);
    EXPECT_NEAR(a.v, b.v, tolerance * size / h);
    EXPECT_NEAR(a.a, b.a, tolerance * size / h / h);
  }
}

TEST(CamBuilderProperty, WhatIsGivenIsKept) {
  Random random(1);
  for (int i = 0; i < casesOf(3000); ++i) {
    const BuiltCam cam(chain(random, 1 + random.below(12), 30, true));
    ASSERT_EQ(cam.error, BuildError::None);
    expectSmooth(cam, 1e-12);
    for (size_t k = 0; k < cam.segments.size(); ++k) {
      const Boundary &given = cam.pieces[k].right;
      const Point end = cam.end(k);
      double size = 0.0;
      for (const double coefficient : cam.segments[k].coefficients)
        size = std::fmax(size, std::fabs(coefficient));
      const double h = cam.segments[k].end - cam.segments[k].start;
      EXPECT_EQ(cam.segments[k].end, given.x);
      EXPECT_NEAR(end.y, given.y, 1e-13 * size);
      if (given.given > 2) {
        EXPECT_NEAR(end.v, given.v, 1e-12 * size / h);
      }
      if (given.given > 3) {
        EXPECT_NEAR(end.a, given.a, 1e-11 * size / h / h);
      }
      if (given.given > 4 && cam.pieces[k].kind == PieceKind::Poly7) {
        EXPECT_NEAR(end.j, given.j, 1e-10 * size / h / h / h);
      }
    }
  }
}

/// The natural quintic spline through places, by 6 n dense equations for its coefficients: places,
/// four continuous derivatives, third and fourth derivative 0 at both ends.
std::vector<double> naturalSpline(const std::vector<double> &x, const std::vector<double> &y) {
  const auto n = static_cast<Eigen::Index>(x.size()) - 1;
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(6 * n, 6 * n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(6 * n);
  Eigen::Index row = 0;
  const auto term = [](int power, int derivative, double u) {
    double factor = 1.0;
    for (int k = 0; k < derivative; ++k)
      factor *= power - k;
    return power < derivative ? 0.0 : factor * std::pow(u, power - derivative);
  };
  const auto width = [&](Eigen::Index i) {
    return x[static_cast<size_t>(i + 1)] - x[static_cast<size_t>(i)];
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    for (int p = 0; p < 6; ++p) {
      m(row, 6 * i + p) = term(p, 0, 0);
      m(row + 1, 6 * i + p) = term(p, 0, 1);
    }
    right(row++) = y[static_cast<size_t>(i)];
    right(row++) = y[static_cast<size_t>(i + 1)];
  }
  for (Eigen::Index i = 0; i + 1 < n; ++i)
    for (int d = 1; d <= 4; ++d, ++row)
      for (int p = 0; p < 6; ++p) {
        m(row, 6 * i + p) = term(p, d, 1);
        m(row, 6 * (i + 1) + p) = -term(p, d, 0) * std::pow(width(i) / width(i + 1), d);
      }
  for (int d = 3; d <= 4; ++d, row += 2)
    for (int p = 0; p < 6; ++p) {
      m(row, p) = term(p, d, 0);
      m(row + 1, 6 * (n - 1) + p) = term(p, d, 1);
    }
  const Eigen::VectorXd solution = m.fullPivLu().solve(right);
  return {solution.data(), solution.data() + solution.size()};
}

TEST(CamBuilderProperty, PlacesAloneGiveTheNaturalQuinticSpline) {
  Random random(2);
  for (int i = 0; i < casesOf(200); ++i) {
    const int n = 2 + random.below(9);
    const double size = random.magnitude(-3, 4);
    const double length = random.magnitude(-3, 4);
    std::vector<double> x = {0.0};
    std::vector<double> y = {0.0};
    std::vector<Piece> pieces;
    for (int k = 0; k < n; ++k) {
      x.push_back(x.back() + length * random.uniform(0.1, 1));
      y.push_back(size * random.uniform(-1, 1));
      pieces.push_back(poly5(k == 0 ? place(0, 0) : implicit(), place(x.back(), y.back())));
    }
    const BuiltCam cam(pieces);
    ASSERT_EQ(cam.error, BuildError::None);
    const std::vector<double> want = naturalSpline(x, y);
    double largest = 0.0;
    for (const double coefficient : want)
      largest = std::fmax(largest, std::fabs(coefficient));
    for (size_t k = 0; k < static_cast<size_t>(n); ++k)
      for (size_t p = 0; p < 6; ++p)
        EXPECT_NEAR(cam.segments[k].coefficients[p], want[6 * k + p], 1e-9 * largest);
  }
}

/// The same pieces with all derivatives given: those of the cam, changed a little where the builder
/// chose.
std::vector<Piece> changed(const BuiltCam &cam, Random &random, double amount, bool closed) {
  std::vector<Piece> pieces = cam.pieces;
  const size_t n = pieces.size();
  for (size_t k = 0; k <= n; ++k) {
    if (closed && k == 0)
      continue;
    const size_t left = k == 0 ? 0 : k - 1;
    const Boundary &given = k == 0 ? pieces[0].left : pieces[k - 1].right;
    const double h = cam.segments[left].end - cam.segments[left].start;
    const Point at = k == 0 ? cam.start(0) : cam.end(k - 1);
    double size = 0.0;
    for (int c = 1; c < 8; ++c)
      size = std::fmax(size, std::fabs(cam.segments[left].coefficients[c]));
    const auto moved = [&](double value, int derivative, int16_t needed) {
      if (given.given >= needed)
        return value;
      return value + amount * size * std::pow(h, -derivative) * random.uniform(-1, 1);
    };
    const Boundary exact = {given.x,
                            given.y,
                            moved(at.v, 1, 3),
                            moved(at.a, 2, 4),
                            moved(given.given > 4 ? given.j : at.j, 3, 5),
                            5};
    if (k > 0)
      pieces[k - 1].right = exact;
    if (k < n)
      pieces[k].left = exact;
    if (closed && k == n) {
      pieces[0].left = exact;
      pieces[0].left.x = cam.segments[0].start;
    }
  }
  return pieces;
}

void expectMinimal(bool seventh, bool closed, uint64_t seed) {
  Random random(seed);
  int compared = 0;
  for (int i = 0; i < casesOf(2000); ++i) {
    std::vector<Piece> pieces = chain(random, 1 + random.below(8), 1000, seventh);
    if (closed) {
      const double shift = -pieces[0].left.x;
      for (Piece &piece : pieces)
        piece.right.x += shift;
      pieces[0].left = implicit();
    }
    // At a joint of two degrees the jerk need not go on: not what is compared here.
    if (seventh)
      for (Piece &piece : pieces)
        piece.kind = PieceKind::Poly7;
    const BuiltCam cam(pieces, closed);
    ASSERT_EQ(cam.error, BuildError::None);
    const double best = energyOf(cam);
    for (const double amount : {1.0, 1e-2, 1e-4}) {
      const BuiltCam other(changed(cam, random, amount, closed));
      ASSERT_EQ(other.error, BuildError::None);
      const double energy = energyOf(other);
      EXPECT_GE(energy, best * (1 - 1e-9)) << i << " " << amount;
      compared += energy > best * (1 + 1e-9);
    }
  }
  EXPECT_GT(compared,
            casesOf(2000)); // some have nothing open, and the smallest change does not show
}

TEST(CamBuilderProperty, NoOtherDerivativesHaveLessJerk) { expectMinimal(false, false, 3); }
TEST(CamBuilderProperty, NorDoTheyInClosedCams) { expectMinimal(false, true, 4); }
TEST(CamBuilderProperty, NorWithDegree7) { expectMinimal(true, false, 5); }
TEST(CamBuilderProperty, NorWithDegree7InClosedCams) { expectMinimal(true, true, 6); }

TEST(CamBuilderProperty, FourDerivativesGoOnWhereOnlyPlacesAreGiven) {
  Random random(7);
  for (int i = 0; i < casesOf(2000); ++i) {
    const bool closed = random.chance(0.5);
    std::vector<Piece> pieces = chain(random, 3 + random.below(30), 10, false);
    for (Piece &piece : pieces)
      piece.right.given = 2;
    const double shift = -pieces[0].left.x;
    for (Piece &piece : pieces)
      piece.right.x += shift;
    pieces[0].left = closed ? implicit() : place(0, 0);
    const BuiltCam cam(pieces, closed);
    ASSERT_EQ(cam.error, BuildError::None);
    double size = 0.0;
    for (const Segment &segment : cam.segments)
      for (const double coefficient : segment.coefficients)
        size = std::fmax(size, std::fabs(coefficient));
    const size_t n = cam.segments.size();
    for (size_t k = closed ? 0 : 1; k < n; ++k) {
      const Segment &left = cam.segments[(k + n - 1) % n];
      const Segment &right = cam.segments[k];
      const double h0 = left.end - left.start;
      const double h1 = right.end - right.start;
      const double h = std::fmin(h0, h1);
      EXPECT_NEAR(cam.end((k + n - 1) % n).j, cam.start(k).j, 1e-9 * size / h / h / h);
      const double snap0 = 24 * left.coefficients[4] + 120 * left.coefficients[5];
      EXPECT_NEAR(snap0 / std::pow(h0, 4), 24 * right.coefficients[4] / std::pow(h1, 4),
                  1e-8 * size / std::pow(h, 4));
    }
  }
}

Curve curveOf(const BuiltCam &cam) {
  Curve curve;
  curve.form = Form::Segments;
  curve.start = cam.segments.front().start;
  curve.end = cam.segments.back().end;
  curve.count = static_cast<int32_t>(cam.segments.size());
  curve.data = cam.segments.data();
  return curve;
}

/// Any kind between any boundaries, one of two that meet implicit or without derivatives.
std::vector<Piece> mixture(Random &random) {
  std::vector<Piece> pieces;
  double x = random.uniform(-10, 10);
  const auto boundary = [&] {
    Boundary b = bound(x, random.uniform(-10, 10), random.uniform(-2, 2), random.uniform(-2, 2),
                       random.uniform(-2, 2));
    b.given = static_cast<int16_t>(2 + random.below(4));
    return b;
  };
  Boundary left = random.chance(0.5) ? implicit() : boundary();
  if (left.given == 0)
    x = 0;
  const int n = 1 + random.below(10);
  for (int i = 0; i < n; ++i) {
    x += random.uniform(0.2, 3);
    const bool taken = i + 1 < n && random.chance(0.3); // from the neighbour on the right
    Piece piece =
        pieceOf(static_cast<PieceKind>(random.below(8)), left, taken ? implicit() : boundary());
    piece.inflexion = random.uniform(0.1, 0.9);
    piece.parameter = piece.kind == PieceKind::Law ? random.uniform(0.1, 0.7) : 30;
    piece.law = static_cast<Law>(random.below(5));
    if (piece.kind == PieceKind::Coefficients)
      piece.kind = PieceKind::Line; // its places follow from its coefficients
    pieces.push_back(piece);
    left = taken ? boundary() : implicit();
  }
  return pieces;
}

bool isPolynomial(const Piece &piece) {
  return piece.kind == PieceKind::Poly5 || piece.kind == PieceKind::Poly7;
}

TEST(CamBuilderProperty, PolynomialsJoinWhateverIsBeside) {
  Random random(9);
  int built = 0;
  for (int i = 0; i < casesOf(5000); ++i) {
    const std::vector<Piece> pieces = mixture(random);
    const BuiltCam cam(pieces, random.chance(0.3));
    if (cam.error == BuildError::InvalidParameter) // no such peak of the acceleration
      continue;
    ASSERT_EQ(cam.error, BuildError::None);
    ++built;
    EXPECT_EQ(checkCurve(curveOf(cam)), CurveError::None);
    size_t piece = 0;
    for (size_t k = 0; k + 1 < cam.segments.size(); ++k) {
      const Point before = cam.end(k);
      const Point behind = cam.start(k + 1);
      // A polynomial of degree 7 that takes the jerk of a law gets large in between.
      double size = 1.0;
      for (const Segment &segment : {cam.segments[k], cam.segments[k + 1]})
        for (const double c : segment.coefficients)
          size = std::fmax(size, std::fabs(c) + std::fabs(segment.stroke));
      EXPECT_NEAR(before.y, behind.y, 1e-13 * size);
      const double end = cam.segments[k].end;
      const Boundary &right = pieces[piece].right;
      if (end !=
          (right.given != 0 ? right.x : pieces[piece + 1].left.x)) { // within a modified sine
        expectPoint(before, behind, 3, 1e-10 * size);
        continue;
      }
      const Piece &left = pieces[piece];
      const Piece &next = pieces[++piece];
      // The one whose boundary is implicit takes what the other has, unless that is open on a law.
      const Piece &taker = left.right.given == 0 ? left : next;
      const Piece &giver = left.right.given == 0 ? next : left;
      if (isPolynomial(taker) &&
          (isPolynomial(giver) || giver.kind == PieceKind::Line ||
           giver.kind == PieceKind::InclinedSine || giver.kind == PieceKind::ModifiedSine))
        expectPoint(before, behind, 3, 1e-10 * size);
    }
  }
  EXPECT_GT(built, casesOf(2500));
}

TEST(CamBuilderProperty, WhateverComesInOnlyNumbersComeOut) {
  Random random(10);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double strange[] = {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN(),
                            0.0,       -0.0,       1e308,
                            -1e308,    1e-308,     5e-324,
                            1e150,     1e-150};
  int built = 0;
  int refused = 0;
  for (int i = 0; i < casesOf(20000); ++i) {
    std::vector<Piece> pieces = mixture(random);
    const int changes = random.below(3);
    for (int k = 0; k < changes; ++k) {
      Piece &piece = pieces[static_cast<size_t>(random.below(static_cast<int>(pieces.size())))];
      Boundary &boundary = random.chance(0.5) ? piece.left : piece.right;
      double *const places[] = {&boundary.x,      &boundary.y,           &boundary.v,
                                &boundary.a,      &boundary.j,           &piece.inflexion,
                                &piece.parameter, &piece.coefficients[2]};
      *places[random.below(8)] = strange[random.below(11)];
      if (random.chance(0.2))
        boundary.given = static_cast<int16_t>(random.below(8) - 1);
      if (random.chance(0.1))
        piece.kind = static_cast<PieceKind>(random.below(12) - 2);
      if (random.chance(0.1))
        piece.law = static_cast<Law>(random.below(9) - 2);
    }
    const BuiltCam cam(pieces, random.chance(0.3));
    if (cam.error != BuildError::None) {
      ++refused;
      continue;
    }
    ++built;
    ASSERT_EQ(checkCurve(curveOf(cam)), CurveError::None) << i;
  }
  EXPECT_GT(built, casesOf(3000));
  EXPECT_GT(refused, casesOf(3000));
}

TEST(CamBuilderProperty, LengthsThatDifferMuchKeepTheCamContinuous) {
  Random random(8);
  for (int i = 0; i < casesOf(2000); ++i) {
    const BuiltCam cam(chain(random, 2 + random.below(50), 1e4, true), false);
    ASSERT_EQ(cam.error, BuildError::None);
    expectSmooth(cam, 1e-10);
  }
}

} // namespace
