// NAMESPACE and USING.

#include "compiler/semantics/checker.hpp"

#include <algorithm>

namespace stc {

using namespace ast;

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

NamespaceSymbol *Checker::declareSpace(Module &module, NamePath path) {
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
    NamespaceSymbol &made = program_.spaceStorage.emplace_back();
    made.kind = SymbolKind::space;
    made.name = name;
    made.library = module.library;
    made.space = space;
    made.path = (space == nullptr ? "" : space->path + ".") + std::string(name.text);
    if (space == nullptr)
      module.spaces.emplace(name.id, &made);
    else if (!space->names.emplace(name.id, &made).second)
      report(Code::duplicateName, name.span,
             "the name `" + std::string(name.text) + "` is declared twice", "declared again here")
          .label(found->name.span, "first declared here");
    space = &made;
  }
  return space;
}

const Decl *Checker::home() const {
  if (scope_.home != nullptr)
    return scope_.home;
  return scope_.pou == nullptr ? nullptr : scope_.pou->decl;
}

std::vector<NamespaceSymbol *> Checker::spacesHere() {
  std::vector<NamespaceSymbol *> list;
  if (const Decl *decl = home(); decl != nullptr && !decl->space.empty())
    for (NamespaceSymbol *space = declareSpace(*scope_.module, decl->space); space != nullptr;
         space = space->space)
      list.push_back(space);
  return list;
}

Symbol *Checker::usedSpace(const NamePath &path) {
  const auto follow = [&](Symbol *space, std::size_t from) -> Symbol * {
    for (std::size_t i = from; space != nullptr && i < path.size(); ++i)
      space = memberOfSpace(space, path[i].id);
    return space != nullptr && space->kind == SymbolKind::space ? space : nullptr;
  };
  for (NamespaceSymbol *space : spacesHere())
    if (Symbol *found = follow(space, 0))
      return found;
  const auto root = scope_.module->spaces.find(path.front().id);
  if (root != scope_.module->spaces.end())
    if (Symbol *found = follow(root->second, 1))
      return found;
  if (path.size() == 1 && index_.isLibrary(path.front().id->lower)) {
    auto *library = arena_.make<LibrarySymbol>();
    library->kind = SymbolKind::library;
    library->name = path.front();
    return library;
  }
  return nullptr;
}

Symbol *Checker::memberOfSpace(Symbol *space, Ident id) {
  if (space->kind == SymbolKind::library)
    return lookupInLibrary(space->name.id, id);
  if (space->kind != SymbolKind::space)
    return nullptr;
  const auto *of = static_cast<NamespaceSymbol *>(space);
  const auto it = of->names.find(id);
  if (it != of->names.end())
    return it->second;
  const auto enumerator = of->enumerators.find(id);
  return enumerator == of->enumerators.end() ? nullptr : enumerator->second.front();
}

bool Checker::seesInternals(const Library *library, const NamespaceSymbol *space) {
  if (scope_.module->library != library)
    return false;
  const auto around = spacesHere();
  return space == nullptr || std::find(around.begin(), around.end(), space) != around.end();
}

Symbol *Checker::nameInSpace(Symbol *space, const Name &name) {
  Symbol *found = memberOfSpace(space, name.id);
  if (found == nullptr || found->space == nullptr)
    return found;
  const Decl *decl = found->kind == SymbolKind::pou    ? static_cast<PouSymbol *>(found)->decl
                     : found->kind == SymbolKind::type ? static_cast<TypeSymbol *>(found)->decl
                                                       : nullptr;
  if (decl != nullptr && decl->access == Access::internalA &&
      !seesInternals(found->library, found->space) &&
      reportedNames_.insert(placeOf(name.span)).second)
    noteDeclaration(report(Code::memberNotVisible, name.span,
                           "`" + qualifiedName(found) + "` is INTERNAL",
                           "only the namespace `" + found->space->path + "` can use it"),
                    found);
  return found;
}

Symbol *Checker::lookupInSpaces(Ident id) {
  for (const NamespaceSymbol *space : spacesHere())
    if (const auto it = space->names.find(id); it != space->names.end())
      return it->second;
  return nullptr;
}

Symbol *Checker::lookupInUsings(const Name &name) {
  const Decl *decl = home();
  if (decl == nullptr)
    return nullptr;
  Symbol *found = nullptr;
  for (const NamePath &path : decl->usings) {
    Symbol *space = usedSpace(path);
    Symbol *here = space == nullptr ? nullptr : memberOfSpace(space, name.id);
    if (here == nullptr || here == found || here->kind == SymbolKind::enumerator)
      continue;
    if (found == nullptr) {
      found = nameInSpace(space, name);
      continue;
    }
    if (unknown_.emplace(scope_.pou, name.id).second)
      report(Code::ambiguousNamespace, name.span,
             "`" + std::string(name.text) + "` is in several namespaces", "which one is meant?")
          .label(found->name.span, "`" + qualifiedName(found) + "`")
          .label(here->name.span, "`" + qualifiedName(here) + "`")
          .help("write `" + qualifiedName(found) + "` or `" + qualifiedName(here) + "`");
    return found;
  }
  return found;
}

Symbol *Checker::lookupDeclared(const Name &name) {
  const Decl *decl = home();
  const bool plain = decl == nullptr || (decl->space.empty() && decl->usings.empty());
  if (!plain)
    if (Symbol *symbol = lookupInSpaces(name.id))
      return symbol;
  if (Symbol *symbol = lookupInModule(*scope_.module, name.id))
    return symbol;
  return plain ? nullptr : lookupInUsings(name);
}

Symbol *Checker::lookupPath(NamePath path, bool asType) {
  if (path.size() == 1) {
    Symbol *symbol = lookup(path.front());
    if (symbol == nullptr)
      reportUnknown(path.front(), asType);
    return symbol;
  }
  Symbol *symbol = lookupInSpaces(path.front().id);
  if (symbol == nullptr || symbol->kind != SymbolKind::space) {
    const Name first = path.front();
    symbol = usedSpace(NamePath(path.data(), 1));
    if (symbol == nullptr)
      if (Symbol *used = lookupInUsings(first); used != nullptr && used->kind == SymbolKind::space)
        symbol = used;
  }
  if (symbol == nullptr) {
    reportUnknown(path.front(), asType);
    return nullptr;
  }
  for (const Name &name : path.subspan(1)) {
    Symbol *next = nameInSpace(symbol, name);
    if (next == nullptr) {
      reportUnknown(name, asType);
      return nullptr;
    }
    symbol = next;
  }
  return symbol;
}

void Checker::checkUsings(const Decl *decl) {
  const ScopeGuard guard(*this, {scope_.module, nullptr, decl});
  for (const NamePath &path : decl->usings) {
    const Span span = path.front().span.to(path.back().span);
    if (usedSpace(path) == nullptr && reportedNames_.insert(placeOf(span)).second)
      report(Code::unknownNamespace, span,
             "cannot find the namespace `" + std::string(program_.sources.text(span)) + "`",
             "neither a NAMESPACE nor a library")
          .help("USING names a NAMESPACE of the project, with those around it: `USING A.B;`");
  }
}

} // namespace stc
