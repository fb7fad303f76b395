// Corners of a path become curves: where two objects meet, each is cut and a polynomial of degree 5
// leads from one to the other, without a kink of the tangent or a jump of the curvature. Free of
// the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_CORNER_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_CORNER_HPP

#include "runtime/numeric/cnc/path_object.hpp"

namespace stride::cnc {

/// How far a curve may leave a corner. Whatever is exact::kInfinity does not matter.
struct BlendRules {
  double cut;             ///< What is cut off each object, at most. [u]
  double cornerTolerance; ///< Distance of the curve from the corner, at most. [u]
  double pathTolerance;   ///< Distance of the curve from both objects, at most. [u]
  double acceleration;    ///< No more is cut than the feed needs if this is to be had across the
                          ///< path. [u/s^2]
  double leastTurn;       ///< Corners that turn less stay as they are. [rad]
};

/// No more is cut off an object than this part of what it was before its corners were cut.
inline constexpr double kMostCut = 0.499;

enum class Corner : uint8_t {
  Smooth,  ///< The path hardly turns: nothing was done.
  Blended, ///< Both objects are shorter, and the blend leads from one to the other.
  Kept,    ///< It cannot be blended: it turns by more than path::kMaxTurn, one of both is a rapid
           ///< motion, is no motion in space, or cannot be cut.
};

/// Blends the corner where `before` ends and `after` begins. Of these, `roomBefore` and `roomAfter`
/// may be cut off. The blend has the smaller velocities and accelerations of both, and the source
/// line of the first; axes besides X, Y, Z go along evenly. Switch points keep their distance from
/// the end of the object that is nearer, but stay in their half of it; marks stay. [u] in
Corner blendCorner(PathObject &before, PathObject &after, const BlendRules &rules,
                   double roomBefore, double roomAfter, PathObject &blend) noexcept;

/// Blends the corners of a path whose objects come one after the other. Begins as Blender{rules}.
struct Blender {
  BlendRules rules;
  PathObject held; ///< The last object, whose end may still be cut.
  double room;     ///< What may be cut off there. [u]
  bool holds;
};

/// Takes the next object; what is ready is put out, at most two. How many.
int32_t blendNext(Blender &blender, const PathObject &object, PathObject (&ready)[2]) noexcept;

/// At the end of the path: puts out what is held. How many.
int32_t blendEnd(Blender &blender, PathObject &ready) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_CORNER_HPP
