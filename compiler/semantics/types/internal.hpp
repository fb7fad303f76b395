#ifndef STRIDE_COMPILER_SEMANTICS_TYPES_INTERNAL_HPP
#define STRIDE_COMPILER_SEMANTICS_TYPES_INTERNAL_HPP
// What the sources of this folder have in common.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// The type of `(a, b := 5)`; its enumerators become names of the module or namespace.
const EnumType *makeEnum(Context &c, ast::EnumTypeExpr *expr, TypeSymbol *symbol);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_TYPES_INTERNAL_HPP
