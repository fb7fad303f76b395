#ifndef STRIDE_COMPILER_ASSETS_CNC_EDIT_REVERSE_HPP
#define STRIDE_COMPILER_ASSETS_CNC_EDIT_REVERSE_HPP
// The path of a CNC program the other way round, as the CNC editor does it.

#include "compiler/assets/cnc/cnc_source.hpp"

namespace stc {

/// What the application says of a program.
struct CncStart {
  stride::cnc::Position position{}; ///< Where its path begins.
  bool softMotion3 = false;         ///< What D means.
};

/// The program whose path goes from the end to the start: its sentences in the other order, with
/// their numbers and comments. Switch points stay where they are in space, and say the same; so do
/// M functions within a contour, while those before and after a contour (between two G0) stay
/// before and after it. Modes and modal words hold for the same motions, tools change sides. A G0
/// or G92 at the beginning goes to the new beginning; without one, a G0 goes there. What cannot be
/// reversed is reported (Code::CncEdit), and nothing returned. Source: V2.3 manual, section 3.3,
/// "Invert direction".
[[nodiscard]] std::optional<std::string> reverseCnc(const SourceFile &file, const CncStart &start,
                                                    Diagnostics &diagnostics);

} // namespace stc

#endif // STRIDE_COMPILER_ASSETS_CNC_EDIT_REVERSE_HPP
