#include "runtime/numeric/cam/laws.hpp"

#include "runtime/iec/math.h"
#include "runtime/numeric/exact_math.hpp"

namespace stride::cam {
namespace {

constexpr double kPi = 0x1.921fb54442d18p+1;

/// 1 - cos 2x, without cancellation.
double versine(double sine) noexcept { return 2.0 * sine * sine; }

struct Turn {
  double sine;
  double cosine;
};

/// Sine and cosine together; by their series up to an eighth of a turn, to the last digit or two.
Turn turnOf(double x) noexcept {
  if (!(exact::fabs(x) <= 0.25 * kPi))
    return {::stride::sin(x), ::stride::cos(x)};
  const double z = x * x;
  double sine = -1.0 / 1307674368000.0; // 15!
  sine = sine * z + 1.0 / 6227020800.0;
  sine = sine * z - 1.0 / 39916800.0;
  sine = sine * z + 1.0 / 362880.0;
  sine = sine * z - 1.0 / 5040.0;
  sine = sine * z + 1.0 / 120.0;
  sine = sine * z - 1.0 / 6.0;
  double cosine = 1.0 / 20922789888000.0; // 16!
  cosine = cosine * z - 1.0 / 87178291200.0;
  cosine = cosine * z + 1.0 / 479001600.0;
  cosine = cosine * z - 1.0 / 3628800.0;
  cosine = cosine * z + 1.0 / 40320.0;
  cosine = cosine * z - 1.0 / 720.0;
  cosine = cosine * z + 1.0 / 24.0;
  cosine = cosine * z - 0.5;
  return {x + x * z * sine, 1.0 + z * cosine};
}

Point harmonic(double u) noexcept {
  const auto [half, cosine] = turnOf(0.5 * kPi * u);
  return {half * half, kPi * half * cosine, 0.5 * kPi * kPi * (1.0 - versine(half)),
          -kPi * kPi * kPi * half * cosine};
}

Point cycloidal(double u) noexcept {
  // After a quarter from the middle, where it is short again.
  const bool late = u > 0.25;
  const Turn turn = turnOf(late ? kPi * (0.5 - u) : kPi * u);
  const double half = late ? turn.cosine : turn.sine;
  const double sine = 2.0 * turn.sine * turn.cosine;
  return {u - sine / (2.0 * kPi), versine(half), 2.0 * kPi * sine,
          4.0 * kPi * kPi * (1.0 - versine(half))};
}

/// Up to the middle: the acceleration rises like a quarter of a sine up to `b`, half of the
/// parameter, and falls like a quarter of a cosine from there on.
Point modifiedSine(double parameter, double u) noexcept {
  const double b = 0.5 * parameter;
  const double c = 0.5 - b;
  const double top = 1.0 / (parameter / kPi + 4.0 / (kPi * kPi) * (0.5 - parameter));
  const double rise = 2.0 * b / kPi; // radians to u
  if (u < b) {
    const auto [half, cosine] = turnOf(0.5 * u / rise);
    const double sine = 2.0 * half * cosine;
    return {top * rise * (u - rise * sine), top * rise * versine(half), top * sine,
            top / rise * (1.0 - versine(half))};
  }
  const double fall = 2.0 * c / kPi;
  const double w = u - b;
  const auto [half, cosine] = turnOf(0.5 * w / fall);
  const double sine = 2.0 * half * cosine;
  return {top * (rise * (b - rise) + rise * w + fall * fall * versine(half)),
          top * (rise + fall * sine), top * (1.0 - versine(half)), -top / fall * sine};
}

/// Up to the middle: a quarter of a sine, a plateau, a quarter of a cosine.
Point modifiedTrapezoid(double u) noexcept {
  constexpr double kTop = 8.0 * kPi / (2.0 + kPi);
  constexpr double kRise = 0.25 / kPi; // radians to u
  constexpr double kYPlateau = kTop * kRise * (0.125 - kRise);
  constexpr double kVPlateau = kTop * kRise;
  constexpr double kYFall = kYPlateau + kVPlateau * 0.25 + 0.5 * kTop * 0.0625;
  constexpr double kVFall = kVPlateau + kTop * 0.25;
  if (u < 0.125) {
    const auto [half, cosine] = turnOf(2.0 * kPi * u);
    const double sine = 2.0 * half * cosine;
    return {kTop * kRise * (u - kRise * sine), kTop * kRise * versine(half), kTop * sine,
            kTop / kRise * (1.0 - versine(half))};
  }
  if (u < 0.375) {
    const double w = u - 0.125;
    return {kYPlateau + (kVPlateau + 0.5 * kTop * w) * w, kVPlateau + kTop * w, kTop, 0.0};
  }
  const double w = u - 0.375;
  const auto [half, cosine] = turnOf(2.0 * kPi * w);
  const double sine = 2.0 * half * cosine;
  return {kYFall + kVFall * w + kTop * kRise * kRise * versine(half), kVFall + kTop * kRise * sine,
          kTop * (1.0 - versine(half)), -kTop / kRise * sine};
}

/// Up to the middle of the symmetric law; the other half is the same, turned round.
Point firstHalf(const LawShape &shape, double u) noexcept {
  switch (shape.law) {
  case Law::Harmonic:
    return harmonic(u);
  case Law::Cycloidal:
    return cycloidal(u);
  case Law::ModifiedSine:
    return modifiedSine(shape.parameter, u);
  case Law::ModifiedTrapezoid:
    return modifiedTrapezoid(u);
  case Law::Polynomial:
    break;
  }
  return {0.0, 0.0, 0.0, 0.0};
}

/// A half of the law that takes `width` of the way.
Point scaledHalf(const LawShape &shape, double width, double u) noexcept {
  const double factor = 2.0 * width;
  if (factor == 1.0)
    return firstHalf(shape, u);
  const Point point = firstHalf(shape, u / factor);
  return {point.y * factor, point.v, point.a / factor, point.j / (factor * factor)};
}

} // namespace

bool isUsable(const LawShape &shape) noexcept {
  if (shape.law < Law::Polynomial || shape.law > Law::ModifiedTrapezoid ||
      !exact::isfinite(shape.parameter) || !exact::isfinite(shape.inflexion))
    return false;
  return shape.law == Law::Polynomial ||
         (shape.inflexion > 0.0 && shape.inflexion < 1.0 &&
          (shape.law != Law::ModifiedSine || (shape.parameter >= 0.0 && shape.parameter < 1.0)));
}

Point evaluateLaw(const LawShape &shape, double u) noexcept {
  if (shape.law == Law::Polynomial)
    return {0.0, 0.0, 0.0, 0.0};
  if (u <= shape.inflexion)
    return scaledHalf(shape, shape.inflexion, u);
  const Point point = scaledHalf(shape, 1.0 - shape.inflexion, 1.0 - u);
  return {1.0 - point.y, point.v, -point.a, point.j};
}

} // namespace stride::cam
