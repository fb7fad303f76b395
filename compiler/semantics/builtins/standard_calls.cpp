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

/// What checkOperatorFunction has made of a call.
bool isOperation(const CallExpr *expr) {
  return expr->arguments.size() == 1 && expr->arguments[0].value->kind == ExprKind::Binary &&
         as<BinaryExpr>(expr->arguments[0].value)->opSpan.begin == expr->callee->span.begin;
}

} // namespace

/// Reports too few or too many arguments.
static bool requireOperands(Context &c, CallExpr *expr, const OperatorFunction &function) {
  if (!function.isWord || expr->arguments.size() >= 2)
    return requireCount(c, expr);
  const std::string name(as<NameExpr>(expr->callee)->name.text);
  const bool repeats = builtinRow(expr->builtin).takes.most > 2;
  c.report(Code::WrongArgumentCount, expr->span,
           "`" + name + "` takes " + (repeats ? "at least " : "") + "2 arguments, not " +
               std::to_string(expr->arguments.size()),
           "in this call")
      .help("as an operator it stands between its operands: `a " + name + " b`");
  return false;
}

/// `a + b + …` of the arguments
static BinaryExpr *operationOf(Context &c, CallExpr *expr, BinaryOp op) {
  Expr *left = expr->arguments[0].value;
  BinaryExpr *operation = nullptr;
  for (size_t i = 1; i < expr->arguments.size(); ++i) {
    operation = c.arena.make<BinaryExpr>();
    operation->span = expr->span;
    operation->parenthesized = true;
    operation->op = op;
    operation->opSpan = expr->callee->span;
    operation->left = left;
    operation->right = expr->arguments[i].value;
    left = operation;
  }
  return operation;
}

const Type *checkOperatorFunction(Context &c, CallExpr *expr, const OperatorFunction &function) {
  const Type *bad = elementaryType(TypeKind::Error);
  if (isOperation(expr)) { // checked once more, for another expected type
    Expr *operation = expr->arguments[0].value;
    expr->builtin = Builtin::Move;
    return check(c, operation, nullptr);
  }
  if (!requireOperands(c, expr, function))
    return bad;
  if (isComparison(function.op) && expr->arguments.size() > 2)
    return checkOrderCall(c, expr);
  // The call becomes the operator, so that all that is true of it holds here as well: it keeps one
  // argument, which is the operation.
  Expr *whole = operationOf(c, expr, function.op);
  const Type *type = check(c, whole, nullptr);
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
  operation.value = whole;
  operation.span = expr->span;
  expr->arguments = c.arena.copy(std::vector<Argument>{operation});
  expr->builtin = Builtin::Move;
  expr->common = whole->common;
  expr->constant = whole->constant;
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

const Type *checkIsValid(Context &c, CallExpr *expr) {
  const Type *kind = kindOf(expr, 0);
  if (!isReal(kind) && kind->kind != TypeKind::AnyReal)
    return argumentError(c, expr, 0, "REAL or LREAL");
  settledKindOf(expr, 0);
  return elementaryType(TypeKind::Boolean);
}

const Type *checkIsValidBcd(Context &c, CallExpr *expr) {
  const Type *kind = kindOf(expr, 0);
  if (kind->kind == TypeKind::AnyInteger)
    coerce(c, valueOf(expr, 0), elementaryType(TypeKind::Lword), "the argument of IS_VALID_BCD");
  else if (!isBitString(kind))
    return argumentError(c, expr, 0, "a bit string");
  return elementaryType(TypeKind::Boolean);
}

const Type *checkByteOrder(Context &c, CallExpr *expr) {
  const Type *kind = kindOf(expr, 0);
  if (!isElementary(kind) || isString(kind) || isUntyped(kind))
    return argumentError(c, expr, 0, "a number, a bit string or a time with a type of its own");
  setTarget(valueOf(expr, 0), kind);
  return kind;
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
