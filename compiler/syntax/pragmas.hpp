#ifndef STRIDE_COMPILER_SYNTAX_PRAGMAS_HPP
#define STRIDE_COMPILER_SYNTAX_PRAGMAS_HPP
// `{word …}`: the words that pragmas begin with.

#include <cstdint>
#include <span>
#include <string_view>

namespace stc {

enum class PragmaWord : uint8_t {
  None, ///< another one, which is passed over
#define STC_PRAGMA(enumerator, ...) enumerator,
#include "compiler/syntax/pragmas.def"
};

/// A row of pragmas.def.
struct PragmaRow {
  std::string_view word;    ///< in lower case
  std::string_view example; ///< as docs/language.md shows it
  std::string_view text;    ///< what it does; empty: the row before says it
};
/// All of them, in the order of PragmaWord without `None`.
[[nodiscard]] std::span<const PragmaRow> pragmaRows();

/// Which pragma begins with the word, whatever its case.
[[nodiscard]] PragmaWord findPragma(std::string_view word);

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_PRAGMAS_HPP
