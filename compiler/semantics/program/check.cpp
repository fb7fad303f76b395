// A whole program: what is checked in which order.

#include "compiler/semantics/classes/classes.hpp"
#include "compiler/semantics/config/config.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/lint/lint.hpp"
#include "compiler/semantics/lint/shadowing.hpp"
#include "compiler/semantics/names/names.hpp"
#include "compiler/semantics/program.hpp"
#include "compiler/semantics/program/own_checks.hpp"
#include "compiler/semantics/statements/statements.hpp"
#include "compiler/semantics/types/resolve.hpp"

#include <algorithm>
#include <utility>

namespace stc::sema {

using namespace ast;

static void lintModule(Context &c, Module &module);
static void declareUsed(Context &c);

template <class List, class Action> static void byIndex(List &list, Action &&action) {
  for (size_t i = 0; i < list.size(); ++i) // the list may grow meanwhile
    action(list[i]);
}

static void checkModule(Context &c, Module &module) {
  Library *library = module.library;
  resolveInstances(c, module);
  // Enumerators are visible without their type's name, so they come first.
  resolveEnumerations(c, module);
  byIndex(module.declaredTypes, [&](TypeSymbol *t) {
    const ScopeGuard guard(c, {&module, nullptr, t->decl});
    resolve(c, t);
  });
  byIndex(library->pous, [&](PouSymbol *p) { link(c, p); });
  byIndex(library->globals, [&](GlobalsSymbol *g) { declare(c, g); });
  byIndex(library->pous, [&](PouSymbol *p) { declare(c, p); });
  byIndex(library->pous, [&](PouSymbol *p) { checkClass(c, p); });
  checkContainment(c, module);
  for (const TypeSymbol *t : library->types) {
    if (t->type->kind == TypeKind::Structure && typeAs<StructType>(t->type)->isUnion &&
        t->decl->kind == DeclKind::Structure)
      checkUnion(c, typeAs<StructType>(t->type));
  }
  for (TypeSymbol *t : std::vector<TypeSymbol *>(library->types)) {
    const ScopeGuard guard(c, {&module, nullptr, t->decl});
    if (t->type->kind == TypeKind::Structure && t->decl->kind == DeclKind::Structure) {
      for (VarSymbol *field : typeAs<StructType>(t->type)->fields)
        checkInitOf(c, field);
    } else if (t->init != nullptr && t->decl->kind == DeclKind::Alias) {
      t->init = checkInit(c, t->init, t->type);
    }
  }
  byIndex(library->globals, [&](GlobalsSymbol *g) {
    for (VarSymbol *v : g->variables)
      checkInitOf(c, v);
  });
  byIndex(library->pous, [&](PouSymbol *p) { checkBody(c, p); });
}

static void checkUsingsOf(Context &c, Module &module, const std::vector<File *> &files) {
  const ScopeGuard guard(c, {&module, nullptr});
  for (const File *file : files)
    for (const Decl *decl : file->declarations)
      checkUsings(c, decl);
}

/// What is compiled with the application: libraries of the user's own, and those of Stride whose
/// parameters the project sets.
static void checkBuiltLibraries(Context &c) {
  c.names.declareOwnLibraries();
  for (const ParameterValue &parameter : c.program.parameters) {
    Library *library = c.names.module(parameter.library).library;
    if (std::exchange(library->isBuilt, true))
      continue;
    c.names.loadAll(library->name);
    checkModule(c, c.names.module(library->name));
  }
  c.names.reportUnknownParameters();
  for (const LibrarySource &source : c.program.librarySources) {
    Module &module = c.names.module(source.name);
    checkUsingsOf(c, module, source.files);
    checkModule(c, module);
  }
}

static void checkUser(Context &c, const std::vector<File *> &files) {
  checkBuiltLibraries(c);
  Module &user = c.names.module("");
  for (File *file : files)
    c.names.declare(user, file);
  checkUsingsOf(c, user, files);
  checkModule(c, user);
  findImplicitChecks(c, user);
  declareUsed(c);
  checkConfigured(c, user);
  for (const File *file : files) {
    for (const Decl *decl : file->declarations)
      checkConsistent(c, decl);
  }
  finishImage(c);
  lintModule(c, user);
}

/// Looks for what is probably not meant; only in programs without errors.
static void lintModule(Context &c, Module &module) {
  if (c.program.diagnostics.hasErrors())
    return;
  checkShadowing(c, module);
  checkHiddenLibrary(c, module);
  lint::run(c.program, *module.library);
}

/// Initial values of what a library's types are made with.
static void checkDefaults(Context &c, TypeSymbol *t) {
  if (t->onDemand) { // the application holds its code
    const ScopeGuard guard(c, {&c.names.moduleOf(t), nullptr, t->decl});
    for (VarSymbol *field : typeAs<StructType>(t->type)->fields)
      checkInitOf(c, field);
  }
  const bool alias = t->decl != nullptr && t->decl->kind == DeclKind::Alias;
  if (!alias || t->init == nullptr || t->init->type != nullptr)
    return;
  const ScopeGuard guard(c, {&c.names.moduleOf(t), nullptr});
  t->init = checkInit(c, t->init, t->type); // the default of the user's variables, too
}

/// Blocks of it are extended or implement interfaces: which ones must be known in full.
static bool isHierarchyUsed(const Library &library) {
  return std::any_of(library.pous.begin(), library.pous.end(), [](const PouSymbol *p) {
    return p->isInterface() || (p->isBlock() && hasTypeId(p));
  });
}

static void declareUsed(Context &c, Library &library) {
  byIndex(library.pous, [&](PouSymbol *p) { declare(c, p); });
  byIndex(library.globals, [&](GlobalsSymbol *g) { declare(c, g); });
  byIndex(library.types, [&](TypeSymbol *t) { checkDefaults(c, t); });
  // The library's own code has been compiled; what it uses must be in the application.
  byIndex(library.pous, [&](PouSymbol *p) {
    if (!p->decl->external)
      checkBody(c, p);
  });
  if (!library.isUser && isHierarchyUsed(library))
    c.names.loadAll(library.name);
}

/// Declares the blocks and lists read from libraries: an instance that nobody calls has members
/// and defaults too. That pulls in what they use, so that the lists grow meanwhile.
static void declareUsed(Context &c) {
  const auto count = [&c] {
    size_t total = c.program.libraries.size();
    for (const auto &library : c.program.libraries)
      total += library->pous.size() + library->types.size() + library->globals.size();
    return total;
  };
  for (size_t before = 0; before != count();) {
    before = count();
    for (size_t l = 0; l < c.program.libraries.size(); ++l)
      declareUsed(c, *c.program.libraries[l]);
  }
}

static void checkWholeLibrary(Context &c, std::string_view name) {
  Module &target = c.names.module(name);
  c.names.loadAll(name);
  checkModule(c, target);
  declareUsed(c);
  lintModule(c, target);
}

} // namespace stc::sema

namespace stc {

namespace {

/// Lets the check resolve enumerations of the files that are read while it runs.
class LoadGuard {
public:
  explicit LoadGuard(sema::Context &c) : names_(c.names) {
    names_.onLoad([&c](Module &module) { sema::resolveEnumerations(c, module); });
  }
  ~LoadGuard() { names_.onLoad({}); }
  LoadGuard(const LoadGuard &) = delete;
  LoadGuard &operator=(const LoadGuard &) = delete;

private:
  Lookup &names_;
};

} // namespace

void check(Program &program, Lookup &names, const std::vector<ast::File *> &files) {
  program.files = files;
  sema::Context context(program, names);
  const LoadGuard guard(context);
  sema::checkUser(context, files);
}

void check(Program &program, const std::vector<ast::File *> &files, const LibraryIndex &index) {
  Lookup names(program, index);
  check(program, names, files);
}

void checkLibrary(Program &program, std::string_view library, const LibraryIndex &index) {
  Lookup names(program, index);
  sema::Context context(program, names);
  const LoadGuard guard(context);
  sema::checkWholeLibrary(context, library);
}

} // namespace stc
