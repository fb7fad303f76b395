// Operators, their parentheses and the order in which their operands are evaluated.

#include "compiler/codegen/emitter.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

/// g++ takes time that grows with the square of a sum's length; longer ones are computed in parts.
constexpr std::size_t kMaxTerms = 64;

bool isComparison(BinaryOp op) { return op >= BinaryOp::equal && op <= BinaryOp::greaterEqual; }

std::string_view comparison(BinaryOp op) {
  switch (op) {
  case BinaryOp::equal:
    return "==";
  case BinaryOp::notEqual:
    return "!=";
  case BinaryOp::less:
    return "<";
  case BinaryOp::lessEqual:
    return "<=";
  case BinaryOp::greater:
    return ">";
  default:
    return ">=";
  }
}

/// What C++ makes of an operand of the type in arithmetic.
const Type *promoted(const Type *t, const Type *dint) {
  t = underlying(t);
  return isInteger(t) && bitWidth(t) < 32 ? dint : t;
}

} // namespace

Emitter::Infix Emitter::infix(const BinaryExpr *e) const {
  const Type *type = e->operandType;
  if (type == nullptr)
    return {}; // durations and points in time
  switch (e->op) {
  case BinaryOp::add:
    return {"+", kAdd};
  case BinaryOp::subtract:
    return {"-", kAdd};
  case BinaryOp::multiply:
    return {"*", kMultiply};
  case BinaryOp::divide:
    if (isReal(type) || safeDivisor(e->right))
      return {"/", kMultiply};
    return {};
  case BinaryOp::modulo:
    if (safeDivisor(e->right))
      return {"%", kMultiply};
    return {};
  case BinaryOp::power:
    return {};
  case BinaryOp::equal:
  case BinaryOp::notEqual:
    return {comparison(e->op), kEquality};
  case BinaryOp::less:
  case BinaryOp::lessEqual:
  case BinaryOp::greater:
  case BinaryOp::greaterEqual:
    return {comparison(e->op), kRelation};
  case BinaryOp::logicalAnd:
    if (type->kind == TypeKind::boolean &&
        (c_.analysis.effects(e->right) & (effectRaises | effectCalls)) == 0)
      return {"&&", kAnd};
    return {"&", kBitAnd};
  case BinaryOp::logicalOr:
    if (type->kind == TypeKind::boolean &&
        (c_.analysis.effects(e->right) & (effectRaises | effectCalls)) == 0)
      return {"||", kOr};
    return {"|", kBitOr};
  case BinaryOp::logicalXor:
    if (type->kind == TypeKind::boolean)
      return {"!=", kEquality};
    return {"^", kBitXor};
  case BinaryOp::andThen:
    return {"&&", kAnd};
  case BinaryOp::orElse:
    return {"||", kOr};
  }
  return {};
}

