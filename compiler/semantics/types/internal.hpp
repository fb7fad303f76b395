#pragma once
// What the sources of this folder have in common.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

const EnumType *makeEnum(Context &c, ast::EnumTypeExpr *expr, TypeSymbol *symbol);

} // namespace stc::sema
