#pragma once
// What the sources of this folder have in common.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

std::vector<std::string_view> visibleNames(Context &c, bool types);
/// The namespace of that path, made when it is new; null for an empty path.
NamespaceSymbol *declareSpace(Context &c, Module &module, ast::NamePath path);
/// The namespaces around this place, from inside to outside.
std::vector<NamespaceSymbol *> spacesHere(Context &c);
/// What a USING directive names: a namespace or a library; null: neither.
Symbol *usedSpace(Context &c, const ast::NamePath &path);

} // namespace stc::sema
