// What is said about a name that nothing has.

#include "compiler/semantics/names/names.hpp"

#include "compiler/semantics/cam_tables.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/plain_data.hpp"
#include "compiler/semantics/type_table.hpp"
#include "compiler/source/suggest.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;

static bool helpElsewhere(Context &c, Diagnostic &d, const Name &name, bool asType);

/// THIS or SUPER where there is none; true when it was one of them.
static bool reportSelf(Context &c, const Name &name) {
  const bool isSuper = name.id->lower == "super";
  if (!isSuper && name.id->lower != "this")
    return false;
  const PouSymbol *block = c.scope.pou == nullptr ? nullptr : blockOf(c.scope.pou);
  if (isSuper && block != nullptr && block->isBlock()) {
    auto &d =
        c.report(Code::NoSelf, name.span,
                 "there is no SUPER: `" + std::string(block->name.text) + "` extends no block",
                 "no base block");
    noteDeclaration(d, block);
    d.help("write `FUNCTION_BLOCK " + std::string(block->name.text) + " EXTENDS …`");
  } else {
    c.report(Code::NoSelf, name.span,
             std::string(isSuper ? "SUPER" : "THIS") +
                 " is only possible inside of a function block",
             "there is no instance here");
  }
  return true;
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
      {"void", "a FUNCTION without a result has no type after its name"}};
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

bool reportUnqualified(Context &c, const Name &name, const Type *expected) {
  if (expected == nullptr || expected->kind != TypeKind::Enumeration)
    return false;
  const EnumeratorSymbol *e = findEnumerator(typeAs<EnumType>(expected), name.id);
  if (e == nullptr)
    return false;
  const std::string full = typeName(expected) + "." + std::string(name.text);
  auto &d = c.report(Code::UnknownName, name.span,
                     "`" + std::string(name.text) + "` needs the name of its type in front",
                     "`" + typeName(expected) + "` is `qualified_only`");
  noteDeclaration(d, e);
  d.suggest("write `" + full + "`", name.span, full);
  return true;
}

std::vector<std::string_view> memberNames(const Type *type) {
  std::vector<std::string_view> list;
  for (const Symbol *member : Lookup::members(type))
    list.push_back(member->name.text);
  return list;
}

/// Whether a symbol can be what a wrong name meant.
static bool canBeMeant(const Symbol *symbol, Sought sought) {
  if (symbol->kind == SymbolKind::Variable && static_cast<const VarSymbol *>(symbol)->hidden)
    return false;
  const auto *pou =
      symbol->kind == SymbolKind::Pou ? static_cast<const PouSymbol *>(symbol) : nullptr;
  const bool isFunction = symbol->kind == SymbolKind::Builtin ||
                          (pou != nullptr && (pou->isFunction() || pou->isMethod()));
  if (sought == Sought::Type)
    return symbol->kind == SymbolKind::Type || (pou != nullptr && !isFunction);
  const bool isPrefix = // of longer names, which are not what was written
      symbol->kind == SymbolKind::Globals ||
      ((symbol->kind == SymbolKind::Space || symbol->kind == SymbolKind::Enumerator) &&
       (symbol->space == nullptr) == (symbol->kind == SymbolKind::Space));
  return symbol->kind != SymbolKind::Type && !isPrefix && (sought == Sought::Callee || !isFunction);
}

static bool canBeMeant(const LibraryIndex::Name &name, Sought sought) {
  using Kind = LibraryIndex::Kind;
  switch (name.kind) {
  case Kind::Function:
    return sought == Sought::Callee;
  case Kind::Type:
    return sought == Sought::Type;
  default:
    return sought == Sought::Value;
  }
}

/// The names that can be meant by a wrong one.
static std::vector<std::string_view> visibleNames(Context &c, Sought sought) {
  std::vector<std::string_view> list;
  for (const Symbol *symbol : c.names.visible(c.scope)) {
    if (canBeMeant(symbol, sought))
      list.push_back(symbol->name.text);
  }
  if (sought == Sought::Type) {
    for (const char *name : {"BOOL",  "SINT",  "INT",   "DINT", "LINT",   "USINT",  "UINT",
                             "UDINT", "ULINT", "BYTE",  "WORD", "DWORD",  "LWORD",  "REAL",
                             "LREAL", "TIME",  "LTIME", "DATE", "STRING", "WSTRING"})
      list.emplace_back(name);
  }
  for (const UsedLibrary &used : c.scope.module->library->uses) {
    if (used.library->qualifiedOnly)
      continue;
    for (const auto &[id, symbol] : c.names.findModule(used.library->name)->names)
      if (canBeMeant(symbol, sought))
        list.push_back(symbol->name.text);
  }
  std::sort(list.begin(), list.end());
  for (const LibraryIndex::Name &name : c.names.libraryNames()) {
    if (canBeMeant(name, sought))
      list.push_back(name.text);
  }
  return list;
}

