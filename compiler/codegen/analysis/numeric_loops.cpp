#include "compiler/codegen/analysis/numeric_loops.hpp"

#include "compiler/semantics/types.hpp"
#include "compiler/syntax/visit.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

bool computesWithElements(Expr *expr) {
  bool computes = false;
  bool indexes = false;
  walk(expr, [&](const Expr *e) {
    const Type *operands = e->kind == ExprKind::Binary ? as<BinaryExpr>(e)->operandType : nullptr;
    computes = computes || (operands != nullptr && isReal(underlying(operands)) &&
                            !isComparison(as<BinaryExpr>(e)->op));
    indexes = indexes ||
              (e->kind == ExprKind::Index && e->type != nullptr && isReal(underlying(e->type)));
  });
  return computes && indexes;
}

/// `depth`: loops around the block.
bool isNumeric(Block block, unsigned depth) {
  bool found = false;
  for (const Stmt *s : block) {
    const bool isLoop =
        s->kind == StmtKind::For || s->kind == StmtKind::While || s->kind == StmtKind::RepeatS;
    const unsigned inner = isLoop ? depth + 1 : depth;
    forEachChild(
        s, [&](Expr *e) { found = found || (depth > 1 && computesWithElements(e)); },
        [&](Block within) { found = found || isNumeric(within, inner); });
  }
  return found;
}

} // namespace

bool hasNumericLoop(Block body) { return isNumeric(body, 0); }

} // namespace stc::codegen
