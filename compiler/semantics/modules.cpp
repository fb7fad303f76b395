// Modules: files become symbols, libraries are pulled in on demand.

#include "compiler/semantics/checker.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/lint.hpp"
#include "compiler/source/stack.hpp"
#include "compiler/syntax/parser.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace stc {

using namespace ast;

namespace {

/// How many are shown is up to the command; this only bounds what is kept.
constexpr std::size_t kMaxErrors = 1000;
constexpr std::uint32_t kVarGlobal = 10; // letters

} // namespace

std::vector<VarSymbol *> PouSymbol::parameters() const {
  std::vector<VarSymbol *> list;
  if (base != nullptr)
    list = base->parameters();
  for (VarSymbol *v : variables) {
    if (v->section == Section::input || v->section == Section::output ||
        v->section == Section::inOut)
      list.push_back(v);
  }
  return list;
}

Checker::Checker(Program &program, const LibraryIndex &index)
    : program_(program), errorLimit_(program.diagnostics.errorCount() + kMaxErrors),
      arena_(program.arena), index_(index), types_(program.arena), stackEnd_(endOfStack()) {
  for (const auto &[name, function] : builtins()) {
    const Ident id = program.interner.intern(name);
    auto *symbol = arena_.make<BuiltinSymbol>();
    symbol->kind = SymbolKind::builtin;
    symbol->name = {id, id->lower, {}};
    symbol->id = function;
    builtins_.emplace(id, symbol);
  }
}

Checker::Module &Checker::module(const std::string &name) {
  auto &slot = modules_[name];
  if (!slot) {
    slot = std::make_unique<Module>();
    auto library = std::make_unique<Library>();
    library->name = name;
    library->isUser = name.empty();
    slot->library = library.get();
    if (name.empty())
      program_.user = library.get();
    program_.libraries.push_back(std::move(library));
  }
  return *slot;
}

Checker::Module &Checker::moduleOf(const Symbol *symbol) {
  return *modules_.at(symbol->library->name);
}

void Checker::loadLibraryFile(const LibraryIndex::Entry &entry) {
  Module &target = module(std::string(entry.library));
  if (!target.loadedFiles.insert(std::string(entry.fileName)).second)
    return;
  const FileId id = program_.sources.add(std::string(entry.fileName), std::string(entry.text));
  declareFile(target,
              parse(program_.sources.file(id), program_.interner, arena_, program_.diagnostics));
  resolveEnumerations(target);
}

void Checker::addName(Module &module, Symbol *symbol) {
  auto &names = symbol->space == nullptr ? module.names : symbol->space->names;
  const auto [it, inserted] = names.emplace(symbol->name.id, symbol);
  if (inserted)
    return;
  auto &d = report(Code::duplicateName, symbol->name.span,
                   "the name `" + std::string(symbol->name.text) + "` is declared twice",
                   "declared again here");
  d.label(it->second->name.span, "first declared here");
  d.help("rename one of them, or move the variable into a list with {attribute 'qualified_only'}");
}