/// The only one of the names that begins with the wrong one, `MC_MoveAbsolute` for `MC_MoveAbs`.
static std::string_view onlyLonger(std::string_view start,
                                   const std::vector<std::string_view> &names) {
  constexpr size_t kFewest = 5; // letters that say enough
  std::string_view found;
  for (const std::string_view name : names) {
    if (start.size() < kFewest || name.size() <= start.size() ||
        !equalIgnoringCase(name.substr(0, start.size()), start))
      continue;
    if (!found.empty() && !equalIgnoringCase(found, name))
      return {};
    found = name;
  }
  return found;
}

/// Empty also when there have been so many mistakes in so large a program that looking for what was
/// meant would take longer than the check.
static std::string_view similarName(Context &c, const Name &name, Sought sought) {
  constexpr size_t kMostLooks = 2'000'000;
  if (c.reported.namesLookedAt >= kMostLooks)
    return {};
  std::vector<std::string_view> names = visibleNames(c, sought);
  c.reported.namesLookedAt += names.size();
  std::erase_if(names, [&](std::string_view other) { return equalIgnoringCase(other, name.text); });
  const std::string_view found = nearest(name.text, names);
  return found.empty() ? onlyLonger(name.text, names) : found;
}

/// The library that has the name, which needs the library's before it; empty: none.
static std::string qualifiedOnlyLibrary(Context &c, const Name &name) {
  for (const UsedLibrary &own : c.scope.module->library->uses)
    if (own.library->qualifiedOnly &&
        c.names.findModule(own.library->name)->find(name.id) != nullptr)
      return own.name;
  for (const LibraryIndex::Entry &entry : c.names.index().find(name.id->lower))
    if (entry.qualifiedOnly)
      return std::string(entry.library);
  return {};
}

/// The name of an elementary type, or what begins as the end of a block, where a value is meant.
static bool helpTypesAndEnds(Diagnostic &d, const Name &name, Sought sought) {
  if (findElementaryType(name.id->lower) != nullptr) {
    d.help(sought == Sought::Callee
               ? "a value is converted with `TO_" + stride::common::upperCase(name.text) + "(…)`"
               : "this is a type; variables of it are declared in VAR sections");
    return true;
  }
  if (!name.id->lower.starts_with("end_"))
    return false;
  static const std::vector<std::string_view> kEnds = {
      "END_IF",      "END_FOR",      "END_WHILE",          "END_REPEAT", "END_CASE",    "END_VAR",
      "END_PROGRAM", "END_FUNCTION", "END_FUNCTION_BLOCK", "END_METHOD", "END_PROPERTY"};
  const std::string_view meant = nearest(name.text, kEnds);
  if (meant.empty())
    return false;
  d.suggest("write `" + std::string(meant) + "`", name.span, std::string(meant));
  return true;
}

static std::string helpForAxis(const Name &name, std::string_view type) {
  return std::string(type == "axis_ref"
                         ? "a drive or a virtual axis is declared in stride.toml: "
                           "`[[bus.axis_group.drive]]` or `[[axis]]`"
                         : "an axis group is declared in stride.toml: `[[bus.axis_group]]`") +
         " with `name = \"" + std::string(name.text) + "\"`";
}

