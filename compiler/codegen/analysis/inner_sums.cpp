#include "compiler/codegen/analysis/inner_sums.hpp"

#include "compiler/syntax/visit.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

/// What is known of a round while its statements are looked at in their order.
class Round {
public:
  Round(Analysis &analysis, const std::vector<const VarSymbol *> &locals)
      : analysis_(analysis), locals_(locals) {}

  bool body(Block block, bool isInner) {
    return std::all_of(block.begin(), block.end(),
                       [&](const Stmt *s) { return statement(s, isInner); });
  }

  /// What the round has set first, and changed in the inner loop.
  [[nodiscard]] const std::vector<const VarSymbol *> &sums() const { return changed_; }
  [[nodiscard]] bool isComplete() const {
    return loops_ == 1 && !set_.empty() && changed_.size() == set_.size();
  }

private:
  bool statement(const Stmt *s, bool isInner) {
    if (s->kind == StmtKind::Assign)
      return assignment(as<AssignStmt>(s), isInner);
    return s->kind == StmtKind::For && !isInner && inner(as<ForStmt>(s));
  }

  /// Its variable ends with the same value in each round.
  bool inner(const ForStmt *s) {
    if (++loops_ != 1 || !analysis_.shortLoop(s) || !analysis_.endsInside(s) ||
        !contains(locals_, namedVariable(s->variable)))
      return false;
    analysis_.enterLoop(s);
    const bool fits = body(s->body, true);
    analysis_.leaveLoop();
    return fits;
  }

  bool assignment(const AssignStmt *s, bool isInner) {
    if (s->op == AssignOp::Reference || s->targets.size() != 1 || !computes(s->value))
      return false;
    Expr *target = s->targets.front();
    read(s->value);
    if (target->kind == ExprKind::Index) { // an element for each round
      read(target);
      return isScalar(target->type) && analysis_.effects(target) == kEffectReads;
    }
    const VarSymbol *v = target->kind == ExprKind::Name ? namedVariable(target) : nullptr;
    if (v == nullptr || !isReal(underlying(v->type)) || !contains(locals_, v))
      return false;
    if (isInner) {
      if (!contains(changed_, v))
        changed_.push_back(v);
      return contains(set_, v);
    }
    if (loops_ == 0 && !contains(set_, v)) {
      if (s->op != AssignOp::Assign || contains(early_, v))
        return false;
      set_.push_back(v);
    }
    return contains(set_, v);
  }

  /// What has not been set is what the round before has left.
  void read(Expr *expr) {
    walk(expr, [&](const Expr *e) {
      if (const VarSymbol *v = namedVariable(e); v != nullptr && !contains(set_, v))
        early_.push_back(v);
    });
  }

  /// It can neither leave the cycle nor change anything.
  bool computes(const Expr *value) {
    return (analysis_.effects(value) & ~unsigned{kEffectReads}) == 0;
  }

  Analysis &analysis_;
  const std::vector<const VarSymbol *> &locals_;
  std::vector<const VarSymbol *> early_; ///< read before the round has set them
  std::vector<const VarSymbol *> set_;
  std::vector<const VarSymbol *> changed_;
  unsigned loops_ = 0;
};

} // namespace

std::vector<const VarSymbol *> innerSums(Analysis &analysis, const ForStmt *loop,
                                         const std::vector<const VarSymbol *> &locals) {
  const int64_t rounds = analysis.ownRounds(loop);
  Round round(analysis, locals);
  if (locals.empty() || rounds < 2 || rounds > kMostRounds || !round.body(loop->body, false) ||
      !round.isComplete())
    return {};
  return round.sums();
}

} // namespace stc::codegen
