#ifndef STRIDE_COMPILER_ASSETS_CNC_EDIT_TRACE_HPP
#define STRIDE_COMPILER_ASSETS_CNC_EDIT_TRACE_HPP
// What a CNC program that is edited does, sentence by sentence, jumps included.

#include "compiler/assets/cnc_edit/sentence_text.hpp"

namespace stc::gcode {

/// A sentence has been carried out.
struct CncVisit {
  int32_t sentence = 0;        ///< Index of the text's sentences.
  int32_t object = -1;         ///< Index of the motion that it has made; -1: none.
  int32_t function = -1;       ///< G of the motion, be it the last sentence's; else -1.
  int32_t origin = 0;          ///< Index of where the coordinates begin.
  uint16_t unknown = 0;        ///< Axes whose place before depends on variables, by bit.
  bool relative = false;       ///< G91
  bool centreAbsolute = false; ///< G98
};

/// All of a program.
struct CncTrace {
  using Origin = std::array<double, stride::cnc::kAxes>;

  std::vector<EditSentence> sentences;
  std::vector<CncVisit> visits; ///< In the order in which they come.
  std::vector<stride::cnc::PathObject> objects;
  std::vector<int32_t> visitOf; ///< By object: index of the visit that has made it.
  std::vector<Origin> origins;
  bool endless = false; ///< Jumps lead on and on; this is the first part.
};

/// What variables count as: the programs that are edited have been checked, and with it none of
/// their sentences is wrong.
void assumeVariables(CncProgram &program);
/// readForEdit() with that.
[[nodiscard]] std::optional<CncProgram> readForTrace(const SourceFile &file,
                                                     Diagnostics &diagnostics);

/// Carries out a program that has no errors. Nothing where what it does depends on variables, or is
/// too much, or its coordinates may be turned, which is reported. It begins where the settings say,
/// and must outlive the trace.
[[nodiscard]] std::optional<CncTrace> traceCnc(const CncProgram &program, Diagnostics &diagnostics);

/// Letters of axes by AxisBit.
inline constexpr std::string_view kAxisWords = "XYZABCPQUVW";

} // namespace stc::gcode

#endif // STRIDE_COMPILER_ASSETS_CNC_EDIT_TRACE_HPP
