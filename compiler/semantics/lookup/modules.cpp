// Modules: files become symbols, libraries are pulled in on demand.

#include "compiler/semantics/lookup/names.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/lookup/internal.hpp"
#include "compiler/semantics/types/resolve.hpp"
#include "compiler/syntax/parser.hpp"

#include <cctype>
#include <filesystem>

namespace stc::sema {

using namespace ast;

static void declareGlobals(Context &c, Module &module, GlobalsDecl *decl);

namespace {

constexpr std::uint32_t kVarGlobal = 10; // letters

} // namespace

Module &moduleNamed(Context &c, const std::string &name) {
  auto &slot = c.modules[name];
  if (!slot) {
    slot = std::make_unique<Module>();
    auto library = std::make_unique<Library>();
    library->name = name;
    library->isUser = name.empty();
    slot->library = library.get();
    if (name.empty())
      c.program.user = library.get();
    c.program.libraries.push_back(std::move(library));
  }
  return *slot;
}

Module &moduleOf(Context &c, const Symbol *symbol) { return *c.modules.at(symbol->library->name); }

void loadLibraryFile(Context &c, const LibraryIndex::Entry &entry) {
  Module &target = moduleNamed(c, std::string(entry.library));
  if (!target.loadedFiles.insert(std::string(entry.fileName)).second)
    return;
  const FileId id = c.program.sources.add(std::string(entry.fileName), std::string(entry.text));
  declareFile(
      c, target,
      parse(c.program.sources.file(id), c.program.interner, c.arena, c.program.diagnostics));
  resolveEnumerations(c, target);
}

static void addName(Context &c, Module &module, Symbol *symbol) {
  auto &names = symbol->space == nullptr ? module.names : symbol->space->names;
  const auto [it, inserted] = names.emplace(symbol->name.id, symbol);
  if (inserted)
    return;
  auto &d = c.report(Code::duplicateName, symbol->name.span,
                     "the name `" + std::string(symbol->name.text) + "` is declared twice",
                     "declared again here");
  d.label(it->second->name.span, "first declared here");
  d.help("rename one of them, or move the variable into a list with {attribute 'qualified_only'}");
}

void declareFile(Context &c, Module &module, File *file) {
  Library *library = module.library;
  for (Decl *decl : file->declarations) {
    switch (decl->kind) {
    case DeclKind::program:
    case DeclKind::function:
    case DeclKind::functionBlock:
    case DeclKind::classD:
    case DeclKind::interface: {
      PouSymbol &pou = c.program.pouStorage.emplace_back();
      pou.kind = SymbolKind::pou;
      pou.name = decl->name;
      pou.library = library;
      pou.decl = as<PouDecl>(decl);
      pou.space = declareSpace(c, module, decl->space);
      if (decl->kind != DeclKind::function) {
        const TypeKind kind = decl->kind == DeclKind::program     ? TypeKind::program
                              : decl->kind == DeclKind::interface ? TypeKind::interface
                                                                  : TypeKind::functionBlock;
        pou.type = c.arena.make<PouType>(Type{kind}, &pou, packMode(c, decl->attributes, 0));
      }
      library->pous.push_back(&pou);
      addName(c, module, &pou);
      break;
    }
    case DeclKind::structure:
    case DeclKind::enumeration:
    case DeclKind::alias: {
      TypeSymbol &type = c.program.typeStorage.emplace_back();
      type.kind = SymbolKind::type;
      type.name = decl->name;
      type.library = library;
      type.decl = decl;
      type.space = declareSpace(c, module, decl->space);
      module.declaredTypes.push_back(&type);
      addName(c, module, &type);
      break;
    }
    case DeclKind::globals:
      if (!decl->space.empty())
        c.report(Code::sectionNotAllowed,
                 {decl->span.file, decl->span.begin, decl->span.begin + kVarGlobal},
                 "VAR_GLOBAL cannot stand in a NAMESPACE",
                 "global variables belong to no namespace")
            .help("move it out of the NAMESPACE");
      declareGlobals(c, module, as<GlobalsDecl>(decl));
      break;
    case DeclKind::config:
      c.configs.push_back(as<GlobalsDecl>(decl));
      break;
    case DeclKind::access:
      c.accesses.push_back(as<GlobalsDecl>(decl));
      break;
    case DeclKind::configuration:
      c.resourceNames.insert(decl->name.id);
      for (const ResourceDecl &resource : as<ConfigurationDecl>(decl)->resources)
        c.resourceNames.insert(resource.name.id);
      break;
    case DeclKind::method: // they stand in their blocks
    case DeclKind::action:
    case DeclKind::property:
      break;
    }
  }
}

namespace {

/// The name of a list of globals: the file's without suffix, made an identifier.
std::string listName(const std::string &fileName) {
  std::string name;
  for (const char c : std::filesystem::path(fileName).stem().string()) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      name += c;
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  while (!name.empty() && name.back() == '_')
    name.pop_back();
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0)
    name.insert(0, "GVL_");
  return name;
}

} // namespace

static void declareGlobals(Context &c, Module &module, GlobalsDecl *decl) {
  Name name = decl->name;
  if (!name) {
    const std::string stem = listName(c.program.sources.file(decl->span.file).name());
    name.id = c.program.interner.intern(stem);
    name.text = c.arena.copy(std::string_view(stem));
    name.span = {decl->span.file, decl->span.begin, decl->span.begin};
  }
  GlobalsSymbol *&list = module.lists[name.id];
  if (list == nullptr) {
    list = &c.program.globalsStorage.emplace_back();
    list->kind = SymbolKind::globals;
    list->name = name;
    list->library = module.library;
    module.library->globals.push_back(list);
  }
  bool qualifiedOnly = false;
  for (const Attribute &a : decl->attributes)
    qualifiedOnly = qualifiedOnly || a.name == "qualified_only";
  for (VarDecl *v : decl->variables) {
    VarSymbol *symbol = makeVariable(c, v, module, nullptr);
    symbol->globals = list;
    symbol->home = decl;
    if (!list->scope.emplace(v->name.id, symbol).second) {
      auto &d = c.report(Code::duplicateName, v->name.span,
                         "the name `" + std::string(v->name.text) + "` is declared twice",
                         "declared again here");
      d.label(list->scope.at(v->name.id)->name.span, "first declared here");
      continue;
    }
    list->variables.push_back(symbol);
    if (!qualifiedOnly)
      addName(c, module, symbol);
  }
}

void resolveEnumerations(Context &c, Module &module) {
  for (std::size_t i = 0; i < module.declaredTypes.size(); ++i) {
    if (module.declaredTypes[i]->decl->kind == DeclKind::enumeration)
      resolve(c, module.declaredTypes[i]);
  }
}

} // namespace stc::sema
