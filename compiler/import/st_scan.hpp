#ifndef STRIDE_COMPILER_IMPORT_ST_SCAN_HPP
#define STRIDE_COMPILER_IMPORT_ST_SCAN_HPP
// Where code stands in a piece of ST that may be incomplete: past comments, pragmas and texts.

#include <cstddef>
#include <string>
#include <string_view>

namespace stc::import {

/// After the comment (nested or not), the line comment or the pragma that begins at `at`; `at` when
/// none begins there. One without its end reaches to the end of the text.
[[nodiscard]] size_t afterComment(std::string_view text, size_t at);
/// After the text between quotes that begins at `at`, in ' or "; `$` takes the next sign with it.
/// `at` when none begins there.
[[nodiscard]] size_t afterString(std::string_view text, size_t at);
/// The first place from `at` on that is neither blank nor comment nor pragma.
[[nodiscard]] size_t codeFrom(std::string_view text, size_t at = 0);
/// Letters, digits, `_` and all that is not ASCII, from `at` on.
[[nodiscard]] std::string_view wordAt(std::string_view text, size_t at);
/// The first word of the code in capital letters: `FUNCTION_BLOCK`.
[[nodiscard]] std::string firstKeyword(std::string_view text);
/// The text as the inside of a literal '…'.
[[nodiscard]] std::string quotedForSt(std::string_view text);
/// Makes an identifier of a name: what cannot stand in one becomes `_`.
[[nodiscard]] std::string asIdentifier(std::string_view name);
/// The path with `/` where the file has `\`.
[[nodiscard]] std::string withSlashes(std::string_view path);
/// The name of the file without folders and ending.
[[nodiscard]] std::string stemOf(std::string_view path);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_ST_SCAN_HPP
