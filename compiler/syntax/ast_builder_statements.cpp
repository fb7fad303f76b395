#include "compiler/syntax/ast_builder.hpp"

#include <string>

#include <algorithm>

namespace stc {

using namespace ast;

namespace {

bool isCompound(const Stmt *statement) {
  switch (statement->kind) {
  case StmtKind::If:
  case StmtKind::Case:
  case StmtKind::For:
  case StmtKind::While:
  case StmtKind::RepeatS:
  case StmtKind::Try:
    return true;
  default:
    return false;
  }
}

} // namespace

void AstBuilder::declarationInBody(const Name &variable) {
  diagnostics_
      .report(Code::DeclarationInBody, variable.span,
              "`" + std::string(variable.text) + "` is declared among the statements",
              "variables are declared before the first statement")
      .help("move it into VAR … END_VAR");
}

void AstBuilder::statements(Grammar::StatementsContext *context, std::vector<Stmt *> &out) {
  for (size_t i = 0; i < context->children.size(); ++i) {
    Stmt *node = statement(child(context, i));
    if (node == nullptr)
      continue;
    out.insert(out.end(), before_.begin(), before_.end());
    before_.clear();
    // `t : TON;` is no label with a statement that does nothing.
    if (node->kind == StmtKind::Call && as<CallStmt>(node)->expr->kind == ExprKind::Name &&
        !out.empty() && out.back()->kind == StmtKind::Label) {
      declarationInBody(as<LabelStmt>(out.back())->label);
      out.pop_back();
      continue;
    }
    // The `;` after END_IF and the like belongs to it.
    if (node->kind == StmtKind::Empty && !out.empty() && isCompound(out.back()) &&
        first(child(context, i)) != 0 &&
        token(first(child(context, i)) - 1).end == out.back()->span.end)
      continue;
    out.push_back(node);
  }
}

Block AstBuilder::block(Context *context) {
  std::vector<Stmt *> list;
  list.reserve(context->children.size());
  statements(static_cast<Grammar::StatementsContext *>(context), list);
  return arena_.copy(list);
}

/// `JMP name;` and `name:`; null: the name is missing.
Stmt *AstBuilder::jump(const Context *context) {
  const Token &start = token(first(context));
  const Token &target = token(first(context) + 1);
  if (target.type != Tok::IDENT || first(context) + 1 > last(context))
    return nullptr;
  if (start.type == Tok::JMP) {
    auto *node = arena_.make<JumpStmt>();
    node->label = name(target);
    node->span = span(start).to(node->label.span);
    return node;
  }
  auto *node = arena_.make<LabelStmt>();
  node->label = name(target);
  node->span = node->label.span;
  return node;
}

/// A statement that consists of tokens only.
Stmt *AstBuilder::wordStatement(const Context *context) {
  const uint16_t keyword = token(first(context)).type;
  if (keyword == Tok::JMP || keyword == Tok::JUMP_LABEL)
    return jump(context);
  auto *node = arena_.make<Stmt>();
  node->span = span(context);
  switch (keyword) {
  case Tok::EXIT:
    node->kind = StmtKind::Exit;
    break;
  case Tok::RETURN:
    node->kind = StmtKind::Return;
    break;
  case Tok::CONTINUE:
    node->kind = StmtKind::Continue;
    break;
  default:
    node->kind = StmtKind::Empty;
    break;
  }
  return node;
}

/// `RETURN(x)` is IF x THEN RETURN; END_IF.
Stmt *AstBuilder::conditionalReturn(Context *context) {
  auto *leave = arena_.make<Stmt>();
  leave->kind = StmtKind::Return;
  leave->span = span(context);
  IfBranch only = branch(child(context, 0));
  only.body = arena_.copy(std::vector<Stmt *>{leave});
  auto *node = arena_.make<IfStmt>();
  node->span = leave->span;
  node->branches = arena_.copy(std::vector<IfBranch>{only});
  return node;
}

Stmt *AstBuilder::statement(Context *context) {
  if (failed(context))
    return nullptr;
  if (context->children.empty())
    return wordStatement(context);
  Context *inner = child(context, 0);
  switch (inner->getRuleIndex()) {
  case Grammar::RuleSimpleStatement:
    return simpleStatement(inner);
  case Grammar::RuleIfStatement:
    return ifStatement(inner);
  case Grammar::RuleCaseStatement:
    return caseStatement(inner);
  case Grammar::RuleForStatement:
    return forStatement(inner);
  case Grammar::RuleTryStatement:
    return tryStatement(inner);
  case Grammar::RuleCondition:
    return conditionalReturn(context);
  case Grammar::RuleWhileStatement: {
    auto *node = arena_.make<WhileStmt>();
    node->span = span(inner);
    node->condition = condition(child(inner, 0));
    node->body = block(child(inner, 1));
    return node;
  }
  default: {
    auto *node = arena_.make<RepeatStmt>();
    node->span = span(inner);
    node->body = block(child(inner, 0));
    node->until = condition(child(inner, 1));
    return node;
  }
  }
}

Stmt *AstBuilder::assignment(AssignOp op, const Token &sign, const std::vector<Expr *> &targets,
                             Expr *value) {
  auto *node = arena_.make<AssignStmt>();
  node->op = op;
  node->opSpan = span(sign);
  node->value = value;
  node->targets = arena_.copy(targets);
  node->span = targets.front()->span.to(value->span);
  return node;
}

/// A call, or what looks like one.
Stmt *AstBuilder::withoutSign(Context *context) {
  const size_t count = context->children.size();
  // `a = b` as a statement is meant as an assignment.
  if (const Token &first = token(last(child(context, 0)) + 1);
      count > 1 && first.type == Tok::EQUAL) {
    if (!first.reported)
      diagnostics_
          .report(Code::EqualForAssign, span(first), "`=` compares, it does not assign",
                  "expected `:=`")
          .help("write `:=` to assign a value");
    return assignment(AssignOp::Assign, first, {operand(child(context, 0))},
                      flat(context, 1, count));
  }
  auto *node = arena_.make<CallStmt>();
  node->expr = flat(context, 0, count);
  node->span = node->expr->span;
  return node;
}

namespace {

AssignOp assignOpOf(uint16_t sign) {
  return sign == Tok::SET_ASSIGN     ? AssignOp::Set
         : sign == Tok::RESET_ASSIGN ? AssignOp::Reset
         : sign == Tok::REF_ASSIGN   ? AssignOp::Reference
                                     : AssignOp::Assign;
}

} // namespace

/// `a S= b R= x` is IF x THEN a S= TRUE; b R= TRUE; END_IF
Stmt *AstBuilder::mixedAssignment(const std::vector<Expr *> &targets,
                                  const std::vector<const Token *> &signs, Expr *value) {
  std::vector<Stmt *> body;
  for (size_t i = 0; i < targets.size(); ++i) {
    auto *yes = arena_.make<Literal>();
    yes->span = value->span;
    yes->literal = LiteralKind::Boolean;
    yes->integer = 1;
    yes->text = "TRUE";
    body.push_back(assignment(assignOpOf(signs[i]->type), *signs[i], {targets[i]}, yes));
  }
  auto *node = arena_.make<IfStmt>();
  node->span = targets.front()->span.to(value->span);
  IfBranch branch;
  branch.condition = value;
  branch.body = arena_.copy(body);
  node->branches = arena_.copy(std::vector<IfBranch>{branch});
  return node;
}

Stmt *AstBuilder::simpleStatement(Context *context) {
  const size_t count = context->children.size();
  size_t operands = 1;
  while (operands < count && child(context, operands)->getRuleIndex() == Grammar::RuleOperand)
    ++operands;
  if (operands == count)
    return withoutSign(context);
  const Token &sign = token(last(child(context, operands - 1)) + 1);
  std::vector<Expr *> targets{flat(context, 0, operands)};
  std::vector<const Token *> signs{&sign};
  for (size_t i = operands; i + 1 < count; ++i) {
    targets.push_back(expression(child(context, i)));
    signs.push_back(&token(last(child(context, i)) + 1));
  }
  Expr *value = expression(child(context, count - 1));
  const bool alike =
      std::all_of(signs.begin(), signs.end(), [&](const Token *s) { return s->type == sign.type; });
  return alike ? assignment(assignOpOf(sign.type), sign, targets, value)
               : mixedAssignment(targets, signs, value);
}

Expr *AstBuilder::condition(Context *context) {
  if (failed(context) || context->children.empty())
    return error(span(context));
  Expr *node = expression(child(context, 0));
  if (context->children.size() == 1)
    return node;
  const Token &sign = token(last(child(context, 0)) + 1);
  diagnostics_
      .report(Code::AssignInCondition, span(sign), "`:=` assigns, it does not compare",
              "expected `=`")
      .help("write `=` to compare");
  return error(span(context));
}

/// `x := y` with a place that is found twice without being evaluated twice.
bool AstBuilder::assignsCondition(Context *context) {
  if (failed(context) || context->children.size() != 2)
    return false;
  const Context *target = child(context, 0);
  for (size_t i = first(target); i <= last(target); ++i) {
    if (const uint16_t type = token(i).type;
        type != Tok::IDENT && type != Tok::DOT && type != Tok::CARET)
      return false;
  }
  return true;
}

/// A branch of IF without its body. Where its condition is assigned, the assignment goes into
/// `before_`.
IfBranch AstBuilder::branch(Context *context) {
  IfBranch out;
  if (!assignsCondition(context)) {
    out.condition = condition(context);
    return out;
  }
  const Token &sign = token(last(child(context, 0)) + 1);
  Stmt *assigned = assignment(AssignOp::Assign, sign, {expression(child(context, 0))},
                              expression(child(context, 1)));
  before_.push_back(assigned);
  out.assigned = as<AssignStmt>(assigned);
  out.condition = expression(child(context, 0));
  return out;
}

/// IF from its branch at `at` on. An ELSIF whose condition is assigned is an IF in ELSE.
IfStmt *AstBuilder::ifFrom(Context *context, size_t at) {
  auto *node = arena_.make<IfStmt>();
  node->span = at == 0 ? span(context) : span(child(context, at)).to(span(context));
  const size_t count = context->children.size();
  std::vector<IfBranch> branches;
  std::vector<Stmt *> before;
  branches.reserve(count / 2);
  size_t i = at;
  for (; i + 1 < count && (i == at || !assignsCondition(child(context, i))); i += 2) {
    IfBranch one = branch(child(context, i));
    before.insert(before.end(), before_.begin(), before_.end());
    before_.clear();
    one.body = block(child(context, i + 1));
    branches.push_back(one);
  }
  node->branches = arena_.copy(branches);
  node->hasElse = i < count;
  if (i + 1 < count) {
    IfStmt *rest = ifFrom(context, i);
    before_.push_back(rest);
    node->elseBody = arena_.copy(before_);
  } else if (i < count) {
    node->elseBody = block(child(context, i));
  }
  before_ = std::move(before);
  return node;
}

Stmt *AstBuilder::ifStatement(Context *context) { return ifFrom(context, 0); }

Stmt *AstBuilder::caseStatement(Context *context) {
  auto *node = arena_.make<CaseStmt>();
  node->span = span(context);
  node->selector = condition(child(context, 0));
  std::vector<CaseBranch> branches;
  for (size_t i = 1; i < context->children.size(); ++i) {
    Context *part = child(context, i);
    if (part->getRuleIndex() != Grammar::RuleCaseBranch) {
      node->hasElse = true;
      node->elseBody = block(part);
      continue;
    }
    CaseBranch branch;
    std::vector<CaseLabel> labels;
    Context *list = child(part, 0);
    for (size_t k = 0; !failed(list) && k < list->children.size(); ++k) {
      Context *one = child(list, k);
      CaseLabel label;
      label.span = span(one);
      label.low = expression(child(one, 0));
      if (one->children.size() > 1)
        label.high = expression(child(one, 1));
      labels.push_back(label);
    }
    if (labels.empty()) {
      CaseLabel label;
      label.span = span(list);
      label.low = error(label.span);
      labels.push_back(label);
    }
    branch.labels = arena_.copy(labels);
    branch.body = block(child(part, 1));
    branches.push_back(branch);
  }
  node->branches = arena_.copy(branches);
  return node;
}

Stmt *AstBuilder::forStatement(Context *context) {
  auto *node = arena_.make<ForStmt>();
  node->span = span(context);
  Context *control = child(context, 0);
  if (failed(control)) {
    node->variable = node->from = node->to = error(span(control));
  } else {
    node->variable = operand(child(control, 0));
    node->from = expression(child(control, 1));
    node->to = expression(child(control, 2));
    if (control->children.size() > 3)
      node->by = expression(child(control, 3));
  }
  node->body = block(child(context, 1));
  return node;
}

Stmt *AstBuilder::tryStatement(Context *context) {
  auto *node = arena_.make<TryStmt>();
  node->span = span(context);
  node->body = block(child(context, 0));
  for (size_t i = 1; i < context->children.size(); ++i) {
    Context *part = child(context, i);
    if (part->getRuleIndex() == Grammar::RuleOperand) {
      node->exception = operand(part);
      continue;
    }
    const bool isFinally = token(first(part) - 1).type == Tok::FINALLY;
    (isFinally ? node->hasFinally : node->hasCatch) = true;
    (isFinally ? node->finallyBody : node->catchBody) = block(part);
  }
  return node;
}

} // namespace stc
