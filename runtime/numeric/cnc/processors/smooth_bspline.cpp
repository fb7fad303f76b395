#include "runtime/numeric/cnc/processors/smooth_bspline.hpp"

#include "runtime/numeric/cnc/meeting.hpp"
#include "runtime/numeric/cnc/velocity_check.hpp"
#include "runtime/numeric/path/blend.hpp"

namespace stride::cnc {
namespace {

using numeric::norm;

constexpr int32_t kMiddle = kSplineDegree / 2; ///< Of the lines that a piece depends on.
constexpr int32_t kBefore = kSplineDegree - 1; ///< Pieces before one that say its knots.

Vector3 wayOf(const PathObject &line) noexcept { return placeOf(line.end) - placeOf(line.start); }

bool isSmoothed(const SmoothBSpline &spline, const PathObject &object) noexcept {
  const double length = norm(wayOf(object));
  return object.moveType == MoveType::Line && object.probe == 0 &&
         (object.features & spline.features) == spline.features && exact::isPositive(length);
}

/// Whether a line goes on where the run has come to, and does not turn back.
bool goesOn(const SmoothBSpline &spline, const PathObject &line) noexcept {
  const PathObject &last = spline.lines[spline.count - 1];
  for (int32_t k = 0; k < kAxes; ++k)
    if (last.end.coordinate[k] != line.start.coordinate[k])
      return false;
  const Vector3 before = wayOf(last);
  const Vector3 after = wayOf(line);
  return path::turnBetween(before * (1.0 / norm(before)), after * (1.0 / norm(after))) <=
         path::kMaxTurn;
}

double spanOf(const SmoothBSpline &spline, const PathObject &line) noexcept {
  const double length = norm(wayOf(line));
  switch (spline.spacing) {
  case KnotSpacing::ChordLength:
    return length;
  case KnotSpacing::Centripetal:
    return exact::sqrt(length);
  case KnotSpacing::Uniform:
    break;
  }
  return 1.0;
}

SplineWindow windowOf(const SmoothBSpline &spline) noexcept {
  SplineWindow window{};
  for (int32_t k = 0; k < kAxes; ++k) {
    window.corner[0][k] = spline.lines[0].start.coordinate[k];
    for (int32_t i = 0; i < kSplineDegree; ++i)
      window.corner[i + 1][k] = spline.lines[i].end.coordinate[k];
  }
  for (int32_t i = 0; i < kBefore; ++i)
    window.span[i] = spline.span[i];
  for (int32_t i = 0; i < kSplineDegree && i + kSplineDegree <= spline.count; ++i)
    window.span[kBefore + i] = spanOf(spline, spline.lines[i + kMiddle]);
  return window;
}

// ---- the piece

Vector3 spaceOf(const double (&point)[kAxes]) noexcept {
  return {point[kAxisX], point[kAxisY], point[kAxisZ]};
}

/// Bezier's points as coefficients of the powers of u.
path::Shape shapeFrom(const double (&points)[kSplineCorners][kAxes]) noexcept {
  constexpr double kFactors[kSplineCorners][kSplineCorners] = {
      {1, 0, 0, 0, 0, 0},       {-5, 5, 0, 0, 0, 0},     {10, -20, 10, 0, 0, 0},
      {-10, 30, -30, 10, 0, 0}, {5, -20, 30, -20, 5, 0}, {-1, 5, -10, 10, -5, 1}};
  Vector3 coefficients[kSplineCorners];
  for (int32_t k = 0; k < kSplineCorners; ++k) {
    coefficients[k] = numeric::kZero;
    for (int32_t i = 0; i <= k; ++i)
      coefficients[k] = coefficients[k] + spaceOf(points[i]) * kFactors[k][i];
  }
  return path::polynomialShape(coefficients);
}

/// What an axis goes over the way between two of Bezier's points.
double slopeBetween(const double (&from)[kAxes], const double (&to)[kAxes], int32_t axis,
                    double even) noexcept {
  const double way = norm(spaceOf(to) - spaceOf(from));
  return way > 0.0 ? (to[axis] - from[axis]) / way : even;
}

/// A piece with everything but its shape: the velocities of the line in the middle, and what
/// concerns the tool of the first line of the run.
PathObject beginPiece(const SmoothBSpline &spline) noexcept {
  PathObject piece = spline.lines[kMiddle];
  piece.marks = spline.pieces == 0 ? spline.first.marks : uint8_t{0};
  piece.toolRadius = spline.first.toolRadius;
  piece.cornerDistance = spline.first.cornerDistance;
  piece.velocityEnd = piece.velocity;
  unsigned axes = 0;
  for (int32_t i = 0; i < kSplineDegree; ++i)
    axes |= spline.lines[i].end.axes;
  piece.start = spline.pieces == 0 ? spline.lines[0].start : spline.end;
  piece.end = spline.lines[kSplineDegree - 1].end;
  piece.start.axes = piece.end.axes = static_cast<uint16_t>(axes);
  piece.start.sProfile = piece.end.sProfile = 0;
  return piece;
}

void putAxes(const double (&points)[kSplineCorners][kAxes], bool isLast,
             PathObject &piece) noexcept {
  // The run ends where its last line does, to the last bit.
  for (int32_t k = 0; k < kAxes && !isLast; ++k)
    piece.end.coordinate[k] = points[kSplineDegree][k];
  piece.slopes = 0;
  for (int32_t i = 0; i < 3; ++i) {
    const int32_t axis = kAxisA + i;
    const double way = piece.end.coordinate[axis] - piece.start.coordinate[axis];
    const double even = way / piece.length;
    piece.startSlope[i] = slopeBetween(points[0], points[1], axis, even);
    piece.endSlope[i] = slopeBetween(points[kSplineDegree - 1], points[kSplineDegree], axis, even);
    if ((static_cast<unsigned>(piece.end.axes) >> static_cast<unsigned>(axis) & 1U) != 0)
      piece.slopes |= static_cast<uint8_t>(1U << static_cast<unsigned>(i));
  }
}

StreamError errorOf(const SmoothBSpline &spline) noexcept {
  for (int32_t i = 0; i < kSplineDegree; ++i) {
    if (spline.lines[i].planar != 0)
      return StreamError::NotInSpace;
    for (const int16_t id : spline.lines[i].switchId)
      if (id != 0)
        return StreamError::SwitchPoint;
  }
  return StreamError::None;
}

void forgetLine(SmoothBSpline &spline) noexcept {
  for (int32_t i = 1; i < spline.count; ++i)
    spline.lines[i - 1] = spline.lines[i];
  --spline.count;
}

/// Puts out the next piece, for which there are at least kSplineDegree lines. False: an error.
bool putPiece(SmoothBSpline &spline, Output &output) noexcept {
  output.error = errorOf(spline);
  const SplineWindow window = windowOf(spline);
  double points[kSplineCorners][kAxes];
  bezierOf(window, points);
  const path::Shape shape = shapeFrom(points);
  if (output.error == StreamError::None && !exact::isPositive(shape.length))
    output.error = StreamError::InvalidObject;
  if (output.error != StreamError::None)
    return false;
  PathObject piece = beginPiece(spline);
  describePiece(shape, piece);
  putAxes(points, spline.count == kSplineDegree, piece);
  (void)put(output, piece);
  spline.end = piece.end;
  for (int32_t i = 0; i + 1 < kBefore; ++i)
    spline.span[i] = spline.span[i + 1];
  spline.span[kBefore - 1] = window.span[kBefore];
  ++spline.pieces;
  forgetLine(spline);
  return true;
}

/// Puts out what is left of a run: its last pieces, or the lines if they are too few.
Step endRun(SmoothBSpline &spline, Output &output) noexcept {
  while (spline.count >= kSplineDegree || (spline.pieces == 0 && spline.count > 0)) {
    if (output.count >= kMostPerStep)
      return Step::Again;
    if (spline.count >= kSplineDegree) {
      if (!putPiece(spline, output))
        return Step::Failed;
      continue;
    }
    (void)put(output, spline.lines[0]);
    forgetLine(spline);
  }
  spline.count = spline.pieces = 0;
  return Step::Took;
}

} // namespace

Step next(SmoothBSpline &spline, const Source &source, Output &output) noexcept {
  if (spline.unknownFeature) {
    output.error = StreamError::FeatureBit;
    return Step::Failed;
  }
  const PathObject &object = source.object;
  const bool smoothed = isSmoothed(spline, object);
  if (spline.count != 0 && !(smoothed && goesOn(spline, object))) {
    const Step step = endRun(spline, output);
    if (step != Step::Took)
      return step;
  }
  if (!smoothed)
    return put(output, object) != nullptr ? Step::Took : Step::Again;
  if (spline.count == 0) {
    spline.first = object;
    for (double &span : spline.span)
      span = 0.0;
  }
  spline.lines[spline.count++] = object;
  if (spline.count == kSplineLines && !putPiece(spline, output))
    return Step::Failed;
  return Step::Took;
}

Step finish(SmoothBSpline &spline, Ending /*ending*/, Output &output) noexcept {
  return endRun(spline, output);
}

} // namespace stride::cnc
