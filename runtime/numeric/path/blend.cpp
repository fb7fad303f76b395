#include "runtime/numeric/path/blend.hpp"

#include "runtime/iec/math.h"

namespace stride::path {
namespace {

using numeric::cross;
using numeric::dot;
using numeric::norm;

constexpr double kStep = 0.17453292519943296; ///< 10 degrees.

/// For turns of 0, 10 ... 170 degrees: the length of the end derivatives, over the chord, with
/// which the greatest curvature is least ...
constexpr double kStretch[] = {0.8858, 0.8880, 0.8936, 0.9039, 0.9184, 0.9372,
                               0.9618, 0.9919, 1.0282, 1.0718, 1.1252, 1.1891,
                               1.2662, 1.3616, 1.4789, 1.6282, 1.8188, 2.0779};
/// ... and that curvature times the cut, over the tangent of half the turn.
constexpr double kCurvature[] = {1.17667, 1.17654, 1.17621, 1.17568, 1.17499, 1.17419,
                                 1.17333, 1.17247, 1.17164, 1.17083, 1.17002, 1.16906,
                                 1.16774, 1.16562, 1.16206, 1.15599, 1.14581, 1.12897};
constexpr int kTurns = sizeof kStretch / sizeof kStretch[0];

double interpolated(const double (&table)[kTurns], double turn) noexcept {
  const double at = exact::smaller(exact::larger(turn, 0.0) / kStep, kTurns - 1.0);
  const int index = at < kTurns - 2.0 ? static_cast<int>(at) : kTurns - 2;
  const double part = at - index;
  return table[index] + (table[index + 1] - table[index]) * part;
}

} // namespace

double turnBetween(const Vector3 &before, const Vector3 &after) noexcept {
  return ::stride::atan2(norm(cross(before, after)), dot(before, after));
}

double blendStretch(double turn) noexcept { return interpolated(kStretch, turn); }

Shape blendShape(const Derivatives &before, const Derivatives &after) noexcept {
  return blendShape(before, after, turnBetween(before.d1, after.d1));
}

Shape blendShape(const Derivatives &before, const Derivatives &after, double turn) noexcept {
  const double speed = blendStretch(turn) * norm(after.p - before.p);
  const auto over = [speed](const Derivatives &end) {
    return Derivatives{end.p, end.d1 * speed, end.d2 * (speed * speed), numeric::kZero};
  };
  return quinticShape(over(before), over(after));
}

double deviationPerCut(double turn) noexcept {
  // The middle of the polynomial is that of the chord and 5/32 of the difference of the ends'
  // derivatives.
  const double half = 0.5 * turn;
  return ::stride::sin(half) * (1.0 - 0.625 * interpolated(kStretch, turn) * ::stride::cos(half));
}

double curvatureTimesCut(double turn) noexcept {
  return interpolated(kCurvature, turn) * ::stride::tan(0.5 * turn);
}

} // namespace stride::path
