#ifndef STRIDE_COMPILER_ASSETS_CNC_EDIT_ARC_WORDS_HPP
#define STRIDE_COMPILER_ASSETS_CNC_EDIT_ARC_WORDS_HPP
// I, J and K of curves.

#include "compiler/assets/cnc/cnc_source.hpp"

#include <array>

namespace stc::gcode {

/// The way from the start of a curve, in its plane, to its centre, or of a parabola (G6) to where
/// the tangents of its ends meet. [u]
[[nodiscard]] std::array<double, 3> centreWay(const stride::cnc::PathObject &object);

} // namespace stc::gcode

#endif // STRIDE_COMPILER_ASSETS_CNC_EDIT_ARC_WORDS_HPP
