#include "compiler/syntax/chart_nodes.hpp"

#include "compiler/syntax/attributes.hpp"

namespace stc {

using namespace ast;

Name ChartNodes::name(const std::string &text, Span span) {
  const std::string_view kept = arena_.copy(std::string_view(text));
  return {interner_.intern(kept), kept, span};
}

Expr *ChartNodes::variable(const Name &of) {
  auto *node = arena_.make<NameExpr>();
  node->name = of;
  node->span = of.span;
  if (of.span.end - of.span.begin != of.text.size())
    node->name.span = {}; // another word stands there: this is no use of the name
  return node;
}

Expr *ChartNodes::member(const Name &of, const char *field, Span span) {
  auto *node = arena_.make<MemberExpr>();
  node->base = variable({of.id, of.text, span});
  node->name = name(field, {});
  node->span = span;
  return node;
}

Expr *ChartNodes::boolean(bool value, Span span) {
  auto *node = arena_.make<Literal>();
  node->literal = LiteralKind::Boolean;
  node->integer = value ? 1 : 0;
  node->text = value ? "TRUE" : "FALSE";
  node->span = span;
  return node;
}

Expr *ChartNodes::text(const Name &of) {
  auto *node = arena_.make<Literal>();
  node->literal = LiteralKind::String;
  node->text = of.text;
  node->span = of.span;
  return node;
}

Expr *ChartNodes::noTime(Span span) {
  auto *node = arena_.make<Literal>();
  node->literal = LiteralKind::Time;
  node->text = "T#0ms";
  node->span = span;
  return node;
}

Expr *ChartNodes::binary(BinaryOp op, Expr *left, Expr *right) {
  auto *node = arena_.make<BinaryExpr>();
  node->op = op;
  node->left = left;
  node->right = right;
  node->span = left->span;
  node->opSpan = left->span;
  return node;
}

Expr *ChartNodes::negated(Expr *operand) {
  auto *node = arena_.make<UnaryExpr>();
  node->op = UnaryOp::LogicalNot;
  node->operand = operand;
  node->span = operand->span;
  return node;
}

Expr *ChartNodes::combined(BinaryOp op, Expr *const *operands, size_t count) {
  if (count == 1)
    return *operands;
  return binary(op, combined(op, operands, count / 2),
                combined(op, operands + count / 2, count - count / 2));
}

Expr *ChartNodes::combined(BinaryOp op, const std::vector<Expr *> &operands) {
  return operands.empty() ? nullptr : combined(op, operands.data(), operands.size());
}

Stmt *ChartNodes::empty(Span span) {
  auto *node = arena_.make<Stmt>();
  node->span = span;
  return node;
}

Stmt *ChartNodes::assign(Expr *target, Expr *value) {
  auto *node = arena_.make<AssignStmt>();
  node->targets = arena_.copy(std::vector<Expr *>{target});
  node->value = value;
  node->span = target->span;
  node->opSpan = target->span;
  return node;
}

Stmt *ChartNodes::when(Expr *condition, const Statements &then, const Statements &otherwise) {
  auto *node = arena_.make<IfStmt>();
  IfBranch branch;
  branch.condition = condition;
  branch.body = arena_.copy(then);
  node->branches = arena_.copy(std::vector<IfBranch>{branch});
  node->hasElse = !otherwise.empty();
  node->elseBody = arena_.copy(otherwise);
  node->span = condition->span;
  return node;
}

Stmt *ChartNodes::call(const Name &callee, const std::vector<Argument> &arguments) {
  auto *expr = arena_.make<CallExpr>();
  expr->callee = variable(callee);
  expr->arguments = arena_.copy(arguments);
  expr->span = callee.span;
  auto *node = arena_.make<CallStmt>();
  node->expr = expr;
  node->span = callee.span;
  return node;
}

Argument ChartNodes::argument(const char *parameter, Expr *value) {
  Argument out;
  out.name = name(parameter, value->span);
  out.value = value;
  out.span = value->span;
  return out;
}

VarDecl *ChartNodes::declaration(const Name &what, const std::vector<const char *> &type,
                                 Section section) {
  auto *written = arena_.make<NamedTypeExpr>();
  std::vector<Name> path;
  path.reserve(type.size());
  for (const char *part : type)
    path.push_back(name(part, what.span));
  written->path = arena_.copy(path);
  written->span = what.span;
  auto *node = arena_.make<VarDecl>();
  node->name = what;
  node->section = section;
  node->type = written;
  return node;
}

void ChartNodes::hide(VarDecl *variable) {
  Attribute hide;
  hide.id = AttributeId::Hide;
  hide.name = "hide";
  hide.span = variable->name.span;
  variable->attributes = arena_.copy(std::vector<Attribute>{hide});
}

} // namespace stc
