#pragma once
// Names.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

Module &moduleNamed(Context &c, const std::string &name);
Module &moduleOf(Context &c, const Symbol *symbol);
void loadLibraryFile(Context &c, const LibraryIndex::Entry &entry);
void declareFile(Context &c, Module &module, ast::File *file);
void resolveEnumerations(Context &c, Module &module);
Symbol *lookup(Context &c, const ast::Name &name);
Symbol *lookupInModule(Module &module, Ident id);
Symbol *lookupInLibraries(Context &c, Ident id);
/// `Library.Name`
Symbol *lookupInLibrary(Context &c, Ident library, Ident id);
EnumeratorSymbol *lookupEnumerator(Context &c, const ast::Name &name, const Type *expected,
                                   bool &ambiguous);
EnumeratorSymbol *findEnumerator(const EnumType *type, Ident id);
VarSymbol *findMember(Context &c, const Type *type, Ident id);
std::vector<std::string_view> memberNames(const Type *type);
/// An enumerator of the expected type that must not be called by its plain name.
bool reportUnqualified(Context &c, const ast::Name &name, const Type *expected);
void reportUnknown(Context &c, const ast::Name &name, bool asType);
/// The nearest of the members, or all of them when they are few.
void helpMembers(Diagnostic &d, const ast::Name &name,
                 const std::vector<std::string_view> &members);
/// The declaration whose NAMESPACE and USING hold here, or null.
[[nodiscard]] const ast::Decl *home(Context &c);
/// A name of the project (or library): in the namespaces around, outside of all, by USING.
Symbol *lookupDeclared(Context &c, const ast::Name &name);
/// `A.B.Name`, also `Library.Name`; reports what it does not find.
Symbol *lookupPath(Context &c, ast::NamePath path, bool asType);
/// The same, where the ST names it: reports what is INTERNAL to a namespace.
Symbol *nameInSpace(Context &c, Symbol *space, const ast::Name &name);
/// Whether what is INTERNAL and declared there can be used here.
bool seesInternals(Context &c, const Library *library, const NamespaceSymbol *space);
void checkUsings(Context &c, const ast::Decl *decl);

} // namespace stc::sema
