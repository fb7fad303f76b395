#ifndef STRIDE_COMPILER_ASSETS_CNC_EDIT_TRANSFORM_HPP
#define STRIDE_COMPILER_ASSETS_CNC_EDIT_TRANSFORM_HPP
// Moves the paths of CNC programs as the CNC editor's commands do (V2.3 manual, section 3.3).
// Comments, blanks, numbers of sentences and all words that need not change stay as they are. What
// cannot be changed is reported (Code::CncEdit), and nothing is returned then.

#include "compiler/assets/cnc/cnc_source.hpp"

namespace stc {

/// How the places of a path move: X, Y and Z by a rotation, an equal scale or a reflection, then
/// all axes by a shift.
struct CncTransform {
  double linear[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double shift[stride::cnc::kAxes]{}; ///< By AxisBit. [u]
  double angle = 0;                   ///< Of a rotation about Z, counterclockwise. [degrees]
  double factor = 1;                  ///< Of lengths.
  int mirrored = -1;                  ///< The axis that a reflection turns round, or -1.
  bool turns = false;                 ///< It is a rotation.
};

/// Counterclockwise about a place in X and Y. [degrees]
[[nodiscard]] CncTransform cncRotation(double angle, const double (&about)[stride::cnc::kAxes]);
/// X, Y and Z away from a place, by a factor greater than 0.
[[nodiscard]] CncTransform cncScale(double factor, const double (&about)[stride::cnc::kAxes]);
/// X, Y or Z (0 to 2) becomes what it is on the other side of `at`.
[[nodiscard]] CncTransform cncReflection(int axis, double at);
/// All axes by so much. [u]
[[nodiscard]] CncTransform cncShift(const double (&by)[stride::cnc::kAxes]);

/// The text of a program whose path is moved: each motion leads to the place that the transform
/// makes of its old target. Where the path begins stays, since the application says that: a first
/// line leads from there. Velocities, D, and axes besides X, Y, Z (but for a shift) stay.
[[nodiscard]] std::optional<std::string>
transformCnc(const SourceFile &file, const CncTransform &transform, Diagnostics &diagnostics);

} // namespace stc

#endif // STRIDE_COMPILER_ASSETS_CNC_EDIT_TRANSFORM_HPP
