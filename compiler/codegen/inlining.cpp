#include "compiler/codegen/inlining.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

constexpr int kLimit = 160;

/// Counts nodes until there are too many.
class Size {
public:
  [[nodiscard]] bool fits() const { return left_ >= 0; }

  void block(Block block) {
    for (const Stmt *s : block) {
      if (!fits())
        return;
      statement(s);
    }
  }

private:
  void statement(const Stmt *s) {
    --left_;
    switch (s->kind) {
    case StmtKind::empty:
    case StmtKind::returnS:
      return;
    case StmtKind::assign:
      for (const Expr *target : as<AssignStmt>(s)->targets)
        expression(target);
      expression(as<AssignStmt>(s)->value);
      return;
    case StmtKind::call:
      expression(as<CallStmt>(s)->expr);
      return;
    case StmtKind::ifS:
      for (const IfBranch &b : as<IfStmt>(s)->branches) {
        expression(b.condition);
        block(b.body);
      }
      block(as<IfStmt>(s)->elseBody);
      return;
    case StmtKind::caseS:
      expression(as<CaseStmt>(s)->selector);
      for (const CaseBranch &b : as<CaseStmt>(s)->branches) {
        left_ -= static_cast<int>(b.labels.size());
        block(b.body);
      }
      block(as<CaseStmt>(s)->elseBody);
      return;
    default: // a loop outweighs its call
      left_ = -1;
      return;
    }
  }

  void expression(const Expr *e) {
    while (e != nullptr && fits()) {
      --left_;
      switch (e->kind) {
      case ExprKind::member:
        e = as<MemberExpr>(e)->base;
        continue;
      case ExprKind::index:
        for (const Expr *i : as<IndexExpr>(e)->indices)
          expression(i);
        e = as<IndexExpr>(e)->base;
        continue;
      case ExprKind::deref:
        e = as<DerefExpr>(e)->base;
        continue;
      case ExprKind::unary:
        e = as<UnaryExpr>(e)->operand;
        continue;
      case ExprKind::binary:
        expression(as<BinaryExpr>(e)->right);
        e = as<BinaryExpr>(e)->left;
        continue;
      case ExprKind::call:
        left_ -= 5;
        for (const Argument &a : as<CallExpr>(e)->arguments)
          expression(a.value);
        e = as<CallExpr>(e)->callee;
        continue;
      default:
        return;
      }
    }
  }

  int left_ = kLimit;
};

} // namespace

bool isInlinable(const PouSymbol *pou) {
  const DeclKind kind = pou->decl->kind;
  if ((kind != DeclKind::function && kind != DeclKind::functionBlock) || pou->decl->external)
    return false;
  Size size;
  size.block(pou->decl->body);
  return size.fits();
}

} // namespace stc::codegen
