#ifndef STRIDE_COMPILER_SYNTAX_FORMAT_LINE_HPP
#define STRIDE_COMPILER_SYNTAX_FORMAT_LINE_HPP
// One statement or declaration: blanks between its tokens, and line breaks where it is too wide.
// Internal to compiler/syntax.

#include "compiler/syntax/format.hpp"
#include "compiler/syntax/format_items.hpp"

#include <string>
#include <vector>

namespace stc {

/// What a line is, which decides about some of its blanks.
enum class LineKind : uint8_t { Statement, Label, Declaration, Head, Configuration };

struct LineRequest {
  size_t from = 0; ///< items [from, to)
  size_t to = 0;
  unsigned level = 0;
  LineKind kind = LineKind::Statement;
  /// declaration: the column, after the indentation, of its first colon outside of brackets
  size_t colon = 0;
  std::string prefix; ///< comments before the first token, on its line
};

/// The blanks before a line of this level.
[[nodiscard]] std::string indentation(const FormatStyle &style, unsigned level);

/// Characters of UTF-8 text.
[[nodiscard]] size_t widthOf(std::string_view text);

/// The text of a comment, with its line ends as they are written.
[[nodiscard]] std::string commentText(std::string_view text);

/// The lines without the indentation of the first; without a line end after the last.
[[nodiscard]] std::string layLine(const std::vector<FormatItem> &items, const LineRequest &request,
                                  const FormatStyle &style);

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_FORMAT_LINE_HPP
