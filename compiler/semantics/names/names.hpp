#ifndef STRIDE_COMPILER_SEMANTICS_NAMES_NAMES_HPP
#define STRIDE_COMPILER_SEMANTICS_NAMES_NAMES_HPP
// Names as the checker meets them: looked up from the scope it is in, with diagnostics for what is
// ambiguous, out of reach or unknown.

#include "compiler/semantics/context/context.hpp"

#include <string_view>
#include <vector>

namespace stc::sema {

/// What a plain name stands for in an expression; null: nothing, or an enumerator.
Symbol *lookup(Context &c, const ast::Name &name);
/// A name of the project (or library): in the namespaces around, outside of all, by USING.
Symbol *lookupDeclared(Context &c, const ast::Name &name);
/// A name that needs no library's name before it.
Symbol *lookupInLibraries(Context &c, const ast::Name &name);
/// `A.B.Name`, also `Library.Name`; reports what it does not find. `asType`: a type is meant.
Symbol *lookupPath(Context &c, ast::NamePath path, bool asType);
/// What `space.name` is, of a namespace or a library; null: nothing. Reports what is INTERNAL
/// there.
Symbol *nameInSpace(Context &c, Symbol *space, const ast::Name &name);
/// Reports USING directives that name neither a NAMESPACE nor a library.
void checkUsings(Context &c, const ast::Decl *decl);

/// Reports an enumerator of the expected type that must not be called by its plain name; false:
/// there is none.
bool reportUnqualified(Context &c, const ast::Name &name, const Type *expected);
/// What a name is meant for.
enum class Sought : uint8_t { Value, Callee, Type };
/// Reports a name that nothing has, with what may be meant; once for each name of a POU.
void reportUnknown(Context &c, const ast::Name &name, Sought sought);
/// The names of what can stand after the dot of a value of the type.
[[nodiscard]] std::vector<std::string_view> memberNames(const Type *type);
/// Adds the nearest of the members, or all of them when they are few.
void helpMembers(Diagnostic &d, const ast::Name &name,
                 const std::vector<std::string_view> &members);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_NAMES_NAMES_HPP
