#pragma once
// What one check of a program knows while it runs, and the few operations that all parts of the
// checker need. The checks themselves are free functions, by topic in the folders beside.

#include "compiler/semantics/program.hpp"
#include "compiler/semantics/storage.hpp"
#include "compiler/semantics/type_table.hpp"

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace stc::sema {

/// The names of one library or of the project.
struct Module {
  Library *library = nullptr;
  /// POUs, types, variables of lists that need no qualification
  std::unordered_map<Ident, Symbol *> names;
  std::unordered_map<Ident, GlobalsSymbol *> lists;
  std::unordered_map<Ident, std::vector<EnumeratorSymbol *>> enumerators;
  std::unordered_map<Ident, NamespaceSymbol *> spaces; ///< outermost namespaces
  std::vector<TypeSymbol *> declaredTypes;             ///< in the order of the text
  std::unordered_set<std::string> loadedFiles;
};

/// Where names are looked up.
struct Scope {
  Module *module = nullptr;
  PouSymbol *pou = nullptr;
  const ast::Decl *home = nullptr; ///< whose NAMESPACE and USING hold; null: the POU's
};

/// The state of one check.
struct Context {
  Context(Program &checked, const LibraryIndex &libraries);
  Context(const Context &) = delete;
  Context &operator=(const Context &) = delete;

  /// Reports, unless so much has been reported that nobody reads it.
  Diagnostic &report(Code code, Span where, std::string message, std::string label = {});
  /// What is reported is kept. Who has to work for a message asks first.
  [[nodiscard]] bool keepsErrors() const { return program.diagnostics.errorCount() < errorLimit; }
  /// Lives as long as the program.
  const ConstValue *makeConstant(const ConstValue &value) { return arena.make<ConstValue>(value); }

  Program &program;
  Arena &arena;
  const LibraryIndex &index;
  TypeTable types;
  Storage storage;
  const char *stackEnd; ///< of the thread that checks

  // Names
  /// By library name; the project is "".
  std::unordered_map<std::string, std::unique_ptr<Module>> modules;
  std::unordered_map<Ident, BuiltinSymbol *> builtins;
  std::unordered_map<Ident, const Type *> elementary;
  /// Results of lookupInLibraries, also the misses.
  std::unordered_map<Ident, Symbol *> libraryMisses;
  std::unordered_set<const Library *> wholeLibraries; ///< all of their files are loaded
  Scope scope;

  // What has been reported, or is remembered to be reported
  std::size_t errorLimit;                ///< so many errors are kept
  Diagnostic notKept;                    ///< takes the others
  std::size_t namesLookedAt = 0;         ///< for names that are similar to unknown ones
  std::set<std::uint64_t> reportedNames; ///< places of USING and INTERNAL names
  std::set<std::pair<const PouSymbol *, Ident>> unknown;
  std::set<std::pair<const PouSymbol *, Ident>> throughSelf; ///< members named `THIS^.x`

  // CONFIGURATION
  std::vector<ast::GlobalsDecl *> configs;  ///< VAR_CONFIG
  std::vector<ast::GlobalsDecl *> accesses; ///< VAR_ACCESS
  std::unordered_set<Ident> resourceNames;  ///< of CONFIGURATIONs and RESOURCEs
  std::unordered_map<const Type *, bool> hasSlots;

  // Modes, set by a ScopeGuard or ModeGuard
  unsigned loopDepth = 0;                  ///< of loops around the statement that is checked
  bool programTypes = false;               ///< the type being resolved may be a PROGRAM
  const ast::Expr *assignTarget = nullptr; ///< is checked as the target of an assignment
  const ast::TypeExpr *openArrayAllowed = nullptr; ///< the type of the VAR_IN_OUT being resolved
};

/// Gives a mode of the context another value for the lifetime of the guard.
template <class Mode> class ModeGuard {
public:
  ModeGuard(Mode &mode, Mode value) : mode_(mode), saved_(std::exchange(mode, value)) {}
  ~ModeGuard() { mode_ = saved_; }
  ModeGuard(const ModeGuard &) = delete;
  ModeGuard &operator=(const ModeGuard &) = delete;

private:
  Mode &mode_;
  Mode saved_;
};

/// Sets the scope for the lifetime of the guard.
class ScopeGuard : ModeGuard<Scope> {
public:
  ScopeGuard(Context &c, Scope scope) : ModeGuard(c.scope, scope) {}
};

/// Reports a name that is reached through so many declarations that the stack ends.
bool isTooDeep(Context &c, const ast::Name &name);

} // namespace stc::sema
