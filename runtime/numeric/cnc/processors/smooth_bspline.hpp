// Runs of lines become B-splines of degree 5 whose control points are the ends of the lines:
// SMC_SmoothBSpline. Free of the C++ standard library: linked into every application.
// Source: SoftMotion 3.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_SMOOTH_BSPLINE_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_SMOOTH_BSPLINE_HPP

#include "runtime/numeric/cnc/processors/bspline.hpp"
#include "runtime/numeric/cnc/processors/stream.hpp"

namespace stride::cnc {

/// How far the knots of a piece are apart, by the line in the middle of the five that it depends
/// on.
enum class KnotSpacing : uint8_t {
  Uniform,
  ChordLength, ///< As the line is long.
  Centripetal, ///< As the square root of that.
};

/// So many lines say all about a piece: those that it depends on and those that say its knots.
inline constexpr int32_t kSplineLines = 9;

/// The user sets the first members.
///
/// n >= 5 lines in a row, each of them with a way, have n + 1 ends and become n - 4 pieces. The
/// spline is clamped: only the ends of the run are interpolated, and it begins and ends along the
/// first and the last line. Each piece lies in the convex hull of six ends in a row.
struct SmoothBSpline {
  static constexpr Generator kGenerator = kByNobody;
  static constexpr bool kLooksAhead = false;

  uint32_t features; ///< Which of PathObject::features have to be on; 0: all lines are smoothed.
  KnotSpacing spacing;
  bool unknownFeature; ///< The user has asked for a bit that there is not.
  // Its own:
  PathObject lines[kSplineLines]; ///< Of the run, from the first one that a piece still needs on.
  PathObject first;               ///< Line of the run, for what concerns the tool.
  Position end;                   ///< Of the last piece.
  double span[kSplineDegree - 1]; ///< Knots of the last four pieces.
  int32_t count;                  ///< Of `lines`.
  int32_t pieces;                 ///< Of the run, that have been put out.
};

inline void start(SmoothBSpline &spline) noexcept { spline.count = spline.pieces = 0; }
Step next(SmoothBSpline &spline, const Source &source, Output &output) noexcept;
Step finish(SmoothBSpline &spline, Ending ending, Output &output) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_SMOOTH_BSPLINE_HPP
