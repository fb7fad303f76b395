#ifndef STRIDE_COMPILER_SEMANTICS_CONTEXT_CONTEXT_HPP
#define STRIDE_COMPILER_SEMANTICS_CONTEXT_CONTEXT_HPP
// What one check of a program knows while it runs, and the few operations that all parts of the
// checker need. The checks themselves are free functions, by topic in the folders beside.

#include "compiler/semantics/lookup/lookup.hpp"
#include "compiler/semantics/storage.hpp"
#include "compiler/semantics/type_table.hpp"

#include <set>
#include <string>
#include <unordered_map>
#include <utility>

namespace stc::sema {

/// What has been reported about names, so that one mistake is reported once.
struct Reported {
  std::set<uint64_t> names; ///< places of USING and INTERNAL names
  std::set<std::pair<const PouSymbol *, Ident>> unknown;
  std::set<std::pair<FileId, Ident>> spaces; ///< unknown libraries and namespaces, by file
  std::set<std::pair<FileId, Ident>> types;  ///< unknown types, by file
  size_t namesLookedAt = 0;                  ///< for names that are similar to unknown ones
};

/// The state of one check.
struct Context {
  Context(Program &checked, Lookup &lookup);
  Context(const Context &) = delete;
  Context &operator=(const Context &) = delete;

  Diagnostic &report(Code code, Span where, std::string message, std::string label = {}) {
    return reporter.report(code, where, std::move(message), std::move(label));
  }
  /// Lives as long as the program.
  const ConstValue *makeConstant(const ConstValue &value) { return arena.make<ConstValue>(value); }

  Program &program;
  Arena &arena;
  Lookup &names;
  Reporter &reporter;
  TypeTable types;
  Storage storage;
  const char *stackEnd; ///< of the thread that checks
  Scope scope;

  std::unordered_map<Ident, const Type *> elementary; ///< by name; null: the name is none of them
  std::unordered_map<const Type *, bool> hasSlots;    ///< config/slots.cpp
  Reported reported;
  std::set<std::pair<const PouSymbol *, Ident>> throughSelf; ///< members named `THIS^.x`

  // Modes, set by a ScopeGuard or ModeGuard
  unsigned loopDepth = 0; ///< of loops around the statement that is checked
  bool inputsOptional =
      false;                 ///< of the call to be checked next: it has EN and names its arguments
  bool programTypes = false; ///< the type being resolved may be a PROGRAM
  const ast::Expr *assignTarget = nullptr;         ///< is checked as the target of an assignment
  const ast::TypeExpr *openArrayAllowed = nullptr; ///< the type of the VAR_IN_OUT being resolved
  const Type *inOutOf = nullptr; ///< the type of the VAR_IN_OUT that the name being checked is for
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

#endif // STRIDE_COMPILER_SEMANTICS_CONTEXT_CONTEXT_HPP
