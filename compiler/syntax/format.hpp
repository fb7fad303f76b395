#ifndef STRIDE_COMPILER_SYNTAX_FORMAT_HPP
#define STRIDE_COMPILER_SYNTAX_FORMAT_HPP
// The formatter of Structured Text: lays a file out anew without changing what it says.

#include "compiler/source/sources.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace stc {

enum class KeywordCase : uint8_t { Upper, Lower, Keep };

/// How formatted text looks.
struct FormatStyle {
  unsigned width = 100; ///< longest line, in characters, where the text can be broken
  unsigned indent = 2;  ///< blanks per level; with tabs: what a tab counts
  bool tabs = false;    ///< indent with tabs, align with blanks
  KeywordCase keywords = KeywordCase::Upper;
  bool align = true; ///< colons and comments of declarations that follow each other
};

/// The text of `file` laid out anew; the file should be free of syntax errors. All branches of
/// conditional pragmas are formatted. The result holds the same tokens (but for the case of
/// keywords and names of elementary types) and the same comments in the same order: that is
/// checked, and where it would not hold, nothing is returned.
[[nodiscard]] std::optional<std::string> format(const SourceFile &file, const FormatStyle &style);

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_FORMAT_HPP
