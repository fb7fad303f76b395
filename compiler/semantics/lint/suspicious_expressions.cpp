// Comparisons, shifts and conversions whose outcome is known or surprising.

#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/lint/internal.hpp"

#include <cmath>

namespace stc::lint {

using namespace ast;

namespace {

bool isWhole(const Type *t) {
  return isInteger(t) || t->kind == TypeKind::Subrange || t->kind == TypeKind::AnyInteger;
}

std::string upperName(const Type *t) {
  std::string name = typeName(underlying(t));
  for (char &c : name)
    c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return name;
}

/// The comparison with its sides exchanged.
BinaryOp mirrored(BinaryOp op) {
  switch (op) {
  case BinaryOp::Less:
    return BinaryOp::Greater;
  case BinaryOp::LessEqual:
    return BinaryOp::GreaterEqual;
  case BinaryOp::Greater:
    return BinaryOp::Less;
  case BinaryOp::GreaterEqual:
    return BinaryOp::LessEqual;
  default:
    return op;
  }
}

/// What `x op value` gives for every x of the range, when it is always the same.
std::optional<bool> decided(BinaryOp op, const ValueRange &x, int64_t value) {
  switch (op) {
  case BinaryOp::Equal:
    return value < x.low || value > x.high ? std::optional(false) : std::nullopt;
  case BinaryOp::NotEqual:
    return value < x.low || value > x.high ? std::optional(true) : std::nullopt;
  case BinaryOp::Less:
    return x.high < value   ? std::optional(true)
           : x.low >= value ? std::optional(false)
                            : std::nullopt;
  case BinaryOp::LessEqual:
    return x.high <= value ? std::optional(true)
           : x.low > value ? std::optional(false)
                           : std::nullopt;
  case BinaryOp::Greater:
    return x.low > value     ? std::optional(true)
           : x.high <= value ? std::optional(false)
                             : std::nullopt;
  case BinaryOp::GreaterEqual:
    return x.low >= value   ? std::optional(true)
           : x.high < value ? std::optional(false)
                            : std::nullopt;
  default:
    return std::nullopt;
  }
}

/// A division of integers on which the value depends, below `+`, `-`, `*` and signs.
const BinaryExpr *integerDivision(const Expr *expr) {
  for (;;) {
    if (expr->kind == ExprKind::Unary) {
      expr = as<UnaryExpr>(expr)->operand;
      continue;
    }
    if (expr->kind != ExprKind::Binary)
      return nullptr;
    const auto *b = as<BinaryExpr>(expr);
    if (b->op == BinaryOp::Divide) {
      const bool exact = b->left->constant != nullptr && b->right->constant != nullptr &&
                         b->right->constant->integer != 0 &&
                         b->left->constant->integer % b->right->constant->integer == 0;
      return exact ? nullptr : b;
    }
    if (b->op != BinaryOp::Add && b->op != BinaryOp::Subtract && b->op != BinaryOp::Multiply)
      return nullptr;
    if (b->right->kind == ExprKind::Binary || b->right->kind == ExprKind::Unary)
      if (const BinaryExpr *found = integerDivision(b->right))
        return found;
    expr = b->left;
  }
}

} // namespace

namespace {

/// All values of an integer type of up to 63 bits, of LINT too.
std::optional<ValueRange> typeRange(const Type *type) {
  if (type->kind == TypeKind::AnyInteger || type->kind == TypeKind::Ulint ||
      type->kind == TypeKind::Lword)
    return std::nullopt;
  const unsigned bits = bitWidth(type);
  if (isSignedInteger(type))
    return ValueRange{bits == 64 ? INT64_MIN : -(int64_t{1} << (bits - 1)),
                      bits == 64 ? INT64_MAX : (int64_t{1} << (bits - 1)) - 1};
  return ValueRange{0, (int64_t{1} << bits) - 1};
}

} // namespace

std::optional<ValueRange> valueRange(const Expr *expr) {
  if (expr->type == nullptr || !isWhole(expr->type) || expr->constant != nullptr)
    return std::nullopt;
  if (expr->kind == ExprKind::Binary) {
    const auto *b = as<BinaryExpr>(expr);
    const ConstValue *right = b->right->constant;
    if (right != nullptr && right->kind == ConstKind::Integer && right->integer > 0 &&
        b->left->type != nullptr && isWhole(b->left->type)) {
      const std::optional<ValueRange> left = valueRange(b->left);
      const bool negative = !left || left->low < 0;
      if (b->op == BinaryOp::Modulo)
        return ValueRange{negative ? 1 - right->integer : 0, right->integer - 1};
      if (b->op == BinaryOp::LogicalAnd)
        return ValueRange{0, right->integer};
    }
  }
  const Type *type = expr->type;
  if (type->kind == TypeKind::Subrange) {
    const auto *sub = typeAs<SubrangeType>(type);
    if (bitWidth(sub) == 64)
      return std::nullopt;
    return ValueRange{sub->low, sub->high};
  }
  return typeRange(type);
}

void comparison(Context &c, const BinaryExpr *expr) {
  const bool equality = expr->op == BinaryOp::Equal || expr->op == BinaryOp::NotEqual;
  if (expr->operandType != nullptr && isReal(expr->operandType)) {
    const auto isZero = [](const Expr *e) {
      return e->constant != nullptr &&
             (e->constant->kind == ConstKind::Real ? std::fpclassify(e->constant->real) == FP_ZERO
                                                   : e->constant->integer == 0);
    };
    if (equality && expr->constant == nullptr && !isZero(expr->left) && !isZero(expr->right) &&
        !sameExpr(expr->left, expr->right))
      report(c, Code::RealEquality, expr->opSpan,
             typeName(expr->operandType) + " values are compared for equality",
             "rounding makes equal results differ")
          .help("ask whether they are close enough: `ABS(" + text(c, expr->left->span) + " - " +
                text(c, expr->right->span) + ") < 0.001`");
    return;
  }
  const bool constantLeft = expr->left->constant != nullptr;
  if (constantLeft == (expr->right->constant != nullptr))
    return;
  const Expr *constant = constantLeft ? expr->left : expr->right;
  const Expr *other = constantLeft ? expr->right : expr->left;
  if (other->type == nullptr || constant->type == nullptr ||
      constant->constant->kind != ConstKind::Integer)
    return;
  const bool isFalse = constant->constant->integer == 0;
  if (other->type->kind == TypeKind::Boolean) {
    if (!equality || !isLiteral(constant))
      return;
    const bool negated = (expr->op == BinaryOp::Equal) == isFalse;
    const std::string name = text(c, other->span);
    const bool simple = other->kind != ExprKind::Binary || other->parenthesized;
    report(c, Code::BoolCompared, expr->span,
           "a BOOL need not be compared with " + text(c, constant->span),
           "says the same as `" + std::string(negated ? "NOT " : "") + name + "`")
        .suggest("write `" + std::string(negated ? "NOT " : "") + name + "`", expr->span,
                 (negated ? simple ? "NOT " : "NOT (" : "") +
                     std::string(c.program.sources.text(other->span)) +
                     (negated && !simple ? ")" : ""));
    return;
  }
  if (isUnsigned64(constant->type))
    return;
  const BinaryOp op = constantLeft ? mirrored(expr->op) : expr->op;
  std::optional<ValueRange> range = valueRange(other);
  if (!range && isUnsigned64(other->type) && constant->constant->integer <= 0)
    range = ValueRange{0, INT64_MAX};
  if (!range)
    return;
  const std::optional<bool> outcome = decided(op, *range, constant->constant->integer);
  if (!outcome)
    return;
  const bool whole64 = range->high == INT64_MAX;
  report(c, Code::ComparisonAlways, expr->span,
         "this comparison is always " + std::string(*outcome ? "TRUE" : "FALSE"),
         whole64 ? "`" + text(c, other->span) + "` is never below 0"
                 : "`" + text(c, other->span) + "` is " + std::to_string(range->low) + " to " +
                       std::to_string(range->high))
      .note("`" + text(c, other->span) + "` is of type " + typeName(other->type));
}

void sameOperands(Context &c, const BinaryExpr *expr) {
  if (expr->constant != nullptr || expr->op == BinaryOp::Add || expr->op == BinaryOp::Multiply ||
      expr->op == BinaryOp::Power || expr->operandType == nullptr ||
      isReal(expr->operandType) || // x <> x asks for NaN
      !sameExpr(expr->left, expr->right))
    return;
  report(c, Code::SameOperands, expr->span, "both sides of this operator are the same",
         "`" + text(c, expr->left->span) + "` on both sides")
      .help("did you mean another variable on one side?");
}

void shift(Context &c, const CallExpr *expr) {
  if (expr->arguments.size() != 2 || expr->type == nullptr)
    return;
  const Expr *count = expr->arguments[1].value;
  const Expr *value = expr->arguments[0].value;
  if (count == nullptr || value == nullptr || count->constant == nullptr ||
      count->constant->kind != ConstKind::Integer || !isWhole(expr->type) ||
      expr->type->kind == TypeKind::AnyInteger)
    return;
  const int64_t n = count->constant->integer;
  const auto bits = static_cast<int64_t>(bitWidth(expr->type));
  if (n >= 0 && n < bits)
    return;
  report(c, Code::ShiftCount, count->span,
         n < 0 ? std::string("a shift by a negative count")
               : typeName(expr->type) + " has only " + std::to_string(bits) + " bits",
         n < 0 ? "counts are 0 to " + std::to_string(bits - 1) : "shifts out all of them")
      .help(n < 0 ? "shift in the other direction with SHL or SHR"
                  : "convert the value to a wider type first");
}

void saturation(Context &c, const CallExpr *expr) {
  if (expr->type == nullptr || !isInteger(expr->type) || expr->arguments.size() != 1)
    return;
  const Expr *value = expr->arguments[0].value;
  if (value == nullptr || value->constant == nullptr || value->constant->kind != ConstKind::Real)
    return;
  const bool cuts = expr->builtin == Builtin::Trunc;
  const double whole = cuts ? std::trunc(value->constant->real) : std::round(value->constant->real);
  const std::optional<ValueRange> range = typeRange(expr->type);
  const bool below = range ? whole < static_cast<double>(range->low) : whole < 0;
  // 2^63 and 2^64 are doubles, the largest LINT and ULINT are not.
  const bool above = !range                     ? whole >= 18446744073709551616.0
                     : range->high == INT64_MAX ? whole >= 9223372036854775808.0
                                                : whole > static_cast<double>(range->high);
  if (!below && !above)
    return;
  const std::string low = range ? std::to_string(range->low) : "0";
  const std::string high = range ? std::to_string(range->high) : std::to_string(UINT64_MAX);
  report(c, Code::ConstantSaturates, value->span,
         "`" + text(c, value->span) + "` is outside of " + typeName(expr->type),
         "becomes " + (below ? low : high))
      .note(typeName(expr->type) + " holds " + low + " to " + high)
      .help("convert to a wider type, or use a value that fits");
}

void conversion(Context &c, const Expr *expr) {
  const Type *target = expr->target;
  if (target == nullptr || !isReal(target) || expr->type == nullptr || !isWhole(expr->type))
    return;
  if (const BinaryExpr *division = integerDivision(expr)) {
    const Expr *operand = division->left;
    const bool literal = isLiteral(operand);
    const std::string name = text(c, operand->span);
    auto &d = report(c, Code::IntegerDivision, division->span,
                     "this division of integers drops the fraction, although a " +
                         typeName(target) + " takes the result",
                     "computed in " + (division->type->kind == TypeKind::AnyInteger
                                           ? std::string("integers")
                                           : typeName(division->type)));
    if (literal && operand->kind == ExprKind::Literal)
      d.suggest("write `" + name + ".0`",
                {operand->span.file, operand->span.end, operand->span.end}, ".0");
    else
      d.suggest("convert an operand first: `" + upperName(operand->type) + "_TO_" +
                    typeName(target) + "(" + name + ") / …`",
                operand->span,
                upperName(operand->type) + "_TO_" + typeName(target) + "(" +
                    std::string(c.program.sources.text(operand->span)) + ")");
    return;
  }
  if (expr->constant == nullptr || expr->constant->kind != ConstKind::Integer ||
      expr->type->kind == TypeKind::Ulint)
    return;
  const int64_t value = expr->constant->integer;
  const bool narrow = target->kind == TypeKind::Real;
  const long double exact = static_cast<long double>(value);
  const long double rounded = narrow ? static_cast<long double>(static_cast<float>(value))
                                     : static_cast<long double>(static_cast<double>(value));
  if (!(rounded < exact) && !(rounded > exact))
    return;
  report(c, Code::PrecisionLoss, expr->span,
         typeName(target) + " cannot hold " + std::to_string(value) + " exactly",
         "becomes " + std::to_string(static_cast<int64_t>(rounded)))
      .help(narrow ? "use LREAL, which holds whole numbers up to 9007199254740992"
                   : "compute with LINT, or use a rounder number");
}

} // namespace stc::lint
