// Looking names up.

#include "compiler/semantics/checker.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/suggest.hpp"

#include <algorithm>

namespace stc {

using namespace ast;

Symbol *Checker::lookupInModule(Module &module, Ident id) {
  const auto it = module.names.find(id);
  return it == module.names.end() ? nullptr : it->second;
}

Symbol *Checker::lookupInLibraries(Ident id) {
  const auto [it, fresh] = libraryMisses_.emplace(id, nullptr);
  if (!fresh)
    return it->second;
  for (const LibraryIndex::Entry &entry : index_.find(id->lower)) {
    loadLibraryFile(entry);
    if (Symbol *symbol = lookupInModule(module(std::string(entry.library)), id)) {
      libraryMisses_[id] = symbol;
      return symbol;
    }
  }
  return nullptr;
}

Symbol *Checker::lookupInLibrary(Ident library, Ident id) {
  for (const LibraryIndex::Entry &entry : index_.find(id->lower)) {
    if (program_.interner.intern(entry.library) != library)
      continue;
    loadLibraryFile(entry);
    if (Symbol *symbol = lookupInModule(module(std::string(entry.library)), id))
      return symbol;
  }
  return nullptr;
}

Symbol *Checker::lookup(const Name &name) {
  if (scope_.pou != nullptr) {
    if (Symbol *symbol = lookupInPou(scope_.pou, name.id))
      return symbol;
  }
  if (Symbol *symbol = lookupDeclared(name))
    return symbol;
  if (Symbol *symbol = lookupSelf(name))
    return symbol;
  const auto builtin = builtins_.find(name.id);
  if (builtin != builtins_.end())
    return builtin->second;
  if (Symbol *symbol = lookupInLibraries(name.id))
    return symbol;
  const auto list = scope_.module->lists.find(name.id);
  if (list != scope_.module->lists.end())
    return list->second;
  const auto space = scope_.module->spaces.find(name.id);
  if (space != scope_.module->spaces.end())
    return space->second;
  if (index_.isLibrary(name.id->lower)) {
    auto *symbol = arena_.make<LibrarySymbol>();
    symbol->kind = SymbolKind::library;
    symbol->name = name;
    return symbol;
  }
  return nullptr;
}

EnumeratorSymbol *Checker::findEnumerator(const EnumType *type, Ident id) {
  for (EnumeratorSymbol *e : type->enumerators) {
    if (e->name.id == id)
      return e;
  }
  return nullptr;
}

EnumeratorSymbol *Checker::lookupEnumerator(const Name &name, const Type *expected,
                                            bool &ambiguous) {
  ambiguous = false;
  if (expected != nullptr && expected->kind == TypeKind::enumeration) {
    if (EnumeratorSymbol *e = findEnumerator(typeAs<EnumType>(expected), name.id))
      return e;
  }
  const auto inModule = [&](Module &m) -> EnumeratorSymbol * {
    const auto it = m.enumerators.find(name.id);
    if (it == m.enumerators.end())
      return nullptr;
    ambiguous = it->second.size() > 1;
    return it->second.front();
  };
  for (NamespaceSymbol *space : spacesHere()) {
    const auto it = space->enumerators.find(name.id);
    if (it == space->enumerators.end())
      continue;
    ambiguous = it->second.size() > 1;
    return it->second.front();
  }
  if (EnumeratorSymbol *e = inModule(*scope_.module))
    return e;
  if (const Decl *decl = home(); decl != nullptr)
    for (const NamePath &path : decl->usings) {
      Symbol *space = usedSpace(path);
      if (space == nullptr || space->kind != SymbolKind::space)
        continue;
      const auto &enumerators = static_cast<NamespaceSymbol *>(space)->enumerators;
      if (const auto it = enumerators.find(name.id); it != enumerators.end()) {
        ambiguous = it->second.size() > 1;
        return it->second.front();
      }
    }
  for (const LibraryIndex::Entry &entry : index_.find(name.id->lower)) {
    loadLibraryFile(entry);
    if (EnumeratorSymbol *e = inModule(module(std::string(entry.library))))
      return e;
  }
  return nullptr;
}

VarSymbol *Checker::findMember(const Type *type, Ident id) {
  if (type->kind == TypeKind::structure) {
    const auto &fields = typeAs<StructType>(type)->symbol->fields;
    const auto it = fields.find(id);
    return it == fields.end() ? nullptr : it->second;
  }
  if (isInstance(type)) {
    PouSymbol *pou = typeAs<PouType>(type)->symbol;
    declare(pou);
    return findVariable(pou, id);
  }
  return nullptr;
}

std::vector<std::string_view> Checker::visibleNames(bool types) {
  std::vector<std::string_view> list;
  const auto add = [&](const Symbol *symbol) {
    const bool isType =
        symbol->kind == SymbolKind::type ||
        (symbol->kind == SymbolKind::pou && !static_cast<const PouSymbol *>(symbol)->isFunction());
    if (types ? isType : symbol->kind != SymbolKind::type)
      list.push_back(symbol->name.text);
  };
  if (scope_.pou != nullptr && !types) {
    for (const PouSymbol *p = scope_.pou; p != nullptr; p = p->owner) {
      for (const PouSymbol *b = p; b != nullptr; b = b->base) {
        for (const auto &[id, symbol] : b->scope)
          add(symbol);
        for (const auto &[id, symbol] : b->members)
          add(symbol);
      }
    }
  }
  for (const NamespaceSymbol *space : spacesHere())
    for (const auto &[id, symbol] : space->names)
      add(symbol);
  for (const auto &[id, symbol] : scope_.module->names)
    add(symbol);
  if (types) {
    for (const char *name : {"BOOL",  "SINT",  "INT",   "DINT", "LINT",   "USINT",  "UINT",
                             "UDINT", "ULINT", "BYTE",  "WORD", "DWORD",  "LWORD",  "REAL",
                             "LREAL", "TIME",  "LTIME", "DATE", "STRING", "WSTRING"})
      list.emplace_back(name);
  } else {
    for (const auto &[id, symbol] : builtins_)
      list.push_back(id->lower);
    for (const auto &[id, symbols] : scope_.module->enumerators)
      list.push_back(symbols.front()->name.text);
  }
  // The hash maps' order must not show.
  std::sort(list.begin(), list.end());
  for (const std::string_view name : index_.names())
    list.push_back(name);
  return list;
}

std::vector<std::string_view> Checker::memberNames(const Type *type) {
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

namespace {

/// Words of the language that later versions understand.
bool isLaterWord(std::string_view lower) {
  static constexpr std::string_view kWords[] = {"lower_bound", "upper_bound", "__new",   "__delete",
                                                "bitadr",      "xsizeof",     "indexof", "ini"};
  return std::find(std::begin(kWords), std::end(kWords), lower) != std::end(kWords);
}

} // namespace

void Checker::reportUnknown(const Name &name, bool asType) {
  if (!asType) {
    if (!unknown_.emplace(scope_.pou, name.id).second)
      return; // one missing declaration is one mistake
    if (reportSelf(name))
      return;
    if (isLaterWord(name.id->lower)) {
      report(Code::unsupported, name.span,
             "`" + std::string(name.text) + "` is not supported by this version", "not available");
      return;
    }
  }
  auto &d =
      asType ? report(Code::unknownType, name.span,
                      "cannot find type `" + std::string(name.text) + "`", "no type of this name")
             : report(Code::unknownName, name.span, "cannot find `" + std::string(name.text) + "`",
                      "not declared in this scope");
  const std::string_view similar = nearest(name.text, visibleNames(asType));
  if (!similar.empty())
    d.help("a similar name exists: `" + std::string(similar) + "`");
  else if (!asType)
    d.help("declare it in a VAR section of this POU or in a VAR_GLOBAL list");
}

std::string Checker::describe(const Symbol *symbol) const {
  switch (symbol->kind) {
  case SymbolKind::variable:
    return "a variable";
  case SymbolKind::pou: {
    switch (static_cast<const PouSymbol *>(symbol)->decl->kind) {
    case DeclKind::program:
      return "a program";
    case DeclKind::function:
      return "a function";
    case DeclKind::classD:
      return "a class";
    case DeclKind::interface:
      return "an interface";
    case DeclKind::method:
      return "a method";
    case DeclKind::action:
      return "an action";
    default:
      return "a function block";
    }
  }
  case SymbolKind::type:
    return "a type";
  case SymbolKind::enumerator:
    return "an enumerator";
  case SymbolKind::builtin:
    return "a standard function";
  case SymbolKind::library:
    return "a library";
  case SymbolKind::globals:
    return "a list of global variables";
  case SymbolKind::property:
    return "a property";
  case SymbolKind::self:
    return static_cast<const SelfSymbol *>(symbol)->isSuper ? "the base of this block"
                                                            : "this block's own instance";
  case SymbolKind::space:
    return "a namespace";
  }
  return {};
}

void Checker::noteDeclaration(Diagnostic &diagnostic, const Symbol *symbol) {
  if (symbol->name.span.valid())
    diagnostic.label(symbol->name.span,
                     "`" + std::string(symbol->name.text) + "` is declared here");
}

} // namespace stc
