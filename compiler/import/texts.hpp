#ifndef STRIDE_COMPILER_IMPORT_TEXTS_HPP
#define STRIDE_COMPILER_IMPORT_TEXTS_HPP
// Texts of other tools as parts of Structured Text, and their paths.

#include <string>
#include <string_view>

namespace stc::import {

/// The text as the inside of a literal '…'.
[[nodiscard]] std::string quotedForSt(std::string_view text);
/// Makes an identifier of a name: what cannot stand in one becomes `_`.
[[nodiscard]] std::string asIdentifier(std::string_view name);
/// The path with `/` where the file has `\`.
[[nodiscard]] std::string withSlashes(std::string_view path);
/// The name of the file without folders and ending.
[[nodiscard]] std::string stemOf(std::string_view path);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_TEXTS_HPP
