// Looking names up, in the order in which places hide each other.

#include "compiler/semantics/lookup/lookup.hpp"

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/cam_tables.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/syntax/attributes.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <vector>

namespace stc {

using namespace ast;

namespace {

/// Names of that file are seen in the scope without the library's name: also those of one of
/// Stride's libraries that the project has asked for.
bool isSeenUnqualified(const Scope &scope, const LibraryIndex::Entry &entry) {
  const Library &here = *scope.module->library;
  return !entry.qualifiedOnly || here.name == entry.library ||
         std::ranges::any_of(here.uses, [&](const UsedLibrary &used) {
           return !used.library->isOwn && used.library->name == entry.library;
         });
}

FoundEnumerator
enumeratorOf(const std::unordered_map<Ident, std::vector<EnumeratorSymbol *>> &enumerators,
             Ident id) {
  const auto it = enumerators.find(id);
  return it == enumerators.end() ? FoundEnumerator{}
                                 : FoundEnumerator{it->second.front(), it->second.size() > 1};
}

} // namespace

Symbol *Module::find(Ident id) const {
  const auto it = names.find(id);
  return it == names.end() ? nullptr : it->second;
}

EnumeratorSymbol *findEnumerator(const EnumType *type, Ident id) {
  for (EnumeratorSymbol *e : type->enumerators) {
    if (e->name.id == id)
      return e;
  }
  return nullptr;
}

Lookup::Lookup(Program &program, const LibraryIndex &index)
    : program_(program), arena_(program.arena), index_(index), reporter_(program.diagnostics) {
  for (const auto &[name, function] : builtinNames()) {
    const Ident id = program.interner.intern(name);
    auto *symbol = arena_.make<BuiltinSymbol>();
    symbol->kind = SymbolKind::Builtin;
    symbol->name = {id, name, {}};
    symbol->id = function;
    builtins_.emplace(id, symbol);
  }
}

BuiltinSymbol *Lookup::standardFunction(const Symbol *library, Ident id) const {
  if (library->kind != SymbolKind::Library || ownModule(library->name.id->lower) != nullptr ||
      !index_.answersTo("Standard", library->name.id->lower))
    return nullptr;
  const auto found = builtins_.find(id);
  return found == builtins_.end() ? nullptr : found->second;
}

Symbol *Lookup::inPou(PouSymbol *pou, Ident id) {
  for (PouSymbol *p = pou; p != nullptr; p = p->owner) {
    VarSymbol *v = findVariable(p, id);
    if (v != nullptr && (p == pou || v->section != Section::Temp)) // VAR_TEMP is the body's own
      return v;
    if (p->owner == nullptr && !p->isFunction()) {
      if (Symbol *member = memberNamed(p, id))
        return member;
    }
  }
  return nullptr;
}

Symbol *Lookup::self(const Scope &scope, const Name &name) {
  const bool isSuper = name.id->lower == "super";
  if (!isSuper && name.id->lower != "this")
    return nullptr;
  PouSymbol *block = scope.pou == nullptr ? nullptr : blockOf(scope.pou);
  if (block == nullptr || block->isFunction() || block->isInterface() ||
      (isSuper && block->base == nullptr))
    return nullptr;
  auto *symbol = arena_.make<SelfSymbol>();
  symbol->kind = SymbolKind::Self;
  symbol->name = name;
  symbol->library = block->library;
  symbol->block = isSuper ? block->base : block;
  symbol->isSuper = isSuper;
  return symbol;
}

/// Every name that stands for nothing else asks, again and again: plain enumerators do.
bool Lookup::isStandardLibrary(Ident id) {
  const auto [known, isNew] = isLibrary_.try_emplace(id, false);
  if (isNew)
    known->second = index_.isLibrary(id->lower);
  return known->second;
}

Symbol *Lookup::library(const Scope &scope, const Name &name) {
  const std::string own = ownLibrary(scope, name.id->lower);
  if (own.empty() && !isStandardLibrary(name.id))
    return nullptr;
  auto *symbol = arena_.make<LibrarySymbol>();
  symbol->kind = SymbolKind::Library;
  symbol->name = name;
  if (!own.empty())
    symbol->name.id = program_.interner.intern(own);
  return symbol;
}

Symbol *Lookup::listOfLibraries(const Scope &scope, Ident id) const {
  for (const UsedLibrary &own : scope.module->library->uses) {
    const Module &library = *modules_.at(own.library->name);
    const auto found = library.lists.find(id);
    if (own.library->isOwn && !own.library->qualifiedOnly && found != library.lists.end())
      return found->second;
  }
  for (const LibraryIndex::Entry &entry : standardEntries(id)) {
    const Module *library =
        isSeenUnqualified(scope, entry) ? findModule(entry.library) : nullptr; // loaded by now
    if (library == nullptr)
      continue;
    if (const auto found = library->lists.find(id); found != library->lists.end())
      return found->second;
  }
  return nullptr;
}

/// What the list that the scope is has of this name: inside of it a `qualified_only` list needs no
/// name.
static Symbol *inOwnList(const Scope &scope, Ident id) {
  if (scope.home == nullptr || scope.home->kind != DeclKind::Globals ||
      !hasAttribute(scope.home->attributes, AttributeId::QualifiedOnly))
    return nullptr;
  for (const auto &[name, list] : scope.module->lists) {
    const auto found = list->scope.find(id);
    if (found != list->scope.end() && found->second->home == scope.home)
      return found->second;
  }
  return nullptr;
}

Found Lookup::find(const Scope &scope, const Name &name) {
  if (Symbol *symbol = inOwnList(scope, name.id))
    return {symbol};
  if (scope.pou != nullptr) {
    if (Symbol *symbol = inPou(scope.pou, name.id))
      return {symbol};
  }
  if (const Found found = declared(scope, name.id))
    return found;
  if (Symbol *symbol = self(scope, name))
    return {symbol};
  const auto builtin = builtins_.find(name.id);
  if (builtin != builtins_.end())
    return {builtin->second};
  if (const Found found = inLibraries(scope, name.id))
    return found;
  const auto list = scope.module->lists.find(name.id);
  if (list != scope.module->lists.end())
    return {list->second};
  const auto space = scope.module->spaces.find(name.id);
  if (space != scope.module->spaces.end())
    return {space->second};
  if (Symbol *symbol = listOfLibraries(scope, name.id))
    return {symbol};
  return {library(scope, name)};
}

Found Lookup::inLibraries(const Scope &scope, Ident id) {
  Found found = inOwnLibraries(scope, id);
  if (!found)
    return {inStandardLibraries(scope, id)};
  const std::vector<LibraryIndex::Entry> entries = standardEntries(id);
  const bool contested = std::any_of(entries.begin(), entries.end(),
                                     [](const auto &entry) { return !entry.isForeign; });
  if (found.other == nullptr && contested)
    found.other = inStandardLibraries(scope, id);
  return found;
}

std::vector<LibraryIndex::Entry> Lookup::standardEntries(Ident id) const {
  std::vector<LibraryIndex::Entry> entries = index_.find(id->lower);
  std::erase_if(entries, [&](const LibraryIndex::Entry &entry) {
    return entry.isForeign && ownModule(lowerCase(entry.library)) != nullptr;
  });
  return entries;
}

Symbol *Lookup::inStandardLibraries(const Scope &scope, Ident id) {
  for (const LibraryIndex::Entry &entry : standardEntries(id)) {
    if (!entry.qualifiedOnly || !isSeenUnqualified(scope, entry))
      continue;
    load(entry);
    if (Symbol *symbol = module(entry.library).find(id))
      return symbol;
  }
  const auto [it, fresh] = inLibraries_.emplace(id, nullptr);
  if (!fresh)
    return it->second;
  for (const LibraryIndex::Entry &entry : standardEntries(id)) {
    if (entry.qualifiedOnly)
      continue;
    load(entry);
    if (Symbol *symbol = module(entry.library).find(id)) {
      inLibraries_[id] = symbol;
      return symbol;
    }
  }
  return inLibraries_[id] = declareCamTable(id);
}

Symbol *Lookup::inLibrary(Ident library, Ident id) {
  if (const Module *own = ownModule(library->lower)) {
    if (Symbol *symbol = own->find(id))
      return symbol;
    const auto list = own->lists.find(id);
    const auto space = own->spaces.find(id);
    return list != own->lists.end()     ? static_cast<Symbol *>(list->second)
           : space != own->spaces.end() ? static_cast<Symbol *>(space->second)
                                        : nullptr;
  }
  for (const LibraryIndex::Entry &entry : standardEntries(id)) {
    if (!index_.answersTo(entry.library, library->lower))
      continue;
    load(entry);
    Module &found = module(entry.library);
    if (Symbol *symbol = found.find(id))
      return symbol;
    if (const auto list = found.lists.find(id); list != found.lists.end())
      return list->second;
  }
  return index_.answersTo(kCamTableLibrary, library->lower) ? declareCamTable(id) : nullptr;
}

FoundEnumerator Lookup::usedEnumerator(const Scope &scope, Ident id) {
  const Decl *decl = homeOf(scope);
  if (decl == nullptr)
    return {};
  for (const NamePath &path : decl->usings) {
    Symbol *space = used(scope, path);
    if (space == nullptr || space->kind != SymbolKind::Space)
      continue;
    const auto found = enumeratorOf(static_cast<NamespaceSymbol *>(space)->enumerators, id);
    if (found.enumerator != nullptr)
      return found;
  }
  return {};
}

FoundEnumerator Lookup::enumerator(const Scope &scope, Ident id, const Type *expected) {
  if (expected != nullptr && expected->kind == TypeKind::Enumeration) {
    EnumeratorSymbol *e = findEnumerator(typeAs<EnumType>(expected), id);
    if (e != nullptr && !typeAs<EnumType>(expected)->qualifiedOnly)
      return {e};
  }
  for (const NamespaceSymbol *space : spaces(scope)) {
    if (const auto found = enumeratorOf(space->enumerators, id); found.enumerator != nullptr)
      return found;
  }
  if (const auto found = enumeratorOf(scope.module->enumerators, id); found.enumerator != nullptr)
    return found;
  if (const auto found = usedEnumerator(scope, id); found.enumerator != nullptr)
    return found;
  return enumeratorOfLibraries(scope, id);
}

FoundEnumerator Lookup::enumeratorOfLibraries(const Scope &scope, Ident id) {
  FoundEnumerator own;
  for (const UsedLibrary &used : scope.module->library->uses) {
    if (used.library->qualifiedOnly || !used.library->isOwn)
      continue;
    const auto found = enumeratorOf(modules_.at(used.library->name)->enumerators, id);
    if (found.enumerator == nullptr)
      continue;
    if (own.enumerator != nullptr)
      return {own.enumerator, true, found.enumerator};
    if (found.isAmbiguous)
      return found;
    own = found;
  }
  if (own.enumerator != nullptr)
    return own;
  for (const LibraryIndex::Entry &entry : standardEntries(id)) {
    if (!isSeenUnqualified(scope, entry))
      continue;
    load(entry);
    if (const auto found = enumeratorOf(module(entry.library).enumerators, id);
        found.enumerator != nullptr)
      return found;
  }
  return {};
}

} // namespace stc
