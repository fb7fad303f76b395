// One corner of a path: both objects are cut at a distance from it, and a curve leads from one to
// the other. Free of the C++ standard library: linked into every application.
// Source: SoftMotion V2.3 manual, sections 6.2.5 and 6.2.6; the spline of degree 5 and what becomes
// of switch points are SoftMotion 3's.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_CORNER_PIECE_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_CORNER_PIECE_HPP

#include "runtime/numeric/cnc/corner.hpp"
#include "runtime/numeric/cnc/object_shape.hpp"

namespace stride::cnc {

/// What leads past a corner.
enum class PieceKind : uint8_t {
  Cubic,   ///< A polynomial of degree 3: no kink of the tangent.
  Quintic, ///< One of degree 5: no kink, and no jump of the curvature.
  Arc,     ///< Of a circle, between two lines only; as much is cut off both.
};

struct PieceRules {
  PieceKind kind;
  double distance;  ///< From the corner, where the objects are cut. [u]
  bool symmetrical; ///< As much is cut off both objects.
  double leastTurn; ///< Corners that turn less stay as they are. [rad]
};

/// What became of a corner.
enum class CornerChange : uint8_t {
  Kept,     ///< Both objects are as they were.
  Cut,      ///< The piece leads from one to the other.
  Replaced, ///< Likewise, and nothing is left of the first one: the piece stands for it, too.
};

/// What is known of an object before its corner.
struct BeforeCorner {
  double room;      ///< What may be cut off its end; negative: half of it. [u]
  bool isDescribed; ///< `shape` is what describeAtCorner() says.
  ObjectShape shape;
};

/// Puts a piece into the corner where `before` ends and `after` begins. No more than `known` says
/// is cut off `before`, which may be all that there is, and no more than half of `after`; then
/// `known` is about `after`. A corner that stays has no room in it.
///
/// A piece of polynomials between lines lies in the triangle of the corner and both cuts, so it is
/// nowhere further from the corner than `distance`. It comes as near to the corner as
///   distance * sin(turn / 2) * (1 - tan(turn / 4) / tan(turn / 2))   Cubic and Arc: that of an arc
///   distance * path::deviationPerCut(turn)                           Quintic
/// if both cuts are equal. A corner stays if both objects cannot be cut (CutError: S profiles),
/// turn by more than path::kMaxTurn, do not meet, or, with Arc, are not two lines.
///
/// Switch points stay where they are; those that are cut off go onto the piece, as far from its end
/// as they were from the cut, but in its half of their object. What the piece has no place for goes
/// to the ends of the objects that are next to it. [u] in
CornerChange makeCorner(PathObject &before, PathObject &after, const PieceRules &rules,
                        BeforeCorner &known, PathObject &piece) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_CORNER_PIECE_HPP
