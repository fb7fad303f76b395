#ifndef STRIDE_COMPILER_SYNTAX_AST_STATEMENTS_HPP
#define STRIDE_COMPILER_SYNTAX_AST_STATEMENTS_HPP
// Statements.

#include "compiler/syntax/ast_expressions.hpp"

namespace stc::ast {

enum class StmtKind : uint8_t {
  Empty,
  Assign,
  Call,
  If,
  Case,
  For,
  While,
  RepeatS,
  Exit,
  Continue,
  Return,
  Jump,
  Label,
  Try,
};

struct Stmt {
  StmtKind kind = StmtKind::Empty;
  Span span;
};
using Block = std::span<Stmt *>;

enum class AssignOp : uint8_t { Assign, Set, Reset, Reference };

/// `a := b`, `a := b := c`, `a S= b`, `a R= b`, `a REF= b`
struct AssignStmt : Node<Stmt, StmtKind::Assign> {
  AssignOp op = AssignOp::Assign;
  Span opSpan;
  std::span<Expr *> targets; ///< from left to right; the value goes to the last first
  Expr *value = nullptr;
};

/// A call as a statement. `expr` is a CallExpr (sema reports anything else).
struct CallStmt : Node<Stmt, StmtKind::Call> {
  Expr *expr = nullptr;
};

struct IfBranch {
  Expr *condition = nullptr;
  /// `IF a := b THEN` is `a := b; IF a THEN`: the assignment right before; null: there is none.
  const AssignStmt *assigned = nullptr;
  Block body;
};

struct IfStmt : Node<Stmt, StmtKind::If> {
  std::span<IfBranch> branches; ///< IF, then each ELSIF
  bool hasElse = false;
  Block elseBody;
  /// Of a chart's `IF … THEN action(); END_IF`: what stands here when `action` is no action, but a
  /// variable; null: any other IF.
  Stmt *ofVariable = nullptr;
};

/// `1`, `1..5`, `color.green`
struct CaseLabel {
  Expr *low = nullptr;
  Expr *high = nullptr; ///< null: one value
  Span span;
};

struct CaseBranch {
  std::span<CaseLabel> labels;
  Block body;
};

struct CaseStmt : Node<Stmt, StmtKind::Case> {
  Expr *selector = nullptr;
  std::span<CaseBranch> branches;
  bool hasElse = false;
  Block elseBody;
};

struct ForStmt : Node<Stmt, StmtKind::For> {
  Expr *variable = nullptr;
  Expr *from = nullptr;
  Expr *to = nullptr;
  Expr *by = nullptr; ///< null: 1
  Block body;
};

struct WhileStmt : Node<Stmt, StmtKind::While> {
  Expr *condition = nullptr;
  Block body;
};

struct RepeatStmt : Node<Stmt, StmtKind::RepeatS> {
  Block body;
  Expr *until = nullptr;
};

/// `JMP name;`
struct JumpStmt : Node<Stmt, StmtKind::Jump> {
  Name label;
  struct LabelStmt *target = nullptr; ///< [sema]
};

/// `name:` before a statement.
struct LabelStmt : Node<Stmt, StmtKind::Label> {
  Name label;
  bool used = false; ///< [sema] some JMP leads here
};

/// `__TRY … __CATCH (exc) … __FINALLY … __ENDTRY`
struct TryStmt : Node<Stmt, StmtKind::Try> {
  Block body;
  bool hasCatch = false;
  Expr *exception = nullptr; ///< the variable in parentheses; null: none
  Block catchBody;
  bool hasFinally = false;
  Block finallyBody;
};

} // namespace stc::ast

#endif // STRIDE_COMPILER_SYNTAX_AST_STATEMENTS_HPP