void Checker::declareFile(Module &module, File *file) {
  Library *library = module.library;
  for (Decl *decl : file->declarations) {
    switch (decl->kind) {
    case DeclKind::program:
    case DeclKind::function:
    case DeclKind::functionBlock:
    case DeclKind::classD:
    case DeclKind::interface: {
      PouSymbol &pou = program_.pouStorage.emplace_back();
      pou.kind = SymbolKind::pou;
      pou.name = decl->name;
      pou.library = library;
      pou.decl = as<PouDecl>(decl);
      pou.space = declareSpace(module, decl->space);
      if (decl->kind != DeclKind::function) {
        const TypeKind kind = decl->kind == DeclKind::program     ? TypeKind::program
                              : decl->kind == DeclKind::interface ? TypeKind::interface
                                                                  : TypeKind::functionBlock;
        pou.type = arena_.make<PouType>(Type{kind}, &pou, packMode(decl->attributes, 0));
      }
      library->pous.push_back(&pou);
      addName(module, &pou);
      break;
    }
    case DeclKind::structure:
    case DeclKind::enumeration:
    case DeclKind::alias: {
      TypeSymbol &type = program_.typeStorage.emplace_back();
      type.kind = SymbolKind::type;
      type.name = decl->name;
      type.library = library;
      type.decl = decl;
      type.space = declareSpace(module, decl->space);
      module.declaredTypes.push_back(&type);
      addName(module, &type);
      break;
    }
    case DeclKind::globals:
      if (!decl->space.empty())
        report(Code::sectionNotAllowed,
               {decl->span.file, decl->span.begin, decl->span.begin + kVarGlobal},
               "VAR_GLOBAL cannot stand in a NAMESPACE", "global variables belong to no namespace")
            .help("move it out of the NAMESPACE");
      declareGlobals(module, as<GlobalsDecl>(decl));
      break;
    case DeclKind::config:
      configs_.push_back(as<GlobalsDecl>(decl));
      break;
    case DeclKind::access:
      accesses_.push_back(as<GlobalsDecl>(decl));
      break;
    case DeclKind::configuration:
      resourceNames_.insert(decl->name.id);
      for (const ResourceDecl &resource : as<ConfigurationDecl>(decl)->resources)
        resourceNames_.insert(resource.name.id);
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

void Checker::declareGlobals(Module &module, GlobalsDecl *decl) {
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
    list->kind = SymbolKind::globals;
    list->name = name;
    list->library = module.library;
    module.library->globals.push_back(list);
  }
  bool qualifiedOnly = false;
  for (const Attribute &a : decl->attributes)
    qualifiedOnly = qualifiedOnly || a.name == "qualified_only";
  for (VarDecl *v : decl->variables) {
    VarSymbol *symbol = makeVariable(v, module, nullptr);
    symbol->globals = list;
    symbol->home = decl;
    if (!list->scope.emplace(v->name.id, symbol).second) {
      auto &d = report(Code::duplicateName, v->name.span,
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

void Checker::resolveEnumerations(Module &module) {
  for (std::size_t i = 0; i < module.declaredTypes.size(); ++i) {
    if (module.declaredTypes[i]->decl->kind == DeclKind::enumeration)
      resolve(module.declaredTypes[i]);
  }
}

void Checker::checkModule(Module &module) {
  Library *library = module.library;
  const auto byIndex = [](auto &list, auto &&action) {
    for (std::size_t i = 0; i < list.size(); ++i) // the list may grow meanwhile
      action(list[i]);
  };
  resolveInstances(module);
  // Enumerators are visible without their type's name, so they come first.
  resolveEnumerations(module);
  byIndex(module.declaredTypes, [&](TypeSymbol *t) {
    const ScopeGuard guard(*this, {&module, nullptr, t->decl});
    resolve(t);
  });
  byIndex(library->pous, [&](PouSymbol *p) { link(p); });
  byIndex(library->globals, [&](GlobalsSymbol *g) { declare(g); });
  byIndex(library->pous, [&](PouSymbol *p) { declare(p); });
  byIndex(library->pous, [&](PouSymbol *p) { checkClass(p); });
  checkContainment(module);
  for (const TypeSymbol *t : library->types) {
    if (t->type->kind == TypeKind::structure && typeAs<StructType>(t->type)->isUnion &&
        t->decl->kind == DeclKind::structure)
      checkUnion(typeAs<StructType>(t->type));
  }
  for (TypeSymbol *t : std::vector<TypeSymbol *>(library->types)) {
    const ScopeGuard guard(*this, {&module, nullptr, t->decl});
    if (t->type->kind == TypeKind::structure && t->decl->kind == DeclKind::structure) {
      for (VarSymbol *field : typeAs<StructType>(t->type)->fields)
        checkInitOf(field);
    } else if (t->init != nullptr && t->decl->kind == DeclKind::alias) {
      t->init = checkInit(t->init, t->type);
    }
  }
  byIndex(library->globals, [&](GlobalsSymbol *g) {
    for (VarSymbol *v : g->variables)
      checkInitOf(v);
  });
  byIndex(library->pous, [&](PouSymbol *p) { checkBody(p); });
}

void Checker::checkUser(const std::vector<File *> &files) {
  Module &user = module("");
  for (File *file : files)
    declareFile(user, file);
  {
    const ScopeGuard guard(*this, {&user, nullptr});
    for (const File *file : files)
      for (const Decl *decl : file->declarations)
        checkUsings(decl);
  }
  checkModule(user);
  findImplicitChecks(user);
  declareUsed();
  checkConfigured(user);
  for (const File *file : files) {
    for (const Decl *decl : file->declarations)
      checkConsistent(decl);
  }
  finishImage();
  lint(user);
}

void Checker::lint(Module &module) {
  if (program_.diagnostics.hasErrors())
    return;
  checkShadowing(module);
  checkHiddenLibrary(module);
  Linter(program_).run(*module.library);
}

void Checker::declareUsed() {
  // Declarations and bodies pull in what they use, so that the lists grow meanwhile.
  const auto count = [this] {
    std::size_t total = program_.libraries.size();
    for (const auto &library : program_.libraries)
      total += library->pous.size() + library->types.size() + library->globals.size();
    return total;
  };
  for (std::size_t before = 0; before != count();) {
    before = count();
    for (std::size_t l = 0; l < program_.libraries.size(); ++l) {
      Library *library = program_.libraries[l].get();
      for (std::size_t i = 0; i < library->pous.size(); ++i)
        declare(library->pous[i]);
      for (std::size_t i = 0; i < library->globals.size(); ++i)
        declare(library->globals[i]);
      for (std::size_t i = 0; i < library->types.size(); ++i) {
        TypeSymbol *t = library->types[i];
        if (t->onDemand) { // the application holds its code
          const ScopeGuard guard(*this, {&moduleOf(t), nullptr, t->decl});
          for (VarSymbol *field : typeAs<StructType>(t->type)->fields)
            checkInitOf(field);
        }
        const bool alias = t->decl != nullptr && t->decl->kind == DeclKind::alias;
        if (!alias || t->init == nullptr || t->init->type != nullptr)
          continue;
        const ScopeGuard guard(*this, {&moduleOf(t), nullptr});
        t->init = checkInit(t->init, t->type); // the default of the user's variables, too
      }
      // The library's own code has been compiled; what it uses must be in the application.
      for (std::size_t i = 0; i < library->pous.size(); ++i) {
        if (!library->pous[i]->decl->external)
          checkBody(library->pous[i]);
      }
      // Which blocks extend a library's block or implement its interface must be known in full.
      if (!library->isUser && !wholeLibraries_.contains(library) &&
          std::any_of(library->pous.begin(), library->pous.end(), [](const PouSymbol *p) {
            return p->isInterface() || (p->isBlock() && hasTypeId(p));
          })) {
        wholeLibraries_.insert(library);
        for (const LibraryIndex::Entry &entry : index_.files(library->name))
          loadLibraryFile(entry);
      }
    }
  }
}

void Checker::checkLibrary(std::string_view name) {
  Module &target = module(std::string(name));
  for (const LibraryIndex::Entry &entry : index_.files(name))
    loadLibraryFile(entry);
  checkModule(target);
  declareUsed();
  lint(target);
}

void check(Program &program, const std::vector<File *> &files, const LibraryIndex &index) {
  program.files = files;
  Checker(program, index).checkUser(files);
}

void checkLibrary(Program &program, std::string_view library, const LibraryIndex &index) {
  Checker(program, index).checkLibrary(library);
}

} // namespace stc
