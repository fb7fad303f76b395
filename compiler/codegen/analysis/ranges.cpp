// What is known of the values of variables within loops.

#include "compiler/codegen/analysis/analysis.hpp"
#include "compiler/semantics/fold.hpp"
#include "compiler/syntax/visit.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

/// Far from where 64 bits could wrap.
constexpr int64_t kLimit = 1 << 30;
/// Expressions are looked into so deep.
constexpr unsigned kMaxDepth = 16;

/// All values from `low` to `high` are values of the type.
bool fits(const Type *type, int64_t low, int64_t high) {
  const Type *t = underlying(type);
  return isInteger(t) && low <= high && low >= -kLimit && high <= kLimit && wrapTo(t, low) == low &&
         wrapTo(t, high) == high && (low >= 0 || isSignedInteger(t));
}

bool isConstantInteger(const Expr *e) {
  return e->constant != nullptr && e->constant->kind == ConstKind::Integer &&
         e->constant->integer >= -kLimit && e->constant->integer <= kLimit;
}

/// `variable := value`, or null.
const AssignStmt *plainAssignment(const Stmt *s) {
  const auto *a = s != nullptr && s->kind == StmtKind::Assign ? as<AssignStmt>(s) : nullptr;
  const bool plain = a != nullptr && a->op == AssignOp::Assign && a->targets.size() == 1 &&
                     a->targets.front()->kind == ExprKind::Name &&
                     namedVariable(a->targets.front()) != nullptr;
  return plain ? a : nullptr;
}

/// How often the block names the variable, or a part of it, where it may be written.
size_t writes(Block block, const VarSymbol *variable) {
  size_t count = 0;
  const auto place = [&](const Expr *e) {
    while (e->kind == ExprKind::Member || e->kind == ExprKind::Index) {
      if (namedVariable(e) == variable)
        break;
      e = e->kind == ExprKind::Member ? as<MemberExpr>(e)->base : as<IndexExpr>(e)->base;
    }
    count += namedVariable(e) == variable ? 1U : 0U;
  };
  walkStatements(block, [&](const Stmt *s) {
    if (s->kind == StmtKind::Assign)
      for (const Expr *t : as<AssignStmt>(s)->targets)
        place(t);
    else if (s->kind == StmtKind::For)
      place(as<ForStmt>(s)->variable);
  });
  walkExpressions(block, [&](const Expr *e) {
    if (e->kind != ExprKind::Call)
      return;
    for (const Argument &a : as<CallExpr>(e)->arguments)
      if (a.value != nullptr &&
          (a.output || a.parameter == nullptr || a.parameter->section == Section::InOut ||
           a.parameter->type->kind == TypeKind::Reference))
        place(a.value);
  });
  return count;
}

/// The largest value (or, downwards, the smallest) for which the condition can be true.
std::optional<int64_t> limitOf(const Expr *condition, const VarSymbol *variable, bool up,
                               unsigned depth = 0) {
  if (condition->kind != ExprKind::Binary || condition->constant != nullptr || depth > kMaxDepth)
    return std::nullopt;
  const auto *e = as<BinaryExpr>(condition);
  if (e->op == BinaryOp::LogicalAnd || e->op == BinaryOp::AndThen) {
    const auto left = limitOf(e->left, variable, up, depth + 1);
    return left ? left : limitOf(e->right, variable, up, depth + 1);
  }
  const bool isStrict = e->op == (up ? BinaryOp::Less : BinaryOp::Greater);
  if ((!isStrict && e->op != (up ? BinaryOp::LessEqual : BinaryOp::GreaterEqual)) ||
      e->left->kind != ExprKind::Name || namedVariable(e->left) != variable ||
      !isConstantInteger(e->right) || e->operandType == nullptr || !isInteger(e->operandType) ||
      (!isSignedInteger(e->operandType) && isSignedInteger(underlying(variable->type))))
    return std::nullopt;
  const int64_t limit = e->right->constant->integer;
  return isStrict ? (up ? limit - 1 : limit + 1) : limit;
}

/// The last statement of the body, `v := v + x` or `v := v - x`.
struct Step {
  const VarSymbol *variable = nullptr;
  const Expr *by = nullptr;
  bool up = true;
};

Step stepOf(const WhileStmt *loop) {
  const auto *last = loop->body.empty() ? nullptr : plainAssignment(loop->body.back());
  if (last == nullptr || last->value->kind != ExprKind::Binary || last->value->constant != nullptr)
    return {};
  const auto *sum = as<BinaryExpr>(last->value);
  if (sum->op != BinaryOp::Add && sum->op != BinaryOp::Subtract)
    return {};
  const VarSymbol *v = namedVariable(last->targets.front());
  if (namedVariable(sum->left) == v)
    return {v, sum->right, sum->op == BinaryOp::Add};
  if (sum->op == BinaryOp::Add && namedVariable(sum->right) == v)
    return {v, sum->left, true};
  return {};
}

} // namespace

