// What is visible somewhere, what has which members, where it is declared.

#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/lookup/lookup.hpp"

#include <algorithm>

namespace stc {

using namespace ast;

namespace {

using Symbols = std::vector<const Symbol *>;

/// The last of the declarations that begin before the place; null: none.
template <class T> T *lastBefore(const std::vector<T *> &symbols, FileId file, uint32_t offset) {
  T *last = nullptr;
  for (T *symbol : symbols) {
    const Span span = symbol->decl->span;
    if (span.file == file && span.begin <= offset &&
        (last == nullptr || span.begin > last->decl->span.begin))
      last = symbol;
  }
  return last;
}

/// What ends with the file has no END.
bool isOver(const PouSymbol *pou, uint32_t offset) {
  return pou->decl->endSpan.valid() && pou->decl->endSpan.end < offset;
}

/// Adds what a table of names holds, in an order that does not depend on addresses.
template <class Table> void addSorted(const Table &table, Symbols &out) {
  const auto first = static_cast<ptrdiff_t>(out.size());
  for (const auto &[id, symbol] : table)
    out.push_back(symbol);
  std::sort(out.begin() + first, out.end(),
            [](const Symbol *a, const Symbol *b) { return a->name.id->lower < b->name.id->lower; });
}

/// Of enumerations of one place that have a name in common, the first one stands for all.
void addEnumerators(const std::unordered_map<Ident, std::vector<EnumeratorSymbol *>> &enumerators,
                    Symbols &out) {
  std::unordered_map<Ident, const Symbol *> firsts;
  for (const auto &[id, list] : enumerators)
    firsts.emplace(id, list.front());
  addSorted(firsts, out);
}

bool isMember(const VarSymbol *v) {
  return !v->hidden && v->section != Section::Temp && v->section != Section::Instance;
}

void addFields(const StructType *type, Symbols &out) {
  for (const StructType *s = type; s != nullptr; s = s->base) {
    for (const VarSymbol *field : s->fields) {
      if (!field->hidden)
        out.push_back(field);
    }
  }
}

void addPou(const PouSymbol *pou, Symbols &out) {
  for (const VarSymbol *v : pou->variables) {
    if (isMember(v))
      out.push_back(v);
  }
  for (const PouSymbol *method : pou->methods) {
    if (method->property == nullptr)
      out.push_back(method);
  }
  out.insert(out.end(), pou->properties.begin(), pou->properties.end());
}

void addInstance(const PouSymbol *pou, Symbols &out) {
  std::vector<const PouSymbol *> pous;
  for (const PouSymbol *p = pou; p != nullptr; p = p->base)
    pous.push_back(p);
  for (size_t i = 0; i < pous.size(); ++i) {
    addPou(pous[i], out);
    for (const PouSymbol *base : pous[i]->interfaces) {
      if (pou->isInterface() && std::find(pous.begin(), pous.end(), base) == pous.end())
        pous.push_back(base);
    }
  }
}

/// What the code of a POU sees of itself, its bases and the block around.
void addOwn(const PouSymbol *pou, Symbols &out) {
  for (const PouSymbol *p = pou; p != nullptr; p = p->owner) {
    for (const PouSymbol *b = p; b != nullptr; b = b->base) {
      addSorted(b->scope, out);
      addSorted(b->members, out);
    }
  }
}

} // namespace

std::optional<Scope> Lookup::scopeAt(FileId file, uint32_t offset) const {
  Module *project = findModule("");
  if (project == nullptr)
    return std::nullopt;
  Scope scope{project};
  PouSymbol *pou = lastBefore(project->library->pous, file, offset);
  const TypeSymbol *type = lastBefore(project->declaredTypes, file, offset);
  if (pou != nullptr && !isOver(pou, offset) &&
      (type == nullptr || type->decl->span.begin < pou->decl->span.begin)) {
    PouSymbol *method = lastBefore(pou->methods, file, offset);
    scope.pou = method != nullptr && !isOver(method, offset) ? method : pou;
  } else if (type != nullptr) {
    scope.home = type->decl;
  }
  return scope;
}

std::vector<const Symbol *> Lookup::visible(const Scope &scope) const {
  Symbols list;
  addOwn(scope.pou, list);
  for (const NamespaceSymbol *space : spaces(scope)) {
    addSorted(space->names, list);
    addEnumerators(space->enumerators, list);
  }
  addSorted(scope.module->names, list);
  addEnumerators(scope.module->enumerators, list);
  addSorted(builtins_, list);
  addSorted(scope.module->lists, list);
  addSorted(scope.module->spaces, list);
  return list;
}

std::vector<const Symbol *> Lookup::members(const Type *type) {
  Symbols list;
  if (type->kind == TypeKind::Structure) {
    addFields(typeAs<StructType>(type), list);
  } else if (isInstance(type) || type->kind == TypeKind::Interface) {
    addInstance(typeAs<PouType>(type)->symbol, list);
  } else if (type->kind == TypeKind::Enumeration) {
    const auto &enumerators = typeAs<EnumType>(type)->enumerators;
    list.assign(enumerators.begin(), enumerators.end());
  }
  return list;
}

std::vector<const Symbol *> Lookup::members(const Symbol *symbol) const {
  Symbols list;
  switch (symbol->kind) {
  case SymbolKind::Variable:
  case SymbolKind::Property:
    break;
  case SymbolKind::Type: {
    const Type *type = static_cast<const TypeSymbol *>(symbol)->type;
    return type == nullptr ? list : members(type);
  }
  case SymbolKind::Pou:
    addInstance(static_cast<const PouSymbol *>(symbol), list);
    return list;
  case SymbolKind::Globals: {
    const auto &variables = static_cast<const GlobalsSymbol *>(symbol)->variables;
    list.assign(variables.begin(), variables.end());
    return list;
  }
  case SymbolKind::Space:
    addSorted(static_cast<const NamespaceSymbol *>(symbol)->names, list);
    addEnumerators(static_cast<const NamespaceSymbol *>(symbol)->enumerators, list);
    return list;
  case SymbolKind::Library:
    for (const auto &[name, module] : modules_) {
      if (name.empty() || !index_.answersTo(name, symbol->name.id->lower))
        continue;
      addSorted(module->names, list);
      addSorted(module->lists, list);
    }
    return list;
  case SymbolKind::Enumerator:
  case SymbolKind::Builtin:
  case SymbolKind::Self:
    return list;
  }
  const Type *type = symbol->kind == SymbolKind::Variable
                         ? static_cast<const VarSymbol *>(symbol)->type
                         : static_cast<const PropertySymbol *>(symbol)->type;
  if (type != nullptr && type->kind == TypeKind::Reference)
    type = typeAs<PointerType>(type)->pointee;
  return type == nullptr ? list : members(type);
}

std::optional<Span> Lookup::declaration(const Symbol *symbol) {
  switch (symbol->kind) {
  case SymbolKind::Builtin:
  case SymbolKind::Library:
    return std::nullopt;
  case SymbolKind::Self:
    return declaration(static_cast<const SelfSymbol *>(symbol)->block);
  default:
    return symbol->name.span.valid() ? std::optional(symbol->name.span) : std::nullopt;
  }
}

} // namespace stc
