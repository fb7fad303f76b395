#include "compiler/semantics/fold.hpp"

#include "compiler/semantics/fold_builtins.hpp"
#include "runtime/iec/math.h"

#include <cmath>
#include <limits>

namespace stc {

namespace {

using ast::BinaryOp;

ConstValue realValue(double v, const Type *type) {
  return {ConstKind::real,
          0,
          type->kind == TypeKind::real ? static_cast<double>(static_cast<float>(v)) : v,
          {}};
}

std::uint64_t bits(std::int64_t v) { return static_cast<std::uint64_t>(v); }

double toDouble(const ConstValue &v, const Type *from) {
  if (v.kind == ConstKind::real)
    return v.real;
  return isUnsigned64(from) ? static_cast<double>(bits(v.integer)) : static_cast<double>(v.integer);
}

/// Rounds half away from zero and saturates, NaN gives 0 (dialect table).
std::int64_t roundToInteger(double v, const Type *to) {
  if (std::isnan(v))
    return 0;
  const double r = std::round(v);
  const Type *u = underlying(to);
  const unsigned width = bitWidth(u);
  const bool isSigned = isSignedInteger(u) || u->kind == TypeKind::ltime;
  if (isSigned) {
    const auto high = std::numeric_limits<std::int64_t>::max() >> (64 - width);
    if (r >= static_cast<double>(high))
      return high;
    if (r <= static_cast<double>(-high - 1))
      return -high - 1;
    return static_cast<std::int64_t>(r);
  }
  if (r <= 0)
    return 0;
  const std::uint64_t high = std::numeric_limits<std::uint64_t>::max() >> (64 - width);
  if (r >= static_cast<double>(high))
    return static_cast<std::int64_t>(high);
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(r));
}

std::optional<ConstValue> foldReal(BinaryOp op, double a, double b, const Type *type) {
  switch (op) {
  case BinaryOp::add:
    return realValue(a + b, type);
  case BinaryOp::subtract:
    return realValue(a - b, type);
  case BinaryOp::multiply:
    return realValue(a * b, type);
  case BinaryOp::divide:
    return realValue(a / b, type);
  case BinaryOp::equal:
    return integerValue(a == b);
  case BinaryOp::notEqual:
    return integerValue(a != b);
  case BinaryOp::less:
    return integerValue(a < b);
  case BinaryOp::lessEqual:
    return integerValue(a <= b);
  case BinaryOp::greater:
    return integerValue(a > b);
  case BinaryOp::greaterEqual:
    return integerValue(a >= b);
  case BinaryOp::power: // the run time's own, so that both give the same bits
    if (type->kind == TypeKind::real)
      return realValue(
          static_cast<double>(stride::pow(static_cast<float>(a), static_cast<float>(b))), type);
    return realValue(stride::pow(a, b), type);
  default:
    return std::nullopt;
  }
}

std::optional<ConstValue> foldTexts(BinaryOp op, const ConstValue &a, const ConstValue &b,
                                    const Type *type) {
  const int order = compareTexts(a.text, b.text, type->kind == TypeKind::wstring);
  switch (op) {
  case BinaryOp::equal:
    return integerValue(order == 0);
  case BinaryOp::notEqual:
    return integerValue(order != 0);
  case BinaryOp::less:
    return integerValue(order < 0);
  case BinaryOp::lessEqual:
    return integerValue(order <= 0);
  case BinaryOp::greater:
    return integerValue(order > 0);
  case BinaryOp::greaterEqual:
    return integerValue(order >= 0);
  default:
    return std::nullopt;
  }
}

bool less(std::int64_t a, std::int64_t b, const Type *type) {
  return isUnsigned64(type) ? bits(a) < bits(b) : a < b;
}

/// Untyped constants have 64 bits and no wrap-around.
std::optional<ConstValue> foldUntyped(BinaryOp op, std::int64_t a, std::int64_t b) {
  std::int64_t r = 0;
  bool overflow = false;
  if (op == BinaryOp::add)
    overflow = __builtin_add_overflow(a, b, &r);
  else if (op == BinaryOp::subtract)
    overflow = __builtin_sub_overflow(a, b, &r);
  else
    overflow = __builtin_mul_overflow(a, b, &r);
  if (overflow)
    return std::nullopt;
  return integerValue(r);
}

std::optional<ConstValue> foldDivision(BinaryOp op, std::int64_t a, std::int64_t b,
                                       const Type *type) {
  if (b == 0)
    return std::nullopt;
  const bool quotient = op == BinaryOp::divide;
  if (isUnsigned64(type)) {
    const std::uint64_t r = quotient ? bits(a) / bits(b) : bits(a) % bits(b);
    return integerValue(static_cast<std::int64_t>(r));
  }
  if (b == -1) { // MIN / -1 = MIN, MIN MOD -1 = 0
    if (type->kind == TypeKind::anyInteger && quotient &&
        a == std::numeric_limits<std::int64_t>::min())
      return std::nullopt;
    return integerValue(quotient ? wrapTo(type, static_cast<std::int64_t>(0 - bits(a))) : 0);
  }
  return integerValue(quotient ? a / b : a % b);
}

} // namespace

