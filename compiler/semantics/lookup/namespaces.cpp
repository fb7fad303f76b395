// NAMESPACE and USING.

#include "compiler/semantics/lookup/names.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/lookup/internal.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;

static Symbol *memberOfSpace(Context &c, Symbol *space, Ident id);

namespace {

std::uint64_t placeOf(Span span) { return std::uint64_t{span.file} << 32 | span.begin; }

std::string qualifiedName(const Symbol *symbol) {
  const std::string name(symbol->name.text);
  if (symbol->space != nullptr)
    return symbol->space->path + "." + name;
  return symbol->library != nullptr && !symbol->library->isUser ? symbol->library->name + "." + name
                                                                : name;
}

} // namespace

NamespaceSymbol *declareSpace(Context &c, Module &module, NamePath path) {
  NamespaceSymbol *space = nullptr;
  for (const Name &name : path) {
    Symbol *found = nullptr;
    if (space == nullptr) {
      const auto it = module.spaces.find(name.id);
      found = it == module.spaces.end() ? nullptr : it->second;
    } else if (const auto it = space->names.find(name.id); it != space->names.end()) {
      found = it->second;
    }
    if (found != nullptr && found->kind == SymbolKind::space) {
      space = static_cast<NamespaceSymbol *>(found);
      continue;
    }
    NamespaceSymbol &made = c.program.spaceStorage.emplace_back();
    made.kind = SymbolKind::space;
    made.name = name;
    made.library = module.library;
    made.space = space;
    made.path = (space == nullptr ? "" : space->path + ".") + std::string(name.text);
    if (space == nullptr)
      module.spaces.emplace(name.id, &made);
    else if (!space->names.emplace(name.id, &made).second)
      c.report(Code::duplicateName, name.span,
               "the name `" + std::string(name.text) + "` is declared twice", "declared again here")
          .label(found->name.span, "first declared here");
    space = &made;
  }
  return space;
}

const Decl *home(Context &c) {
  if (c.scope.home != nullptr)
    return c.scope.home;
  return c.scope.pou == nullptr ? nullptr : c.scope.pou->decl;
}

std::vector<NamespaceSymbol *> spacesHere(Context &c) {
  std::vector<NamespaceSymbol *> list;
  if (const Decl *decl = home(c); decl != nullptr && !decl->space.empty())
    for (NamespaceSymbol *space = declareSpace(c, *c.scope.module, decl->space); space != nullptr;
         space = space->space)
      list.push_back(space);
  return list;
}

Symbol *usedSpace(Context &c, const NamePath &path) {
  const auto follow = [&](Symbol *space, std::size_t from) -> Symbol * {
    for (std::size_t i = from; space != nullptr && i < path.size(); ++i)
      space = memberOfSpace(c, space, path[i].id);
    return space != nullptr && space->kind == SymbolKind::space ? space : nullptr;
  };
  for (NamespaceSymbol *space : spacesHere(c))
    if (Symbol *found = follow(space, 0))
      return found;
  const auto root = c.scope.module->spaces.find(path.front().id);
  if (root != c.scope.module->spaces.end())
    if (Symbol *found = follow(root->second, 1))
      return found;
  if (path.size() == 1 && c.index.isLibrary(path.front().id->lower)) {
    auto *library = c.arena.make<LibrarySymbol>();
    library->kind = SymbolKind::library;
    library->name = path.front();
    return library;
  }
  return nullptr;
}

/// What `space.name` is, of a namespace or a library; null: nothing.
static Symbol *memberOfSpace(Context &c, Symbol *space, Ident id) {
  if (space->kind == SymbolKind::library)
    return lookupInLibrary(c, space->name.id, id);
  if (space->kind != SymbolKind::space)
    return nullptr;
  const auto *of = static_cast<NamespaceSymbol *>(space);
  const auto it = of->names.find(id);
  if (it != of->names.end())
    return it->second;
  const auto enumerator = of->enumerators.find(id);
  return enumerator == of->enumerators.end() ? nullptr : enumerator->second.front();
}

bool seesInternals(Context &c, const Library *library, const NamespaceSymbol *space) {
  if (c.scope.module->library != library)
    return false;
  const auto around = spacesHere(c);
  return space == nullptr || std::find(around.begin(), around.end(), space) != around.end();
}

