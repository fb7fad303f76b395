#include "compiler/codegen/cpp/inlining.hpp"

#include "compiler/syntax/visit.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

constexpr int kLimit = 160;
/// Not larger than a call of it.
constexpr int kTiny = 12;

/// Counts nodes until there are too many.
class Size {
public:
  explicit Size(int limit) : left_(limit) {}

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
    case StmtKind::Empty:
    case StmtKind::Return:
    case StmtKind::Assign:
    case StmtKind::Call:
    case StmtKind::If:
      forEachChild(
          s, [this](Expr *e) { expression(e); }, [this](Block inner) { block(inner); });
      return;
    case StmtKind::Case: // a label counts once, whatever its value looks like
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

  void expression(Expr *expr) {
    walk(expr, [this](const Expr *e) {
      if (fits())
        left_ -= e->kind == ExprKind::Call ? 6 : 1;
      return fits();
    });
  }

  int left_;
};

bool fits(const PouSymbol *pou, int limit) {
  const DeclKind kind = pou->decl->kind;
  if ((kind != DeclKind::Function && kind != DeclKind::FunctionBlock) || pou->decl->external)
    return false;
  Size size(limit);
  size.block(pou->decl->body);
  return size.fits();
}

} // namespace

bool isInlinable(const PouSymbol *pou) { return fits(pou, kLimit); }

bool isWorthInlining(const PouSymbol *pou, bool often) { return fits(pou, often ? kLimit : kTiny); }

} // namespace stc::codegen
