#ifndef STRIDE_COMPILER_ASSETS_CNC_EDIT_CNC_EDIT_HPP
#define STRIDE_COMPILER_ASSETS_CNC_EDIT_CNC_EDIT_HPP
// Commands that change CNC programs as a CNC editor does (V2.3 manual, sections 3.3 and 3.6). They
// work on texts: no files, nothing is shown.

#include "compiler/source/diagnostic.hpp"
#include "compiler/source/sources.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace stc {

/// How sentences are numbered. Numbers (N) go up to 2147483647.
struct CncNumbering {
  int32_t first = 10; ///< Of the first sentence; not negative.
  int32_t step = 10;  ///< From each sentence to the next one; positive.
};

/// The program with new numbers (N): each sentence gets one, in the order of the text, and jumps
/// (G20) lead to the same sentences as before. Everything else stays as it is, comments too. What
/// cannot be numbered so is reported, and nothing is returned: a jump to a number that only a
/// variable knows or that no sentence has (SE0884), programs in SoftMotion 3's language (SE0880),
/// more sentences than numbers, a sentence without room for one more word (SE0882).
/// Source: manual, section 3.6, "Renumber program".
[[nodiscard]] std::optional<std::string>
numberCnc(const SourceFile &file, const CncNumbering &numbering, Diagnostics &diagnostics);

} // namespace stc

#endif // STRIDE_COMPILER_ASSETS_CNC_EDIT_CNC_EDIT_HPP
