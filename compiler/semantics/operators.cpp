// Operators: overload resolution, widening, constant folding (dialect table, "integer arithmetic").

#include "compiler/semantics/checker.hpp"
#include "compiler/semantics/fold.hpp"

#include <limits>

namespace stc {

using namespace ast;

namespace {

std::string_view spelling(BinaryOp op) {
  switch (op) {
  case BinaryOp::add:
    return "+";
  case BinaryOp::subtract:
    return "-";
  case BinaryOp::multiply:
    return "*";
  case BinaryOp::divide:
    return "/";
  case BinaryOp::modulo:
    return "MOD";
  case BinaryOp::power:
    return "**";
  case BinaryOp::equal:
    return "=";
  case BinaryOp::notEqual:
    return "<>";
  case BinaryOp::less:
    return "<";
  case BinaryOp::lessEqual:
    return "<=";
  case BinaryOp::greater:
    return ">";
  case BinaryOp::greaterEqual:
    return ">=";
  case BinaryOp::logicalAnd:
    return "AND";
  case BinaryOp::logicalOr:
    return "OR";
  case BinaryOp::logicalXor:
    return "XOR";
  case BinaryOp::andThen:
    return "AND_THEN";
  case BinaryOp::orElse:
    return "OR_ELSE";
  }
  return {};
}

bool isComparison(BinaryOp op) { return op >= BinaryOp::equal && op <= BinaryOp::greaterEqual; }
bool isLogical(BinaryOp op) { return op >= BinaryOp::logicalAnd; }

bool untyped(const Type *t) {
  return t->kind == TypeKind::anyInteger || t->kind == TypeKind::anyReal;
}
bool isNumber(const Type *t) {
  const Type *u = underlying(t);
  return isInteger(u) || isReal(u) || untyped(u);
}
bool isDuration(const Type *t) { return t->kind == TypeKind::time || t->kind == TypeKind::ltime; }

/// The type that remembers what the operand was before widening.
const Type *unwidened(const Expr *e) {
  // What is LREAL stays LREAL; its `common` only keeps an assignment to REAL silent.
  return e->common != nullptr && !isReal(e->type) ? e->common : underlying(e->type);
}

} // namespace

const Type *Checker::operatorError(BinaryExpr *expr) {
  const std::string op(spelling(expr->op));
  auto &d = report(Code::operatorNotDefined, expr->opSpan,
                   "`" + op + "` is not defined for " + typeName(expr->left->type) + " and " +
                       typeName(expr->right->type),
                   "no such operation");
  d.label(expr->left->span, typeName(expr->left->type));
  d.label(expr->right->span, typeName(expr->right->type));
  const Type *l = underlying(expr->left->type);
  const Type *r = underlying(expr->right->type);
  const auto aggregate = [](const Type *t) {
    return t->kind == TypeKind::array || t->kind == TypeKind::structure || isInstance(t);
  };
  if (isComparison(expr->op) && aggregate(l) && aggregate(r))
    d.help(l->kind == TypeKind::array ? "compare the elements one by one, in a loop"
                                      : "compare the members one by one: `a.x = b.x AND …`");
  else if (isString(l) && isString(r) && expr->op == BinaryOp::add)
    d.help("join strings with CONCAT(…, …)");
  else if (l->kind == TypeKind::boolean || r->kind == TypeKind::boolean) {
    if (!isLogical(expr->op))
      d.help("convert the BOOL first: `BOOL_TO_INT(…)`");
    else if (expr->left->kind == ExprKind::binary && isNumber(r) &&
             as<BinaryExpr>(expr->left)->op == BinaryOp::equal)
      d.help("each side is a condition of its own: `… " + op + " " +
             std::string(program_.sources.text(as<BinaryExpr>(expr->left)->left->span)) + " = " +
             std::string(program_.sources.text(expr->right->span)) + "`");
    else if (isNumber(l) || isNumber(r))
      d.help("compare the number first: `… <> 0`");
  }
  return elementaryType(TypeKind::error);
}

/// Gives untyped constants the type of the other side where they fit.
const Type *Checker::commonOf(Expr *a, Expr *b) {
  const auto typeOfOperand = [](Expr *e, const Expr *other) -> const Type * {
    if (e->type->kind == TypeKind::anyReal)
      return isReal(underlying(other->type)) ? underlying(other->type)
                                             : elementaryType(TypeKind::lreal);
    if (e->type->kind == TypeKind::anyInteger) {
      const Type *o = unwidened(other);
      if (other->type->kind == TypeKind::anyReal)
        return elementaryType(TypeKind::lreal);
      if ((isInteger(o) || isReal(o)) && constantFits(*e->constant, e->type, o))
        return o;
      return smallestInteger(e->constant->integer);
    }
    return unwidened(e);
  };
  return commonNumber(typeOfOperand(a, b), typeOfOperand(b, a));
}

const Type *Checker::fold(BinaryExpr *expr) {
  const ConstValue *l = expr->left->constant;
  const ConstValue *r = expr->right->constant;
  if (l == nullptr || r == nullptr)
    return expr->type;
  if (expr->operandType == nullptr) { // `T#1s * 2`: the operands have different types
    const Type *duration = underlying(expr->type);
    const Expr *number = isNumber(underlying(expr->left->type)) ? expr->left : expr->right;
    if (isDuration(duration) && isNumber(underlying(number->type)) &&
        l->kind == ConstKind::integer && r->kind == ConstKind::integer &&
        number->constant->integer >= 0) {
      if (const auto value = foldBinary(expr->op, *l, *r, duration))
        expr->constant = makeConstant(*value);
    }
    return expr->type;
  }
  const auto left = convertConstant(*l, expr->left->type, expr->operandType);
  const auto right = convertConstant(*r, expr->right->type, expr->operandType);
  if (!left || !right)
    return expr->type;
  if (const auto value = foldBinary(expr->op, *left, *right, expr->operandType)) {
    expr->constant = makeConstant(*value);
  } else if (expr->operandType->kind == TypeKind::anyInteger) {
    if (expr->op != BinaryOp::power &&
        !((expr->op == BinaryOp::divide || expr->op == BinaryOp::modulo) && right->integer == 0))
      report(Code::constantOverflow, expr->span,
             "this constant expression does not fit into 64 bits", "too large");
    expr->type = elementaryType(TypeKind::error);
  }
  return expr->type;
}

const Type *Checker::checkUnary(UnaryExpr *expr, const Type *expected) {
  // Long chains (NOT NOT …, - - …) must not eat the stack.
  std::vector<UnaryExpr *> chain{expr};
  while (chain.back()->operand->kind == ExprKind::unary)
    chain.push_back(as<UnaryExpr>(chain.back()->operand));
  check(chain.back()->operand, expected);
  for (std::size_t i = chain.size(); i-- > 0;) {
    UnaryExpr *u = chain[i];
    Expr *operand = u->operand;
    const Type *type = operand->type;
    const Type *own = underlying(type);
    u->type = elementaryType(TypeKind::error);
    if (isError(type))
      continue;
    if (refuseStrict(operand))
      continue;
    const bool isNot = u->op == UnaryOp::logicalNot;
    if (isNot ? !(own->kind == TypeKind::boolean || isInteger(own) ||
                  own->kind == TypeKind::anyInteger)
              : !(isNumber(own) || own->kind == TypeKind::ltime)) {
      const std::string op = isNot ? "NOT" : u->op == UnaryOp::negate ? "-" : "+";
      auto &d = report(Code::operatorNotDefined, u->span,
                       "`" + op + "` is not defined for " + typeName(type),
                       isNot ? "expected BOOL, an integer or a bit string" : "expected a number");
      if (!isNot && own->kind == TypeKind::boolean)
        d.help("negate a BOOL with NOT");
      continue;
    }
    if (isNot) {
      const Type *wanted = expected != nullptr ? underlying(expected) : nullptr;
      if (own->kind != TypeKind::anyInteger)
        u->type = own;
      else if (wanted != nullptr && isInteger(wanted) && operand->constant != nullptr &&
               constantFits(*operand->constant, own, wanted))
        u->type = wanted; // `w AND NOT 16#0F`: a mask as wide as the result
      else
        u->type = settle(operand);
      setTarget(operand, u->type);
    } else if (untyped(own) || isReal(own) || own->kind == TypeKind::ltime) {
      u->type = own;
    } else {
      u->common = unwidened(operand);
      u->type = widened(own);
      if (u->op == UnaryOp::negate && !isSignedInteger(u->type)) // -UDINT needs a sign
        u->type = elementaryType(isBitString(own) && bitWidth(own) < 32 ? TypeKind::dint
                                                                        : TypeKind::lint);
      setTarget(operand, u->type);
    }
    if (u->op == UnaryOp::negate && operand->kind == ExprKind::literal &&
        type->kind == TypeKind::ulint && !as<Literal>(operand)->typeName &&
        operand->constant->integer == std::numeric_limits<std::int64_t>::min()) {
      // `-9223372036854775808` is LINT's smallest value, written with a magnitude that is none.
      u->common = nullptr;
      u->type = elementaryType(TypeKind::anyInteger);
      u->constant = operand->constant;
    } else if (operand->constant != nullptr) {
      const auto value = convertConstant(*operand->constant, type, u->type);
      const auto folded = value ? foldUnary(u->op, *value, u->type) : std::nullopt;
      if (folded)
        u->constant = makeConstant(*folded);
      else if (untyped(u->type)) {
        report(Code::constantOverflow, u->span,
               "this constant expression does not fit into 64 bits", "too large");
        u->type = elementaryType(TypeKind::error);
      }
    }
  }
  return expr->type;
}

const Type *Checker::checkBinary(BinaryExpr *expr, const Type *expected) {
  // Sums of ten thousand terms lean to the left; walk down instead of recursing.
  std::vector<BinaryExpr *> chain{expr};
  while (chain.back()->left->kind == ExprKind::binary)
    chain.push_back(as<BinaryExpr>(chain.back()->left));
  const bool comparison = isComparison(chain.back()->op);
  check(chain.back()->left, comparison ? nullptr : expected);
  for (std::size_t i = chain.size(); i-- > 0;) {
    BinaryExpr *b = chain[i];
    const Type *hint = isComparison(b->op) ? b->left->type : expected;
    check(b->right, hint);
    // `positive = direction`: the enumerator on the left takes its type from the right side.
    b->type = elementaryType(TypeKind::error);
    if (isError(b->left->type) || isError(b->right->type))
      continue;
    if (b->left->type->kind == TypeKind::none || b->right->type->kind == TypeKind::none) {
      report(Code::noValue, (b->left->type->kind == TypeKind::none ? b->left : b->right)->span,
             "this call has no value", "the function has no result type");
      continue;
    }
    if (isComparison(b->op))
      b->type = checkComparison(b);
    else if (isLogical(b->op))
      b->type = checkLogical(b);
    else if (b->op == BinaryOp::power)
      b->type = checkPower(b);
    else
      b->type = checkArithmetic(b);
    if (!isError(b->type))
      fold(b);
  }
  return expr->type;
}

bool Checker::refuseStrict(Expr *expr) {
  if (expr->type->kind != TypeKind::enumeration || !typeAs<EnumType>(expr->type)->strict)
    return false;
  const std::string name = typeName(expr->type);
  auto &d = report(Code::strictEnumeration, expr->span,
                   "`" + name + "` is a strict enumeration, nothing is computed with it",
                   "this is " + name);
  noteDeclaration(d, typeAs<EnumType>(expr->type)->symbol);
  d.help("convert it if its number is meant: `TO_INT(…)`");
  return true;
}

const Type *Checker::checkArithmetic(BinaryExpr *expr) {
  const Type *l = underlying(expr->left->type);
  const Type *r = underlying(expr->right->type);
  if (refuseStrict(expr->left) || refuseStrict(expr->right))
    return elementaryType(TypeKind::error);
  if (isTimeOrDate(l) || isTimeOrDate(r))
    return checkTimeArithmetic(expr);
  if (l->kind == TypeKind::pointer || r->kind == TypeKind::pointer)
    return checkPointerArithmetic(expr);
  if (!isNumber(l) || !isNumber(r))
    return operatorError(expr);
  if (l->kind == TypeKind::anyInteger && r->kind == TypeKind::anyInteger) {
    expr->operandType = l;
  } else if (untyped(l) && untyped(r)) {
    expr->operandType = elementaryType(TypeKind::anyReal);
  } else {
    const Type *common = commonOf(expr->left, expr->right);
    if (common == nullptr) {
      auto &d = report(Code::signedWithUlint, expr->opSpan,
                       "no integer type holds both " + typeName(expr->left->type) + " and " +
                           typeName(expr->right->type),
                       "signed and 64-bit unsigned values cannot be mixed");
      d.label(expr->left->span, typeName(expr->left->type));
      d.label(expr->right->span, typeName(expr->right->type));
      d.help("convert one of them: `" + typeName(l) + "_TO_" + typeName(r) + "(…)`");
      return elementaryType(TypeKind::error);
    }
    const auto narrow = [](const Expr *e) {
      return untyped(e->type) || (e->common != nullptr && e->common->kind == TypeKind::real);
    };
    const bool constants =
        common->kind == TypeKind::lreal && narrow(expr->left) && narrow(expr->right);
    expr->common = constants ? elementaryType(TypeKind::real) : common;
    const Type *operation = widened(common);
    // An operand that had been widened already keeps its width (a*b + c).
    for (const Expr *e : {expr->left, expr->right}) {
      if (isInteger(operation) && isInteger(underlying(e->type)) && !untyped(e->type)) {
        if (const Type *both = commonNumber(operation, underlying(e->type)))
          operation = both;
      }
    }
    expr->operandType = operation;
  }
  if (expr->op == BinaryOp::modulo &&
      (isReal(expr->operandType) || expr->operandType->kind == TypeKind::anyReal)) {
    auto &d = report(Code::operatorNotDefined, expr->opSpan,
                     "`MOD` is not defined for REAL and LREAL", "integers only");
    d.help("for a real remainder use SMC_fmod(x, m) of SM_DriveBasic");
    return elementaryType(TypeKind::error);
  }
  if ((expr->op == BinaryOp::divide || expr->op == BinaryOp::modulo) &&
      expr->right->constant != nullptr && expr->right->constant->kind == ConstKind::integer &&
      expr->right->constant->integer == 0 && !isReal(expr->operandType) &&
      expr->operandType->kind != TypeKind::anyReal) {
    report(Code::divisionByZero, expr->right->span, "division by zero", "this is always 0");
    return elementaryType(TypeKind::error);
  }
  if (!untyped(expr->operandType)) {
    setTarget(expr->left, expr->operandType);
    setTarget(expr->right, expr->operandType);
  }
  return expr->operandType;
}

const Type *Checker::checkTimeArithmetic(BinaryExpr *expr) {
  const Type *l = underlying(expr->left->type);
  const Type *r = underlying(expr->right->type);
  const bool sum = expr->op == BinaryOp::add;
  const bool difference = expr->op == BinaryOp::subtract;
  using enum TypeKind;
  // Durations with durations.
  if (isDuration(l) && isDuration(r)) {
    if (!sum && !difference && expr->op != BinaryOp::modulo)
      return operatorError(expr);
    expr->operandType = elementaryType(l->kind == ltime || r->kind == ltime ? ltime : time);
    setTarget(expr->left, expr->operandType);
    setTarget(expr->right, expr->operandType);
    return expr->operandType;
  }
  // A duration times or divided by a number.
  if ((isDuration(l) && isNumber(r) &&
       (expr->op == BinaryOp::multiply || expr->op == BinaryOp::divide)) ||
      (isNumber(l) && isDuration(r) && expr->op == BinaryOp::multiply)) {
    Expr *number = isDuration(l) ? expr->right : expr->left;
    if (untyped(number->type))
      settle(number);
    if (number->constant != nullptr && expr->op == BinaryOp::divide &&
        number->constant->kind == ConstKind::integer && number->constant->integer == 0) {
      report(Code::divisionByZero, number->span, "division by zero", "this is always 0");
      return elementaryType(error);
    }
    return isDuration(l) ? l : r; // operandType stays null: the operands have different types
  }
  // Points in time plus or minus a duration; differences of points in time.
  const bool pointLeft = isTimeOrDate(l) && !isDuration(l);
  const bool pointRight = isTimeOrDate(r) && !isDuration(r);
  if (pointLeft && isDuration(r) && l->kind != date && l->kind != ldate && (sum || difference))
    return l;
  if (pointLeft && pointRight && l == r && difference)
    return elementaryType(l->kind == date || l->kind == tod || l->kind == dt ? time : ltime);
  return operatorError(expr);
}

const Type *Checker::checkComparison(BinaryExpr *expr) {
  Expr *left = expr->left;
  Expr *right = expr->right;
  const Type *boolean = elementaryType(TypeKind::boolean);
  // An enumerator found without its type may belong to the other side's type.
  if (left->type->kind == TypeKind::enumeration && right->type->kind == TypeKind::enumeration &&
      left->type != right->type && left->kind == ExprKind::name && left->constant != nullptr)
    check(left, right->type);
  const Type *l = left->type;
  const Type *r = right->type;
  const bool equality = expr->op == BinaryOp::equal || expr->op == BinaryOp::notEqual;
  if (l->kind == TypeKind::enumeration && r->kind == TypeKind::enumeration && l != r)
    return operatorError(expr);
  if (l != r && (refuseStrict(left) || refuseStrict(right)))
    return elementaryType(TypeKind::error);
  const Type *ul = underlying(l);
  const Type *ur = underlying(r);
  if (isNumber(ul) && isNumber(ur)) {
    if (untyped(ul) && untyped(ur)) {
      expr->operandType = ul->kind == TypeKind::anyInteger && ur->kind == TypeKind::anyInteger
                              ? ul
                              : elementaryType(TypeKind::anyReal);
      return boolean;
    }
    const Type *common = commonOf(left, right);
    if (common == nullptr) {
      auto &d = report(Code::signedWithUlint, expr->opSpan,
                       "no integer type holds both " + typeName(l) + " and " + typeName(r),
                       "signed and 64-bit unsigned values cannot be compared");
      d.label(left->span, typeName(l));
      d.label(right->span, typeName(r));
      d.help("convert one of them: `" + typeName(ul) + "_TO_" + typeName(ur) + "(…)`");
      return elementaryType(TypeKind::error);
    }
    const Type *operation = widened(common);
    for (const Type *t : {ul, ur}) {
      if (isInteger(operation) && isInteger(t)) {
        if (const Type *both = commonNumber(operation, t))
          operation = both;
      }
    }
    expr->operandType = operation;
  } else if (ul->kind == TypeKind::boolean && ur->kind == TypeKind::boolean) {
    expr->operandType = ul;
  } else if (ul->kind == TypeKind::boolean || ur->kind == TypeKind::boolean) {
    // `b = 1`: 0 and 1 are BOOL literals too.
    Expr *other = ul->kind == TypeKind::boolean ? right : left;
    if (other->constant == nullptr || !constantFits(*other->constant, other->type, boolean))
      return operatorError(expr);
    expr->operandType = boolean;
  } else if (isCharacter(ul) || isCharacter(ur)) {
    Expr *other = isCharacter(ul) ? right : left;
    expr->operandType = isCharacter(ul) ? ul : ur;
    if (ul != ur && (other->constant == nullptr ||
                     !constantFits(*other->constant, other->type, expr->operandType)))
      return operatorError(expr);
  } else if (isString(ul) && ul->kind == ur->kind) {
    const auto length = std::max(typeAs<StringType>(ul)->length, typeAs<StringType>(ur)->length);
    expr->operandType = types_.string(ul->kind == TypeKind::wstring, length);
    return boolean; // the runtime compares strings of any two lengths: no conversion
  } else if (isTimeOrDate(ul) && isTimeOrDate(ur)) {
    if (ul == ur)
      expr->operandType = ul;
    else if (classify(ul, ur) == Conversion::free)
      expr->operandType = ur;
    else if (classify(ur, ul) == Conversion::free)
      expr->operandType = ul;
    else
      return operatorError(expr);
  } else if (equality && (ul->kind == TypeKind::interface || ur->kind == TypeKind::interface)) {
    // Interfaces are equal when they stand for the same instance, whatever their types are.
    expr->operandType = ul->kind == TypeKind::interface ? ul : ur;
    Expr *other = ul->kind == TypeKind::interface ? right : left;
    if (other->type->kind == TypeKind::interface)
      return boolean;
    if (!coerceToInterface(other, expr->operandType) || other->target == nullptr)
      return elementaryType(TypeKind::error);
    return boolean;
  } else if ((ul->kind == TypeKind::pointer || ur->kind == TypeKind::pointer) &&
             comparePointers(expr)) {
    return boolean;
  } else {
    return operatorError(expr);
  }
  setTarget(left, expr->operandType);
  setTarget(right, expr->operandType);
  return boolean;
}

const Type *Checker::checkLogical(BinaryExpr *expr) {
  if (refuseStrict(expr->left) || refuseStrict(expr->right))
    return elementaryType(TypeKind::error);
  const Type *l = underlying(expr->left->type);
  const Type *r = underlying(expr->right->type);
  const Type *boolean = elementaryType(TypeKind::boolean);
  const auto isBool = [&](const Expr *e, const Type *t) {
    return t->kind == TypeKind::boolean ||
           (e->constant != nullptr && constantFits(*e->constant, e->type, boolean));
  };
  const bool shortCircuit = expr->op == BinaryOp::andThen || expr->op == BinaryOp::orElse;
  if ((l->kind == TypeKind::boolean || r->kind == TypeKind::boolean || shortCircuit) &&
      isBool(expr->left, l) && isBool(expr->right, r)) {
    expr->operandType = boolean;
  } else if (!shortCircuit && l->kind == TypeKind::anyInteger && r->kind == TypeKind::anyInteger) {
    expr->operandType = l;
    return l;
  } else {
    // An address is a number here: `ADR(x) AND 16#3`.
    for (Expr *side : {expr->left, expr->right}) {
      if (!shortCircuit && underlying(side->type)->kind == TypeKind::pointer) {
        const Type *address = elementaryType(TypeKind::ulint);
        setTarget(side, address);
        Expr *other = side == expr->left ? expr->right : expr->left;
        const Type *o = underlying(other->type);
        if (!isInteger(o) && o->kind != TypeKind::anyInteger)
          return operatorError(expr);
        setTarget(other, address);
        expr->operandType = address;
        return address;
      }
    }
    const auto integral = [](const Type *t) {
      return isInteger(t) || t->kind == TypeKind::anyInteger;
    };
    if (shortCircuit || !integral(l) || !integral(r))
      return operatorError(expr);
    expr->operandType = commonOf(expr->left, expr->right);
    if (expr->operandType == nullptr) { // bit patterns have no sign: take the unsigned one
      expr->operandType = isSignedInteger(l) || l->kind == TypeKind::anyInteger ? r : l;
      for (Expr *side : {expr->left, expr->right}) {
        if (side->type->kind == TypeKind::anyInteger) { // a negative constant
          coerce(side, expr->operandType, {});
          return elementaryType(TypeKind::error);
        }
      }
    }
  }
  setTarget(expr->left, expr->operandType);
  setTarget(expr->right, expr->operandType);
  return expr->operandType;
}

const Type *Checker::checkPower(BinaryExpr *expr) {
  const Type *l = underlying(expr->left->type);
  const Type *r = underlying(expr->right->type);
  if (!isNumber(l) || !isNumber(r))
    return operatorError(expr);
  expr->operandType = elementaryType(
      l->kind == TypeKind::real && (r->kind == TypeKind::real || untyped(r)) ? TypeKind::real
                                                                             : TypeKind::lreal);
  if (untyped(l) && untyped(r)) // `r := 2.0 ** 0.5` is silent, as `r := 2.0` is
    expr->common = elementaryType(TypeKind::real);
  setTarget(expr->left, expr->operandType);
  setTarget(expr->right, expr->operandType);
  return expr->operandType;
}

} // namespace stc
