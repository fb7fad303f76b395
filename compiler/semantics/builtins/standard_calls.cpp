// Standard functions that stand for operators, and those that look at bit patterns.

#include "compiler/semantics/builtins/internal.hpp"

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/builtins/builtin_calls.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/types/resolve.hpp"

namespace stc::sema {

using namespace ast;

static const Type *checkOrderCall(Context &c, CallExpr *expr);

namespace {

struct OperatorFunction {
  BinaryOp op;
  bool repeats = false;               ///< more than two arguments
  TypeKind duration = TypeKind::None; ///< of the first argument, where only that is allowed
};

OperatorFunction operatorOf(Builtin function) {
  switch (function) {
  case Builtin::Add:
    return {BinaryOp::Add, true};
  case Builtin::Subtract:
    return {BinaryOp::Subtract};
  case Builtin::Multiply:
    return {BinaryOp::Multiply, true};
  case Builtin::Divide:
    return {BinaryOp::Divide};
  case Builtin::Greater:
    return {BinaryOp::Greater, true};
  case Builtin::GreaterEqual:
    return {BinaryOp::GreaterEqual, true};
  case Builtin::Equal:
    return {BinaryOp::Equal, true};
  case Builtin::LessEqual:
    return {BinaryOp::LessEqual, true};
  case Builtin::Less:
    return {BinaryOp::Less, true};
  case Builtin::MultiplyTime:
    return {BinaryOp::Multiply, false, TypeKind::Time};
  case Builtin::MultiplyLtime:
    return {BinaryOp::Multiply, false, TypeKind::Ltime};
  case Builtin::DivideTime:
    return {BinaryOp::Divide, false, TypeKind::Time};
  case Builtin::DivideLtime:
    return {BinaryOp::Divide, false, TypeKind::Ltime};
  case Builtin::LogicalAnd:
    return {BinaryOp::LogicalAnd, true};
  case Builtin::LogicalOr:
    return {BinaryOp::LogicalOr, true};
  case Builtin::LogicalXor:
    return {BinaryOp::LogicalXor, true};
  case Builtin::Modulo:
    return {BinaryOp::Modulo};
  default:
    return {BinaryOp::NotEqual};
  }
}

/// What checkOperatorCall has made of a call.
bool isOperation(const CallExpr *expr) {
  return expr->arguments.size() == 1 && expr->arguments[0].value->kind == ExprKind::Binary &&
         as<BinaryExpr>(expr->arguments[0].value)->opSpan.begin == expr->callee->span.begin;
}

} // namespace

const Type *checkOperatorCall(Context &c, CallExpr *expr) {
  const Type *bad = elementaryType(TypeKind::Error);
  const OperatorFunction function = operatorOf(expr->builtin);
  if (isOperation(expr)) { // checked once more, for another expected type
    Expr *operation = expr->arguments[0].value;
    expr->builtin = Builtin::Move;
    return check(c, operation, nullptr);
  }
  if (expr->builtin >= Builtin::LogicalAnd && expr->arguments.size() < 2) {
    const std::string name(as<NameExpr>(expr->callee)->name.text);
    c.report(Code::WrongArgumentCount, expr->span,
             "`" + name + "` takes " + (function.repeats ? "at least " : "") + "2 arguments, not " +
                 std::to_string(expr->arguments.size()),
             "in this call")
        .help("as an operator it stands between its operands: `a " + name + " b`");
    return bad;
  }
  if (!requireCount(c, expr, 2, function.repeats ? SIZE_MAX : 2))
    return bad;
  const bool order = expr->builtin >= Builtin::Greater && expr->builtin <= Builtin::NotEqual;
  if (order && expr->arguments.size() > 2)
    return checkOrderCall(c, expr);
  // The call becomes the operator, so that all that is true of it holds here as well: it keeps one
  // argument, which is the operation.
  Expr *left = expr->arguments[0].value;
  for (size_t i = 1; i < expr->arguments.size(); ++i) {
    auto *operation = c.arena.make<BinaryExpr>();
    operation->span = expr->span;
    operation->parenthesized = true;
    operation->op = function.op;
    operation->opSpan = expr->callee->span;
    operation->left = left;
    operation->right = expr->arguments[i].value;
    left = operation;
  }
  const Type *type = check(c, left, nullptr);
  if (isError(type))
    return bad;
  if (function.duration != TypeKind::None) {
    const Type *first = underlying(expr->arguments[0].value->type);
    const Type *second = underlying(expr->arguments[1].value->type);
    if (first->kind != function.duration)
      return argumentError(c, expr, 0, typeName(elementaryType(function.duration)));
    if (!isInteger(second) && !isReal(second) && !isUntyped(second))
      return argumentError(c, expr, 1, "a number");
  }
  Argument operation;
  operation.value = left;
  operation.span = expr->span;
  expr->arguments = c.arena.copy(std::vector<Argument>{operation});
  expr->builtin = Builtin::Move;
  expr->common = left->common;
  expr->constant = left->constant;
  return type;
}

/// GT(a, b, c …): each in order with the next.
static const Type *checkOrderCall(Context &c, CallExpr *expr) {
  const Type *bad = elementaryType(TypeKind::Error);
  bool failed = false;
  for (Argument &a : expr->arguments)
    failed = isError(check(c, a.value)) || failed;
  if (failed)
    return bad;
  for (size_t i = 0; i < expr->arguments.size(); ++i) {
    Expr *value = expr->arguments[i].value;
    if (refuseOpenArray(c, value, "use") || refuseStrict(c, value))
      return bad;
    const Type *type = underlying(value->type);
    if (!isElementary(type) && !isUntyped(type))
      return argumentError(c, expr, i, "a value that can be compared");
  }
  if (isError(commonOfArguments(c, expr, 0)))
    return bad;
  expr->common = nullptr;
  return elementaryType(TypeKind::Boolean);
}

const Type *checkPatternCall(Context &c, CallExpr *expr) {
  const Type *bad = elementaryType(TypeKind::Error);
  if (!requireCount(c, expr, 1, 1))
    return bad;
  Expr *value = expr->arguments[0].value;
  const Type *type = underlying(value->type);
  const Type *boolean = elementaryType(TypeKind::Boolean);
  if (expr->builtin == Builtin::IsValid) {
    if (!isReal(type) && type->kind != TypeKind::AnyReal)
      return argumentError(c, expr, 0, "REAL or LREAL");
    if (isUntyped(type))
      settle(value);
    return boolean;
  }
  if (expr->builtin == Builtin::IsValidBcd) {
    if (type->kind == TypeKind::AnyInteger)
      coerce(c, value, elementaryType(TypeKind::Lword), "the argument of IS_VALID_BCD");
    else if (!isBitString(type))
      return argumentError(c, expr, 0, "a bit string");
    return boolean;
  }
  if (!isElementary(type) || isString(type) || isUntyped(type))
    return argumentError(c, expr, 0, "a number, a bit string or a time with a type of its own");
  setTarget(value, type);
  return type;
}

bool checkSpecialArgument(Context &c, CallExpr *expr) {
  Expr *value = expr->arguments[0].value;
  const Type *type = underlying(value->type);
  const bool cut = expr->builtin == Builtin::Trunc;
  if (cut                               ? isReal(type) || type->kind == TypeKind::AnyReal
      : expr->builtin == Builtin::ToBcd ? isUnsignedInteger(type)
                                        : isBitString(type))
    return true;
  if (!cut && type->kind == TypeKind::AnyInteger) {
    coerce(c, value,
           elementaryType(expr->builtin == Builtin::ToBcd ? TypeKind::Ulint : TypeKind::Lword),
           "the argument");
    return value->target != nullptr;
  }
  argumentError(c, expr, 0,
                cut                               ? "REAL or LREAL"
                : expr->builtin == Builtin::ToBcd ? "an unsigned integer"
                                                  : "a bit string");
  return false;
}

} // namespace stc::sema
