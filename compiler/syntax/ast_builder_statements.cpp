#include "compiler/syntax/ast_builder.hpp"

#include <string>

namespace stc {

using namespace ast;

namespace {

bool isCompound(const Stmt *statement) {
  switch (statement->kind) {
  case StmtKind::ifS:
  case StmtKind::caseS:
  case StmtKind::forS:
  case StmtKind::whileS:
  case StmtKind::repeatS:
    return true;
  default:
    return false;
  }
}

} // namespace

void AstBuilder::statements(Grammar::StatementsContext *context, std::vector<Stmt *> &out) {
  for (std::size_t i = 0; i < context->children.size(); ++i) {
    Stmt *node = statement(child(context, i));
    if (node == nullptr)
      continue;
    // The `;` behind END_IF and the like belongs to it.
    if (node->kind == StmtKind::empty && !out.empty() && isCompound(out.back()) &&
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

Stmt *AstBuilder::statement(Context *context) {
  if (failed(context))
    return nullptr;
  if (context->children.empty()) {
    auto *node = arena_.make<Stmt>();
    node->span = span(context);
    switch (token(first(context)).type) {
    case Tok::EXIT:
      node->kind = StmtKind::exit;
      break;
    case Tok::RETURN:
      node->kind = StmtKind::returnS;
      break;
    case Tok::CONTINUE:
      node->kind = StmtKind::continueS;
      break;
    default:
      node->kind = StmtKind::empty;
      break;
    }
    return node;
  }
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
  case Grammar::RuleWhileStatement: {
    auto *node = arena_.make<WhileStmt>();
    node->kind = StmtKind::whileS;
    node->span = span(inner);
    node->condition = condition(child(inner, 0));
    node->body = block(child(inner, 1));
    return node;
  }
  default: {
    auto *node = arena_.make<RepeatStmt>();
    node->kind = StmtKind::repeatS;
    node->span = span(inner);
    node->body = block(child(inner, 0));
    node->until = condition(child(inner, 1));
    return node;
  }
  }
}

bool AstBuilder::checkTarget(const Expr *target) {
  if (target->kind == ExprKind::error)
    return true;
  const bool good = !target->parenthesized &&
                    (target->kind == ExprKind::name || target->kind == ExprKind::member ||
                     target->kind == ExprKind::index || target->kind == ExprKind::deref);
  if (!good)
    diagnostics_.report(Code::invalidTarget, target->span, "this cannot be assigned to",
                        target->kind == ExprKind::call ? "the result of a call" : "not a variable");
  return good;
}

Stmt *AstBuilder::simpleStatement(Context *context) {
  Context *left = child(context, 0);
  const Token &sign = token(last(left) + 1);
  Expr *front = operand(left, Place::value);
  const std::size_t count = context->children.size();
  if (count == 1) {
    if (front->kind != ExprKind::call) {
      if (front->kind != ExprKind::error) {
        Diagnostic &d =
            diagnostics_.report(Code::notAStatement, front->span, "this expression does nothing",
                                "neither an assignment nor a call");
        if (front->kind == ExprKind::name || front->kind == ExprKind::member)
          d.help("a call needs parentheses: `" + std::string(text(token(last(left)))) + "()`");
      }
      return nullptr;
    }
    auto *node = arena_.make<CallStmt>();
    node->kind = StmtKind::call;
    node->span = front->span;
    node->expr = front;
    return node;
  }
  auto *node = arena_.make<AssignStmt>();
  node->kind = StmtKind::assign;
  node->opSpan = span(sign);
  switch (sign.type) {
  case Tok::SET_ASSIGN:
    node->op = AssignOp::set;
    break;
  case Tok::RESET_ASSIGN:
    node->op = AssignOp::reset;
    break;
  case Tok::REF_ASSIGN:
    node->op = AssignOp::reference;
    break;
  case Tok::EQUAL:
    if (!sign.reported) {
      diagnostics_
          .report(Code::equalForAssign, span(sign), "`=` compares, it does not assign",
                  "expected `:=`")
          .help("write `:=` to assign a value");
    }
    break;
  default:
    break;
  }
  bool good = checkTarget(front);
  std::vector<Expr *> targets{front};
  for (std::size_t i = 1; i + 1 < count; ++i) {
    targets.push_back(expression(child(context, i)));
    good = checkTarget(targets.back()) && good;
  }
  node->value = expression(child(context, count - 1));
  node->targets = arena_.copy(targets);
  node->span = front->span.to(node->value->span);
  return good ? node : nullptr;
}

Expr *AstBuilder::condition(Context *context) {
  if (failed(context) || context->children.empty())
    return error(span(context));
  Expr *node = expression(child(context, 0));
  if (context->children.size() == 1)
    return node;
  const Token &sign = token(last(child(context, 0)) + 1);
  diagnostics_
      .report(Code::assignInCondition, span(sign), "`:=` assigns, it does not compare",
              "expected `=`")
      .help("write `=` to compare");
  return error(span(context));
}

Stmt *AstBuilder::ifStatement(Context *context) {
  auto *node = arena_.make<IfStmt>();
  node->kind = StmtKind::ifS;
  node->span = span(context);
  const std::size_t count = context->children.size();
  std::vector<IfBranch> branches;
  branches.reserve(count / 2);
  std::size_t i = 0;
  for (; i + 1 < count; i += 2) {
    IfBranch branch;
    branch.condition = condition(child(context, i));
    branch.body = block(child(context, i + 1));
    branches.push_back(branch);
  }
  node->branches = arena_.copy(branches);
  if (i < count) {
    node->hasElse = true;
    node->elseBody = block(child(context, i));
  }
  return node;
}

Stmt *AstBuilder::caseStatement(Context *context) {
  auto *node = arena_.make<CaseStmt>();
  node->kind = StmtKind::caseS;
  node->span = span(context);
  node->selector = condition(child(context, 0));
  std::vector<CaseBranch> branches;
  for (std::size_t i = 1; i < context->children.size(); ++i) {
    Context *part = child(context, i);
    if (part->getRuleIndex() != Grammar::RuleCaseBranch) {
      node->hasElse = true;
      node->elseBody = block(part);
      continue;
    }
    CaseBranch branch;
    std::vector<CaseLabel> labels;
    Context *list = child(part, 0);
    for (std::size_t k = 0; !failed(list) && k < list->children.size(); ++k) {
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
  node->kind = StmtKind::forS;
  node->span = span(context);
  Context *control = child(context, 0);
  if (failed(control)) {
    node->variable = node->from = node->to = error(span(control));
  } else {
    node->variable = operand(child(control, 0), Place::value);
    if (!checkTarget(node->variable))
      node->variable = error(node->variable->span);
    node->from = expression(child(control, 1));
    node->to = expression(child(control, 2));
    if (control->children.size() > 3)
      node->by = expression(child(control, 3));
  }
  node->body = block(child(context, 1));
  return node;
}

} // namespace stc