bool Emitter::parenthesize(int child, const Infix &parent, bool right, std::string_view childOp) {
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

bool Emitter::implicitOperand(const Expr *e, const Type *type, const Expr *other,
                              bool compared) const {
  const Type *from = underlying(e->type);
  const Type *to = underlying(type);
  if (from == to)
    return true;
  const bool integers = isInteger(from) && isInteger(to);
  if (integers && to->kind == TypeKind::dint && bitWidth(from) < 32)
    return true; // C++ promotes it
  if (other == nullptr)
    return false;
  const Type *otherType = other->constant != nullptr ? to : promoted(other->type, nullptr);
  if (otherType != to)
    return false;
  if (integers) // the usual arithmetic conversions; g++ warns about comparisons of signed with
                // unsigned
    return bitWidth(from) <= bitWidth(to) &&
           (!compared || isSignedInteger(from) == isSignedInteger(to));
  return (isInteger(from) || isReal(from)) && isReal(to);
}

void Emitter::infixOperand(const BinaryExpr *e, const Infix &op, const Expr *side) {
  const bool right = side == e->right;
  const bool compared = isComparison(e->op);
  const Expr *other = right ? e->left : e->right;
  bool parentheses = false;
  if (side->constant == nullptr && implicitOperand(side, e->operandType, other, compared)) {
    const Expr *child = shown(side);
    std::string_view childOp;
    if (child->kind == ExprKind::binary)
      childOp = infix(as<BinaryExpr>(child)).op;
    parentheses = parenthesize(level(side), op, right, childOp);
    // `a == !b` is fine, `!a == b` is not (-Wlogical-not-parentheses).
    const bool comparing = op.level == kRelation || op.level == kEquality;
    parentheses = parentheses || (comparing && child->kind == ExprKind::unary && !right);
  }
  const bool own = right && e->op == BinaryOp::divide && openDivisorCheck(e);
  if (parentheses && !own)
    w_ << '(';
  operand(side, e->operandType, other, compared);
  if (own)
    w_ << "))";
  else if (parentheses)
    w_ << ')';
}

void Emitter::unary(const UnaryExpr *e) {
  const Type *type = underlying(e->type);
  if (e->op == UnaryOp::plus) {
    operand(e->operand, type, nullptr, false);
    return;
  }
  const bool isBool = type->kind == TypeKind::boolean;
  const bool cut = !isBool && isInteger(type) && bitWidth(type) < 32;
  if (cut)
    w_ << "static_cast<" << this->type(type) << ">(";
  w_ << (e->op == UnaryOp::negate ? '-' : isBool ? '!' : '~');
  const bool parentheses =
      e->operand->constant == nullptr
          ? implicitOperand(e->operand, type, nullptr, false) && level(e->operand) > kPostfix
          : level(e->operand) > kPostfix;
  if (parentheses)
    w_ << '(';
  operand(e->operand, type, nullptr, false);
  if (parentheses)
    w_ << ')';
  if (cut)
    w_ << ')';
}

void Emitter::binary(const BinaryExpr *e) {
  // Long sums lean to the left: collect the operators that are written one behind the other.
  std::vector<std::pair<const BinaryExpr *, Infix>> spine;
  const BinaryExpr *at = e;
  while (true) {
    const Infix op = infix(at);
    if (op.op.empty() || isString(at->operandType))
      break;
    spine.emplace_back(at, op);
    const Expr *left = at->left;
    if (left->kind != ExprKind::binary || left->constant != nullptr ||
        !implicitOperand(left, at->operandType, at->right, isComparison(at->op)))
      break;
    const auto *inner = as<BinaryExpr>(left);
    const Infix innerOp = infix(inner);
    if (innerOp.op.empty() || isString(inner->operandType) ||
        parenthesize(innerOp.level, op, false, innerOp.op))
      break;
    at = inner;
  }
  if (spine.empty()) {
    const auto side = [&](const Expr *operandExpr) {
      return [this, operandExpr, e] {
        if (e->operandType == nullptr)
          value(operandExpr);
        else if (isString(e->operandType))
          text(operandExpr);
        else
          operand(operandExpr, e->operandType, nullptr, false);
      };
    };
    const unsigned l = effects(e->left);
    const unsigned r = effects(e->right);
    if (Analysis::orderShows(l, r)) { // they are arguments of a function
      ordered(e);
      return;
    }
    special(e, side(e->left), side(e->right));
    if (e->operandType != nullptr && isString(e->operandType))
      w_ << ' ' << comparison(e->op) << " 0";
    return;
  }
  // Does the order of evaluation matter anywhere in it?
  unsigned before = effects(spine.back().first->left);
  for (std::size_t i = spine.size(); i-- > 0;) {
    const BinaryExpr *b = spine[i].first;
    const unsigned after = effects(b->right);
    const bool sequenced = spine[i].second.level == kAnd || spine[i].second.level == kOr;
    if (!sequenced && Analysis::orderMatters(before, after)) {
      ordered(e);
      return;
    }
    before |= after;
  }
  const bool split = spine.size() > kMaxTerms;
  std::string part;
  const auto open = [&](std::size_t i) { // a part ends with the operator i
    part = temporary("part");
    w_ << "const " << type(underlying(spine[i].first->type)) << ' ' << part << " = ";
  };
  if (split) {
    w_ << "[&] { ";
    open(spine.size() - kMaxTerms);
  }
  infixOperand(spine.back().first, spine.back().second, spine.back().first->left);
  for (std::size_t i = spine.size(), terms = 0; i-- > 0; ++terms) {
    if (terms == kMaxTerms) {
      w_ << "; ";
      const std::string before = part;
      if (i < kMaxTerms)
        w_ << "return ";
      else
        open(i + 1 - kMaxTerms);
      w_ << before;
      terms = 0;
    }
    w_ << ' ' << spine[i].second.op << ' ';
    infixOperand(spine[i].first, spine[i].second, spine[i].first->right);
  }
  if (split)
    w_ << "; }()";
}

/// C++ leaves the order of operands open, ST does not: the values are taken one after the other,
/// and copied where a call may change what they come from.
void Emitter::ordered(const BinaryExpr *e) {
  const std::string left = temporary("left");
  const std::string right = temporary("right");
  const bool calls = ((effects(e->left) | effects(e->right)) & effectCalls) != 0;
  const auto keep = [&](const std::string &name, const Expr *side) {
    const Type *t = side->target != nullptr ? side->target : side->type;
    if (e->operandType != nullptr && !isString(e->operandType))
      t = underlying(e->operandType);
    w_ << type(t) << (calls ? " const " : " const &") << name << " = "; // a text is not copied
    valueAs(side, t);
    w_ << "; ";
  };
  const Infix op = infix(e);
  if (op.level == kAnd || op.level == kOr) { // sequenced by itself
    infixOperand(e, op, e->left);
    w_ << ' ' << op.op << ' ';
    infixOperand(e, op, e->right);
    return;
  }
  w_ << "[&] { ";
  keep(left, e->left);
  keep(right, e->right);
  w_ << "return ";
  if (!op.op.empty() && !isString(e->operandType)) {
    w_ << left << ' ' << op.op << ' ' << right;
  } else {
    special(
        e, [&] { w_ << left; }, [&] { w_ << right; });
    if (e->operandType != nullptr && isString(e->operandType))
      w_ << ' ' << comparison(e->op) << " 0";
  }
  w_ << "; }()";
}

} // namespace stc::codegen
