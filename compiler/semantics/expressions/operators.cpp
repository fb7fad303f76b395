// Operators: what all of them have in common; NOT, AND, OR, XOR.

#include "compiler/semantics/expressions/expressions.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/expressions/internal.hpp"
#include "compiler/semantics/fold.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <memory_resource>
#include <vector>

namespace stc::sema {

using namespace ast;

static const Type *checkLogical(Context &c, BinaryExpr *expr);

namespace {

std::string_view spelling(BinaryOp op) {
  switch (op) {
  case BinaryOp::Add:
    return "+";
  case BinaryOp::Subtract:
    return "-";
  case BinaryOp::Multiply:
    return "*";
  case BinaryOp::Divide:
    return "/";
  case BinaryOp::Modulo:
    return "MOD";
  case BinaryOp::Power:
    return "**";
  case BinaryOp::Equal:
    return "=";
  case BinaryOp::NotEqual:
    return "<>";
  case BinaryOp::Less:
    return "<";
  case BinaryOp::LessEqual:
    return "<=";
  case BinaryOp::Greater:
    return ">";
  case BinaryOp::GreaterEqual:
    return ">=";
  case BinaryOp::LogicalAnd:
    return "AND";
  case BinaryOp::LogicalOr:
    return "OR";
  case BinaryOp::LogicalXor:
    return "XOR";
  case BinaryOp::AndThen:
    return "AND_THEN";
  case BinaryOp::OrElse:
    return "OR_ELSE";
  }
  return {};
}

bool isLogical(BinaryOp op) { return op >= BinaryOp::LogicalAnd; }

} // namespace

const Type *operatorError(Context &c, BinaryExpr *expr) {
  const std::string op(spelling(expr->op));
  auto &d = c.report(Code::OperatorNotDefined, expr->opSpan,
                     "`" + op + "` is not defined for " + typeName(expr->left->type) + " and " +
                         typeName(expr->right->type),
                     "no such operation");
  d.label(expr->left->span, typeName(expr->left->type));
  d.label(expr->right->span, typeName(expr->right->type));
  const Type *l = underlying(expr->left->type);
  const Type *r = underlying(expr->right->type);
  const auto aggregate = [](const Type *t) {
    return t->kind == TypeKind::Array || t->kind == TypeKind::Structure || isInstance(t);
  };
  if (isComparison(expr->op) && aggregate(l) && aggregate(r))
    d.help(l->kind == TypeKind::Array ? "compare the elements one by one, in a loop"
                                      : "compare the members one by one: `a.x = b.x AND …`");
  else if (isString(l) && isString(r) && expr->op == BinaryOp::Add)
    d.help("join strings with CONCAT(…, …)");
  else if (l->kind == TypeKind::Boolean || r->kind == TypeKind::Boolean) {
    if (isComparison(expr->op) && expr->left->kind == ExprKind::Binary &&
        isComparison(as<BinaryExpr>(expr->left)->op) && isNumber(r))
      d.help("each side is a comparison of its own: `" +
             std::string(c.program.sources.text(expr->left->span)) + " AND " +
             std::string(c.program.sources.text(as<BinaryExpr>(expr->left)->right->span)) + " " +
             op + " " + std::string(c.program.sources.text(expr->right->span)) + "`");
    else if (!isLogical(expr->op))
      d.help("convert the BOOL first: `BOOL_TO_INT(…)`");
    else if (expr->left->kind == ExprKind::Binary && isNumber(r) &&
             as<BinaryExpr>(expr->left)->op == BinaryOp::Equal)
      d.help("each side is a condition of its own: `… " + op + " " +
             std::string(c.program.sources.text(as<BinaryExpr>(expr->left)->left->span)) + " = " +
             std::string(c.program.sources.text(expr->right->span)) + "`");
    else if (isNumber(l) || isNumber(r))
      d.help("compare the number first: `… <> 0`");
  }
  return elementaryType(TypeKind::Error);
}

static const Type *fold(Context &c, BinaryExpr *expr) {
  const ConstValue *l = expr->left->constant;
  const ConstValue *r = expr->right->constant;
  if (l == nullptr || r == nullptr)
    return expr->type;
  if (expr->operandType == nullptr) { // `T#1s * 2`: the operands have different types
    const Type *duration = underlying(expr->type);
    const Expr *number = isNumber(underlying(expr->left->type)) ? expr->left : expr->right;
    if (isDuration(duration) && isNumber(underlying(number->type)) &&
        l->kind == ConstKind::Integer && r->kind == ConstKind::Integer &&
        number->constant->integer >= 0) {
      if (const auto value = foldBinary(expr->op, *l, *r, duration))
        expr->constant = c.makeConstant(*value);
    }
    return expr->type;
  }
  const auto left = convertConstant(*l, expr->left->type, expr->operandType);
  const auto right = convertConstant(*r, expr->right->type, expr->operandType);
  if (!left || !right)
    return expr->type;
  if (const auto value = foldBinary(expr->op, *left, *right, expr->operandType)) {
    expr->constant = c.makeConstant(*value);
  } else if (expr->operandType->kind == TypeKind::AnyInteger) {
    if (expr->op != BinaryOp::Power &&
        !((expr->op == BinaryOp::Divide || expr->op == BinaryOp::Modulo) && right->integer == 0))
      c.report(Code::ConstantOverflow, expr->span,
               "this constant expression does not fit into 64 bits", "too large");
    expr->type = elementaryType(TypeKind::Error);
  }
  return expr->type;
}

/// Reports an operand that the operator does not take.
static bool takesOperand(Context &c, const UnaryExpr *u) {
  const Type *own = underlying(u->operand->type);
  const bool isNot = u->op == UnaryOp::LogicalNot;
  if (isNot ? own->kind == TypeKind::Boolean || isInteger(own) || own->kind == TypeKind::AnyInteger
            : isNumber(own) || own->kind == TypeKind::Ltime)
    return true;
  const std::string op = isNot ? "NOT" : u->op == UnaryOp::Negate ? "-" : "+";
  auto &d = c.report(Code::OperatorNotDefined, u->span,
                     "`" + op + "` is not defined for " + typeName(u->operand->type),
                     isNot ? "expected BOOL, an integer or a bit string" : "expected a number");
  if (!isNot && own->kind == TypeKind::Boolean)
    d.help("negate a BOOL with NOT");
  return false;
}

/// Gives the operation its type, and the operand the conversion to it.
static void setUnaryType(UnaryExpr *u, const Type *expected) {
  Expr *operand = u->operand;
  const Type *own = underlying(operand->type);
  if (u->op == UnaryOp::LogicalNot) {
    const Type *wanted = expected != nullptr ? underlying(expected) : nullptr;
    if (own->kind != TypeKind::AnyInteger)
      u->type = own;
    else if (wanted != nullptr && isInteger(wanted) && operand->constant != nullptr &&
             constantFits(*operand->constant, own, wanted))
      u->type = wanted; // `w AND NOT 16#0F`: a mask as wide as the result
    else
      u->type = settle(operand);
    setTarget(operand, u->type);
  } else if (isUntyped(own) || isReal(own) || own->kind == TypeKind::Ltime) {
    u->type = own;
  } else {
    u->common = unwidened(operand);
    u->type = widened(own);
    if (u->op == UnaryOp::Negate && !isSignedInteger(u->type)) // -UDINT needs a sign
      u->type =
          elementaryType(isBitString(own) && bitWidth(own) < 32 ? TypeKind::Dint : TypeKind::Lint);
    setTarget(operand, u->type);
  }
}

static void foldUnaryOf(Context &c, UnaryExpr *u) {
  const Expr *operand = u->operand;
  if (u->op == UnaryOp::Negate && operand->kind == ExprKind::Literal &&
      operand->type->kind == TypeKind::Ulint && !as<Literal>(operand)->typeName &&
      operand->constant->integer == std::numeric_limits<int64_t>::min()) {
    // `-9223372036854775808` is LINT's smallest value, written with a magnitude that is none.
    u->common = nullptr;
    u->type = elementaryType(TypeKind::AnyInteger);
    u->constant = operand->constant;
    return;
  }
  if (operand->constant == nullptr)
    return;
  const auto value = convertConstant(*operand->constant, operand->type, u->type);
  const auto folded = value ? foldUnary(u->op, *value, u->type) : std::nullopt;
  if (folded) {
    u->constant = c.makeConstant(*folded);
  } else if (isUntyped(u->type)) {
    c.report(Code::ConstantOverflow, u->span, "this constant expression does not fit into 64 bits",
             "too large");
    u->type = elementaryType(TypeKind::Error);
  }
}

const Type *checkUnary(Context &c, UnaryExpr *expr, const Type *expected) {
  // Long chains (NOT NOT …, - - …) must not eat the stack.
  std::vector<UnaryExpr *> chain{expr};
  while (chain.back()->operand->kind == ExprKind::Unary)
    chain.push_back(as<UnaryExpr>(chain.back()->operand));
  check(c, chain.back()->operand, expected);
  for (size_t i = chain.size(); i-- > 0;) {
    UnaryExpr *u = chain[i];
    u->type = elementaryType(TypeKind::Error);
    if (isError(u->operand->type) || refuseStrict(c, u->operand) || !takesOperand(c, u))
      continue;
    setUnaryType(u, expected);
    foldUnaryOf(c, u);
  }
  return expr->type;
}

const Type *checkBinary(Context &c, BinaryExpr *expr, const Type *expected) {
  // Sums of ten thousand terms lean to the left; walk down instead of recursing.
  std::array<std::byte, 15 * sizeof(BinaryExpr *)> room; // most are short
  std::pmr::monotonic_buffer_resource memory(room.data(), room.size());
  std::pmr::vector<BinaryExpr *> chain({expr}, &memory);
  while (chain.back()->left->kind == ExprKind::Binary)
    chain.push_back(as<BinaryExpr>(chain.back()->left));
  const bool comparison = isComparison(chain.back()->op);
  check(c, chain.back()->left, comparison ? nullptr : expected);
  for (size_t i = chain.size(); i-- > 0;) {
    BinaryExpr *b = chain[i];
    const Type *hint = isComparison(b->op) ? b->left->type : expected;
    check(c, b->right, hint);
    // `positive = direction`: the enumerator on the left takes its type from the right side.
    b->type = elementaryType(TypeKind::Error);
    if (isError(b->left->type) || isError(b->right->type))
      continue;
    if (b->left->type->kind == TypeKind::None || b->right->type->kind == TypeKind::None) {
      c.report(Code::NoValue, (b->left->type->kind == TypeKind::None ? b->left : b->right)->span,
               "this call has no value", "the function has no result type");
      continue;
    }
    if (isComparison(b->op))
      b->type = checkComparison(c, b);
    else if (isLogical(b->op))
      b->type = checkLogical(c, b);
    else if (b->op == BinaryOp::Power)
      b->type = checkPower(c, b);
    else
      b->type = checkArithmetic(c, b);
    if (!isError(b->type))
      fold(c, b);
  }
  return expr->type;
}

bool refuseStrict(Context &c, Expr *expr) {
  if (expr->type->kind != TypeKind::Enumeration || !typeAs<EnumType>(expr->type)->strict)
    return false;
  const std::string name = typeName(expr->type);
  auto &d = c.report(Code::StrictEnumeration, expr->span,
                     "`" + name + "` is a strict enumeration, nothing is computed with it",
                     "this is " + name);
  noteDeclaration(d, typeAs<EnumType>(expr->type)->symbol);
  d.help("convert it if its number is meant: `TO_INT(…)`");
  return true;
}

static const Type *checkLogical(Context &c, BinaryExpr *expr) {
  if (refuseStrict(c, expr->left) || refuseStrict(c, expr->right))
    return elementaryType(TypeKind::Error);
  const Type *l = underlying(expr->left->type);
  const Type *r = underlying(expr->right->type);
  const Type *boolean = elementaryType(TypeKind::Boolean);
  const auto isBool = [&](const Expr *e, const Type *t) {
    return t->kind == TypeKind::Boolean ||
           (e->constant != nullptr && constantFits(*e->constant, e->type, boolean));
  };
  const bool shortCircuit = expr->op == BinaryOp::AndThen || expr->op == BinaryOp::OrElse;
  if ((l->kind == TypeKind::Boolean || r->kind == TypeKind::Boolean || shortCircuit) &&
      isBool(expr->left, l) && isBool(expr->right, r)) {
    expr->operandType = boolean;
  } else if (!shortCircuit && l->kind == TypeKind::AnyInteger && r->kind == TypeKind::AnyInteger) {
    expr->operandType = l;
    return l;
  } else {
    // An address is a number here: `ADR(x) AND 16#3`.
    for (Expr *side : {expr->left, expr->right}) {
      if (!shortCircuit && underlying(side->type)->kind == TypeKind::Pointer) {
        const Type *address = elementaryType(TypeKind::Ulint);
        setTarget(side, address);
        Expr *other = side == expr->left ? expr->right : expr->left;
        const Type *o = underlying(other->type);
        if (!isInteger(o) && o->kind != TypeKind::AnyInteger)
          return operatorError(c, expr);
        setTarget(other, address);
        expr->operandType = address;
        return address;
      }
    }
    const auto integral = [](const Type *t) {
      return isInteger(t) || t->kind == TypeKind::AnyInteger;
    };
    if (shortCircuit || !integral(l) || !integral(r))
      return operatorError(c, expr);
    expr->operandType = commonOf(expr->left, expr->right);
    if (expr->operandType == nullptr) { // bit patterns have no sign: take the unsigned one
      expr->operandType = isSignedInteger(l) || l->kind == TypeKind::AnyInteger ? r : l;
      for (Expr *side : {expr->left, expr->right}) {
        if (side->type->kind == TypeKind::AnyInteger) { // a negative constant
          coerce(c, side, expr->operandType, {});
          return elementaryType(TypeKind::Error);
        }
      }
    }
  }
  setTarget(expr->left, expr->operandType);
  setTarget(expr->right, expr->operandType);
  return expr->operandType;
}

} // namespace stc::sema
