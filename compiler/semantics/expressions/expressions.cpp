// Expressions: from the node to the function that checks it.

#include "compiler/semantics/expressions/expressions.hpp"

#include "compiler/semantics/calls/calls.hpp"
#include "compiler/semantics/config/config.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/expressions/internal.hpp"
#include "compiler/source/stack.hpp"

namespace stc::sema {

using namespace ast;

std::optional<int64_t> constantInteger(Context &c, Expr *expr, std::string_view what) {
  const Type *type = check(c, expr);
  if (isError(type))
    return std::nullopt;
  if (expr->constant == nullptr || expr->constant->kind != ConstKind::Integer ||
      !(type->kind == TypeKind::AnyInteger || isInteger(underlying(type)))) {
    c.report(Code::NotConstant, expr->span, std::string(what) + " must be an integer constant",
             expr->constant == nullptr ? "its value is only known at run time"
                                       : "this is " + typeName(type))
        .help("use a literal, or a variable declared in VAR CONSTANT or VAR_GLOBAL CONSTANT");
    return std::nullopt;
  }
  if (type->kind == TypeKind::AnyInteger)
    settle(expr);
  return expr->constant->integer;
}

/// What is in brackets is no value: a list, or an assignment.
static void reportAggregate(Context &c, const AggregateExpr *expr, const Type *expected) {
  const bool hasFields =
      expected != nullptr && (expected->kind == TypeKind::Structure || isInstance(expected));
  if (expr->items.empty())
    c.report(Code::UnexpectedToken, expr->span, "expected an expression between the parentheses");
  else if (expr->isStruct && expr->items.size() == 1 && !hasFields)
    c.report(Code::AssignInCondition, expr->span,
             "`:=` assigns: an assignment is no part of an expression", "this has no value here")
        .help("write `=` to compare, or assign in a statement of its own before and use `" +
              std::string(expr->items.front().field.text) + "` here");
  else
    c.report(Code::AggregateNotAllowed, expr->span, "a list of values can only be an initial value",
             "not an expression")
        .help("assign the elements one by one");
}

const Type *check(Context &c, Expr *expr, const Type *expected) {
  if (expected != nullptr && expected->kind == TypeKind::Subrange)
    expected = typeAs<SubrangeType>(expected)->base;
  const Type *type = elementaryType(TypeKind::Error);
  if (stackIsShort(c.stackEnd)) { // constants in the values of constants add up
    c.report(Code::TooDeep, expr->span, "this depends on too many other declarations",
             "one leads to the next");
    expr->type = type;
    return type;
  }
  switch (expr->kind) {
  case ExprKind::Literal:
    type = checkLiteral(c, as<Literal>(expr));
    break;
  case ExprKind::Name:
    type = checkName(c, as<NameExpr>(expr), expected);
    break;
  case ExprKind::Member:
    type = checkMember(c, as<MemberExpr>(expr));
    break;
  case ExprKind::Index:
    type = checkIndex(c, as<IndexExpr>(expr));
    break;
  case ExprKind::Deref:
    type = checkDeref(c, as<DerefExpr>(expr));
    break;
  case ExprKind::Call: {
    type = checkCall(c, as<CallExpr>(expr), false);
    break;
  }
  case ExprKind::Unary:
    type = checkUnary(c, as<UnaryExpr>(expr), expected);
    break;
  case ExprKind::Binary:
    type = checkBinary(c, as<BinaryExpr>(expr), expected);
    break;
  case ExprKind::EnumLiteral:
    type = checkEnumLiteral(c, as<EnumLiteralExpr>(expr));
    break;
  case ExprKind::Aggregate:
    reportAggregate(c, as<AggregateExpr>(expr), expected);
    break;
  case ExprKind::Direct:
    type = checkDirect(c, as<DirectExpr>(expr));
    break;
  case ExprKind::TypeName:
    c.report(Code::NotAVariable, expr->span, "a type is not a value", "a type stands here");
    break;
  case ExprKind::Error:
    break;
  }
  expr->type = type;
  return type;
}

void checkAs(Context &c, Expr *expr, const Type *type, std::string_view what) {
  check(c, expr, type);
  coerce(c, expr, type, what);
}

void checkCondition(Context &c, Expr *expr, std::string_view what) {
  const Type *boolean = elementaryType(TypeKind::Boolean);
  const Type *type = check(c, expr, boolean);
  if (isError(type) || type == boolean)
    return;
  auto &d =
      c.report(Code::ConditionNotBool, expr->span,
               std::string(what) + " must be BOOL, this is " + typeName(type), "expected BOOL");
  if (isInteger(underlying(type)) || isReal(type) || type->kind == TypeKind::AnyInteger ||
      type->kind == TypeKind::Pointer) {
    const Span behind{expr->span.file, expr->span.end, expr->span.end};
    const std::string_view text = c.program.sources.text(expr->span);
    d.suggest("compare it with a value: `" + (text.size() <= 40 ? std::string(text) : "…") +
                  " <> 0`",
              behind, " <> 0");
  }
}

const Type *checkTarget(Context &c, Expr *expr) {
  const ModeGuard target(c.assignTarget, static_cast<const Expr *>(expr));
  return check(c, expr);
}

} // namespace stc::sema
