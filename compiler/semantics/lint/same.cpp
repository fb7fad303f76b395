// Whether two pieces of a program are the same.

#include "compiler/semantics/lint/internal.hpp"

#include <algorithm>

namespace stc::lint {

using namespace ast;

namespace {

constexpr unsigned kDeepest = 64;

bool same(const Expr *a, const Expr *b, unsigned depth);

bool sameOrNone(const Expr *a, const Expr *b, unsigned depth) {
  return a == nullptr || b == nullptr ? a == b : same(a, b, depth);
}

bool same(const Expr *a, const Expr *b, unsigned depth) {
  if (a->kind != b->kind || a->type != b->type || depth > kDeepest)
    return false;
  ++depth;
  switch (a->kind) {
  case ExprKind::Literal: {
    const auto *x = as<Literal>(a);
    const auto *y = as<Literal>(b);
    return x->literal == y->literal && x->integer == y->integer && x->text == y->text &&
           !(x->real < y->real) && !(x->real > y->real);
  }
  case ExprKind::Name:
    return as<NameExpr>(a)->symbol != nullptr && as<NameExpr>(a)->symbol == as<NameExpr>(b)->symbol;
  case ExprKind::Member: {
    const auto *x = as<MemberExpr>(a);
    const auto *y = as<MemberExpr>(b);
    return x->bit == y->bit && x->width == y->width && x->symbol == y->symbol &&
           x->name.id == y->name.id && same(x->base, y->base, depth);
  }
  case ExprKind::Index: {
    const auto *x = as<IndexExpr>(a);
    const auto *y = as<IndexExpr>(b);
    return std::equal(x->indices.begin(), x->indices.end(), y->indices.begin(), y->indices.end(),
                      [&](const Expr *i, const Expr *j) { return same(i, j, depth); }) &&
           same(x->base, y->base, depth);
  }
  case ExprKind::Deref:
    return same(as<DerefExpr>(a)->base, as<DerefExpr>(b)->base, depth);
  case ExprKind::Unary:
    return as<UnaryExpr>(a)->op == as<UnaryExpr>(b)->op &&
           same(as<UnaryExpr>(a)->operand, as<UnaryExpr>(b)->operand, depth);
  case ExprKind::Binary: {
    const auto *x = as<BinaryExpr>(a);
    const auto *y = as<BinaryExpr>(b);
    return x->op == y->op && same(x->right, y->right, depth) && same(x->left, y->left, depth);
  }
  case ExprKind::EnumLiteral:
    return as<EnumLiteralExpr>(a)->symbol == as<EnumLiteralExpr>(b)->symbol;
  default:
    return false;
  }
}

bool sameStmt(const Stmt *a, const Stmt *b, unsigned depth);

bool sameList(Block a, Block b, unsigned depth) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](const Stmt *x, const Stmt *y) { return sameStmt(x, y, depth); });
}

bool sameStmt(const Stmt *a, const Stmt *b, unsigned depth) {
  if (a->kind != b->kind || depth > kDeepest)
    return false;
  ++depth;
  switch (a->kind) {
  case StmtKind::Empty:
  case StmtKind::Exit:
  case StmtKind::Continue:
  case StmtKind::Return:
    return true;
  case StmtKind::Assign: {
    const auto *x = as<AssignStmt>(a);
    const auto *y = as<AssignStmt>(b);
    return x->op == y->op &&
           std::equal(x->targets.begin(), x->targets.end(), y->targets.begin(), y->targets.end(),
                      [](const Expr *i, const Expr *j) { return same(i, j, 0); }) &&
           same(x->value, y->value, 0);
  }
  case StmtKind::Call: {
    const Expr *x = as<CallStmt>(a)->expr;
    const Expr *y = as<CallStmt>(b)->expr;
    if (x->kind != ExprKind::Call || y->kind != ExprKind::Call)
      return false;
    const auto *f = as<CallExpr>(x);
    const auto *g = as<CallExpr>(y);
    return f->pou == g->pou && same(f->callee, g->callee, 0) &&
           std::equal(f->arguments.begin(), f->arguments.end(), g->arguments.begin(),
                      g->arguments.end(), [](const Argument &i, const Argument &j) {
                        return i.parameter == j.parameter && i.output == j.output &&
                               sameOrNone(i.value, j.value, 0);
                      });
  }
  case StmtKind::If: {
    const auto *x = as<IfStmt>(a);
    const auto *y = as<IfStmt>(b);
    return x->hasElse == y->hasElse &&
           std::equal(x->branches.begin(), x->branches.end(), y->branches.begin(),
                      y->branches.end(),
                      [&](const IfBranch &i, const IfBranch &j) {
                        return same(i.condition, j.condition, 0) && sameList(i.body, j.body, depth);
                      }) &&
           sameList(x->elseBody, y->elseBody, depth);
  }
  default:
    return false;
  }
}

} // namespace

bool sameExpr(const Expr *a, const Expr *b) { return same(a, b, 0); }
bool sameBlock(Block a, Block b) { return sameList(a, b, 0); }

} // namespace stc::lint
