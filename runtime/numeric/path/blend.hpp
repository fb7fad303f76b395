// Corner blends: a polynomial of degree 5 that leads from one path object to the next without a
// kink of the tangent or a jump of the curvature. It leaves the first object a cut before the
// corner and meets the second one a cut after it. Free of the C++ standard library: linked into
// every application.
#ifndef STRIDE_RUNTIME_NUMERIC_PATH_BLEND_HPP
#define STRIDE_RUNTIME_NUMERIC_PATH_BLEND_HPP

#include "runtime/numeric/path/shape.hpp"

namespace stride::path {

/// Corners that turn further are no corners to be blended: the motion stops there. 170 degrees.
inline constexpr double kMaxTurn = 2.96705972839036045;

/// The angle between two tangents of length 1, 0 to pi. [rad]
double turnBetween(const Vector3 &before, const Vector3 &after) noexcept;

/// The blend between two places, whose derivatives are those over the arc length: same tangent,
/// same curvature at both ends. Between lines of equal cuts its greatest curvature is the smallest
/// that such a polynomial can have.
Shape blendShape(const Derivatives &before, const Derivatives &after) noexcept;
/// The same where turnBetween() of both tangents is known. [rad] in
Shape blendShape(const Derivatives &before, const Derivatives &after, double turn) noexcept;

/// The length of the derivatives over u that such a blend has at both ends, over that of its chord.
/// [rad] in
double blendStretch(double turn) noexcept;

/// How far a blend between two lines stays away from their corner, in cuts; `turn` up to kMaxTurn.
/// [rad] in
double deviationPerCut(double turn) noexcept;

/// The greatest curvature of a blend between two lines, times the cut. [rad] in
double curvatureTimesCut(double turn) noexcept;

} // namespace stride::path

#endif // STRIDE_RUNTIME_NUMERIC_PATH_BLEND_HPP