void Analysis::enterLoop(const ForStmt *loop, bool countsAlone) {
  Range range{nullptr, 0, 0};
  const VarSymbol *variable = namedVariable(loop->variable);
  const bool own = variable != nullptr && variable->owner != nullptr && !sharedVariable(loop) &&
                   variable->section != Section::InOut && variable->section != Section::Stat &&
                   variable->location == nullptr && variable->type->kind != TypeKind::Reference;
  if (own && loop->from->constant != nullptr && loop->to->constant != nullptr &&
      (loop->by == nullptr ||
       (loop->by->constant != nullptr && loop->by->constant->integer != 0)) &&
      (countsAlone || unchanged(loop->body, variable))) {
    const int64_t from = loop->from->constant->integer;
    const int64_t to = loop->to->constant->integer;
    const bool up = loop->by == nullptr || loop->by->constant->integer > 0;
    if (up ? from <= to : to <= from)
      range = {variable, up ? from : to, up ? to : from};
  }
  ranges_.push_back(range);
}

void Analysis::leaveLoop() { ranges_.pop_back(); }

const VarSymbol *Analysis::steppedVariable(const WhileStmt *loop) { return stepOf(loop).variable; }

void Analysis::enterWhile(const WhileStmt *loop, const Stmt *before) {
  ranges_.push_back(whileRange(loop, before));
}

/// It begins with a known value, each round adds something that is not negative, and it does not
/// wrap: from any value that the condition allows, the next one is one of its type, too.
Analysis::Range Analysis::whileRange(const WhileStmt *loop, const Stmt *before) const {
  constexpr Range kNothing{nullptr, 0, 0};
  const Step step = stepOf(loop);
  const auto *first = plainAssignment(before);
  if (step.variable == nullptr || first == nullptr ||
      namedVariable(first->targets.front()) != step.variable ||
      writes(loop->body, step.variable) != 1)
    return kNothing;
  const auto from = interval(first->value);
  const auto by = interval(step.by);
  const auto limit = limitOf(loop->condition, step.variable, step.up);
  if (!from || !by || !limit || by->low < 0 || *limit < -kLimit || *limit > kLimit)
    return kNothing;
  const Range range =
      step.up ? Range{step.variable, from->low, *limit} : Range{step.variable, *limit, from->high};
  const Type *type = step.variable->type;
  const bool fitsAfter = step.up ? fits(type, range.low, range.high + by->high)
                                 : fits(type, range.low - by->high, range.high);
  return fits(type, from->low, from->high) && range.low <= range.high && fitsAfter ? range
                                                                                   : kNothing;
}

std::optional<Analysis::Interval> Analysis::interval(const Expr *e, unsigned depth) const {
  std::optional<Interval> found;
  if (isConstantInteger(e))
    found = Interval{e->constant->integer, e->constant->integer};
  else if (e->constant == nullptr && e->kind == ExprKind::Binary && depth < kMaxDepth)
    found = intervalOf(as<BinaryExpr>(e), depth + 1);
  else if (const VarSymbol *variable = e->constant == nullptr ? namedVariable(e) : nullptr)
    for (size_t i = ranges_.size(); i-- > 0 && !found;)
      if (ranges_[i].variable == variable)
        found = Interval{ranges_[i].low, ranges_[i].high};
  // A literal has no type of its own.
  const bool isTyped = found && (e->constant != nullptr || fits(e->type, found->low, found->high));
  if (!isTyped || (e->target != nullptr && !fits(e->target, found->low, found->high)))
    return std::nullopt;
  return found;
}

std::optional<Analysis::Interval> Analysis::intervalOf(const BinaryExpr *e, unsigned depth) const {
  const bool adds = e->op == BinaryOp::Add || e->op == BinaryOp::Subtract;
  if ((!adds && e->op != BinaryOp::Multiply) || e->operandType == nullptr ||
      !isInteger(underlying(e->operandType)))
    return std::nullopt;
  const auto left = interval(e->left, depth);
  const auto right = left ? interval(e->right, depth) : std::nullopt;
  if (!left || !right)
    return std::nullopt;
  Interval result{left->low + right->low, left->high + right->high};
  if (e->op == BinaryOp::Subtract)
    result = {left->low - right->high, left->high - right->low};
  if (e->op == BinaryOp::Multiply) {
    const auto [low, high] = std::minmax({left->low * right->low, left->low * right->high,
                                          left->high * right->low, left->high * right->high});
    result = {low, high};
  }
  if (!fits(e->operandType, result.low, result.high))
    return std::nullopt;
  return result;
}

bool Analysis::provenIndex(const Expr *index, const ArrayType *array) const {
  if (index->constant != nullptr)
    return inBounds(index, array);
  const auto values = ranges_.empty() ? std::nullopt : interval(index);
  return values && values->low >= array->low && values->high <= array->high;
}

} // namespace stc::codegen
