#ifndef STRIDE_COMPILER_SYNTAX_ST_TEXT_HPP
#define STRIDE_COMPILER_SYNTAX_ST_TEXT_HPP
// Structured Text that is written, not read: names and literals.

#include "compiler/source/identifier.hpp"
#include "compiler/syntax/ast_declarations.hpp"

#include <string>
#include <string_view>

namespace stc {

/// A word that can never be an identifier, whatever its case.
[[nodiscard]] bool isReservedWord(std::string_view text);
/// Letters, digits and single underscores, beginning with a letter or underscore, no reserved word.
[[nodiscard]] bool isIdentifier(std::string_view text);

/// The keyword of a section of a POU's variables: `VAR_INPUT`; `VAR` for all that are its own.
[[nodiscard]] std::string_view sectionName(ast::Section section);

/// A number as a literal: `0.5`, `1.0`, `1.0e300`. It reads back as the same number.
[[nodiscard]] std::string realLiteral(double value);
/// A text as a literal of type STRING: `'it$'s'`.
[[nodiscard]] std::string stringLiteral(std::string_view text);

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_ST_TEXT_HPP
