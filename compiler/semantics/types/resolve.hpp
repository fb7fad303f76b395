#ifndef STRIDE_COMPILER_SEMANTICS_TYPES_RESOLVE_HPP
#define STRIDE_COMPILER_SEMANTICS_TYPES_RESOLVE_HPP
// Types: as they are written and as they are declared.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// Reports types that hold themselves, and what is nested too deeply or too large; cuts them
/// there.
void checkContainment(Context &c, Module &module);
/// Makes a type of its declaration, unless it has one; reports circles.
void resolve(Context &c, TypeSymbol *symbol);
/// The enumerations of a module: their enumerators can be named without them.
void resolveEnumerations(Context &c, Module &module);
/// The type that is written; the error type (reported) when there is none. `hint`: the name that an
/// enumeration in line gets.
const Type *resolveType(Context &c, ast::TypeExpr *expr, std::string_view hint);
/// The type of a variable of a structure or block, which may be a BIT.
const Type *resolveMember(Context &c, VarSymbol *variable, std::string_view hint);
/// The array can be passed where an ARRAY[*] is declared.
bool fitsOpenArray(const Type *actual, const OpenArrayType *wanted);
/// Reports an ARRAY[*] where a whole value is needed.
bool refuseOpenArray(Context &c, ast::Expr *expr, std::string_view action);
/// Reports members that cannot share their memory, and more than one initial value.
void checkUnion(Context &c, const StructType *type);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_TYPES_RESOLVE_HPP
