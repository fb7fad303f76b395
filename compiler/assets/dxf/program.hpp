#ifndef STRIDE_COMPILER_ASSETS_DXF_PROGRAM_HPP
#define STRIDE_COMPILER_ASSETS_DXF_PROGRAM_HPP
// Contours as G-code.

#include "compiler/assets/dxf/contours.hpp"
#include "compiler/assets/dxf/dxf.hpp"

namespace stc::dxf {

/// A contour as it is driven.
struct Cut {
  Contour contour;
  Point from;             ///< Where G0 leads: the contour's start, or where its lead-in begins.
  bool corrected = false; ///< With G41 or G42.
};

/// The text of a program that drives some contours one after the other.
[[nodiscard]] std::string programText(const std::string &title, const std::vector<Cut> &cuts,
                                      const DxfImport &import);

} // namespace stc::dxf

#endif // STRIDE_COMPILER_ASSETS_DXF_PROGRAM_HPP
