#ifndef STRIDE_COMPILER_SYNTAX_FORMAT_ITEMS_HPP
#define STRIDE_COMPILER_SYNTAX_FORMAT_ITEMS_HPP
// What a text to be formatted consists of. Internal to compiler/syntax: includes ANTLR.

#include "compiler/source/sources.hpp"
#include "compiler/syntax/pragmas.hpp"
#include "compiler/syntax/token.hpp"

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

/// A comment or a pragma before a token.
struct FormatComment {
  std::string_view text;
  unsigned newlines = 0;  ///< line ends between it and what stands before it
  bool toLineEnd = false; ///< `// …`
  size_t margin = 0;      ///< blanks before it on its line
  bool startsLine = false;
};

/// A token with what stands before it.
struct FormatItem {
  uint16_t type = Token::kEnd; ///< kEnd: the end of the text
  std::string_view text;
  unsigned newlines = 0; ///< line ends directly before it
  std::vector<FormatComment> comments;
};

/// Tokens of this type are text that means nothing, in a branch that is not compiled.
inline constexpr uint16_t kUnknownText = Token::kEnd - 1;

/// The tokens of all branches; the last one is the end of the text.
[[nodiscard]] std::vector<FormatItem> readItems(const SourceFile &file);

/// Names after JMP, in lower case.
[[nodiscard]] std::set<std::string> jumpTargets(const std::vector<FormatItem> &items);

/// Which pragma a comment is.
[[nodiscard]] PragmaWord pragmaOf(std::string_view comment);

/// INT, TIME_OF_DAY, …: names of types that are written like keywords.
[[nodiscard]] bool isElementaryName(std::string_view text);
/// SINT … ULINT, BYTE … LWORD.
[[nodiscard]] bool isIntegerName(std::string_view text);

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_FORMAT_ITEMS_HPP
