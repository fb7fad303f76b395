#include "compiler/codegen/expressions/operators.hpp"

#include "compiler/codegen/expressions/expressions.hpp"
#include "compiler/codegen/expressions/special_operators.hpp"
#include "compiler/codegen/places/own_checks.hpp"

#include <algorithm>
#include <cmath>

namespace stc::codegen {

using namespace ast;

namespace {

enum Level : int { // of C++'s operators
  kPostfix = 1,
  kUnary = 2,
  kMultiply = 4,
  kAdd = 5,
  kRelation = 7,
  kEquality = 8,
  kBitAnd = 9,
  kBitXor = 10,
  kBitOr = 11,
  kAnd = 12,
  kOr = 13,
};

struct Infix {
  std::string_view op; ///< empty: not written as an operator
  int level = kPostfix;
};

/// g++ takes time that grows with the square of a sum's length; longer ones are computed in parts.
constexpr size_t kMaxTerms = 64;

std::string_view comparison(BinaryOp op) {
  switch (op) {
  case BinaryOp::Equal:
    return "==";
  case BinaryOp::NotEqual:
    return "!=";
  case BinaryOp::Less:
    return "<";
  case BinaryOp::LessEqual:
    return "<=";
  case BinaryOp::Greater:
    return ">";
  default:
    return ">=";
  }
}

/// What C++ makes of an operand of the type in arithmetic; null for int.
const Type *promoted(const Type *t) {
  t = underlying(t);
  return isInteger(t) && bitWidth(t) < 32 ? nullptr : t;
}

Infix infixOf(const EmitContext &cx, const BinaryExpr *e) {
  const Type *type = e->operandType;
  if (type == nullptr)
    return {}; // durations and points in time
  switch (e->op) {
  case BinaryOp::Add:
    return {"+", kAdd};
  case BinaryOp::Subtract:
    return {"-", kAdd};
  case BinaryOp::Multiply:
    return {"*", kMultiply};
  case BinaryOp::Divide:
    if (isReal(type) || safeDivisor(e->right))
      return {"/", kMultiply};
    return {};
  case BinaryOp::Modulo:
    if (safeDivisor(e->right))
      return {"%", kMultiply};
    return {};
  case BinaryOp::Power:
    return {};
  case BinaryOp::Equal:
  case BinaryOp::NotEqual:
    return {comparison(e->op), kEquality};
  case BinaryOp::Less:
  case BinaryOp::LessEqual:
  case BinaryOp::Greater:
  case BinaryOp::GreaterEqual:
    return {comparison(e->op), kRelation};
  case BinaryOp::LogicalAnd:
    if (type->kind == TypeKind::Boolean &&
        (cx.run.analysis.effects(e->right) & (kEffectRaises | kEffectCalls)) == 0)
      return {"&&", kAnd};
    return {"&", kBitAnd};
  case BinaryOp::LogicalOr:
    if (type->kind == TypeKind::Boolean &&
        (cx.run.analysis.effects(e->right) & (kEffectRaises | kEffectCalls)) == 0)
      return {"||", kOr};
    return {"|", kBitOr};
  case BinaryOp::LogicalXor:
    if (type->kind == TypeKind::Boolean)
      return {"!=", kEquality};
    return {"^", kBitXor};
  case BinaryOp::AndThen:
    return {"&&", kAnd};
  case BinaryOp::OrElse:
    return {"||", kOr};
  }
  return {};
}

bool needsParentheses(int child, const Infix &parent, bool right, std::string_view childOp) {
  if (child <= kUnary)
    return false;
  switch (parent.level) {
  case kMultiply:
  case kAdd:
    return right ? child >= parent.level : child > parent.level;
  case kRelation:
  case kEquality:
    return child > kAdd;
  case kBitAnd:
  case kBitXor:
  case kBitOr:
    return right || childOp != parent.op;
  case kAnd:
  case kOr: // g++ wants parentheses around && within ||
    return child > kEquality && (right || childOp != parent.op);
  default:
    return true;
  }
}

int levelOf(const EmitContext &cx, const Expr *e) {
  e = shown(e);
  if (e->constant != nullptr) {
    const ConstValue &c = *e->constant;
    const bool negative = c.kind == ConstKind::Integer
                              ? c.integer < 0
                              : c.kind == ConstKind::Real && std::signbit(c.real);
    return negative ? kUnary : kPostfix;
  }
  if (e->kind == ExprKind::Unary)
    return kUnary;
  if (e->kind == ExprKind::Binary) {
    const Infix op = infixOf(cx, as<BinaryExpr>(e));
    return op.op.empty() ? kPostfix : op.level;
  }
  return kPostfix;
}

void emitInfixOperand(EmitContext &cx, const BinaryExpr *e, const Infix &op, const Expr *side) {
  const bool right = side == e->right;
  const bool compared = isComparison(e->op);
  const Expr *other = right ? e->left : e->right;
  bool parentheses = false;
  if (side->constant == nullptr && isImplicitOperand(side, e->operandType, other, compared)) {
    const Expr *child = shown(side);
    std::string_view childOp;
    if (child->kind == ExprKind::Binary)
      childOp = infixOf(cx, as<BinaryExpr>(child)).op;
    parentheses = needsParentheses(levelOf(cx, side), op, right, childOp);
    // `a == !b` is fine, `!a == b` is not (-Wlogical-not-parentheses).
    const bool comparing = op.level == kRelation || op.level == kEquality;
    parentheses = parentheses || (comparing && child->kind == ExprKind::Unary && !right);
  }
  const bool own = right && e->op == BinaryOp::Divide && openDivisorCheck(cx, e);
  if (parentheses && !own)
    cx.out << '(';
  emitOperand(cx, side, e->operandType, other, compared);
  if (own)
    cx.out << "))";
  else if (parentheses)
    cx.out << ')';
}

/// An operator that is written between its operands.
struct Link {
  const BinaryExpr *expr;
  Infix infix;
};

bool isInfix(const BinaryExpr *e, const Infix &infix) {
  return !infix.op.empty() && !isString(e->operandType);
}

bool isSequenced(const Infix &infix) { return infix.level == kAnd || infix.level == kOr; }

/// Long sums lean to the left: the operators that are written one after the other, the last first.
std::vector<Link> spineOf(const EmitContext &cx, const BinaryExpr *e) {
  std::vector<Link> spine;
  Infix infix = infixOf(cx, e);
  while (isInfix(e, infix)) {
    spine.push_back({e, infix});
    const Expr *left = e->left;
    if (left->kind != ExprKind::Binary || left->constant != nullptr ||
        !isImplicitOperand(left, e->operandType, e->right, isComparison(e->op)))
      break;
    const auto *inner = as<BinaryExpr>(left);
    const Infix innerInfix = infixOf(cx, inner);
    if (!isInfix(inner, innerInfix) ||
        needsParentheses(innerInfix.level, infix, false, innerInfix.op))
      break;
    e = inner;
    infix = innerInfix;
  }
  return spine;
}

/// C++ might evaluate the operands in an order that makes a difference.
bool orderMatters(const EmitContext &cx, const std::vector<Link> &spine) {
  unsigned before = cx.effects(spine.back().expr->left);
  for (auto link = spine.rbegin(); link != spine.rend(); ++link) {
    const unsigned after = cx.effects(link->expr->right);
    if (!isSequenced(link->infix) && Analysis::orderMatters(before, after))
      return true;
    before |= after;
  }
  return false;
}

void emitInfix(EmitContext &cx, const Link &link) {
  cx.out << ' ' << link.infix.op << ' ';
  emitInfixOperand(cx, link.expr, link.infix, link.expr->right);
}

void emitLeftmost(EmitContext &cx, const std::vector<Link> &spine) {
  const Link &first = spine.back();
  emitInfixOperand(cx, first.expr, first.infix, first.expr->left);
}

/// More operators than g++ should get at once: constants `part__…`, each of kMaxTerms operators.
void emitInParts(EmitContext &cx, const std::vector<Link> &spine) {
  const auto open = [&](size_t i) { // a part ends with the operator i
    std::string part = cx.temporary("part");
    cx.out << "const " << cx.type(underlying(spine[i].expr->type)) << ' ' << part << " = ";
    return part;
  };
  cx.out << "[&] { ";
  std::string part = open(spine.size() - kMaxTerms);
  emitLeftmost(cx, spine);
  for (size_t i = spine.size(), terms = 0; i-- > 0; ++terms) {
    if (terms == kMaxTerms) {
      cx.out << "; ";
      const std::string before = std::exchange(part, {});
      if (i < kMaxTerms)
        cx.out << "return ";
      else
        part = open(i + 1 - kMaxTerms);
      cx.out << before;
      terms = 0;
    }
    emitInfix(cx, spine[i]);
  }
  cx.out << "; }()";
}

/// What the runtime gives for the comparison of texts is compared with 0.
void emitFunction(EmitContext &cx, const BinaryExpr *e, Part left, Part right) {
  emitSpecial(cx, e, left, right);
  if (e->operandType != nullptr && isString(e->operandType))
    cx.out << ' ' << comparison(e->op) << " 0";
}

/// An operand of what is written as a function.
void emitArgumentOf(EmitContext &cx, const BinaryExpr *e, const Expr *side) {
  if (e->operandType == nullptr)
    emitValue(cx, side);
  else if (isString(e->operandType))
    emitText(cx, side);
  else
    emitOperand(cx, side, e->operandType, nullptr, false);
}

/// Takes an operand's value as `name`. It is copied where a call may change what it comes from.
void keepOperand(EmitContext &cx, const BinaryExpr *e, const Expr *side, const std::string &name) {
  const bool calls = ((cx.effects(e->left) | cx.effects(e->right)) & kEffectCalls) != 0;
  const Type *t = side->target != nullptr ? side->target : side->type;
  if (e->operandType != nullptr && !isString(e->operandType))
    t = underlying(e->operandType);
  cx.out << cx.type(t) << (calls ? " const " : " const &") << name << " = "; // a text is not copied
  emitValueAs(cx, side, t);
  cx.out << "; ";
}

/// C++ leaves the order of operands open, ST does not: the values are taken one after the other.
void emitOrdered(EmitContext &cx, const BinaryExpr *e) {
  const std::string left = cx.temporary("left");
  const std::string right = cx.temporary("right");
  const Infix op = infixOf(cx, e);
  if (isSequenced(op)) { // by itself
    emitInfixOperand(cx, e, op, e->left);
    cx.out << ' ' << op.op << ' ';
    emitInfixOperand(cx, e, op, e->right);
    return;
  }
  cx.out << "[&] { ";
  keepOperand(cx, e, e->left, left);
  keepOperand(cx, e, e->right, right);
  cx.out << "return ";
  if (isInfix(e, op))
    cx.out << left << ' ' << op.op << ' ' << right;
  else
    emitFunction(
        cx, e, [&] { cx.out << left; }, [&] { cx.out << right; });
  cx.out << "; }()";
}

} // namespace

const Expr *shown(const Expr *e) {
  const auto plain = [](const Expr *x) {
    return x->kind == ExprKind::Unary && x->constant == nullptr &&
           as<UnaryExpr>(x)->operand->target == nullptr;
  };
  while (plain(e)) {
    const auto *outer = as<UnaryExpr>(e);
    if (outer->op == UnaryOp::Plus) {
      e = outer->operand;
      continue;
    }
    if (!plain(outer->operand) || as<UnaryExpr>(outer->operand)->op != outer->op ||
        outer->operand->type != e->type)
      break;
    e = as<UnaryExpr>(outer->operand)->operand;
  }
  return e;
}

bool isImplicitOperand(const Expr *e, const Type *type, const Expr *other, bool compared) {
  const Type *from = underlying(e->type);
  const Type *to = underlying(type);
  if (from == to)
    return true;
  const bool integers = isInteger(from) && isInteger(to);
  if (integers && to->kind == TypeKind::Dint && bitWidth(from) < 32)
    return true; // C++ promotes it
  if (other == nullptr)
    return false;
  const Type *otherType = other->constant != nullptr ? to : promoted(other->type);
  if (otherType != to)
    return false;
  if (integers) // the usual arithmetic conversions; g++ warns about comparisons of signed with
                // unsigned
    return bitWidth(from) <= bitWidth(to) &&
           (!compared || isSignedInteger(from) == isSignedInteger(to));
  return (isInteger(from) || isReal(from)) && isReal(to);
}

void emitUnary(EmitContext &cx, const UnaryExpr *e) {
  const Type *type = underlying(e->type);
  if (e->op == UnaryOp::Plus) {
    emitOperand(cx, e->operand, type, nullptr, false);
    return;
  }
  const bool isBool = type->kind == TypeKind::Boolean;
  const bool cut = !isBool && isInteger(type) && bitWidth(type) < 32;
  if (cut)
    cx.out << "static_cast<" << cx.type(type) << ">(";
  cx.out << (e->op == UnaryOp::Negate ? '-' : isBool ? '!' : '~');
  const bool parentheses = e->operand->constant == nullptr
                               ? isImplicitOperand(e->operand, type, nullptr, false) &&
                                     levelOf(cx, e->operand) > kPostfix
                               : levelOf(cx, e->operand) > kPostfix;
  if (parentheses)
    cx.out << '(';
  emitOperand(cx, e->operand, type, nullptr, false);
  if (parentheses)
    cx.out << ')';
  if (cut)
    cx.out << ')';
}

void emitBinary(EmitContext &cx, const BinaryExpr *e) {
  const std::vector<Link> spine = spineOf(cx, e);
  const bool ordered = spine.empty() // they are arguments of a function
                           ? Analysis::orderShows(cx.effects(e->left), cx.effects(e->right))
                           : orderMatters(cx, spine);
  if (ordered) {
    emitOrdered(cx, e);
  } else if (spine.empty()) {
    emitFunction(
        cx, e, [&] { emitArgumentOf(cx, e, e->left); }, [&] { emitArgumentOf(cx, e, e->right); });
  } else if (spine.size() > kMaxTerms) {
    emitInParts(cx, spine);
  } else {
    emitLeftmost(cx, spine);
    for (auto link = spine.rbegin(); link != spine.rend(); ++link)
      emitInfix(cx, *link);
  }
}

} // namespace stc::codegen
