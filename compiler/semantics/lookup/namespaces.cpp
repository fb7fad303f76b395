// NAMESPACE and USING.

#include "compiler/semantics/lookup/lookup.hpp"

#include <algorithm>

namespace stc {

using namespace ast;

namespace {

/// The space of that path; where it ends at another kind of name, the one so far. Null: none.
NamespaceSymbol *spaceOf(const Module &module, NamePath path) {
  NamespaceSymbol *space = nullptr;
  for (const Name &name : path) {
    Symbol *next = nullptr;
    if (space == nullptr) {
      const auto it = module.spaces.find(name.id);
      next = it == module.spaces.end() ? nullptr : it->second;
    } else if (const auto it = space->names.find(name.id); it != space->names.end()) {
      next = it->second;
    }
    if (next == nullptr || next->kind != SymbolKind::Space)
      return space;
    space = static_cast<NamespaceSymbol *>(next);
  }
  return space;
}

bool isInternal(const Symbol *symbol) {
  const Decl *decl = symbol->kind == SymbolKind::Pou ? static_cast<const PouSymbol *>(symbol)->decl
                     : symbol->kind == SymbolKind::Type
                         ? static_cast<const TypeSymbol *>(symbol)->decl
                         : nullptr;
  return decl != nullptr && decl->access == Access::Internal;
}

} // namespace

const Decl *homeOf(const Scope &scope) {
  if (scope.home != nullptr)
    return scope.home;
  return scope.pou == nullptr ? nullptr : scope.pou->decl;
}

std::vector<NamespaceSymbol *> Lookup::spaces(const Scope &scope) const {
  std::vector<NamespaceSymbol *> list;
  if (const Decl *decl = homeOf(scope); decl != nullptr && !decl->space.empty())
    for (NamespaceSymbol *space = spaceOf(*scope.module, decl->space); space != nullptr;
         space = space->space)
      list.push_back(space);
  return list;
}

Symbol *Lookup::used(const Scope &scope, NamePath path) {
  const auto follow = [&](Symbol *space, size_t from) -> Symbol * {
    for (size_t i = from; space != nullptr && i < path.size(); ++i)
      space = memberOfSpace(space, path[i].id);
    return space != nullptr && space->kind == SymbolKind::Space ? space : nullptr;
  };
  for (NamespaceSymbol *space : spaces(scope))
    if (Symbol *found = follow(space, 0))
      return found;
  const auto root = scope.module->spaces.find(path.front().id);
  if (root != scope.module->spaces.end())
    if (Symbol *found = follow(root->second, 1))
      return found;
  return path.size() == 1 ? library(scope, path.front()) : nullptr;
}

Symbol *Lookup::memberOfSpace(Symbol *space, Ident id) {
  if (space->kind == SymbolKind::Library)
    return inLibrary(space->name.id, id);
  if (space->kind != SymbolKind::Space)
    return nullptr;
  const auto *of = static_cast<NamespaceSymbol *>(space);
  const auto it = of->names.find(id);
  if (it != of->names.end())
    return it->second;
  const auto enumerator = of->enumerators.find(id);
  return enumerator == of->enumerators.end() ? nullptr : enumerator->second.front();
}

bool Lookup::isForeign(const Scope &scope, const Symbol *symbol) const {
  return isInternal(symbol) && !seesInternals(scope, symbol->library, symbol->space);
}

bool Lookup::seesInternals(const Scope &scope, const Library *library,
                           const NamespaceSymbol *space) const {
  if (scope.module->library != library)
    return false;
  const auto around = spaces(scope);
  return space == nullptr || std::find(around.begin(), around.end(), space) != around.end();
}

Found Lookup::inSpace(const Scope &scope, Symbol *space, Ident id) {
  Found found{memberOfSpace(space, id)};
  // What a block of a library is used for is looked at where its type is used.
  const bool isBlock = found && found.symbol->space == nullptr &&
                       found.symbol->kind == SymbolKind::Pou &&
                       static_cast<const PouSymbol *>(found.symbol)->isBlock();
  found.isForeign = found && !isBlock && isForeign(scope, found.symbol);
  return found;
}

Symbol *Lookup::inSpaces(const Scope &scope, Ident id) const {
  for (const NamespaceSymbol *space : spaces(scope))
    if (const auto it = space->names.find(id); it != space->names.end())
      return it->second;
  return nullptr;
}

Found Lookup::inUsings(const Scope &scope, Ident id) {
  Found found;
  const Decl *decl = homeOf(scope);
  if (decl == nullptr)
    return found;
  for (const NamePath &path : decl->usings) {
    Symbol *space = used(scope, path);
    Symbol *here = space == nullptr ? nullptr : memberOfSpace(space, id);
    if (here == nullptr || here == found.symbol || here->kind == SymbolKind::Enumerator)
      continue;
    if (found) {
      found.other = here;
      return found;
    }
    found = inSpace(scope, space, id);
  }
  return found;
}

Found Lookup::declared(const Scope &scope, Ident id) {
  const Decl *decl = homeOf(scope);
  const bool plain = decl == nullptr || (decl->space.empty() && decl->usings.empty());
  if (!plain)
    if (Symbol *symbol = inSpaces(scope, id))
      return {symbol};
  if (Symbol *symbol = scope.module->find(id))
    return {symbol};
  return plain ? Found{} : inUsings(scope, id);
}

} // namespace stc
