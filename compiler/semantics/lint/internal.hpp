#ifndef STRIDE_COMPILER_SEMANTICS_LINT_INTERNAL_HPP
#define STRIDE_COMPILER_SEMANTICS_LINT_INTERNAL_HPP
// What the sources of this folder have in common: what is known while bodies are walked, and who
// says what about it.

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/lint/lint.hpp"
#include "compiler/semantics/program.hpp"

#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace stc::lint {

/// A body: of a POU, method, action, property accessor.
struct Body {
  ast::PouDecl *decl = nullptr;
  ast::PouDecl *owner = nullptr; ///< the block or program of a method; else decl
  PouSymbol *pou = nullptr;      ///< of `owner`
  bool sideEffects = false;      ///< writes something that is not its own
  bool hasLabels = false;        ///< JMP: the order of the text says little
  bool recursesAlways = false;
  std::vector<const ast::CallExpr *> calls; ///< of functions, one for each callee
};
struct Loop {
  bool exits = false; ///< EXIT, RETURN or JMP inside of it
  bool continues = false;
  uint32_t writesBefore = 0;
  bool calls = false; ///< something that may change what is not local
};

/// How often a function is called.
struct CallCount {
  unsigned all = 0;
  unsigned asStatement = 0;
};

/// A loop whose condition nothing in its body changes.
struct StillCondition {
  const ast::Expr *condition = nullptr;
  Span loop;         ///< its first word
  std::string names; ///< `a`, `b`
  std::vector<const VarSymbol *> variables;
};

/// A VAR_IN_OUT of an instance that nothing in its POU has called before.
struct EarlyInOut {
  const ast::MemberExpr *member = nullptr;
  const VarSymbol *variable = nullptr;
  const VarSymbol *instance = nullptr;
};

/// What one thread has found in the bodies of a POU.
struct Findings {
  std::optional<Diagnostics> reports;
  // What others may do to the variables decides.
  std::vector<StillCondition> conditions;
  std::vector<EarlyInOut> inOuts;
  std::vector<const ast::CallExpr *> ignored; ///< calls of functions whose result nobody takes
};

/// The state of one look through a library (or the project); of several threads each has one, which
/// have their bodies in common.
struct Context {
  Program &program;
  std::vector<Body> &bodies;
  size_t current = 0;        ///< index in bodies of the body that is walked
  Findings *found = nullptr; ///< of its POU
  std::unordered_set<const ast::PouDecl *> resultsWritten;
  std::unordered_set<const PouSymbol *> usedPous;
  std::unordered_set<const VarSymbol *> usedOutside; ///< by VAR_CONFIG and VAR_ACCESS
  std::unordered_set<Ident> resultsTaken; ///< names of methods whose result somebody takes
  std::unordered_set<const Type *> usedTypes;
  std::unordered_map<const ast::PouDecl *, size_t> bodyOf;
  std::unordered_map<const ast::PouDecl *, bool> purity;
  unsigned purityCalls = 0; ///< isPure() within isPure()
  std::unordered_map<const ast::PouDecl *, CallCount> functionCalls;
  std::vector<ast::BinaryExpr *> chain;

  // While a body is walked.
  const ast::Expr *statementCall = nullptr; ///< the call that is a statement of its own
  std::vector<Loop *> loops;
  std::vector<const ast::ForStmt *> fors;
  uint32_t writes = 0;    ///< counts writes, so that "since" can be asked
  uint32_t loopStart = 0; ///< identifies the outermost loop; 0 outside of loops
  uint32_t loopCount = 0;
  unsigned conditional = 0; ///< depth of what need not run
  bool mayHaveLeft = false; ///< a RETURN stands before

  Context(Program &of, std::vector<Body> &all) : program(of), bodies(all) {}
  Context(const Context &) = delete;
  Context &operator=(const Context &) = delete;
};

inline Diagnostic &report(Context &c, Code code, Span where, std::string message,
                          std::string label = {}) {
  if (c.found == nullptr)
    return c.program.diagnostics.report(code, where, std::move(message), std::move(label));
  if (!c.found->reports)
    c.found->reports = c.program.diagnostics.part();
  return c.found->reports->report(code, where, std::move(message), std::move(label));
}
/// The text of a short place; else `…`.
[[nodiscard]] std::string text(const Context &c, Span span);

// lint.cpp: bodies, uses of variables
/// One of c.bodies.
void walk(Context &c, size_t index);
/// Constants are used by bounds and lengths, too.
void typeExpr(Context &c, ast::TypeExpr *type);
void initial(Context &c, ast::Expr *init);
/// Notes bits of Use.
void markUse(const Context &c, VarSymbol *variable, uint8_t bits);
/// Bits of Use of a variable of a POU, when all bodies have been walked.
[[nodiscard]] inline unsigned usesOf(const VarSymbol *variable) {
  return unsigned{variable->uses} | variable->usesElsewhere;
}
void read(Context &c, ast::Expr *expr);
void write(Context &c, ast::Expr *target);
void takeAddress(Context &c, ast::Expr *expr);
[[nodiscard]] bool isOwnLocal(const Context &c, const VarSymbol *variable);

// unused.cpp: what is said about variables and POUs when all uses are known
void reportVariables(Context &c, const Body &body);
void reportResults(Context &c, const Body &body);
void reportUnusedPous(Context &c, const Library &library);
void markUsed(Context &c, const Type *type);

// recursion.cpp
void reportRecursion(Context &c);
/// Of calls whose result nobody takes.
void reportIgnored(Context &c, const std::vector<const ast::CallExpr *> &ignored);

// flow.cpp: statements; the result says whether what follows can run
bool block(Context &c, ast::Block statements);

// axes.cpp
void reportAxes(Context &c, const Library &library);

// suspicious_statements.cpp
void assignment(Context &c, ast::AssignStmt *stmt);
void missingCases(Context &c, const ast::CaseStmt *stmt);
void unreachableCases(Context &c, const ast::CaseStmt *stmt);
void ifChain(Context &c, const ast::IfStmt *stmt);

// suspicious_expressions.cpp
void comparison(Context &c, const ast::BinaryExpr *expr);
void sameOperands(Context &c, const ast::BinaryExpr *expr);
void shift(Context &c, const ast::CallExpr *expr);
void saturation(Context &c, const ast::CallExpr *expr);
void conversion(Context &c, const ast::Expr *expr);

/// `a.b[i]` and `A.b[i]`: the same value whenever both are read with nothing between. Calls are
/// never the same.
[[nodiscard]] bool sameExpr(const ast::Expr *a, const ast::Expr *b);
[[nodiscard]] bool sameBlock(ast::Block a, ast::Block b);
/// Only literals: not the value of a constant that somebody may change.
[[nodiscard]] bool isLiteral(const ast::Expr *expr);
/// The variable in which a variable lies (`a` of `a.b[3]`), or null (`p^.x`, calls).
[[nodiscard]] VarSymbol *rootVariable(const ast::Expr *expr);

/// The values that an integer expression can have.
struct ValueRange {
  int64_t low;
  int64_t high;
};
[[nodiscard]] std::optional<ValueRange> valueRange(const ast::Expr *expr);

} // namespace stc::lint

#endif // STRIDE_COMPILER_SEMANTICS_LINT_INTERNAL_HPP
