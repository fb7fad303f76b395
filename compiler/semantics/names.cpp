// Looking names up.

#include "compiler/semantics/cam_tables.hpp"
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

bool Checker::isSeenUnqualified(const LibraryIndex::Entry &entry) const {
  return !entry.qualifiedOnly || scope_.module->library->name == entry.library;
}

Symbol *Checker::lookupInLibraries(Ident id) {
  for (const LibraryIndex::Entry &entry : index_.find(id->lower)) {
    if (!entry.qualifiedOnly || !isSeenUnqualified(entry))
      continue;
    loadLibraryFile(entry);
    if (Symbol *symbol = lookupInModule(module(std::string(entry.library)), id))
      return symbol;
  }
  const auto [it, fresh] = libraryMisses_.emplace(id, nullptr);
  if (!fresh)
    return it->second;
  for (const LibraryIndex::Entry &entry : index_.find(id->lower)) {
    if (entry.qualifiedOnly)
      continue;
    loadLibraryFile(entry);
    if (Symbol *symbol = lookupInModule(module(std::string(entry.library)), id)) {
      libraryMisses_[id] = symbol;
      return symbol;
    }
  }
  return libraryMisses_[id] = declareCamTable(id);
}

Symbol *Checker::declareCamTable(Ident id) {
  if (!looksLikeCamTable(id->lower))
    return nullptr;
  const CamTableName table = readCamTable(id->lower);
  if (!table.problem.empty())
    return nullptr;
  const std::string library(kCamTableLibrary);
  const std::string file = "<stdlib>/" + library + "/" + table.name + ".st";
  loadLibraryFile({library, file, camTableDeclaration(table)});
  Symbol *symbol = lookupInModule(module(library), id);
  static_cast<TypeSymbol *>(symbol)->onDemand = true;
  return symbol;
}

Symbol *Checker::lookupInLibrary(Ident library, Ident id) {
  for (const LibraryIndex::Entry &entry : index_.find(id->lower)) {
    if (!index_.answersTo(entry.library, library->lower))
      continue;
    loadLibraryFile(entry);
    Module &found = module(std::string(entry.library));
    if (Symbol *symbol = lookupInModule(found, id))
      return symbol;
    if (const auto list = found.lists.find(id); list != found.lists.end())
      return list->second;
  }
  return index_.answersTo(kCamTableLibrary, library->lower) ? declareCamTable(id) : nullptr;
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
  for (const LibraryIndex::Entry &entry : index_.find(name.id->lower)) { // loaded by now
    if (!isSeenUnqualified(entry))
      continue;
    const Module &library = module(std::string(entry.library));
    if (const auto found = library.lists.find(name.id); found != library.lists.end())
      return found->second;
  }
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
    if (!isSeenUnqualified(entry))
      continue;
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

struct Word {
  std::string_view theirs;
  std::string_view ours;
};

/// What a type of another language is called here.
std::string_view typeOfOtherLanguages(std::string_view lower) {
  static constexpr Word kTypes[] = {
      {"float", "REAL"},
      {"double", "LREAL"},
      {"single", "REAL"},
      {"boolean", "BOOL"},
      {"integer", "INT"},
      {"short", "INT"},
      {"long", "DINT"},
      {"unsigned", "UDINT"},
      {"int8", "SINT"},
      {"int16", "INT"},
      {"int32", "DINT"},
      {"int64", "LINT"},
      {"uint8", "USINT"},
      {"uint16", "UINT"},
      {"uint32", "UDINT"},
      {"uint64", "ULINT"},
      {"int8_t", "SINT"},
      {"int16_t", "INT"},
      {"int32_t", "DINT"},
      {"int64_t", "LINT"},
      {"uint8_t", "USINT"},
      {"uint16_t", "UINT"},
      {"uint32_t", "UDINT"},
      {"uint64_t", "ULINT"},
      {"float32", "REAL"},
      {"float64", "LREAL"},
      {"size_t", "UDINT"},
      {"str", "STRING"},
      {"qword", "LWORD"},
      {"timer", "TON"},
      {"counter", "CTU"},
      {"datetime", "DT"},
      {"void", "a FUNCTION without a result has no type behind its name"}};
  const auto at = std::find_if(std::begin(kTypes), std::end(kTypes),
                               [&](const Word &word) { return word.theirs == lower; });
  return at == std::end(kTypes) ? std::string_view() : at->ours;
}

/// What to write for a word of another language.
std::string_view wordOfOtherLanguages(std::string_view lower) {
  static constexpr Word kWords[] = {
      {"break", "leave a loop with EXIT; a branch of CASE ends by itself"},
      {"null", "0"},
      {"nullptr", "0"},
      {"nil", "0"},
      {"default", "the last branch of a CASE begins with ELSE, without a colon"},
      {"otherwise", "the last branch of a CASE begins with ELSE, without a colon"},
      {"switch", "choose by a value with CASE … OF … END_CASE"},
      {"pass", "a statement that does nothing is a `;`"},
      {"this", "THIS stands in methods and function blocks only"},
      {"self", "THIS"},
      {"printf", "nothing is printed from a program: write into a variable and watch it"},
      {"print", "nothing is printed from a program: write into a variable and watch it"},
      {"strlen", "LEN"},
      {"strcat", "CONCAT"},
      {"fabs", "ABS"},
      {"pow", "EXPT"},
      {"fmod", "SMC_fmod"},
      {"ceil", "write `TRUNC(x)` and add 1 where x is larger"},
      {"begin", "statements follow the last END_VAR directly"},
      {"end", "each block is closed by its own word: END_IF, END_FOR, END_WHILE, END_CASE"}};
  const auto at = std::find_if(std::begin(kWords), std::end(kWords),
                               [&](const Word &word) { return word.theirs == lower; });
  return at == std::end(kWords) ? std::string_view() : at->ours;
}

} // namespace

