// Files become symbols; those of libraries are pulled in on demand.

#include "compiler/semantics/attributes.hpp"
#include "compiler/semantics/cam_tables.hpp"
#include "compiler/semantics/lookup/lookup.hpp"
#include "compiler/syntax/parser.hpp"

#include <cctype>
#include <filesystem>
#include <utility>

namespace stc {

using namespace ast;

namespace {

constexpr uint32_t kVarGlobal = 10; // letters

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

VarSymbol *makeVariable(Arena &arena, VarDecl *decl, Module &module, PouSymbol *owner) {
  auto *symbol = arena.make<VarSymbol>();
  symbol->kind = SymbolKind::Variable;
  symbol->name = decl->name;
  symbol->library = module.library;
  symbol->decl = decl;
  symbol->section = decl->section;
  symbol->owner = owner;
  symbol->isConstant = (decl->qualifiers & kQualConstant) != 0;
  symbol->hidden = hasAttribute(decl->attributes, AttributeId::Hide);
  decl->symbol = symbol;
  return symbol;
}

Module &Lookup::module(std::string_view library) {
  auto &slot = modules_[std::string(library)];
  if (!slot) {
    slot = std::make_unique<Module>();
    auto made = std::make_unique<Library>();
    made->name = library;
    made->isUser = library.empty();
    slot->library = made.get();
    if (library.empty())
      program_.user = made.get();
    program_.libraries.push_back(std::move(made));
  }
  return *slot;
}

Module *Lookup::findModule(std::string_view library) const {
  const auto it = modules_.find(std::string(library));
  return it == modules_.end() ? nullptr : it->second.get();
}

Module &Lookup::moduleOf(const Symbol *symbol) const { return *modules_.at(symbol->library->name); }

void Lookup::load(const LibraryIndex::Entry &entry) {
  Module &target = module(entry.library);
  if (!target.loadedFiles.insert(std::string(entry.fileName)).second)
    return;
  const FileId id = program_.sources.add(std::string(entry.fileName), std::string(entry.text));
  declare(target,
          parse(program_.sources.file(id), program_.interner, arena_, program_.diagnostics));
  if (loaded_)
    loaded_(target);
}

void Lookup::loadAll(std::string_view library) {
  if (std::exchange(module(library).isWhole, true))
    return;
  for (const LibraryIndex::Entry &entry : index_.files(library))
    load(entry);
}

Symbol *Lookup::declareCamTable(Ident id) {
  if (!looksLikeCamTable(id->lower))
    return nullptr;
  const CamTableName table = readCamTable(id->lower);
  if (!table.problem.empty())
    return nullptr;
  const std::string library(kCamTableLibrary);
  const std::string file = "<stdlib>/" + library + "/" + table.name + ".st";
  load({library, file, camTableDeclaration(table)});
  Symbol *symbol = module(library).find(id);
  static_cast<TypeSymbol *>(symbol)->onDemand = true;
  return symbol;
}

void Lookup::addName(Module &module, Symbol *symbol) {
  auto &names = symbol->space == nullptr ? module.names : symbol->space->names;
  const auto [it, inserted] = names.emplace(symbol->name.id, symbol);
  if (inserted)
    return;
  auto &d = reporter_.report(Code::DuplicateName, symbol->name.span,
                             "the name `" + std::string(symbol->name.text) + "` is declared twice",
                             "declared again here");
  d.label(it->second->name.span, "first declared here");
  d.help("rename one of them, or move the variable into a list with {attribute 'qualified_only'}");
}

NamespaceSymbol *Lookup::makeSpace(Module &module, NamespaceSymbol *around, const Name &name) {
  NamespaceSymbol &made = program_.spaceStorage.emplace_back();
  made.kind = SymbolKind::Space;
  made.name = name;
  made.library = module.library;
  made.space = around;
  made.path = (around == nullptr ? "" : around->path + ".") + std::string(name.text);
  return &made;
}

/// The namespace of that path, made when it is new; null for an empty path.
NamespaceSymbol *Lookup::declareSpace(Module &module, NamePath path) {
  NamespaceSymbol *space = nullptr;
  for (const Name &name : path) {
    Symbol *found = nullptr;
    if (space == nullptr) {
      const auto it = module.spaces.find(name.id);
      found = it == module.spaces.end() ? nullptr : it->second;
    } else if (const auto it = space->names.find(name.id); it != space->names.end()) {
      found = it->second;
    }
    if (found != nullptr && found->kind == SymbolKind::Space) {
      space = static_cast<NamespaceSymbol *>(found);
      continue;
    }
    NamespaceSymbol *made = makeSpace(module, space, name);
    if (space == nullptr)
      module.spaces.emplace(name.id, made);
    else if (!space->names.emplace(name.id, made).second)
      reporter_
          .report(Code::DuplicateName, name.span,
                  "the name `" + std::string(name.text) + "` is declared twice",
                  "declared again here")
          .label(found->name.span, "first declared here");
    space = made;
  }
  return space;
}

void Lookup::declarePou(Module &module, PouDecl *decl) {
  PouSymbol &pou = program_.pouStorage.emplace_back();
  pou.kind = SymbolKind::Pou;
  pou.name = decl->name;
  pou.library = module.library;
  pou.decl = decl;
  pou.space = declareSpace(module, decl->space);
  if (decl->kind != DeclKind::Function) {
    const TypeKind kind = decl->kind == DeclKind::Program     ? TypeKind::Program
                          : decl->kind == DeclKind::Interface ? TypeKind::Interface
                                                              : TypeKind::FunctionBlock;
    pou.type = arena_.make<PouType>(Type{kind}, &pou, packMode(reporter_, decl->attributes, 0));
  }
  module.library->pous.push_back(&pou);
  addName(module, &pou);
}

void Lookup::declareType(Module &module, Decl *decl) {
  TypeSymbol &type = program_.typeStorage.emplace_back();
  type.kind = SymbolKind::Type;
  type.name = decl->name;
  type.library = module.library;
  type.decl = decl;
  type.space = declareSpace(module, decl->space);
  module.declaredTypes.push_back(&type);
  addName(module, &type);
}

void Lookup::declare(Module &module, File *file) {
  for (Decl *decl : file->declarations) {
    switch (decl->kind) {
    case DeclKind::Program:
    case DeclKind::Function:
    case DeclKind::FunctionBlock:
    case DeclKind::Class:
    case DeclKind::Interface:
      declarePou(module, as<PouDecl>(decl));
      break;
    case DeclKind::Structure:
    case DeclKind::Enumeration:
    case DeclKind::Alias:
      declareType(module, decl);
      break;
    case DeclKind::Globals:
      if (!decl->space.empty())
        reporter_
            .report(Code::SectionNotAllowed,
                    {decl->span.file, decl->span.begin, decl->span.begin + kVarGlobal},
                    "VAR_GLOBAL cannot stand in a NAMESPACE",
                    "global variables belong to no namespace")
            .help("move it out of the NAMESPACE");
      declareGlobals(module, as<GlobalsDecl>(decl));
      break;
    case DeclKind::Config:
      configuration_.configs.push_back(as<GlobalsDecl>(decl));
      break;
    case DeclKind::Access:
      configuration_.accesses.push_back(as<GlobalsDecl>(decl));
      break;
    case DeclKind::Configuration:
      configuration_.resourceNames.insert(decl->name.id);
      for (const ResourceDecl &resource : as<ConfigurationDecl>(decl)->resources)
        configuration_.resourceNames.insert(resource.name.id);
      break;
    case DeclKind::Method: // they stand in their blocks
    case DeclKind::Action:
    case DeclKind::Property:
      break;
    }
  }
}

void Lookup::declareGlobals(Module &module, GlobalsDecl *decl) {
  Name name = decl->name;
  if (!name) {
    const std::string stem = listName(program_.sources.file(decl->span.file).name());
    name.id = program_.interner.intern(stem);
    name.text = arena_.copy(std::string_view(stem));
    name.span = {decl->span.file, decl->span.begin, decl->span.begin};
  }
  GlobalsSymbol *&list = module.lists[name.id];
  if (list == nullptr) {
    list = &program_.globalsStorage.emplace_back();
    list->kind = SymbolKind::Globals;
    list->name = name;
    list->library = module.library;
    module.library->globals.push_back(list);
  }
  setParameters(module, list->name, decl);
  const bool qualifiedOnly = hasAttribute(decl->attributes, AttributeId::QualifiedOnly);
  for (VarDecl *v : decl->variables) {
    VarSymbol *symbol = makeVariable(arena_, v, module, nullptr);
    symbol->globals = list;
    symbol->home = decl;
    if (!list->scope.emplace(v->name.id, symbol).second) {
      auto &d = reporter_.report(Code::DuplicateName, v->name.span,
                                 "the name `" + std::string(v->name.text) + "` is declared twice",
                                 "declared again here");
      d.label(list->scope.at(v->name.id)->name.span, "first declared here");
      continue;
    }
    list->variables.push_back(symbol);
    if (!qualifiedOnly)
      addName(module, symbol);
  }
}

} // namespace stc
