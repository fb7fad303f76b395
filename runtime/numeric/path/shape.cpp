#include "runtime/numeric/path/shape.hpp"

#include "runtime/iec/math.h"

namespace stride::path {
namespace {

using numeric::dot;
using numeric::norm;

constexpr int kParts = 8;        ///< In which a curve is integrated at first.
constexpr int kMaxHalvings = 24; ///< Of a part, within each other.
constexpr int kMostHalved = 64;  ///< Of a part, in all: where terms nearly cancel out, what numbers
                                 ///< leave of them never agrees.
constexpr int kMaxSteps = 64;    ///< Of the search for a parameter.

bool hasConstantSpeed(const Shape &shape) noexcept {
  return shape.kind == ShapeKind::Line || shape.kind == ShapeKind::Arc;
}

Derivatives lineOver(const Shape &shape, double u) noexcept {
  return {shape.v[0] + shape.v[1] * u, shape.v[1], numeric::kZero, numeric::kZero};
}

Derivatives ellipseOver(const Shape &shape, double u) noexcept {
  const double phi = shape.angle + shape.sweep * u;
  const auto [s, c] = ::stride::sineCosine(phi);
  const double w = shape.sweep;
  const Vector3 outwards = shape.v[1] * c + shape.v[2] * s;
  const Vector3 onwards = shape.v[2] * c - shape.v[1] * s;
  return {shape.v[0] + outwards + shape.v[3] * u, onwards * w + shape.v[3], outwards * (-w * w),
          onwards * (-w * w * w)};
}

Derivatives polynomialOver(const Shape &shape, double u) noexcept {
  Derivatives d{shape.v[5], numeric::kZero, numeric::kZero, numeric::kZero};
  for (int k = 4; k >= 0; --k) {
    d.d3 = d.d3 * u + d.d2;
    d.d2 = d.d2 * u + d.d1;
    d.d1 = d.d1 * u + d.p;
    d.p = d.p * u + shape.v[k];
  }
  d.d2 = d.d2 * 2.0;
  d.d3 = d.d3 * 6.0;
  return d;
}

/// How fast a polynomial is gone through: the coefficients of its derivative.
struct SpeedOf {
  Vector3 c[5];
};

SpeedOf speedOf(const Shape &polynomial) noexcept {
  const Vector3(&v)[6] = polynomial.v;
  return {{v[1], v[2] * 2.0, v[3] * 3.0, v[4] * 4.0, v[5] * 5.0}};
}

/// The speeds at several parameters, which take their places. An even number of them goes through
/// the processor's lanes by pairs.
template <int kPoints> void setSpeeds(const SpeedOf &speed, double (&at)[kPoints]) noexcept {
  const Vector3(&c)[5] = speed.c;
  for (double &place : at) {
    const double u = place;
    const double x = c[0].x + (c[1].x + (c[2].x + (c[3].x + c[4].x * u) * u) * u) * u;
    const double y = c[0].y + (c[1].y + (c[2].y + (c[3].y + c[4].y * u) * u) * u) * u;
    const double z = c[0].z + (c[1].z + (c[2].z + (c[3].z + c[4].z * u) * u) * u) * u;
    place = x * x + y * y + z * z;
  }
  for (double &square : at)
    square = exact::sqrt(square);
}

/// The integral over one part, halved until both halves together say the same. Where a curve nearly
/// stands still, the rule is wrong by the square of the width: there the smallest parts must not be
/// asked for less than the others, or they would be halved without end.
double integrate(const Shape &shape, double from, double to, double tolerance) noexcept {
  // The parts that are left lie one after the other: those ahead of the present one are the right
  // halves of the levels that are marked.
  double sum = 0.0;
  double begin = from;
  double width = to - from;
  int level = 0;
  int halved = 0;
  uint32_t left = 0; // levels at which the present part is a left half
  double whole = quickLength(shape, begin, begin + width);
  for (;;) {
    const double half = 0.5 * width;
    const double first = quickLength(shape, begin, begin + half);
    const double second = quickLength(shape, begin + half, begin + width);
    if (level < kMaxHalvings && halved < kMostHalved &&
        exact::fabs(first + second - whole) > tolerance) {
      width = half;
      whole = first;
      ++level;
      ++halved;
      left |= 1U << static_cast<unsigned>(level);
      continue;
    }
    sum += first + second;
    begin += width;
    while (level > 0 && (left >> static_cast<unsigned>(level) & 1U) == 0) {
      width *= 2.0;
      --level;
    }
    if (level == 0)
      return sum;
    left &= ~(1U << static_cast<unsigned>(level));
    whole = quickLength(shape, begin, begin + width);
  }
}

/// An integral by Gauss's rule of 7 points and by Kronrod's of 15, which goes on from it.
struct Integral {
  double gauss;
  double kronrod;
};

/// Of coefficients from 1e-90 to 1e90: squares neither overflow nor count where they vanish.
Integral integral(const SpeedOf &speed, double from, double to) noexcept {
  constexpr int kPoints = 16; // the middle twice: pairs go through the processor's lanes
  // Even places are Gauss's.
  constexpr double kAt[] = {0.0,
                            0.20778495500789846760,
                            0.40584515137739716691,
                            0.58608723546769113029,
                            0.74153118559939443986,
                            0.86486442335976907279,
                            0.94910791234275852453,
                            0.99145537112081263921};
  constexpr double kWeight[] = {0.20948214108472782801, 0.20443294007529889241,
                                0.19035057806478540991, 0.16900472663926790658,
                                0.14065325971552591875, 0.10479001032225018384,
                                0.06309209262997855329, 0.02293532201052922496};
  constexpr double kGauss[] = {0.41795918367346938776, 0.38183005050511894495,
                               0.27970539148927666790, 0.12948496616886969327};
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  double length[kPoints];
  for (int i = 0; i < 8; ++i) {
    length[i] = middle - half * kAt[i];
    length[8 + i] = middle + half * kAt[i];
  }
  setSpeeds(speed, length);
  Integral sum{kGauss[0] * length[0], kWeight[0] * length[0]};
  for (int i = 1; i < 8; ++i) {
    const double both = length[i] + length[8 + i];
    sum.kronrod += kWeight[i] * both;
    if (i % 2 == 0)
      sum.gauss += kGauss[i / 2] * both;
  }
  return {sum.gauss * half, sum.kronrod * half};
}

/// Gauss's error goes down with the 14th power of what separates the interval from where the speed
/// is not smooth, Kronrod's with the 24th: if the first is 1e-9, the other is below 4e-16.
bool agrees(const Integral &part) noexcept {
  return exact::fabs(part.kronrod - part.gauss) <= 1e-9 * part.kronrod;
}

/// The length of a polynomial that bends little, as corners do; less than 0 if it bends too much
/// for that.
double smoothLength(const Shape &shape) noexcept {
  const SpeedOf speed = speedOf(shape);
  Vector3 last = numeric::kZero;
  double most = 0.0;
  for (const Vector3 &c : speed.c) {
    last = last + c;
    most = exact::larger(
        most, exact::larger(exact::fabs(c.x), exact::larger(exact::fabs(c.y), exact::fabs(c.z))));
  }
  if (!(most > 1e-90 && most < 1e90))
    return -1.0;
  const double turned = dot(speed.c[0], last);
  const bool bendsLittle = turned > 0.9 * norm(speed.c[0]) * norm(last); // by less than 26 degrees
  Integral whole{};
  if (bendsLittle) {
    whole = integral(speed, 0.0, 1.0);
    if (agrees(whole))
      return whole.kronrod;
  }
  const Integral first = integral(speed, 0.0, 0.5);
  const Integral second = integral(speed, 0.5, 1.0);
  const double halves = first.kronrod + second.kronrod;
  if (agrees(first) && agrees(second))
    return halves;
  // If Kronrod's error is 1e-12 over the whole, what separates is 3.2, and 4.7 or more for either
  // half, whose error is then below 1e-16.
  if (!bendsLittle)
    whole = integral(speed, 0.0, 1.0);
  return exact::fabs(whole.kronrod - halves) <= 1e-12 * halves ? halves : -1.0;
}

/// An arc of a circle or an ellipse, without its length.
Shape roundShape(ShapeKind kind, const Vector3 &centre, const Vector3 &first, const Vector3 &second,
                 double angle, double sweep, const Vector3 &climb) noexcept {
  Shape shape{};
  shape.kind = kind;
  shape.v[0] = centre;
  shape.v[1] = first;
  shape.v[2] = second;
  shape.v[3] = climb;
  shape.angle = angle;
  shape.sweep = sweep;
  return shape;
}

Shape withLength(Shape shape) noexcept {
  shape.length = lengthBetween(shape, 0.0, 1.0);
  return shape;
}

} // namespace

Shape lineShape(const Vector3 &start, const Vector3 &end) noexcept {
  Shape shape{};
  shape.kind = ShapeKind::Line;
  shape.v[0] = start;
  shape.v[1] = end - start;
  shape.length = norm(shape.v[1]);
  return shape;
}

Shape arcShape(const Vector3 &centre, const Vector3 &radial, const Vector3 &lateral, double angle,
               double sweep, const Vector3 &climb) noexcept {
  Shape shape = roundShape(ShapeKind::Arc, centre, radial, lateral, angle, sweep, climb);
  shape.length = norm({norm(radial) * sweep, norm(climb), 0.0});
  return shape;
}

Shape ellipseShape(const Vector3 &centre, const Vector3 &first, const Vector3 &second, double angle,
                   double sweep, const Vector3 &climb) noexcept {
  return withLength(roundShape(ShapeKind::Ellipse, centre, first, second, angle, sweep, climb));
}

Shape polynomialShape(const Vector3 (&coefficients)[6]) noexcept {
  Shape shape{};
  shape.kind = ShapeKind::Polynomial;
  for (int k = 0; k < 6; ++k)
    shape.v[k] = coefficients[k];
  const double length = smoothLength(shape);
  if (!(length >= 0.0))
    return withLength(shape);
  shape.length = length;
  return shape;
}

Shape quinticShape(const Derivatives &begin, const Derivatives &end) noexcept {
  // What is left of the end after the first three terms.
  const Vector3 p = end.p - begin.p - begin.d1 - begin.d2 * 0.5;
  const Vector3 d1 = end.d1 - begin.d1 - begin.d2;
  const Vector3 d2 = end.d2 - begin.d2;
  return polynomialShape({begin.p, begin.d1, begin.d2 * 0.5, p * 10.0 - d1 * 4.0 + d2 * 0.5,
                          d1 * 7.0 - p * 15.0 - d2, p * 6.0 - d1 * 3.0 + d2 * 0.5});
}

bool cutStart(Shape &shape, double u) noexcept {
  const double rest = 1.0 - u;
  if (shape.kind == ShapeKind::Line) {
    shape.v[0] = shape.v[0] + shape.v[1] * u;
    shape.v[1] = shape.v[1] * rest;
  } else if (shape.kind == ShapeKind::Arc) {
    shape.v[0] = shape.v[0] + shape.v[3] * u;
    shape.v[3] = shape.v[3] * rest;
    shape.angle += shape.sweep * u;
    shape.sweep *= rest;
  } else {
    return false;
  }
  shape.length *= rest;
  return true;
}

Derivatives overParameter(const Shape &shape, double u) noexcept {
  switch (shape.kind) {
  case ShapeKind::Line:
    return lineOver(shape, u);
  case ShapeKind::Arc:
  case ShapeKind::Ellipse:
    return ellipseOver(shape, u);
  case ShapeKind::Polynomial:
    break;
  }
  return polynomialOver(shape, u);
}

Derivatives overLength(const Derivatives &c) noexcept {
  // With r = 1 / |d1|: t = d1 r, and r' = -(d1 d2) r^4 over the length.
  const double r = 1.0 / norm(c.d1);
  const Vector3 t = c.d1 * r;
  const Vector3 n2 = c.d2 * (r * r);
  const Vector3 n3 = c.d3 * (r * r * r);
  const double along = dot(t, n2);
  const Vector3 curvature = n2 - t * along;
  const double alongNext = dot(curvature, n2) + dot(t, n3) - 2.0 * along * along;
  return {c.p, t, curvature, n3 - n2 * (2.0 * along) - curvature * along - t * alongNext};
}

double speedAt(const Shape &shape, double u) noexcept {
  if (shape.kind != ShapeKind::Polynomial)
    return norm(overParameter(shape, u).d1);
  const Vector3(&v)[6] = shape.v;
  Vector3 d1 = v[5] * 5.0; // as setSpeeds has it
  for (int k = 4; k >= 1; --k)
    d1 = v[k] * k + d1 * u;
  return norm(d1);
}

double quickLength(const Shape &shape, double from, double to) noexcept {
  constexpr double kAt[] = {0.0, 0.53846931010568309104, 0.90617984593866399280};
  constexpr double kWeight[] = {0.56888888888888888889, 0.47862867049936646804,
                                0.23692688505618908751};
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  double at[] = {middle,
                 middle - half * kAt[1],
                 middle - half * kAt[2],
                 middle, // the middle twice: see setSpeeds
                 middle + half * kAt[1],
                 middle + half * kAt[2]};
  if (shape.kind == ShapeKind::Polynomial)
    setSpeeds(speedOf(shape), at);
  else
    for (double &place : at)
      place = speedAt(shape, place);
  return (kWeight[0] * at[0] + kWeight[1] * (at[1] + at[4]) + kWeight[2] * (at[2] + at[5])) * half;
}

double lengthBetween(const Shape &shape, double from, double to) noexcept {
  if (hasConstantSpeed(shape))
    return shape.length * (to - from);
  double size = shape.length;
  for (int i = 0; i <= kParts && !(shape.length > 0.0); ++i)
    size = exact::larger(size, speedAt(shape, from + (to - from) * i / kParts));
  const double tolerance = 1e-15 * size * exact::fabs(to - from);
  const int parts = exact::fabs(to - from) * kParts > 1.0 ? kParts : 1;
  double sum = 0.0;
  for (int i = 0; i < parts; ++i)
    sum += integrate(shape, from + (to - from) * i / parts, from + (to - from) * (i + 1) / parts,
                     tolerance);
  return sum;
}

double parameterBetween(const Shape &shape, double from, double to, double way,
                        double first) noexcept {
  // Newton's steps, kept between what is known to be too little and too much.
  double low = from;
  double high = to;
  double u = first;
  double at = lengthBetween(shape, from, u);
  for (int i = 0; i < kMaxSteps; ++i) {
    const double off = way - at;
    if (exact::fabs(off) <= 1e-15 * shape.length)
      break;
    (off > 0.0 ? low : high) = u;
    double next = u + off / speedAt(shape, u);
    if (!(next > low && next < high))
      next = 0.5 * (low + high);
    if (next == u)
      break;
    at += next > u ? lengthBetween(shape, u, next) : -lengthBetween(shape, next, u);
    u = next;
  }
  return u;
}

double parameterAt(const Shape &shape, double way) noexcept {
  if (!(way > 0.0))
    return 0.0;
  if (way >= shape.length)
    return 1.0;
  const double evenly = way / shape.length;
  return hasConstantSpeed(shape) ? evenly : parameterBetween(shape, 0.0, 1.0, way, evenly);
}

} // namespace stride::path
