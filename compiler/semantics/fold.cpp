#include "compiler/semantics/fold.hpp"

#include "compiler/semantics/fold_builtins.hpp"
#include "runtime/iec/math.h"

#include <cmath>
#include <limits>

namespace stc {

namespace {

using ast::BinaryOp;

ConstValue realOf(double v, const Type *type) {
  return {ConstKind::Real,
          0,
          type->kind == TypeKind::Real ? static_cast<double>(static_cast<float>(v)) : v,
          {}};
}

uint64_t bits(int64_t v) { return static_cast<uint64_t>(v); }

double toDouble(const ConstValue &v, const Type *from) {
  if (v.kind == ConstKind::Real)
    return v.real;
  return isUnsigned64(from) ? static_cast<double>(bits(v.integer)) : static_cast<double>(v.integer);
}

/// Rounds half away from zero and saturates, NaN gives 0 (dialect table).
int64_t roundToInteger(double v, const Type *to) {
  if (std::isnan(v))
    return 0;
  const double r = std::round(v);
  const Type *u = underlying(to);
  const unsigned width = bitWidth(u);
  const bool isSigned = isSignedInteger(u) || u->kind == TypeKind::Ltime;
  if (isSigned) {
    const auto high = std::numeric_limits<int64_t>::max() >> (64 - width);
    if (r >= static_cast<double>(high))
      return high;
    if (r <= static_cast<double>(-high - 1))
      return -high - 1;
    return static_cast<int64_t>(r);
  }
  if (r <= 0)
    return 0;
  const uint64_t high = std::numeric_limits<uint64_t>::max() >> (64 - width);
  if (r >= static_cast<double>(high))
    return static_cast<int64_t>(high);
  return static_cast<int64_t>(static_cast<uint64_t>(r));
}

std::optional<ConstValue> foldReal(BinaryOp op, double a, double b, const Type *type) {
  switch (op) {
  case BinaryOp::Add:
    return realOf(a + b, type);
  case BinaryOp::Subtract:
    return realOf(a - b, type);
  case BinaryOp::Multiply:
    return realOf(a * b, type);
  case BinaryOp::Divide:
    return realOf(a / b, type);
  case BinaryOp::Equal:
    return integerValue(a == b);
  case BinaryOp::NotEqual:
    return integerValue(a != b);
  case BinaryOp::Less:
    return integerValue(a < b);
  case BinaryOp::LessEqual:
    return integerValue(a <= b);
  case BinaryOp::Greater:
    return integerValue(a > b);
  case BinaryOp::GreaterEqual:
    return integerValue(a >= b);
  case BinaryOp::Power: // the run time's own, so that both give the same bits
    if (type->kind == TypeKind::Real)
      return realOf(static_cast<double>(stride::pow(static_cast<float>(a), static_cast<float>(b))),
                    type);
    return realOf(stride::pow(a, b), type);
  default:
    return std::nullopt;
  }
}

std::optional<ConstValue> foldTexts(BinaryOp op, const ConstValue &a, const ConstValue &b,
                                    const Type *type) {
  const int order = compareTexts(a.text, b.text, type->kind == TypeKind::Wstring);
  switch (op) {
  case BinaryOp::Equal:
    return integerValue(order == 0);
  case BinaryOp::NotEqual:
    return integerValue(order != 0);
  case BinaryOp::Less:
    return integerValue(order < 0);
  case BinaryOp::LessEqual:
    return integerValue(order <= 0);
  case BinaryOp::Greater:
    return integerValue(order > 0);
  case BinaryOp::GreaterEqual:
    return integerValue(order >= 0);
  default:
    return std::nullopt;
  }
}

bool less(int64_t a, int64_t b, const Type *type) {
  return isUnsigned64(type) ? bits(a) < bits(b) : a < b;
}

/// Untyped constants have 64 bits and no wrap-around.
std::optional<ConstValue> foldUntyped(BinaryOp op, int64_t a, int64_t b) {
  int64_t r = 0;
  bool overflow = false;
  if (op == BinaryOp::Add)
    overflow = __builtin_add_overflow(a, b, &r);
  else if (op == BinaryOp::Subtract)
    overflow = __builtin_sub_overflow(a, b, &r);
  else
    overflow = __builtin_mul_overflow(a, b, &r);
  if (overflow)
    return std::nullopt;
  return integerValue(r);
}

std::optional<ConstValue> foldDivision(BinaryOp op, int64_t a, int64_t b, const Type *type) {
  if (b == 0)
    return std::nullopt;
  const bool quotient = op == BinaryOp::Divide;
  if (isUnsigned64(type)) {
    const uint64_t r = quotient ? bits(a) / bits(b) : bits(a) % bits(b);
    return integerValue(static_cast<int64_t>(r));
  }
  if (b == -1) { // MIN / -1 = MIN, MIN MOD -1 = 0
    if (type->kind == TypeKind::AnyInteger && quotient && a == std::numeric_limits<int64_t>::min())
      return std::nullopt;
    return integerValue(quotient ? wrapTo(type, static_cast<int64_t>(0 - bits(a))) : 0);
  }
  return integerValue(quotient ? a / b : a % b);
}

} // namespace

int64_t wrapTo(const Type *type, int64_t value) {
  const Type *u = underlying(type);
  if (u->kind == TypeKind::AnyInteger)
    return value;
  if (u->kind == TypeKind::Boolean)
    return value & 1;
  const unsigned width = bitWidth(u);
  if (width == 64)
    return value;
  const unsigned shift = 64 - width;
  if (isSignedInteger(u))
    return static_cast<int64_t>(bits(value) << shift) >> shift;
  return static_cast<int64_t>((bits(value) << shift) >> shift);
}

std::optional<ConstValue> convertConstant(const ConstValue &value, const Type *from,
                                          const Type *to) {
  const Type *f = underlying(from);
  const Type *t = underlying(to);
  if (value.kind == ConstKind::String && isCharacter(t))
    return integerValue(wrapTo(t, firstUnit(value.text, f->kind == TypeKind::Wstring)));
  if (value.kind == ConstKind::String)
    return isString(t) && f->kind == t->kind ? std::optional(value) : std::nullopt;
  if (isString(t))
    return std::nullopt;
  if (isReal(t) || t->kind == TypeKind::AnyReal) {
    if (isTimeOrDate(f))
      return std::nullopt;
    if (t->kind == TypeKind::Real && value.kind == ConstKind::Integer) // rounded once, not twice
      return realOf(static_cast<double>(isUnsigned64(f) ? static_cast<float>(bits(value.integer))
                                                        : static_cast<float>(value.integer)),
                    t);
    return realOf(toDouble(value, f), t);
  }
  if (t->kind == TypeKind::Boolean)
    return integerValue(value.kind == ConstKind::Real ? value.real != 0 : value.integer != 0);
  if (isTimeOrDate(f) || isTimeOrDate(t)) {
    using enum TypeKind;
    if (f->kind == t->kind)
      return value;
    if ((f->kind == Time && t->kind == Ltime) || (f->kind == Tod && t->kind == Ltod))
      return integerValue(value.integer * 1'000'000); // ms to ns
    if ((f->kind == Date && t->kind == Ldate) || (f->kind == Dt && t->kind == Ldt))
      return integerValue(value.integer * 1'000'000'000); // s to ns
    return std::nullopt;                                  // the runtime converts
  }
  if (value.kind == ConstKind::Real)
    return integerValue(roundToInteger(value.real, t));
  return integerValue(wrapTo(t, value.integer));
}

std::optional<ConstValue> foldBinary(BinaryOp op, const ConstValue &left, const ConstValue &right,
                                     const Type *type) {
  if (left.kind == ConstKind::String && right.kind == ConstKind::String)
    return foldTexts(op, left, right, type);
  if (left.kind == ConstKind::String || right.kind == ConstKind::String)
    return std::nullopt;
  if (left.kind == ConstKind::Real || right.kind == ConstKind::Real)
    return foldReal(op, toDouble(left, type), toDouble(right, type), type);
  const int64_t a = left.integer;
  const int64_t b = right.integer;
  switch (op) {
  case BinaryOp::Add:
  case BinaryOp::Subtract:
  case BinaryOp::Multiply: {
    if (type->kind == TypeKind::AnyInteger)
      return foldUntyped(op, a, b);
    const uint64_t r = op == BinaryOp::Add        ? bits(a) + bits(b)
                       : op == BinaryOp::Subtract ? bits(a) - bits(b)
                                                  : bits(a) * bits(b);
    return integerValue(wrapTo(type, static_cast<int64_t>(r)));
  }
  case BinaryOp::Divide:
  case BinaryOp::Modulo:
    return foldDivision(op, a, b, type);
  case BinaryOp::Power:
    return std::nullopt;
  case BinaryOp::Equal:
    return integerValue(a == b);
  case BinaryOp::NotEqual:
    return integerValue(a != b);
  case BinaryOp::Less:
    return integerValue(less(a, b, type));
  case BinaryOp::LessEqual:
    return integerValue(!less(b, a, type));
  case BinaryOp::Greater:
    return integerValue(less(b, a, type));
  case BinaryOp::GreaterEqual:
    return integerValue(!less(a, b, type));
  case BinaryOp::LogicalAnd:
  case BinaryOp::AndThen:
    return integerValue(wrapTo(type, a & b));
  case BinaryOp::LogicalOr:
  case BinaryOp::OrElse:
    return integerValue(wrapTo(type, a | b));
  case BinaryOp::LogicalXor:
    return integerValue(wrapTo(type, a ^ b));
  }
  return std::nullopt;
}

std::optional<ConstValue> foldUnary(ast::UnaryOp op, const ConstValue &value, const Type *type) {
  if (value.kind == ConstKind::String)
    return std::nullopt;
  if (op == ast::UnaryOp::Plus)
    return value;
  if (op == ast::UnaryOp::LogicalNot) {
    if (value.kind == ConstKind::Real)
      return std::nullopt;
    return integerValue(type->kind == TypeKind::Boolean ? (value.integer == 0)
                                                        : wrapTo(type, ~value.integer));
  }
  if (value.kind == ConstKind::Real)
    return realOf(-value.real, type);
  if (type->kind == TypeKind::AnyInteger && value.integer == std::numeric_limits<int64_t>::min())
    return std::nullopt;
  return integerValue(wrapTo(type, static_cast<int64_t>(0 - bits(value.integer))));
}

} // namespace stc
