#pragma once
// Types: as they are written and as they are declared.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// Reports types that hold themselves, and what is nested too deeply or too large; cuts them
/// there.
void checkContainment(Context &c, Module &module);
void resolve(Context &c, TypeSymbol *symbol);
/// The enumerations of a module: their enumerators can be named without them.
void resolveEnumerations(Context &c, Module &module);
const Type *resolveType(Context &c, ast::TypeExpr *expr, std::string_view hint);
/// The type of a variable of a structure or block, which may be a BIT.
const Type *resolveMember(Context &c, VarSymbol *variable, std::string_view hint);
bool fitsOpenArray(const Type *actual, const OpenArrayType *wanted);
/// Reports an ARRAY[*] where a whole value is needed.
bool refuseOpenArray(Context &c, ast::Expr *expr, std::string_view action);
void checkUnion(Context &c, const StructType *type);

} // namespace stc::sema
