#ifndef STRIDE_COMPILER_IMPORT_NETWORKS_EXP_NETWORKS_HPP
#define STRIDE_COMPILER_IMPORT_NETWORKS_EXP_NETWORKS_HPP
// Drawn bodies in exports of CoDeSys V2.3: ladder and function block diagrams as trees in prefix
// order, continuous function charts as lists of elements.

#include "compiler/import/networks/network.hpp"
#include "compiler/import/networks/scope.hpp"
#include "compiler/import/networks/translation.hpp"

#include <string>
#include <vector>

namespace stc::import::networks {

/// A line of the file with its number.
struct NumberedLine {
  std::string text;
  size_t line = 1;
};

/// Whether a line begins a drawn body (`_LD_BODY`, `_FBD_BODY`, `_CFC_BODY`).
[[nodiscard]] bool isTranslatedBody(std::string_view line);

/// Translates a body whose first line begins a drawn body. The files have no names of pins: `scope`
/// must know the blocks' declarations. Words that no published export shows (jumps among them) are
/// problems: their meaning is not guessed.
[[nodiscard]] Translation translatedExpBody(const std::vector<NumberedLine> &lines, Scope &scope);

/// The parts of it: an empty body and problems where it cannot be read.
[[nodiscard]] Body readExpNetworks(const std::vector<NumberedLine> &lines, const Scope &scope,
                                   std::vector<Problem> &problems);
[[nodiscard]] Body readExpChart(const std::vector<NumberedLine> &lines, const Scope &scope,
                                std::vector<Problem> &problems);

} // namespace stc::import::networks

#endif // STRIDE_COMPILER_IMPORT_NETWORKS_EXP_NETWORKS_HPP