std::int64_t wrapTo(const Type *type, std::int64_t value) {
  const Type *u = underlying(type);
  if (u->kind == TypeKind::anyInteger)
    return value;
  if (u->kind == TypeKind::boolean)
    return value & 1;
  const unsigned width = bitWidth(u);
  if (width == 64)
    return value;
  const unsigned shift = 64 - width;
  if (isSignedInteger(u))
    return static_cast<std::int64_t>(bits(value) << shift) >> shift;
  return static_cast<std::int64_t>((bits(value) << shift) >> shift);
}

std::optional<ConstValue> convertConstant(const ConstValue &value, const Type *from,
                                          const Type *to) {
  const Type *f = underlying(from);
  const Type *t = underlying(to);
  if (value.kind == ConstKind::string && isCharacter(t))
    return integerValue(wrapTo(t, firstUnit(value.text, f->kind == TypeKind::wstring)));
  if (value.kind == ConstKind::string)
    return isString(t) && f->kind == t->kind ? std::optional(value) : std::nullopt;
  if (isString(t))
    return std::nullopt;
  if (isReal(t) || t->kind == TypeKind::anyReal) {
    if (isTimeOrDate(f))
      return std::nullopt;
    if (t->kind == TypeKind::real && value.kind == ConstKind::integer) // rounded once, not twice
      return realValue(static_cast<double>(isUnsigned64(f) ? static_cast<float>(bits(value.integer))
                                                           : static_cast<float>(value.integer)),
                       t);
    return realValue(toDouble(value, f), t);
  }
  if (t->kind == TypeKind::boolean)
    return integerValue(value.kind == ConstKind::real ? value.real != 0 : value.integer != 0);
  if (isTimeOrDate(f) || isTimeOrDate(t)) {
    using enum TypeKind;
    if (f->kind == t->kind)
      return value;
    if ((f->kind == time && t->kind == ltime) || (f->kind == tod && t->kind == ltod))
      return integerValue(value.integer * 1'000'000); // ms to ns
    if ((f->kind == date && t->kind == ldate) || (f->kind == dt && t->kind == ldt))
      return integerValue(value.integer * 1'000'000'000); // s to ns
    return std::nullopt;                                  // the runtime converts
  }
  if (value.kind == ConstKind::real)
    return integerValue(roundToInteger(value.real, t));
  return integerValue(wrapTo(t, value.integer));
}

std::optional<ConstValue> foldBinary(BinaryOp op, const ConstValue &left, const ConstValue &right,
                                     const Type *type) {
  if (left.kind == ConstKind::string && right.kind == ConstKind::string)
    return foldTexts(op, left, right, type);
  if (left.kind == ConstKind::string || right.kind == ConstKind::string)
    return std::nullopt;
  if (left.kind == ConstKind::real || right.kind == ConstKind::real)
    return foldReal(op, toDouble(left, type), toDouble(right, type), type);
  const std::int64_t a = left.integer;
  const std::int64_t b = right.integer;
  switch (op) {
  case BinaryOp::add:
  case BinaryOp::subtract:
  case BinaryOp::multiply: {
    if (type->kind == TypeKind::anyInteger)
      return foldUntyped(op, a, b);
    const std::uint64_t r = op == BinaryOp::add        ? bits(a) + bits(b)
                            : op == BinaryOp::subtract ? bits(a) - bits(b)
                                                       : bits(a) * bits(b);
    return integerValue(wrapTo(type, static_cast<std::int64_t>(r)));
  }
  case BinaryOp::divide:
  case BinaryOp::modulo:
    return foldDivision(op, a, b, type);
  case BinaryOp::power:
    return std::nullopt;
  case BinaryOp::equal:
    return integerValue(a == b);
  case BinaryOp::notEqual:
    return integerValue(a != b);
  case BinaryOp::less:
    return integerValue(less(a, b, type));
  case BinaryOp::lessEqual:
    return integerValue(!less(b, a, type));
  case BinaryOp::greater:
    return integerValue(less(b, a, type));
  case BinaryOp::greaterEqual:
    return integerValue(!less(a, b, type));
  case BinaryOp::logicalAnd:
  case BinaryOp::andThen:
    return integerValue(wrapTo(type, a & b));
  case BinaryOp::logicalOr:
  case BinaryOp::orElse:
    return integerValue(wrapTo(type, a | b));
  case BinaryOp::logicalXor:
    return integerValue(wrapTo(type, a ^ b));
  }
  return std::nullopt;
}

std::optional<ConstValue> foldUnary(ast::UnaryOp op, const ConstValue &value, const Type *type) {
  if (value.kind == ConstKind::string)
    return std::nullopt;
  if (op == ast::UnaryOp::plus)
    return value;
  if (op == ast::UnaryOp::logicalNot) {
    if (value.kind == ConstKind::real)
      return std::nullopt;
    return integerValue(type->kind == TypeKind::boolean ? (value.integer == 0)
                                                        : wrapTo(type, ~value.integer));
  }
  if (value.kind == ConstKind::real)
    return realValue(-value.real, type);
  if (type->kind == TypeKind::anyInteger &&
      value.integer == std::numeric_limits<std::int64_t>::min())
    return std::nullopt;
  return integerValue(wrapTo(type, static_cast<std::int64_t>(0 - bits(value.integer))));
}

} // namespace stc
