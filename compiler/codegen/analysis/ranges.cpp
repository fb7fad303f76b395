// What is known of the values of variables within loops.

#include "compiler/codegen/analysis/analysis.hpp"
#include "compiler/semantics/fold.hpp"
#include "compiler/syntax/visit.hpp"

#include <algorithm>

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

/// `v := v + x`, `v - x`, `v * x`, `v / x`, of the variable that the condition limits.
struct Step {
  const VarSymbol *variable = nullptr;
  const Expr *by = nullptr;
  BinaryOp op = BinaryOp::Add;
  int64_t limit = 0;

  [[nodiscard]] bool up() const { return op == BinaryOp::Add || op == BinaryOp::Multiply; }
};

Step stepIn(const AssignStmt *a, const Expr *condition) {
  if (a->value->kind != ExprKind::Binary || a->value->constant != nullptr)
    return {};
  const auto *sum = as<BinaryExpr>(a->value);
  Step step{namedVariable(a->targets.front()), sum->right, sum->op};
  if (!step.up() && sum->op != BinaryOp::Subtract && sum->op != BinaryOp::Divide)
    return {};
  if (namedVariable(sum->left) != step.variable) {
    if (!step.up() || namedVariable(sum->right) != step.variable)
      return {};
    step.by = sum->left;
  }
  const auto limit = limitOf(condition, step.variable, step.up());
  if (!limit || *limit < -kLimit || *limit > kLimit)
    return {};
  step.limit = *limit;
  return step;
}

bool mentions(Block block, const VarSymbol *variable) {
  bool found = false;
  walkExpressions(block, [&](const Expr *e) { found = found || symbolAt(e) == variable; });
  return found;
}

/// At the end of the body; what comes after it has nothing to do with the variable.
Step stepOf(const WhileStmt *loop) {
  for (size_t i = loop->body.size(); i-- > 0;) {
    const AssignStmt *a = plainAssignment(loop->body[i]);
    if (a == nullptr)
      break;
    if (const Step step = stepIn(a, loop->condition); step.variable != nullptr)
      return mentions(loop->body.subspan(i + 1), step.variable) ? Step{} : step;
  }
  return {};
}

/// The last statement that gives the variable its value, among those directly before a loop.
const AssignStmt *valueBefore(Analysis &analysis, Block before, const VarSymbol *variable) {
  constexpr size_t kMost = 8;
  for (size_t i = before.size(), n = 0; i-- > 0 && n < kMost; ++n) {
    const AssignStmt *a = plainAssignment(before[i]);
    if (a == nullptr || namedVariable(a->targets.front()) == variable)
      return a;
    if (namedVariable(a->targets.front())->type->kind == TypeKind::Reference ||
        namedVariable(a->targets.front())->section == Section::InOut ||
        (analysis.effects(a->value) & kEffectCalls) != 0)
      return nullptr;
  }
  return nullptr;
}

/// A CONTINUE of the loop itself can keep a round from its last statements.
bool canContinue(Block body) {
  return std::any_of(body.begin(), body.end(), [](const Stmt *s) {
    bool found = s->kind == StmtKind::Continue;
    if (s->kind != StmtKind::For && s->kind != StmtKind::While && s->kind != StmtKind::RepeatS)
      forEachChild(
          s, [](const Expr *) {}, [&](Block inner) { found = found || canContinue(inner); });
    return found;
  });
}

/// How often a loop runs at most that multiplies or divides by `by` (2 or more) while its variable
/// is in the range (of numbers above 0).
int64_t roundsByFactors(int64_t low, int64_t high, int64_t by) {
  int64_t rounds = 1;
  for (; low <= high / by; low *= by)
    ++rounds;
  return rounds;
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

int64_t Analysis::whileRounds(const WhileStmt *loop, Block before) {
  // Nobody knows how long a call takes, nor how many rounds leave the variable as it is.
  if (canContinue(loop->body) || !computes(loop->body, [](const Expr *) { return true; }))
    return kHuge;
  return whileFacts(loop, before).rounds;
}

void Analysis::enterWhile(const WhileStmt *loop, Block before) {
  ranges_.push_back(whileFacts(loop, before).range);
}

/// It begins with a known value, each round goes on from there or stays, and it does not wrap: from
/// any value that the condition allows, the next one is one of its type, too.
Analysis::WhileFacts Analysis::whileFacts(const WhileStmt *loop, Block before) {
  const Step step = stepOf(loop);
  const auto *first =
      step.variable == nullptr ? nullptr : valueBefore(*this, before, step.variable);
  // What the condition calls may change it, too; a check of the project's own may give another
  // value.
  if (first == nullptr || writes(loop->body, step.variable) != 1 ||
      (effects(loop->condition) & kEffectCalls) != 0 ||
      step.variable->type->kind == TypeKind::Subrange ||
      (step.op == BinaryOp::Divide && step.by->constant == nullptr))
    return {};
  const bool up = step.up();
  const auto from = interval(first->value);
  const auto by = interval(step.by);
  if (!from || !by)
    return {};
  const Range range = up ? Range{step.variable, from->low, step.limit}
                         : Range{step.variable, step.limit, from->high};
  const Type *type = step.variable->type;
  if (range.low > range.high || !fits(type, from->low, from->high) ||
      !fits(type, range.low, range.high))
    return {};
  if (step.op == BinaryOp::Multiply || step.op == BinaryOp::Divide) {
    const bool grows =
        by->low >= 2 && range.low >= 1 && (!up || fits(type, range.low, range.high * by->high));
    return grows ? WhileFacts{range, roundsByFactors(range.low, range.high, by->low)}
                 : WhileFacts{};
  }
  if (by->low < 0 || !(up ? fits(type, range.low, range.high + by->high)
                          : fits(type, range.low - by->high, range.high)))
    return {};
  return {range, by->low == 0 ? kHuge : (range.high - range.low) / by->low + 1};
}

int64_t Analysis::roundsAtMost(const ForStmt *loop) const {
  const auto from = interval(loop->from);
  const auto to = from ? interval(loop->to) : std::nullopt;
  if (!to || (loop->by != nullptr && loop->by->constant == nullptr))
    return kHuge;
  // Nothing wraps.
  if (const VarSymbol *first = namedVariable(loop->from); first != nullptr)
    if (const auto beyond = distance(loop->to, first))
      return std::max(std::max(beyond->high, -beyond->low), int64_t{0}) + 1;
  return std::max(to->high - from->low, from->high - to->low) + 1;
}

std::optional<Analysis::Interval> Analysis::distance(const Expr *e,
                                                     const VarSymbol *variable) const {
  Interval sum{0, 0};
  for (unsigned depth = 0; depth < kMaxDepth && e->constant == nullptr; ++depth) {
    if (e->kind == ExprKind::Name && namedVariable(e) == variable)
      return sum;
    const auto *binary = e->kind == ExprKind::Binary ? as<BinaryExpr>(e) : nullptr;
    if (binary == nullptr || (binary->op != BinaryOp::Add && binary->op != BinaryOp::Subtract))
      break;
    const auto right = interval(binary->right);
    if (!right)
      break;
    const bool adds = binary->op == BinaryOp::Add;
    sum = {sum.low + (adds ? right->low : -right->high),
           sum.high + (adds ? right->high : -right->low)};
    e = binary->left;
  }
  return std::nullopt;
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