void reportUnknown(Context &c, const Name &name, Sought sought) {
  const bool asType = sought == Sought::Type;
  if (asType) { // one missing type is one mistake in a file
    if (!c.reported.types.emplace(name.span.file, name.id).second)
      return;
  } else {
    if (!c.reported.unknown.emplace(c.scope.pou, name.id).second)
      return; // one missing declaration is one mistake
    if (!c.reporter.keepsErrors())
      return; // nobody would see what is found out for it
    if (c.reported.spaces.contains({name.span.file, name.id}) ||
        (c.scope.pou != nullptr && isIncomplete(blockOf(c.scope.pou))))
      return; // it may be in what has been reported
    if (reportSelf(c, name))
      return;
  }
  auto &d =
      asType
          ? c.report(Code::UnknownType, name.span,
                     "cannot find type `" + std::string(name.text) + "`", "no type of this name")
          : c.report(Code::UnknownName, name.span, "cannot find `" + std::string(name.text) + "`",
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
  if (const std::string library = qualifiedOnlyLibrary(c, name); !library.empty()) {
    d.help("the library `" + library + "` has one: write `" + library + "." +
           std::string(name.text) + "`");
    return;
  }
  if (asType && findAnyGroup(name.id->lower) != AnyGroup::None) {
    d.help("ANY and the like are types of inputs (VAR_INPUT) only");
    return;
  }
  if ((!asType && helpTypesAndEnds(d, name, sought)) || helpElsewhere(c, d, name, asType))
    return;
  const std::string_view similar = similarName(c, name, sought);
  if (!similar.empty())
    d.suggest("a similar name exists: `" + std::string(similar) + "`", name.span,
              std::string(similar));
  else if (!asType && isAxisType(c.inOutOf))
    d.help(helpForAxis(name, typeAs<StructType>(c.inOutOf)->symbol->name.id->lower));
  else if (sought == Sought::Callee)
    d.help("write a FUNCTION of this name, or declare an instance of a block with it in a VAR "
           "section");
  else if (!asType)
    d.help("declare it in a VAR section of this POU or in a VAR_GLOBAL list");
}

/// What a word of another language is called here.
static bool helpOtherLanguages(Diagnostic &d, const Name &name, bool asType) {
  const std::string_view meant =
      asType ? typeOfOtherLanguages(name.id->lower) : wordOfOtherLanguages(name.id->lower);
  if (meant.empty())
    return false;
  const std::string word(meant);
  if (meant.find(' ') == std::string_view::npos)
    d.suggest("in Structured Text this is `" + word + "`", name.span, word);
  else
    d.help(word);
  return true;
}

/// What the members of instances and structures in the POU that have the name are called.
static void addMembers(Context &c, const Name &name, std::vector<std::string> &places) {
  if (c.scope.pou == nullptr)
    return;
  for (const VarSymbol *v : c.scope.pou->variables) {
    if (v->type == nullptr || v->hidden)
      continue;
    if (v->type->kind != TypeKind::Structure && !isInstance(v->type))
      continue;
    const VarSymbol *member = findMember(c, v->type, name.id);
    const bool open = member != nullptr && !member->hidden && !member->isResult &&
                      (member->owner == nullptr || member->section == Section::Input ||
                       member->section == Section::Output);
    if (open)
      places.push_back(std::string(v->name.text) + "." + std::string(member->name.text));
  }
}

/// The same of programs' variables, lists of globals and enumerations that must be named.
static void addQualified(const Context &c, const Name &name, std::vector<std::string> &places) {
  const Library &library = *c.scope.module->library;
  for (const PouSymbol *pou : library.pous) {
    if (pou == c.scope.pou || pou->decl->kind != DeclKind::Program)
      continue;
    for (const VarDecl *v : pou->decl->variables) {
      if (v->name.id == name.id && v->section != Section::Temp)
        places.push_back(std::string(pou->name.text) + "." + std::string(v->name.text));
    }
  }
  for (const GlobalsSymbol *list : library.globals) {
    const auto it = list->scope.find(name.id);
    if (it != list->scope.end())
      places.push_back(std::string(list->name.text) + "." + std::string(it->second->name.text));
  }
  for (const TypeSymbol *symbol : library.types) {
    const Type *type = symbol->type;
    if (type != nullptr && type->kind == TypeKind::Enumeration &&
        typeAs<EnumType>(type)->qualifiedOnly && findEnumerator(typeAs<EnumType>(type), name.id))
      places.push_back(typeName(type) + "." + std::string(name.text));
  }
}

/// Says where else the name exists, or what another language's word is called here.
static bool helpElsewhere(Context &c, Diagnostic &d, const Name &name, bool asType) {
  if (helpOtherLanguages(d, name, asType))
    return true;
  if (asType)
    return false;
  std::vector<std::string> all;
  addMembers(c, name, all);
  addQualified(c, name, all);
  std::vector<std::string> places; // each once, in that order
  for (std::string &place : all) {
    if (std::find(places.begin(), places.end(), place) == places.end())
      places.push_back(std::move(place));
  }
  constexpr size_t kMost = 3;
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

void helpMembers(Diagnostic &d, const Name &name, const std::vector<std::string_view> &members) {
  constexpr size_t kFew = 8;
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

} // namespace stc::sema