/// An enumerator of the expected type that must not be called by its plain name.
bool Checker::reportUnqualified(const Name &name, const Type *expected) {
  if (expected == nullptr || expected->kind != TypeKind::enumeration)
    return false;
  const EnumeratorSymbol *e = findEnumerator(typeAs<EnumType>(expected), name.id);
  if (e == nullptr)
    return false;
  const std::string full = typeName(expected) + "." + std::string(name.text);
  auto &d = report(Code::unknownName, name.span,
                   "`" + std::string(name.text) + "` needs the name of its type in front",
                   "`" + typeName(expected) + "` is `qualified_only`");
  noteDeclaration(d, e);
  d.suggest("write `" + full + "`", name.span, full);
  return true;
}

/// Empty also when there have been so many mistakes in so large a program that looking for what was
/// meant would take longer than the check.
std::string_view Checker::similarName(const Name &name, bool asType) {
  constexpr std::size_t kMostLooks = 2'000'000;
  if (namesLookedAt_ >= kMostLooks)
    return {};
  const std::vector<std::string_view> names = visibleNames(asType);
  namesLookedAt_ += names.size();
  return nearest(name.text, names);
}

void Checker::reportUnknown(const Name &name, bool asType) {
  if (!asType) {
    if (!unknown_.emplace(scope_.pou, name.id).second)
      return; // one missing declaration is one mistake
    if (!keepsErrors())
      return; // nobody would see what is found out for it
    if (reportSelf(name))
      return;
  }
  auto &d =
      asType ? report(Code::unknownType, name.span,
                      "cannot find type `" + std::string(name.text) + "`", "no type of this name")
             : report(Code::unknownName, name.span, "cannot find `" + std::string(name.text) + "`",
                      "not declared in this scope");
  if (looksLikeCamTable(name.id->lower)) {
    const CamTableName table = readCamTable(name.id->lower);
    if (!table.problem.empty())
      d.note(table.problem);
    if (table.problem.empty())
      d.help("it is in the library `" + std::string(kCamTableLibrary) + "`");
    else if (!table.help.empty())
      d.help(table.help);
    return;
  }
  for (const LibraryIndex::Entry &entry : index_.find(name.id->lower)) {
    if (!entry.qualifiedOnly)
      continue;
    const std::string library(entry.library);
    d.help("the library `" + library + "` has one: write `" + library + "." +
           std::string(name.text) + "`");
    return;
  }
  if (helpElsewhere(d, name, asType))
    return;
  const std::string_view similar = similarName(name, asType);
  if (!similar.empty())
    d.suggest("a similar name exists: `" + std::string(similar) + "`", name.span,
              std::string(similar));
  else if (!asType)
    d.help("declare it in a VAR section of this POU or in a VAR_GLOBAL list");
}

