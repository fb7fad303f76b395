#ifndef STRIDE_COMPILER_SEMANTICS_LINT_LINT_HPP
#define STRIDE_COMPILER_SEMANTICS_LINT_LINT_HPP
// What is allowed but probably not meant: looked for in programs without errors, after checking.
// Internal to compiler/semantics.

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/program.hpp"

#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace stc {

class Linter {
public:
  explicit Linter(Program &program) : program_(program) {}

  /// Looks through all POUs of the library (or the project).
  void run(Library &library);

private:
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

  // lint.cpp: bodies, uses of variables
  void walk(ast::PouDecl *decl, ast::PouDecl *owner, PouSymbol *pou);
  void declarations(std::span<ast::VarDecl *const> variables);
  void typeExpr(ast::TypeExpr *type);
  void construct(std::span<ast::Argument> arguments);
  void initial(ast::Expr *init);
  void usePath(const StatePath &path, const VarSymbol *end);
  void read(ast::Expr *expr);
  void readBinary(ast::BinaryExpr *expr);
  void write(ast::Expr *target);
  void takeAddress(ast::Expr *expr);
  void call(ast::CallExpr *expr);
  void use(VarSymbol *variable, uint8_t bits, const ast::Expr *where);
  [[nodiscard]] bool isOwnLocal(const VarSymbol *variable) const;

  // unused.cpp: what is said about variables and POUs when all uses are known
  void reportVariables(const Body &body);
  void reportVariable(const Body &body, VarSymbol *variable);
  void reportUnused(const Body &body, VarSymbol *variable);
  void reportResults(const Body &body);
  void reportUnusedPous(const Library &library);
  void markUsed(const Type *type);

  // recursion.cpp
  void reportRecursion();
  void reportIgnored();
  [[nodiscard]] bool isPure(const PouSymbol *pou);

  // flow.cpp: statements; the result says whether what follows can run
  bool block(ast::Block statements);
  bool statement(ast::Stmt *stmt);
  bool ifStatement(ast::IfStmt *stmt);
  bool whileLoop(ast::WhileStmt *stmt);
  bool repeatLoop(ast::RepeatStmt *stmt);
  void forLoop(ast::ForStmt *stmt);
  bool caseStatement(ast::CaseStmt *stmt);
  /// `before` and `after` are the condition, which runs once a round.
  bool loopBody(ast::Block body, Loop &loop, ast::Expr *before, ast::Expr *after);
  void unchangingCondition(const ast::Expr *condition, const Loop &loop, Span where);
  bool variablesOf(const ast::Expr *expr, std::vector<const VarSymbol *> &out) const;
  void leave();

  // suspicious_statements.cpp
  void assignment(ast::AssignStmt *stmt);
  void dangling(const ast::AssignStmt *stmt);
  void missingCases(const ast::CaseStmt *stmt);
  void unreachableCases(const ast::CaseStmt *stmt);
  void ifChain(const ast::IfStmt *stmt);

  // suspicious_expressions.cpp
  void comparison(const ast::BinaryExpr *expr);
  void sameOperands(const ast::BinaryExpr *expr);
  void shift(const ast::CallExpr *expr);
  void saturation(const ast::CallExpr *expr);
  void conversion(const ast::Expr *expr);

  Diagnostic &report(Code code, Span where, std::string message, std::string label = {}) {
    return program_.diagnostics.report(code, where, std::move(message), std::move(label));
  }
  [[nodiscard]] std::string text(Span span) const;

  Program &program_;
  std::vector<Body> bodies_;
  size_t current_ = 0; ///< index in bodies_ of the body that is walked
  std::unordered_set<const ast::PouDecl *> walked_;
  std::unordered_set<const ast::PouDecl *> resultsWritten_;
  std::unordered_set<const PouSymbol *> usedPous_;
  std::unordered_set<const VarSymbol *> usedOutside_; ///< by VAR_CONFIG and VAR_ACCESS
  std::unordered_set<Ident> resultsTaken_; ///< names of methods whose result somebody takes
  std::unordered_set<const Type *> usedTypes_;
  std::unordered_map<const ast::PouDecl *, size_t> bodyOf_;
  std::vector<const ast::CallExpr *> ignored_; ///< calls of functions whose result nobody takes
  std::unordered_map<const ast::PouDecl *, bool> purity_;
  unsigned purityCalls_ = 0; ///< isPure() within isPure()
  struct CallCount {
    unsigned all = 0;
    unsigned asStatement = 0;
  };
  std::unordered_map<const ast::PouDecl *, CallCount> functionCalls_;
  std::vector<ast::BinaryExpr *> chain_;

  // While a body is walked.
  const ast::Expr *statementCall_ = nullptr; ///< the call that is a statement of its own
  std::vector<Loop *> loops_;
  std::vector<const ast::ForStmt *> fors_;
  uint32_t writes_ = 0;    ///< counts writes, so that "since" can be asked
  uint32_t loopStart_ = 0; ///< identifies the outermost loop; 0 outside of loops
  uint32_t loopCount_ = 0;
  unsigned conditional_ = 0; ///< depth of what need not run
  bool mayHaveLeft_ = false; ///< a RETURN stands before
};

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

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_LINT_LINT_HPP
