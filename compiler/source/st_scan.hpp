#ifndef STRIDE_COMPILER_SOURCE_ST_SCAN_HPP
#define STRIDE_COMPILER_SOURCE_ST_SCAN_HPP
// Where code stands in a piece of Structured Text (or IL, or textual SFC) that may be incomplete:
// past comments, pragmas and texts, and its words without the grammar.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

/// After the comment that begins at `at`; `at` when none does. `(*` nests in `(*` only; one
/// without its end reaches to the end of the text.
[[nodiscard]] size_t commentEnd(std::string_view text, size_t at);
/// After the pragma `{…}` that begins at `at`; `at` when none does, the end of the text when it has
/// no end. Texts between quotes may have a `}` when they end on their line. In them `$` is a sign
/// like any other. What follows a letter or a digit directly is an apostrophe: `{it's}`.
[[nodiscard]] size_t afterPragma(std::string_view text, size_t at);
/// After the comment or the pragma that begins at `at`; `at` when none does.
[[nodiscard]] size_t afterComment(std::string_view text, size_t at);
/// After the text between quotes that begins at `at`, in ' or "; `$` takes the next sign with it.
/// It ends with its line at the latest. `at` when none begins there.
[[nodiscard]] size_t afterString(std::string_view text, size_t at);
/// The first place from `at` on that is neither blank nor comment nor pragma.
[[nodiscard]] size_t codeFrom(std::string_view text, size_t at = 0);
/// Letters, digits, `_` and all that is not ASCII, from `at` on.
[[nodiscard]] std::string_view wordAt(std::string_view text, size_t at);
/// The first word of the code in capital letters: `FUNCTION_BLOCK`.
[[nodiscard]] std::string firstKeyword(std::string_view text);
/// Without blanks and ends of lines at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// A piece of a source text.
struct StWord {
  enum class Kind : uint8_t {
    Name,    ///< an identifier or a keyword
    Number,  ///< also `16#FF`, `5ms`: what begins with a digit
    Address, ///< `%IX0.3`
    Sign,    ///< one character that is none of the others
  };
  Kind kind = Kind::Sign;
  size_t begin = 0;
  size_t end = 0;
};

/// All pieces in order; comments, texts, and pragmas are left out.
[[nodiscard]] std::vector<StWord> wordsOf(std::string_view text);

/// Replaces the pieces for which `by` gives a text; the rest stays to the letter.
[[nodiscard]] std::string
replaceWords(std::string_view text,
             const std::function<std::string(const StWord &, std::string_view)> &by);

} // namespace stc

#endif // STRIDE_COMPILER_SOURCE_ST_SCAN_HPP
