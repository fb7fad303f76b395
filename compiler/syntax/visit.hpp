#ifndef STRIDE_COMPILER_SYNTAX_VISIT_HPP
#define STRIDE_COMPILER_SYNTAX_VISIT_HPP
// The children of a node, and walks over all that is below one. Who needs to know what kind of node
// a child hangs at asks for the kind; who needs only to see everything walks.

#include "compiler/syntax/ast.hpp"

#include <span>
#include <type_traits>
#include <vector>

namespace stc::ast {

namespace detail {

/// What could not be parsed may be missing.
template <class Visit> void visitOne(Expr *expr, Visit &visit) {
  if (expr != nullptr)
    visit(expr);
}

template <class Visit> void visitItems(std::span<const AggregateItem> items, Visit &visit) {
  for (const AggregateItem &item : items) {
    visitOne(item.repeat, visit);
    visitOne(item.value, visit);
    visitItems(std::span<const AggregateItem>(item.values), visit);
  }
}

template <class OnExpr, class OnBlock>
void visitCase(const CaseStmt *stmt, OnExpr &onExpr, OnBlock &onBlock) {
  visitOne(stmt->selector, onExpr);
  for (const CaseBranch &branch : stmt->branches) {
    for (const CaseLabel &label : branch.labels) {
      visitOne(label.low, onExpr);
      visitOne(label.high, onExpr);
    }
    onBlock(branch.body);
  }
  onBlock(stmt->elseBody);
}

/// Calls `visit`, which may say whether to look below the node.
template <class Visit, class Node> bool goesOn(Visit &visit, Node *node) {
  if constexpr (std::is_same_v<std::invoke_result_t<Visit &, Node *>, bool>) {
    return visit(node);
  } else {
    visit(node);
    return true;
  }
}

} // namespace detail

/// Calls `visit(Expr *)` for each expression right below `expr`, from left to right. What a type
/// that is written as an argument contains is not among them.
template <class Visit> void forEachChild(const Expr *expr, Visit &&visit) {
  switch (expr->kind) {
  case ExprKind::Literal:
  case ExprKind::Name:
  case ExprKind::EnumLiteral:
  case ExprKind::Direct:
  case ExprKind::TypeName:
  case ExprKind::Error:
    return;
  case ExprKind::Member:
    return detail::visitOne(as<MemberExpr>(expr)->base, visit);
  case ExprKind::Index:
    detail::visitOne(as<IndexExpr>(expr)->base, visit);
    for (Expr *index : as<IndexExpr>(expr)->indices)
      detail::visitOne(index, visit);
    return;
  case ExprKind::Deref:
    return detail::visitOne(as<DerefExpr>(expr)->base, visit);
  case ExprKind::Call:
    detail::visitOne(as<CallExpr>(expr)->callee, visit);
    for (const Argument &argument : as<CallExpr>(expr)->arguments)
      detail::visitOne(argument.value, visit);
    return;
  case ExprKind::Unary:
    return detail::visitOne(as<UnaryExpr>(expr)->operand, visit);
  case ExprKind::Binary:
    detail::visitOne(as<BinaryExpr>(expr)->left, visit);
    return detail::visitOne(as<BinaryExpr>(expr)->right, visit);
  case ExprKind::Aggregate:
    return detail::visitItems(as<AggregateExpr>(expr)->items, visit);
  }
}

/// Calls `onExpr(Expr *)` and `onBlock(Block)` for what is right below a statement, in the order of
/// the text. The values of a CASE's labels are expressions like others.
template <class OnExpr, class OnBlock>
void forEachChild(const Stmt *stmt, OnExpr &&onExpr, OnBlock &&onBlock) {
  switch (stmt->kind) {
  case StmtKind::Empty:
  case StmtKind::Exit:
  case StmtKind::Continue:
  case StmtKind::Return:
  case StmtKind::Jump:
  case StmtKind::Label:
    return;
  case StmtKind::Assign:
    for (Expr *target : as<AssignStmt>(stmt)->targets)
      detail::visitOne(target, onExpr);
    return detail::visitOne(as<AssignStmt>(stmt)->value, onExpr);
  case StmtKind::Call:
    return detail::visitOne(as<CallStmt>(stmt)->expr, onExpr);
  case StmtKind::If:
    for (const IfBranch &branch : as<IfStmt>(stmt)->branches) {
      detail::visitOne(branch.condition, onExpr);
      onBlock(branch.body);
    }
    return onBlock(as<IfStmt>(stmt)->elseBody);
  case StmtKind::Case:
    return detail::visitCase(as<CaseStmt>(stmt), onExpr, onBlock);
  case StmtKind::For: {
    const auto *loop = as<ForStmt>(stmt);
    for (Expr *expr : {loop->variable, loop->from, loop->to, loop->by})
      detail::visitOne(expr, onExpr);
    return onBlock(loop->body);
  }
  case StmtKind::While:
    detail::visitOne(as<WhileStmt>(stmt)->condition, onExpr);
    return onBlock(as<WhileStmt>(stmt)->body);
  case StmtKind::RepeatS:
    onBlock(as<RepeatStmt>(stmt)->body);
    return detail::visitOne(as<RepeatStmt>(stmt)->until, onExpr);
  case StmtKind::Try: {
    const auto *attempt = as<TryStmt>(stmt);
    onBlock(attempt->body);
    detail::visitOne(attempt->exception, onExpr);
    onBlock(attempt->catchBody);
    return onBlock(attempt->finallyBody);
  }
  }
}

/// Calls `visit(Expr *)` for `expr` and everything below it, each node before its children. A
/// `visit` that gives a bool says whether to look below the node.
template <class Visit> void walk(Expr *expr, Visit &&visit) {
  // Sums of thousands of terms lean to the left: they are not descended into.
  std::vector<BinaryExpr *> spine;
  bool below = detail::goesOn(visit, expr);
  while (below && expr->kind == ExprKind::Binary) {
    spine.push_back(as<BinaryExpr>(expr));
    expr = spine.back()->left;
    below = expr != nullptr && detail::goesOn(visit, expr);
  }
  if (below)
    forEachChild(expr, [&](Expr *child) { walk(child, visit); });
  for (auto node = spine.rbegin(); node != spine.rend(); ++node)
    if ((*node)->right != nullptr)
      walk((*node)->right, visit);
}

/// Calls `visit(std::span<Argument>)` for each list of arguments of FB_Init that stands in the
/// variable's declaration: of its instance, or of the elements of its array.
template <class Visit> void forEachConstruction(const VarDecl *variable, Visit &&visit) {
  const TypeExpr *type = variable->type;
  while (type != nullptr && type->kind == TypeExprKind::Array)
    type = as<ArrayTypeExpr>(type)->element;
  if (type == nullptr || type->kind != TypeExprKind::Named)
    return;
  visit(as<NamedTypeExpr>(type)->arguments);
  for (const std::span<Argument> &element : as<NamedTypeExpr>(type)->elements)
    visit(element);
}

/// Calls `visit(Stmt *)` for each statement of the block and of the blocks inside of it, each
/// before what it holds. A `visit` that gives a bool says whether to look inside.
template <class Visit> void walkStatements(Block block, Visit &&visit) {
  for (Stmt *stmt : block) {
    if (detail::goesOn(visit, stmt))
      forEachChild(
          stmt, [](Expr *) {}, [&](Block inner) { walkStatements(inner, visit); });
  }
}

/// Calls `visit` as walk() does for each expression of the block, in the order of the text.
template <class Visit> void walkExpressions(Block block, Visit &&visit) {
  for (const Stmt *stmt : block)
    forEachChild(
        stmt, [&](Expr *expr) { walk(expr, visit); },
        [&](Block inner) { walkExpressions(inner, visit); });
}

} // namespace stc::ast

#endif // STRIDE_COMPILER_SYNTAX_VISIT_HPP
