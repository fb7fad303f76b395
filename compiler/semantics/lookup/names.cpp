// Looking names up.

#include "compiler/semantics/lookup/names.hpp"

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/cam_tables.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/lookup/internal.hpp"

namespace stc::sema {

using namespace ast;

static Symbol *declareCamTable(Context &c, Ident id);

static Symbol *lookupInPou(PouSymbol *pou, Ident id) {
  for (PouSymbol *p = pou; p != nullptr; p = p->owner) {
    VarSymbol *v = findVariable(p, id);
    if (v != nullptr && (p == pou || v->section != Section::temp)) // VAR_TEMP is the body's own
      return v;
    if (p->owner == nullptr && !p->isFunction()) {
      if (Symbol *member = memberNamed(p, id))
        return member;
    }
  }
  return nullptr;
}

static Symbol *lookupSelf(Context &c, const Name &name) {
  const bool isSuper = name.id->lower == "super";
  if (!isSuper && name.id->lower != "this")
    return nullptr;
  PouSymbol *block = c.scope.pou == nullptr ? nullptr : blockOf(c.scope.pou);
  if (block == nullptr || block->isFunction() || block->isInterface() ||
      (isSuper && block->base == nullptr))
    return nullptr;
  auto *symbol = c.arena.make<SelfSymbol>();
  symbol->kind = SymbolKind::self;
  symbol->name = name;
  symbol->library = block->library;
  symbol->block = isSuper ? block->base : block;
  symbol->isSuper = isSuper;
  return symbol;
}

Symbol *lookupInModule(Module &module, Ident id) {
  const auto it = module.names.find(id);
  return it == module.names.end() ? nullptr : it->second;
}

/// Whether names of that file are seen here without the library's name.
static bool isSeenUnqualified(Context &c, const LibraryIndex::Entry &entry) {
  return !entry.qualifiedOnly || c.scope.module->library->name == entry.library;
}

Symbol *lookupInLibraries(Context &c, Ident id) {
  for (const LibraryIndex::Entry &entry : c.index.find(id->lower)) {
    if (!entry.qualifiedOnly || !isSeenUnqualified(c, entry))
      continue;
    loadLibraryFile(c, entry);
    if (Symbol *symbol = lookupInModule(moduleNamed(c, std::string(entry.library)), id))
      return symbol;
  }
  const auto [it, fresh] = c.libraryMisses.emplace(id, nullptr);
  if (!fresh)
    return it->second;
  for (const LibraryIndex::Entry &entry : c.index.find(id->lower)) {
    if (entry.qualifiedOnly)
      continue;
    loadLibraryFile(c, entry);
    if (Symbol *symbol = lookupInModule(moduleNamed(c, std::string(entry.library)), id)) {
      c.libraryMisses[id] = symbol;
      return symbol;
    }
  }
  return c.libraryMisses[id] = declareCamTable(c, id);
}

/// A cam table of that name (cam_tables.hpp); null when it is none.
static Symbol *declareCamTable(Context &c, Ident id) {
  if (!looksLikeCamTable(id->lower))
    return nullptr;
  const CamTableName table = readCamTable(id->lower);
  if (!table.problem.empty())
    return nullptr;
  const std::string library(kCamTableLibrary);
  const std::string file = "<stdlib>/" + library + "/" + table.name + ".st";
  loadLibraryFile(c, {library, file, camTableDeclaration(table)});
  Symbol *symbol = lookupInModule(moduleNamed(c, library), id);
  static_cast<TypeSymbol *>(symbol)->onDemand = true;
  return symbol;
}

Symbol *lookupInLibrary(Context &c, Ident library, Ident id) {
  for (const LibraryIndex::Entry &entry : c.index.find(id->lower)) {
    if (!c.index.answersTo(entry.library, library->lower))
      continue;
    loadLibraryFile(c, entry);
    Module &found = moduleNamed(c, std::string(entry.library));
    if (Symbol *symbol = lookupInModule(found, id))
      return symbol;
    if (const auto list = found.lists.find(id); list != found.lists.end())
      return list->second;
  }
  return c.index.answersTo(kCamTableLibrary, library->lower) ? declareCamTable(c, id) : nullptr;
}

Symbol *lookup(Context &c, const Name &name) {
  if (c.scope.pou != nullptr) {
    if (Symbol *symbol = lookupInPou(c.scope.pou, name.id))
      return symbol;
  }
  if (Symbol *symbol = lookupDeclared(c, name))
    return symbol;
  if (Symbol *symbol = lookupSelf(c, name))
    return symbol;
  const auto builtin = c.builtins.find(name.id);
  if (builtin != c.builtins.end())
    return builtin->second;
  if (Symbol *symbol = lookupInLibraries(c, name.id))
    return symbol;
  const auto list = c.scope.module->lists.find(name.id);
  if (list != c.scope.module->lists.end())
    return list->second;
  const auto space = c.scope.module->spaces.find(name.id);
  if (space != c.scope.module->spaces.end())
    return space->second;
  for (const LibraryIndex::Entry &entry : c.index.find(name.id->lower)) { // loaded by now
    if (!isSeenUnqualified(c, entry))
      continue;
    const Module &library = moduleNamed(c, std::string(entry.library));
    if (const auto found = library.lists.find(name.id); found != library.lists.end())
      return found->second;
  }
  if (c.index.isLibrary(name.id->lower)) {
    auto *symbol = c.arena.make<LibrarySymbol>();
    symbol->kind = SymbolKind::library;
    symbol->name = name;
    return symbol;
  }
  return nullptr;
}

EnumeratorSymbol *findEnumerator(const EnumType *type, Ident id) {
  for (EnumeratorSymbol *e : type->enumerators) {
    if (e->name.id == id)
      return e;
  }
  return nullptr;
}

EnumeratorSymbol *lookupEnumerator(Context &c, const Name &name, const Type *expected,
                                   bool &ambiguous) {
  ambiguous = false;
  if (expected != nullptr && expected->kind == TypeKind::enumeration) {
    EnumeratorSymbol *e = findEnumerator(typeAs<EnumType>(expected), name.id);
    if (e != nullptr && !typeAs<EnumType>(expected)->qualifiedOnly)
      return e;
  }
  const auto inModule = [&](Module &m) -> EnumeratorSymbol * {
    const auto it = m.enumerators.find(name.id);
    if (it == m.enumerators.end())
      return nullptr;
    ambiguous = it->second.size() > 1;
    return it->second.front();
  };
  for (NamespaceSymbol *space : spacesHere(c)) {
    const auto it = space->enumerators.find(name.id);
    if (it == space->enumerators.end())
      continue;
    ambiguous = it->second.size() > 1;
    return it->second.front();
  }
  if (EnumeratorSymbol *e = inModule(*c.scope.module))
    return e;
  if (const Decl *decl = home(c); decl != nullptr)
    for (const NamePath &path : decl->usings) {
      Symbol *space = usedSpace(c, path);
      if (space == nullptr || space->kind != SymbolKind::space)
        continue;
      const auto &enumerators = static_cast<NamespaceSymbol *>(space)->enumerators;
      if (const auto it = enumerators.find(name.id); it != enumerators.end()) {
        ambiguous = it->second.size() > 1;
        return it->second.front();
      }
    }
  for (const LibraryIndex::Entry &entry : c.index.find(name.id->lower)) {
    if (!isSeenUnqualified(c, entry))
      continue;
    loadLibraryFile(c, entry);
    if (EnumeratorSymbol *e = inModule(moduleNamed(c, std::string(entry.library))))
      return e;
  }
  return nullptr;
}

} // namespace stc::sema
