// What can be named somewhere, for "did you mean".

#include "compiler/semantics/lookup/names.hpp"

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/lookup/internal.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;

VarSymbol *findMember(Context &c, const Type *type, Ident id) {
  if (type->kind == TypeKind::structure) {
    const auto &fields = typeAs<StructType>(type)->symbol->fields;
    const auto it = fields.find(id);
    return it == fields.end() ? nullptr : it->second;
  }
  if (isInstance(type)) {
    PouSymbol *pou = typeAs<PouType>(type)->symbol;
    declare(c, pou);
    return findVariable(pou, id);
  }
  return nullptr;
}

std::vector<std::string_view> visibleNames(Context &c, bool types) {
  std::vector<std::string_view> list;
  const auto add = [&](const Symbol *symbol) {
    const bool isType =
        symbol->kind == SymbolKind::type ||
        (symbol->kind == SymbolKind::pou && !static_cast<const PouSymbol *>(symbol)->isFunction());
    if (types ? isType : symbol->kind != SymbolKind::type)
      list.push_back(symbol->name.text);
  };
  if (c.scope.pou != nullptr && !types) {
    for (const PouSymbol *p = c.scope.pou; p != nullptr; p = p->owner) {
      for (const PouSymbol *b = p; b != nullptr; b = b->base) {
        for (const auto &[id, symbol] : b->scope)
          add(symbol);
        for (const auto &[id, symbol] : b->members)
          add(symbol);
      }
    }
  }
  for (const NamespaceSymbol *space : spacesHere(c))
    for (const auto &[id, symbol] : space->names)
      add(symbol);
  for (const auto &[id, symbol] : c.scope.module->names)
    add(symbol);
  if (types) {
    for (const char *name : {"BOOL",  "SINT",  "INT",   "DINT", "LINT",   "USINT",  "UINT",
                             "UDINT", "ULINT", "BYTE",  "WORD", "DWORD",  "LWORD",  "REAL",
                             "LREAL", "TIME",  "LTIME", "DATE", "STRING", "WSTRING"})
      list.emplace_back(name);
  } else {
    for (const auto &[id, symbol] : c.builtins)
      list.push_back(id->lower);
    for (const auto &[id, symbols] : c.scope.module->enumerators)
      list.push_back(symbols.front()->name.text);
  }
  // The hash maps' order must not show.
  std::sort(list.begin(), list.end());
  for (const std::string_view name : c.index.names())
    list.push_back(name);
  return list;
}

std::vector<std::string_view> memberNames(const Type *type) {
  std::vector<std::string_view> list;
  if (type->kind == TypeKind::structure) {
    for (const auto *s = typeAs<StructType>(type); s != nullptr; s = s->base) {
      for (const VarSymbol *f : s->fields) {
        if (!f->hidden)
          list.push_back(f->name.text);
      }
    }
  } else if (isInstance(type) || type->kind == TypeKind::interface) {
    std::vector<const PouSymbol *> pous;
    for (const PouSymbol *p = typeAs<PouType>(type)->symbol; p != nullptr; p = p->base)
      pous.push_back(p);
    for (std::size_t i = 0; i < pous.size(); ++i) {
      for (const VarSymbol *v : pous[i]->variables) {
        if (!v->hidden && v->section != Section::temp && v->section != Section::instance)
          list.push_back(v->name.text);
      }
      for (const PouSymbol *m : pous[i]->methods)
        list.push_back(m->name.text);
      if (type->kind == TypeKind::interface)
        pous.insert(pous.end(), pous[i]->interfaces.begin(), pous[i]->interfaces.end());
    }
  } else if (type->kind == TypeKind::enumeration) {
    for (const EnumeratorSymbol *e : typeAs<EnumType>(type)->enumerators)
      list.push_back(e->name.text);
  }
  return list;
}

} // namespace stc::sema
