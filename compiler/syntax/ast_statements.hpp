#pragma once
// Statements.

#include "compiler/syntax/ast_expressions.hpp"

namespace stc::ast {

enum class StmtKind : std::uint8_t {
  empty,
  assign,
  call,
  ifS,
  caseS,
  forS,
  whileS,
  repeatS,
  exit,
  continueS,
  returnS,
  jump,
  label,
  tryS,
};

struct Stmt {
  StmtKind kind = StmtKind::empty;
  Span span;
};
using Block = std::span<Stmt *>;

enum class AssignOp : std::uint8_t { assign, set, reset, reference };

/// `a := b`, `a := b := c`, `a S= b`, `a R= b`, `a REF= b`
struct AssignStmt : Node<Stmt, StmtKind::assign> {
  AssignOp op = AssignOp::assign;
  Span opSpan;
  std::span<Expr *> targets; ///< from left to right; the value goes to the last first
  Expr *value = nullptr;
};

/// A call as a statement. `expr` is a CallExpr (sema reports anything else).
struct CallStmt : Node<Stmt, StmtKind::call> {
  Expr *expr = nullptr;
};

struct IfBranch {
  Expr *condition = nullptr;
  Block body;
};

struct IfStmt : Node<Stmt, StmtKind::ifS> {
  std::span<IfBranch> branches; ///< IF, then each ELSIF
  bool hasElse = false;
  Block elseBody;
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

struct CaseStmt : Node<Stmt, StmtKind::caseS> {
  Expr *selector = nullptr;
  std::span<CaseBranch> branches;
  bool hasElse = false;
  Block elseBody;
};

struct ForStmt : Node<Stmt, StmtKind::forS> {
  Expr *variable = nullptr;
  Expr *from = nullptr;
  Expr *to = nullptr;
  Expr *by = nullptr; ///< null: 1
  Block body;
};

struct WhileStmt : Node<Stmt, StmtKind::whileS> {
  Expr *condition = nullptr;
  Block body;
};

struct RepeatStmt : Node<Stmt, StmtKind::repeatS> {
  Block body;
  Expr *until = nullptr;
};

/// `JMP name;`
struct JumpStmt : Node<Stmt, StmtKind::jump> {
  Name label;
  struct LabelStmt *target = nullptr; ///< [sema]
};

/// `name:` in front of a statement.
struct LabelStmt : Node<Stmt, StmtKind::label> {
  Name label;
  bool used = false; ///< [sema] some JMP leads here
};

/// `__TRY … __CATCH (exc) … __FINALLY … __ENDTRY`
struct TryStmt : Node<Stmt, StmtKind::tryS> {
  Block body;
  bool hasCatch = false;
  Expr *exception = nullptr; ///< the variable in parentheses; null: none
  Block catchBody;
  bool hasFinally = false;
  Block finallyBody;
};

} // namespace stc::ast
