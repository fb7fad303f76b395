// Looking names up from the scope of the check.

#include "compiler/semantics/names/names.hpp"

#include "compiler/semantics/context/describe.hpp"

namespace stc::sema {

using namespace ast;

namespace {

uint64_t placeOf(Span span) { return uint64_t{span.file} << 32 | span.begin; }

std::string qualifiedName(const Symbol *symbol) {
  const std::string name(symbol->name.text);
  if (symbol->space != nullptr && !symbol->library->isOwn)
    return symbol->space->path + "." + name;
  if (symbol->space != nullptr)
    return symbol->library->name + "." + symbol->space->path + "." + name;
  return symbol->library != nullptr && !symbol->library->isUser ? symbol->library->name + "." + name
                                                                : name;
}

} // namespace

/// The symbol, after what is wrong with the name has been reported.
static Symbol *use(Context &c, const Name &name, const Found &found) {
  if (found.isForeign && c.reported.names.insert(placeOf(name.span)).second)
    noteDeclaration(
        c.report(Code::MemberNotVisible, name.span,
                 "`" + qualifiedName(found.symbol) + "` is INTERNAL",
                 "only the " +
                     (found.symbol->space != nullptr ? "namespace `" + found.symbol->space->path
                                                     : "library `" + found.symbol->library->name) +
                     "` can use it"),
        found.symbol);
  if (found.other != nullptr && c.reported.unknown.emplace(c.scope.pou, name.id).second)
    c.report(Code::AmbiguousNamespace, name.span,
             "`" + std::string(name.text) + "` is in several " +
                 (found.symbol->space == nullptr ? "libraries" : "namespaces"),
             "which one is meant?")
        .label(found.symbol->name.span, "`" + qualifiedName(found.symbol) + "`")
        .label(found.other->name.span, "`" + qualifiedName(found.other) + "`")
        .help("write `" + qualifiedName(found.symbol) + "` or `" + qualifiedName(found.other) +
              "`");
  return found.symbol;
}

Symbol *lookup(Context &c, const Name &name) { return use(c, name, c.names.find(c.scope, name)); }

Symbol *lookupDeclared(Context &c, const Name &name) {
  return use(c, name, c.names.declared(c.scope, name.id));
}

Symbol *lookupInLibraries(Context &c, const Name &name) {
  return use(c, name, c.names.inLibraries(c.scope, name.id));
}

Symbol *nameInSpace(Context &c, Symbol *space, const Name &name) {
  return use(c, name, c.names.inSpace(c.scope, space, name.id));
}

/// The namespace or library at the beginning of a path; null: none.
static Symbol *spaceOfPath(Context &c, const Name &first, NamePath path) {
  Symbol *symbol = c.names.inSpaces(c.scope, first.id);
  if (symbol != nullptr && symbol->kind == SymbolKind::Space)
    return symbol;
  symbol = c.names.used(c.scope, NamePath(path.data(), 1));
  if (symbol != nullptr)
    return symbol;
  Symbol *used = use(c, first, c.names.inUsings(c.scope, first.id));
  return used != nullptr && used->kind == SymbolKind::Space ? used : nullptr;
}

/// One missing library is one mistake in a file.
static void reportUnknownSpace(Context &c, const Name &name) {
  if (!c.reported.spaces.emplace(name.span.file, name.id).second)
    return;
  c.report(Code::UnknownNamespace, name.span,
           "cannot find the library or namespace `" + std::string(name.text) + "`",
           "not named in stride.toml, no NAMESPACE of the project")
      .help("a library of your own is named in stride.toml: `[[library]]` with `path = \"…\"`");
}

Symbol *lookupPath(Context &c, NamePath path, bool asType) {
  const Name first = path.front();
  Symbol *symbol = path.size() == 1 ? lookup(c, first) : spaceOfPath(c, first, path);
  if (symbol == nullptr && path.size() != 1) {
    reportUnknownSpace(c, first);
    return nullptr;
  }
  if (symbol == nullptr) {
    reportUnknown(c, first, asType ? Sought::Type : Sought::Value);
    return nullptr;
  }
  for (const Name &name : path.subspan(1)) {
    Symbol *next = nameInSpace(c, symbol, name);
    if (next == nullptr) {
      reportUnknown(c, name, asType ? Sought::Type : Sought::Value);
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
    if (c.names.used(c.scope, path) == nullptr && c.reported.names.insert(placeOf(span)).second)
      c.report(Code::UnknownNamespace, span,
               "cannot find the namespace `" + std::string(c.program.sources.text(span)) + "`",
               "neither a NAMESPACE nor a library")
          .help("USING names a NAMESPACE of the project, with those around it: `USING A.B;`");
  }
}

} // namespace stc::sema
