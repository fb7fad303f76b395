// One object of a path in all its coordinates: a shape in space, and what goes along with it; where
// it is at a way, and what limits of the axes mean for the motion along it.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_PATH_SEGMENT_HPP
#define STRIDE_RUNTIME_NUMERIC_PATH_SEGMENT_HPP

#include "runtime/numeric/path/course.hpp"
#include "runtime/numeric/path/way_table.hpp"

namespace stride::path {

/// X, Y, Z, and nine more that go along.
inline constexpr int32_t kCoordinates = 12;
inline constexpr int32_t kSpace = 3; ///< Of these, the first three are those of the shape.
inline constexpr int32_t kBent = 3;  ///< So many after these may go by slopes: A, B, C.

/// Trivially copyable. Made by makeSegment.
struct Segment {
  Shape shape;
  double length;              ///< Of the way along it, > 0. [u]
  double start[kCoordinates]; ///< Of what goes along. [u]
  double delta[kCoordinates]; ///< How far it goes. [u]
  uint16_t along;             ///< What goes along, a bit for each coordinate.
  uint16_t profile;           ///< Of these, what goes by an S profile: at rest at both ends.
  uint16_t bent;              ///< Of these, what goes by slopes.
  double startSlope[kBent];   ///< Of what goes by slopes, less that of going evenly.
  double endSlope[kBent];     ///< Likewise.
  bool isStill;               ///< The shape is a place; the way is that of what goes furthest.
  WayTable table;
};

/// A place of a path and the derivatives of its coordinates over the way.
struct PathPoint {
  double at[kCoordinates]; ///< [u]
  double d1[kCoordinates];
  double d2[kCoordinates]; ///< [1/u]
  double d3[kCoordinates]; ///< [1/u^2]
};

/// A coordinate that goes along with a shape.
struct Companion {
  double start;  ///< [u]
  double end;    ///< [u]
  bool follows;  ///< False: the shape has it (X, Y, Z), or nobody.
  bool sProfile; ///< By 10 u^3 - 15 u^4 + 6 u^5 over the part u of the way, instead of evenly.
  bool slopes;   ///< By the cubic that has these slopes at its ends; the first kBent after space.
  double startSlope; ///< Over the way. [u/u]
  double endSlope;
};

/// The segment of a shape and what goes along with it. Where a coordinate of space goes along, the
/// shape's does not count. Slopes count before an S profile. A segment with `length` 0 goes
/// nowhere, and is none.
Segment makeSegment(const Shape &shape, const Companion (&companions)[kCoordinates]) noexcept;

/// Whether the parameter of its shape is not proportional to the way.
inline bool hasTable(const Segment &segment) noexcept {
  return !segment.isStill &&
         (segment.shape.kind == ShapeKind::Ellipse || segment.shape.kind == ShapeKind::Polynomial);
}

/// Where it is at a way, 0 <= way <= length, and how it goes on from there. [u] in
PathPoint pointAt(const Segment &segment, double way) noexcept;

/// The parameter of its shape at a way, and the way at that, which takes less time. [u]
double parameterAt(const Segment &segment, double way) noexcept;
double wayAt(const Segment &segment, double parameter) noexcept;

/// pointAt() where both are known already.
PathPoint pointOver(const Segment &segment, double parameter, double way) noexcept;

/// Limits of the axes; 0: none.
struct AxesLimits {
  double velocity[kCoordinates];     ///< [u/s]
  double acceleration[kCoordinates]; ///< [u/s^2]
  double jerk[kCoordinates];         ///< Of the path's curve at constant velocity. [u/s^3]
};

/// What the axes' limits make of the way from `from` on: puts `along`, `across` and `ceiling` into
/// the strip. Returns where that ends to be true, at most segment.length. [u]
double limitStrip(const Segment &segment, const AxesLimits &limits, double from,
                  Strip &strip) noexcept;

/// The same for a part of the way that the caller has chosen, by its ends and its middle.
void limitBetween(const Segment &segment, const AxesLimits &limits, double from, double to,
                  Strip &strip) noexcept;

/// The same for all of a segment that goes along an arc of a circle, or a helix, and in which
/// nothing goes by an S profile or by slopes: in closed form.
void limitArc(const Segment &segment, const AxesLimits &limits, Strip &strip) noexcept;

/// The greatest square of the velocity at a kink between two segments, so that no axis changes its
/// velocity by more than its acceleration within `time`; `other` is the acceleration of axes
/// without a limit. kInfinity if there is no kink. [s] in, [u^2/s^2] out
double kinkCeiling(const PathPoint &before, const PathPoint &after, const AxesLimits &limits,
                   double other, double time) noexcept;

} // namespace stride::path

#endif // STRIDE_RUNTIME_NUMERIC_PATH_SEGMENT_HPP
