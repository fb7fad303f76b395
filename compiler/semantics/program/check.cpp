// A whole program: what is checked in which order.

#include "compiler/semantics/classes/classes.hpp"
#include "compiler/semantics/config/config.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/lint/lint.hpp"
#include "compiler/semantics/lint/shadowing.hpp"
#include "compiler/semantics/lookup/names.hpp"
#include "compiler/semantics/program.hpp"
#include "compiler/semantics/program/own_checks.hpp"
#include "compiler/semantics/statements/statements.hpp"
#include "compiler/semantics/types/resolve.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;

static void lintModule(Context &c, Module &module);
static void declareUsed(Context &c);

static void checkModule(Context &c, Module &module) {
  Library *library = module.library;
  const auto byIndex = [](auto &list, auto &&action) {
    for (std::size_t i = 0; i < list.size(); ++i) // the list may grow meanwhile
      action(list[i]);
  };
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
    if (t->type->kind == TypeKind::structure && typeAs<StructType>(t->type)->isUnion &&
        t->decl->kind == DeclKind::structure)
      checkUnion(c, typeAs<StructType>(t->type));
  }
  for (TypeSymbol *t : std::vector<TypeSymbol *>(library->types)) {
    const ScopeGuard guard(c, {&module, nullptr, t->decl});
    if (t->type->kind == TypeKind::structure && t->decl->kind == DeclKind::structure) {
      for (VarSymbol *field : typeAs<StructType>(t->type)->fields)
        checkInitOf(c, field);
    } else if (t->init != nullptr && t->decl->kind == DeclKind::alias) {
      t->init = checkInit(c, t->init, t->type);
    }
  }
  byIndex(library->globals, [&](GlobalsSymbol *g) {
    for (VarSymbol *v : g->variables)
      checkInitOf(c, v);
  });
  byIndex(library->pous, [&](PouSymbol *p) { checkBody(c, p); });
}

static void checkUser(Context &c, const std::vector<File *> &files) {
  Module &user = moduleNamed(c, "");
  for (File *file : files)
    declareFile(c, user, file);
  {
    const ScopeGuard guard(c, {&user, nullptr});
    for (const File *file : files)
      for (const Decl *decl : file->declarations)
        checkUsings(c, decl);
  }
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
  Linter(c.program).run(*module.library);
}

/// Declares the blocks and lists read from libraries: an instance that nobody calls has members
/// and defaults too.
static void declareUsed(Context &c) {
  // Declarations and bodies pull in what they use, so that the lists grow meanwhile.
  const auto count = [&c] {
    std::size_t total = c.program.libraries.size();
    for (const auto &library : c.program.libraries)
      total += library->pous.size() + library->types.size() + library->globals.size();
    return total;
  };
  for (std::size_t before = 0; before != count();) {
    before = count();
    for (std::size_t l = 0; l < c.program.libraries.size(); ++l) {
      Library *library = c.program.libraries[l].get();
      for (std::size_t i = 0; i < library->pous.size(); ++i)
        declare(c, library->pous[i]);
      for (std::size_t i = 0; i < library->globals.size(); ++i)
        declare(c, library->globals[i]);
      for (std::size_t i = 0; i < library->types.size(); ++i) {
        TypeSymbol *t = library->types[i];
        if (t->onDemand) { // the application holds its code
          const ScopeGuard guard(c, {&moduleOf(c, t), nullptr, t->decl});
          for (VarSymbol *field : typeAs<StructType>(t->type)->fields)
            checkInitOf(c, field);
        }
        const bool alias = t->decl != nullptr && t->decl->kind == DeclKind::alias;
        if (!alias || t->init == nullptr || t->init->type != nullptr)
          continue;
        const ScopeGuard guard(c, {&moduleOf(c, t), nullptr});
        t->init = checkInit(c, t->init, t->type); // the default of the user's variables, too
      }
      // The library's own code has been compiled; what it uses must be in the application.
      for (std::size_t i = 0; i < library->pous.size(); ++i) {
        if (!library->pous[i]->decl->external)
          checkBody(c, library->pous[i]);
      }
      // Which blocks extend a library's block or implement its interface must be known in full.
      if (!library->isUser && !c.wholeLibraries.contains(library) &&
          std::any_of(library->pous.begin(), library->pous.end(), [](const PouSymbol *p) {
            return p->isInterface() || (p->isBlock() && hasTypeId(p));
          })) {
        c.wholeLibraries.insert(library);
        for (const LibraryIndex::Entry &entry : c.index.files(library->name))
          loadLibraryFile(c, entry);
      }
    }
  }
}

static void checkWholeLibrary(Context &c, std::string_view name) {
  Module &target = moduleNamed(c, std::string(name));
  for (const LibraryIndex::Entry &entry : c.index.files(name))
    loadLibraryFile(c, entry);
  checkModule(c, target);
  declareUsed(c);
  lintModule(c, target);
}

} // namespace stc::sema

namespace stc {

void check(Program &program, const std::vector<ast::File *> &files, const LibraryIndex &index) {
  program.files = files;
  sema::Context context(program, index);
  sema::checkUser(context, files);
}

void checkLibrary(Program &program, std::string_view library, const LibraryIndex &index) {
  sema::Context context(program, index);
  sema::checkWholeLibrary(context, library);
}

} // namespace stc
