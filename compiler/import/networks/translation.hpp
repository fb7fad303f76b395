#ifndef STRIDE_COMPILER_IMPORT_NETWORKS_TRANSLATION_HPP
#define STRIDE_COMPILER_IMPORT_NETWORKS_TRANSLATION_HPP
// What becomes of a drawn body (LD, FBD, CFC): Structured Text, or the reasons why there is none.

#include <cstddef>
#include <string>
#include <vector>

namespace stc::import::networks {

/// Something about a line of the imported file.
struct Problem {
  size_t line = 0; ///< as the reader counts them
  std::string text;
};

/// The Structured Text of a drawn body.
struct Translation {
  std::string declarations;      ///< a VAR block for what the statements need in addition, or empty
  std::string statements;        ///< lines that end with \n
  std::vector<Problem> problems; ///< why the body cannot be taken: it has no statements then
  std::vector<Problem> notes;    ///< what was decided or dropped
  [[nodiscard]] bool ok() const { return problems.empty(); }
};

} // namespace stc::import::networks

#endif // STRIDE_COMPILER_IMPORT_NETWORKS_TRANSLATION_HPP