Symbol *nameInSpace(Context &c, Symbol *space, const Name &name) {
  Symbol *found = memberOfSpace(c, space, name.id);
  if (found == nullptr || found->space == nullptr)
    return found;
  const Decl *decl = found->kind == SymbolKind::pou    ? static_cast<PouSymbol *>(found)->decl
                     : found->kind == SymbolKind::type ? static_cast<TypeSymbol *>(found)->decl
                                                       : nullptr;
  if (decl != nullptr && decl->access == Access::internalA &&
      !seesInternals(c, found->library, found->space) &&
      c.reportedNames.insert(placeOf(name.span)).second)
    noteDeclaration(c.report(Code::memberNotVisible, name.span,
                             "`" + qualifiedName(found) + "` is INTERNAL",
                             "only the namespace `" + found->space->path + "` can use it"),
                    found);
  return found;
}

static Symbol *lookupInSpaces(Context &c, Ident id) {
  for (const NamespaceSymbol *space : spacesHere(c))
    if (const auto it = space->names.find(id); it != space->names.end())
      return it->second;
  return nullptr;
}

static Symbol *lookupInUsings(Context &c, const Name &name) {
  const Decl *decl = home(c);
  if (decl == nullptr)
    return nullptr;
  Symbol *found = nullptr;
  for (const NamePath &path : decl->usings) {
    Symbol *space = usedSpace(c, path);
    Symbol *here = space == nullptr ? nullptr : memberOfSpace(c, space, name.id);
    if (here == nullptr || here == found || here->kind == SymbolKind::enumerator)
      continue;
    if (found == nullptr) {
      found = nameInSpace(c, space, name);
      continue;
    }
    if (c.unknown.emplace(c.scope.pou, name.id).second)
      c.report(Code::ambiguousNamespace, name.span,
               "`" + std::string(name.text) + "` is in several namespaces", "which one is meant?")
          .label(found->name.span, "`" + qualifiedName(found) + "`")
          .label(here->name.span, "`" + qualifiedName(here) + "`")
          .help("write `" + qualifiedName(found) + "` or `" + qualifiedName(here) + "`");
    return found;
  }
  return found;
}

Symbol *lookupDeclared(Context &c, const Name &name) {
  const Decl *decl = home(c);
  const bool plain = decl == nullptr || (decl->space.empty() && decl->usings.empty());
  if (!plain)
    if (Symbol *symbol = lookupInSpaces(c, name.id))
      return symbol;
  if (Symbol *symbol = lookupInModule(*c.scope.module, name.id))
    return symbol;
  return plain ? nullptr : lookupInUsings(c, name);
}

Symbol *lookupPath(Context &c, NamePath path, bool asType) {
  if (path.size() == 1) {
    Symbol *symbol = lookup(c, path.front());
    if (symbol == nullptr)
      reportUnknown(c, path.front(), asType);
    return symbol;
  }
  Symbol *symbol = lookupInSpaces(c, path.front().id);
  if (symbol == nullptr || symbol->kind != SymbolKind::space) {
    const Name first = path.front();
    symbol = usedSpace(c, NamePath(path.data(), 1));
    if (symbol == nullptr)
      if (Symbol *used = lookupInUsings(c, first);
          used != nullptr && used->kind == SymbolKind::space)
        symbol = used;
  }
  if (symbol == nullptr) {
    reportUnknown(c, path.front(), asType);
    return nullptr;
  }
  for (const Name &name : path.subspan(1)) {
    Symbol *next = nameInSpace(c, symbol, name);
    if (next == nullptr) {
      reportUnknown(c, name, asType);
      return nullptr;
    }
    symbol = next;
  }
  return symbol;
}

void checkUsings(Context &c, const Decl *decl) {
  const ScopeGuard guard(c, {c.scope.module, nullptr, decl});
  for (const NamePath &path : decl->usings) {
    const Span span = path.front().span.to(path.back().span);
    if (usedSpace(c, path) == nullptr && c.reportedNames.insert(placeOf(span)).second)
      c.report(Code::unknownNamespace, span,
               "cannot find the namespace `" + std::string(c.program.sources.text(span)) + "`",
               "neither a NAMESPACE nor a library")
          .help("USING names a NAMESPACE of the project, with those around it: `USING A.B;`");
  }
}

} // namespace stc::sema
