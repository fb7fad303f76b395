// From the lines of an instruction list to statements.
#include "compiler/syntax/instruction_list.hpp"

#include "compiler/syntax/visit.hpp"

#include <string>
#include <utility>

namespace stc {

using namespace ast;

namespace {

/// So many operators may wait in one expression.
constexpr unsigned kMaxOperators = 100;

bool calls(Expr *expr) {
  bool found = false;
  walk(expr, [&](Expr *one) { found = found || one->kind == ExprKind::Call; });
  return found;
}

} // namespace

InstructionLowering::InstructionLowering(const std::vector<Instruction> &list, Interner &interner,
                                         Arena &arena, Diagnostics &diagnostics,
                                         std::vector<VarDecl *> &variables, std::string prefix)
    : list_(list), interner_(interner), arena_(arena), diagnostics_(diagnostics),
      variables_(variables), prefix_(std::move(prefix)) {
  for (size_t i = 0; i < list.size(); ++i)
    if (list[i].kind == Instruction::Kind::Label)
      labels_.emplace(list[i].label.id, i);
}

void InstructionLowering::run(std::vector<Stmt *> &out) {
  out_ = &out;
  for (size_t i = 0; i < list_.size(); ++i)
    instruction(i);
  drop();
  for (const Open &open : open_)
    diagnostics_
        .report(Code::InstructionParenthesis, open.instruction->opSpan,
                "this parenthesis is not closed", "its `)` is missing")
        .help("write `)` on a line of its own after the last instruction of the right side");
}

// ---------------------------------------------------------------------------------------------
// what is used later

/// Whether the current result before the instruction `at` is used by it or one after it.
bool InstructionLowering::isUsedFrom(size_t at) const {
  std::vector<bool> seen;
  while (at < list_.size()) {
    const Instruction &one = list_[at++];
    switch (one.kind) {
    case Instruction::Kind::Label:
      continue;
    case Instruction::Kind::Value:
      return false;
    case Instruction::Kind::Function:
    case Instruction::Kind::Close:
      return true;
    case Instruction::Kind::Operator:
      break;
    }
    if (one.op->operation == Operation::Load)
      return false;
    const bool leaves = one.op->operation == Operation::Jump ||
                        one.op->operation == Operation::Call ||
                        one.op->operation == Operation::Return;
    if (!leaves || one.op->conditional)
      return true;
    const auto target = labels_.find(one.label.id);
    if (one.op->operation != Operation::Jump || target == labels_.end())
      return false;
    seen.resize(list_.size());
    if (seen[at - 1])
      return false;
    seen[at - 1] = true;
    at = target->second;
  }
  return false;
}

bool InstructionLowering::labelUses(const Name &label) const {
  const auto found = labels_.find(label.id);
  return found != labels_.end() && isUsedFrom(found->second);
}

// ---------------------------------------------------------------------------------------------
// instructions

void InstructionLowering::instruction(size_t at) {
  const Instruction &one = list_[at];
  const bool branches =
      one.kind == Instruction::Kind::Label ||
      (one.kind == Instruction::Kind::Operator &&
       (one.op->operation == Operation::Jump || one.op->operation == Operation::Return));
  if (branches && !open_.empty()) {
    diagnostics_
        .report(Code::InstructionParenthesis, one.span,
                "neither labels nor jumps can stand inside of parentheses", "not here")
        .label(open_.back().instruction->opSpan, "the parenthesis")
        .help("close it before, or keep the left side in a variable");
    return;
  }
  switch (one.kind) {
  case Instruction::Kind::Label:
    return label(one, at);
  case Instruction::Kind::Function:
    return function(one);
  case Instruction::Kind::Value:
    drop();
    return set(one.operands.front(), 1);
  case Instruction::Kind::Close:
    return close(one);
  case Instruction::Kind::Operator:
    return operate(one, at);
  }
}

void InstructionLowering::operate(const Instruction &one, size_t at) {
  switch (one.op->operation) {
  case Operation::Load:
    return load(one);
  case Operation::Calculate:
    return calculate(one);
  case Operation::Not: {
    Expr *operand = current(one);
    return set(negation(one, operand), now_.depth + 1);
  }
  case Operation::Store:
  case Operation::Set:
  case Operation::Reset:
    return store(one, at);
  case Operation::Jump:
    return jump(one, at);
  case Operation::Call:
    return call(one, at);
  case Operation::Return:
    return leave(one, at);
  }
}

void InstructionLowering::load(const Instruction &one) {
  drop();
  Expr *value = one.operands.front();
  set(one.op->negated ? negation(one, value) : value, one.op->negated ? 1 : 0);
}

void InstructionLowering::calculate(const Instruction &one) {
  Expr *left = current(one); // also said of `AND(`
  if (one.opens) {
    now_.expr = left;
    open_.push_back({now_, &one});
    now_ = {};
    if (!one.operands.empty())
      set(one.operands.front(), 0);
    return;
  }
  for (Expr *operand : one.operands)
    combine(one, *one.op, operand, one.span);
}

void InstructionLowering::close(const Instruction &one) {
  if (open_.empty()) {
    diagnostics_
        .report(Code::InstructionParenthesis, one.span, "this `)` closes nothing",
                "there is no `(` for it")
        .help("an operator opens a parenthesis: `AND(`");
    return;
  }
  Expr *right = current(one);
  const Open open = open_.back();
  const unsigned depth = now_.depth;
  open_.pop_back();
  now_ = open.left;
  now_.depth += depth;
  combine(*open.instruction, *open.instruction->op, right, open.instruction->span.to(one.span));
}

void InstructionLowering::combine(const Instruction &one, const InstructionOperator &op,
                                  Expr *right, Span whole) {
  Expr *left = read(now_);
  auto *node = arena_.make<BinaryExpr>();
  node->op = op.binary;
  node->opSpan = one.opSpan;
  node->left = left;
  node->right = op.negated ? negation(one, right) : right;
  node->span = left->span.to(whole);
  set(node, now_.depth + 1);
}

void InstructionLowering::function(const Instruction &one) {
  std::vector<Argument> list;
  const auto add = [&](Expr *value) {
    Argument &argument = list.emplace_back();
    argument.value = value;
    argument.span = value->span;
  };
  add(current(one));
  for (Expr *operand : one.operands)
    add(operand);
  auto *node = arena_.make<CallExpr>();
  node->callee = one.callee;
  node->span = one.span;
  node->arguments = arena_.copy(list);
  set(node, now_.depth + 1);
}

void InstructionLowering::store(const Instruction &one, size_t at) {
  Expr *value = peek(one, isUsedFrom(at + 1));
  const Operation operation = one.op->operation;
  assign(one.operands.front(), one.op->negated ? negation(one, value) : value, one,
         operation == Operation::Set     ? AssignOp::Set
         : operation == Operation::Reset ? AssignOp::Reset
                                         : AssignOp::Assign);
}

void InstructionLowering::jump(const Instruction &one, size_t at) {
  const bool carries = labelUses(one.label);
  Expr *condition = nullptr;
  if (one.op->conditional)
    condition = peek(one, carries || isUsedFrom(at + 1));
  else if (!carries)
    drop();
  if (carries && (one.op->conditional || now_.isDefined())) {
    VarDecl *&merged = merged_[one.label.id];
    if (merged == nullptr)
      merged = variable(one.opSpan);
    assignTo(merged, read(now_));
  } else if (carries && reachable_) {
    reportUndefined(one.opSpan, "the label goes on with it, and nothing has set it here");
  }
  auto *node = arena_.make<JumpStmt>();
  node->label = one.label;
  node->span = one.span;
  if (one.op->conditional)
    return emitIf(one, condition, node);
  emit(node);
  now_ = {};
  reachable_ = false;
}

void InstructionLowering::label(const Instruction &one, size_t at) {
  const bool carries = isUsedFrom(at + 1);
  if (carries) {
    VarDecl *&merged = merged_[one.label.id];
    if (now_.isDefined()) {
      if (merged == nullptr)
        merged = variable(one.span);
      assignTo(merged, read(now_));
    } else if (reachable_ || merged == nullptr) {
      reportUndefined(one.span, "it is used after this label, and nothing before it has set it");
      merged = nullptr;
    }
  } else {
    drop();
  }
  auto *node = arena_.make<LabelStmt>();
  node->label = one.label;
  node->span = one.label.span;
  emit(node);
  now_ = {};
  reachable_ = true;
  if (!carries)
    return;
  VarDecl *merged = merged_[one.label.id];
  if (merged == nullptr) { // reported
    now_.expr = arena_.make<Expr>();
    now_.expr->span = one.span;
    return;
  }
  now_.variable = merged;
  now_.expr = nameOf(merged, one.span);
}

void InstructionLowering::call(const Instruction &one, size_t at) {
  Expr *condition = nullptr;
  if (one.op->conditional)
    condition = peek(one, isUsedFrom(at + 1));
  else
    drop();
  Expr *operand = one.operands.front();
  if (operand->kind != ExprKind::Call && operand->kind != ExprKind::Error) {
    auto *node = arena_.make<CallExpr>();
    node->callee = operand;
    node->span = operand->span;
    operand = node;
  }
  auto *node = arena_.make<CallStmt>();
  node->expr = operand;
  node->span = one.span;
  emitIf(one, condition, node);
}

void InstructionLowering::leave(const Instruction &one, size_t at) {
  Expr *condition = nullptr;
  if (one.op->conditional)
    condition = peek(one, isUsedFrom(at + 1));
  else
    drop();
  auto *node = arena_.make<Stmt>();
  node->kind = StmtKind::Return;
  node->span = one.span;
  emitIf(one, condition, node);
  if (!one.op->conditional)
    reachable_ = false;
}

// ---------------------------------------------------------------------------------------------
// the current result

void InstructionLowering::reportUndefined(Span where, const char *why) {
  diagnostics_
      .report(Code::CurrentResultUndefined, where, "the current result is undefined here", why)
      .help("set it with LD first");
}

Expr *InstructionLowering::current(const Instruction &one) {
  if (!now_.isDefined()) {
    if (reachable_)
      reportUndefined(one.opSpan, "nothing has set it");
    else
      reportUndefined(one.opSpan, "nothing leads here");
    now_.expr = arena_.make<Expr>();
    now_.expr->span = one.opSpan;
  }
  return read(now_);
}

Expr *InstructionLowering::peek(const Instruction &one, bool isUsedLater) {
  Expr *value = current(one);
  if (isUsedLater) {
    keep(now_);
    return read(now_);
  }
  now_ = {};
  return value;
}

void InstructionLowering::set(Expr *expr, unsigned depth) {
  now_ = {expr, nullptr, depth};
  if (depth > kMaxOperators)
    keep(now_);
}

void InstructionLowering::drop() {
  Result last = now_;
  now_ = {};
  if (!last.isDefined() || last.variable != nullptr || !calls(last.expr))
    return;
  if (last.expr->kind != ExprKind::Call)
    return keep(last);
  auto *node = arena_.make<CallStmt>();
  node->expr = last.expr;
  node->span = last.expr->span;
  emit(node);
}

/// Puts it into a variable, unless it is one already or a literal.
void InstructionLowering::keep(Result &result) {
  if (!result.isDefined() || result.variable != nullptr || result.expr->kind == ExprKind::Literal ||
      result.expr->kind == ExprKind::Error)
    return;
  result.variable = variable(result.expr->span);
  result.depth = 0;
  assignTo(result.variable, result.expr);
}

/// An expression of its own for each use of what was kept.
Expr *InstructionLowering::read(const Result &result) {
  if (result.variable != nullptr)
    return nameOf(result.variable, result.expr->span);
  if (result.expr->kind != ExprKind::Literal)
    return result.expr;
  auto *copy = arena_.make<Literal>();
  *copy = *as<Literal>(result.expr);
  return copy;
}

Expr *InstructionLowering::negation(const Instruction &one, Expr *expr) {
  auto *node = arena_.make<UnaryExpr>();
  node->op = UnaryOp::LogicalNot;
  node->operand = expr;
  node->span = expr->span.to(one.opSpan);
  return node;
}

// ---------------------------------------------------------------------------------------------
// statements

VarDecl *InstructionLowering::variable(Span span) {
  auto *node = arena_.make<VarDecl>();
  const std::string_view spelling = arena_.copy(prefix_ + std::to_string(++made_));
  node->name = {interner_.intern(spelling), spelling, span};
  node->section = Section::Temp;
  node->type = arena_.make<TypeExpr>();
  node->type->kind = TypeExprKind::Inferred;
  node->type->span = span;
  variables_.push_back(node);
  return node;
}

Expr *InstructionLowering::nameOf(const VarDecl *variable, Span span) {
  auto *node = arena_.make<NameExpr>();
  node->name = variable->name;
  node->name.span = span;
  node->span = span;
  return node;
}

void InstructionLowering::assign(Expr *target, Expr *value, const Instruction &one, AssignOp op) {
  auto *node = arena_.make<AssignStmt>();
  node->op = op;
  node->opSpan = one.opSpan;
  node->targets = arena_.copy(std::vector<Expr *>{target});
  node->value = value;
  node->span = one.span;
  emit(node);
}

void InstructionLowering::assignTo(const VarDecl *variable, Expr *value) {
  auto *node = arena_.make<AssignStmt>();
  node->opSpan = node->span = value->span;
  node->targets = arena_.copy(std::vector<Expr *>{nameOf(variable, value->span)});
  node->value = value;
  out_->push_back(node);
}

/// What waits in front of a parenthesis was evaluated before the statements inside of it.
void InstructionLowering::emit(Stmt *stmt) {
  for (Open &open : open_)
    keep(open.left);
  out_->push_back(stmt);
}

/// Without condition the statement alone.
void InstructionLowering::emitIf(const Instruction &one, Expr *condition, Stmt *stmt) {
  if (condition == nullptr)
    return emit(stmt);
  IfBranch branch;
  branch.condition = one.op->negated ? negation(one, condition) : condition;
  branch.body = arena_.copy(std::vector<Stmt *>{stmt});
  auto *node = arena_.make<IfStmt>();
  node->branches = arena_.copy(std::vector<IfBranch>{branch});
  node->span = one.span;
  emit(node);
}

} // namespace stc