bool Checker::helpElsewhere(Diagnostic &d, const Name &name, bool asType) {
  const std::string text(name.text);
  if (const std::string_view meant =
          asType ? typeOfOtherLanguages(name.id->lower) : wordOfOtherLanguages(name.id->lower);
      !meant.empty()) {
    const bool plain = meant.find(' ') == std::string_view::npos;
    const std::string help =
        plain ? "in Structured Text this is `" + std::string(meant) + "`" : std::string(meant);
    if (plain)
      d.suggest(help, name.span, std::string(meant));
    else
      d.help(help);
    return true;
  }
  if (asType)
    return false;
  // A member of something that is in scope, a variable of a program, a list that must be named.
  std::vector<std::string> places;
  const auto found = [&](std::string place) {
    if (std::find(places.begin(), places.end(), place) == places.end())
      places.push_back(std::move(place));
  };
  if (scope_.pou != nullptr) {
    for (VarSymbol *v : scope_.pou->variables) {
      if (v->type == nullptr || v->hidden)
        continue;
      if (v->type->kind != TypeKind::structure && !isInstance(v->type))
        continue;
      const VarSymbol *member = findMember(v->type, name.id);
      const bool open = member != nullptr && !member->hidden && !member->isResult &&
                        (member->owner == nullptr || member->section == Section::input ||
                         member->section == Section::output);
      if (open)
        found(std::string(v->name.text) + "." + std::string(member->name.text));
    }
  }
  for (const PouSymbol *pou : scope_.module->library->pous) {
    if (pou == scope_.pou || pou->decl->kind != DeclKind::program)
      continue;
    for (const VarDecl *v : pou->decl->variables) {
      if (v->name.id == name.id && v->section != Section::temp)
        found(std::string(pou->name.text) + "." + std::string(v->name.text));
    }
  }
  for (const GlobalsSymbol *list : scope_.module->library->globals) {
    const auto it = list->scope.find(name.id);
    if (it != list->scope.end())
      found(std::string(list->name.text) + "." + std::string(it->second->name.text));
  }
  for (const TypeSymbol *symbol : scope_.module->library->types) {
    const Type *type = symbol->type;
    if (type != nullptr && type->kind == TypeKind::enumeration &&
        typeAs<EnumType>(type)->qualifiedOnly && findEnumerator(typeAs<EnumType>(type), name.id))
      found(typeName(type) + "." + std::string(name.text));
  }
  constexpr std::size_t kMost = 3;
  if (places.empty() || places.size() > kMost)
    return false;
  if (places.size() == 1) {
    d.suggest("did you mean `" + places[0] + "`?", name.span, places[0]);
    return true;
  }
  std::string list;
  for (const std::string &place : places)
    list += (list.empty() ? "`" : ", `") + place + "`";
  d.help("did you mean one of these: " + list + "?");
  return true;
}

void Checker::helpMembers(Diagnostic &d, const Name &name,
                          const std::vector<std::string_view> &members) {
  constexpr std::size_t kFew = 8;
  if (const std::string_view similar = nearest(name.text, members); !similar.empty()) {
    d.suggest("a similar one exists: `" + std::string(similar) + "`", name.span,
              std::string(similar));
  } else if (!members.empty() && members.size() <= kFew) {
    std::string list;
    for (const std::string_view member : members)
      list += (list.empty() ? "`" : ", `") + std::string(member) + "`";
    d.help("there is " + list);
  }
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
