#ifndef STRIDE_COMPILER_ASSETS_CNC_EDIT_PIECES_HPP
#define STRIDE_COMPILER_ASSETS_CNC_EDIT_PIECES_HPP
// Sentences for the pieces of a motion.

#include "compiler/assets/cnc_edit/path_match.hpp"
#include "compiler/assets/cnc_edit/trace.hpp"

namespace stc::gcode {

/// A motion that is cut.
struct Pieces {
  Path objects;       ///< One after another.
  bool lines = false; ///< They are lines instead of the curve, from cut to cut.
};

/// Cuts a motion at ways from its start, which ascend. Nothing where it cannot be cut, which is
/// reported. [u] in
[[nodiscard]] std::optional<Pieces> cutMotion(const CncTrace &trace, const CncVisit &visit,
                                              const std::vector<double> &ways, bool lines,
                                              Diagnostics &diagnostics);

/// The lines of text for the pieces: the first one is the sentence's line with its comments.
/// Nothing where they cannot be written, which is reported.
[[nodiscard]] std::optional<std::vector<std::string>>
linesOf(std::string_view text, const CncTrace &trace, const CncVisit &visit, const Pieces &pieces,
        Diagnostics &diagnostics);

} // namespace stc::gcode

#endif // STRIDE_COMPILER_ASSETS_CNC_EDIT_PIECES_HPP
