#ifndef STRIDE_COMPILER_ASSETS_CNC_EDIT_CUT_PROGRAM_HPP
#define STRIDE_COMPILER_ASSETS_CNC_EDIT_CUT_PROGRAM_HPP
// A CNC program with other sentences for some of its motions.

#include "compiler/assets/cnc_edit/pieces.hpp"

#include <functional>

namespace stc::gcode {

/// What becomes of motions.
struct CutRule {
  /// Where a motion is cut: ways from its start, which ascend; nothing: it stays as it is.
  std::function<std::optional<std::vector<double>>(const CncTrace &, const CncVisit &)> cuts;
  /// Whether a sentence that is never reached, with this G function (-1: none), is one of them.
  std::function<bool(const EditSentence &, int32_t)> wants;
  bool lines = false; ///< They become lines.
};

/// The program with the pieces instead of its motions. What cannot be written is reported, and
/// nothing returned.
[[nodiscard]] std::optional<std::string> cutProgram(const SourceFile &file, const CncTrace &trace,
                                                    const CutRule &rule, Diagnostics &diagnostics);

} // namespace stc::gcode

#endif // STRIDE_COMPILER_ASSETS_CNC_EDIT_CUT_PROGRAM_HPP
