#ifndef STRIDE_COMPILER_ASSETS_CNC_EDIT_SPLIT_HPP
#define STRIDE_COMPILER_ASSETS_CNC_EDIT_SPLIT_HPP
// Cuts the motions of CNC programs, and makes lines of curves, as the CNC editor does. Comments,
// blanks, and sentences that need not change stay as they are; the first piece of a sentence has
// its number (N) and its comments. What cannot be cut is reported (Code::CncEdit), and nothing is
// returned then.

#include "compiler/assets/cnc/cnc_source.hpp"

namespace stc {

/// Where a program is cut: one sentence, or all that are long.
struct CncSplit {
  int32_t sentence = 0; ///< Its number (N), or its line if it has none.
  double at = 0.5;      ///< The part of it where it is cut: greater than 0, less than 1.
  double length = 0;    ///< Not 0: instead of that all motions but G0 become pieces of equal length
                        ///< that are not longer. [u]
};

/// Two motions instead of one, or more, that go where it went, with the same velocities; switch
/// points stay where they are. Splines (G5, G10) cannot be cut.
/// Source: V2.3 manual, section 3.3, "Split object".
[[nodiscard]] std::optional<std::string> splitCnc(const SourceFile &file, const CncSplit &split,
                                                  Diagnostics &diagnostics);

/// How long the lines are that curves become. One of both is 0.
struct CncExpansion {
  double length = 0; ///< Of the curve, for each line at most. [u]
  double angle = 0;  ///< Lines that follow each other turn by less. [degrees]
};

/// Lines instead of splines, parabolas and ellipses (G5, G6, G8, G9, G10), whose ends are on the
/// curve. Arcs of circles stay.
/// Source: V2.3 manual, section 3.6, "Convert splines/ellipses to lines".
[[nodiscard]] std::optional<std::string>
expandCnc(const SourceFile &file, const CncExpansion &expansion, Diagnostics &diagnostics);

} // namespace stc

#endif // STRIDE_COMPILER_ASSETS_CNC_EDIT_SPLIT_HPP
