#ifndef STRIDE_COMPILER_SEMANTICS_CONTEXT_DESCRIBE_HPP
#define STRIDE_COMPILER_SEMANTICS_CONTEXT_DESCRIBE_HPP
// Symbols in diagnostics.

#include "compiler/semantics/symbols.hpp"
#include "compiler/source/diagnostic.hpp"

#include <string>

namespace stc::sema {

/// `a variable`, `a function block`, `the base of this block`
[[nodiscard]] std::string describe(const Symbol *symbol);
/// Shows where the symbol is declared, if that is in a source.
void noteDeclaration(Diagnostic &diagnostic, const Symbol *symbol);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_CONTEXT_DESCRIBE_HPP
