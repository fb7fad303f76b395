#include "compiler/semantics/fold_builtins.hpp"

#include "compiler/semantics/fold.hpp"
#include "compiler/semantics/fold_texts.hpp"
#include "runtime/iec/ops.h"

#include <array>

namespace stc {

using ast::BinaryOp;

namespace {

// -------------------------------------------------------------------------------------------------
// real numbers

// The functions that the generated code calls, on REAL and on LREAL.
struct Sqrt {
  auto operator()(auto x, auto) const { return stride::sqrt(x); }
};
struct Ln {
  auto operator()(auto x, auto) const { return stride::ln(x); }
};
struct Log {
  auto operator()(auto x, auto) const { return stride::log10(x); }
};
struct Exp {
  auto operator()(auto x, auto) const { return stride::exp(x); }
};
struct Sin {
  auto operator()(auto x, auto) const { return stride::sin(x); }
};
struct Cos {
  auto operator()(auto x, auto) const { return stride::cos(x); }
};
struct Tan {
  auto operator()(auto x, auto) const { return stride::tan(x); }
};
struct Asin {
  auto operator()(auto x, auto) const { return stride::asin(x); }
};
struct Acos {
  auto operator()(auto x, auto) const { return stride::acos(x); }
};
struct Atan {
  auto operator()(auto x, auto) const { return stride::atan(x); }
};
struct Atan2 {
  auto operator()(auto x, auto y) const { return stride::atan2(x, y); }
};
struct Expt {
  auto operator()(auto x, auto y) const { return stride::pow(x, y); }
};

/// A function of one or two real numbers.
template <class Function> std::optional<ConstValue> foldReal(const FoldCall &call) {
  const double x = call.arguments[0].value.real;
  const double y = call.arguments.size() > 1 ? call.arguments[1].value.real : 0;
  if (underlying(call.result)->kind == TypeKind::Real)
    return realValue(Function()(static_cast<float>(x), static_cast<float>(y)));
  return realValue(Function()(x, y));
}

std::optional<ConstValue> foldAbs(const FoldCall &call) {
  const ConstArgument &x = call.arguments[0];
  if (x.value.kind == ConstKind::Real)
    return realValue(stride::abs(x.value.real));
  const Type *u = underlying(x.type);
  if (x.value.integer < 0 && (isSignedInteger(u) || u->kind == TypeKind::Ltime))
    return integerValue(
        wrapTo(u, static_cast<int64_t>(0 - static_cast<uint64_t>(x.value.integer))));
  return x.value;
}

std::optional<ConstValue> foldTrunc(const FoldCall &call) {
  const Type *t = underlying(call.result);
  const double value = call.arguments[0].value.real;
  const auto cut = [&](auto narrow) {
    using T = decltype(narrow);
    return integerValue(static_cast<int64_t>(stride::truncate<T>(value)));
  };
  switch (bitWidth(t)) {
  case 8:
    return isSignedInteger(t) ? cut(int8_t{}) : cut(uint8_t{});
  case 16:
    return isSignedInteger(t) ? cut(int16_t{}) : cut(uint16_t{});
  case 32:
    return isSignedInteger(t) ? cut(int32_t{}) : cut(uint32_t{});
  default:
    return isSignedInteger(t) ? cut(int64_t{}) : cut(uint64_t{});
  }
}

std::optional<ConstValue> foldIsValid(const FoldCall &call) {
  return integerValue(stride::isValid<uint8_t>(call.arguments[0].value.real));
}

// -------------------------------------------------------------------------------------------------
// selection

bool less(const ConstArgument &a, const ConstArgument &b) {
  if (a.value.kind == ConstKind::String)
    return compareTexts(a.value.text, b.value.text, a.type->kind == TypeKind::Wstring) < 0;
  if (a.value.kind == ConstKind::Real)
    return a.value.real < b.value.real;
  if (isUnsigned64(a.type))
    return static_cast<uint64_t>(a.value.integer) < static_cast<uint64_t>(b.value.integer);
  return a.value.integer < b.value.integer;
}

std::optional<ConstValue> foldItself(const FoldCall &call) { return call.arguments[0].value; }

std::optional<ConstValue> foldMin(const FoldCall &call) {
  const ConstArgument *best = &call.arguments[0];
  for (const ConstArgument &a : call.arguments.subspan(1)) {
    if (less(a, *best))
      best = &a;
  }
  return best->value;
}

std::optional<ConstValue> foldMax(const FoldCall &call) {
  const ConstArgument *best = &call.arguments[0];
  for (const ConstArgument &a : call.arguments.subspan(1)) {
    if (less(*best, a))
      best = &a;
  }
  return best->value;
}

std::optional<ConstValue> foldLimit(const FoldCall &call) {
  const ConstArgument &least = call.arguments[0];
  const ConstArgument &most = call.arguments[2];
  const ConstArgument &low = less(call.arguments[1], least) ? least : call.arguments[1];
  return (less(most, low) ? most : low).value;
}

std::optional<ConstValue> foldSel(const FoldCall &call) {
  return call.arguments[call.arguments[0].value.integer != 0 ? 2 : 1].value;
}

std::optional<ConstValue> foldMux(const FoldCall &call) {
  const int64_t at = call.arguments[0].value.integer;
  if (at < 0 || static_cast<uint64_t>(at) + 1 >= call.arguments.size())
    return std::nullopt;
  return call.arguments[static_cast<size_t>(at) + 1].value;
}

/// GT(a, b, c …): each argument with the next one.
template <ast::BinaryOp op> std::optional<ConstValue> foldOrder(const FoldCall &call) {
  bool all = true;
  for (size_t i = 1; i < call.arguments.size(); ++i) {
    const auto pair = foldBinary(op, call.arguments[i - 1].value, call.arguments[i].value,
                                 call.arguments[i].type);
    if (!pair)
      return std::nullopt;
    all = all && pair->integer != 0;
  }
  return integerValue(all ? 1 : 0);
}

// -------------------------------------------------------------------------------------------------
// bit strings

struct Shl {
  auto operator()(auto x, int64_t n) const { return stride::shl(x, n); }
};
struct Shr {
  auto operator()(auto x, int64_t n) const { return stride::shr(x, n); }
};
struct Rol {
  auto operator()(auto x, int64_t n) const { return stride::rol(x, n); }
};
struct Ror {
  auto operator()(auto x, int64_t n) const { return stride::ror(x, n); }
};

template <class Function> std::optional<ConstValue> foldShift(const FoldCall &call) {
  const auto shifted = [&](auto kind) {
    const auto x = static_cast<decltype(kind)>(call.arguments[0].value.integer);
    return integerValue(static_cast<int64_t>(Function()(x, call.arguments[1].value.integer)));
  };
  const bool isSigned = isSignedInteger(call.result);
  switch (bitWidth(call.result)) {
  case 8:
    return isSigned ? shifted(int8_t{}) : shifted(uint8_t{});
  case 16:
    return isSigned ? shifted(int16_t{}) : shifted(uint16_t{});
  case 32:
    return isSigned ? shifted(int32_t{}) : shifted(uint32_t{});
  default:
    return isSigned ? shifted(int64_t{}) : shifted(uint64_t{});
  }
}

uint64_t patternOf(const FoldCall &call) {
  return static_cast<uint64_t>(call.arguments[0].value.integer);
}

std::optional<ConstValue> foldFromBcd(const FoldCall &call) {
  return integerValue(wrapTo(call.result, stride::fromBcd<int64_t>(patternOf(call))));
}

std::optional<ConstValue> foldToBcd(const FoldCall &call) {
  return integerValue(wrapTo(call.result, stride::toBcd<int64_t>(patternOf(call))));
}

std::optional<ConstValue> foldIsValidBcd(const FoldCall &call) {
  return integerValue(stride::isValidBcd<uint8_t>(patternOf(call)));
}

int64_t swapped(const Type *type, int64_t value) {
  switch (bitWidth(underlying(type))) {
  case 64:
    return static_cast<int64_t>(stride::swapBytes(static_cast<uint64_t>(value)));
  case 32:
    return wrapTo(type, stride::swapBytes(static_cast<uint32_t>(value)));
  case 16:
    return wrapTo(type, stride::swapBytes(static_cast<uint16_t>(value)));
  default:
    return value;
  }
}

/// Nothing of a REAL: what its bytes mean backwards has bits that no constant keeps.
std::optional<ConstValue> foldSwapped(const FoldCall &call) {
  const ConstValue &value = call.arguments[0].value;
  if (value.kind == ConstKind::Real)
    return std::nullopt;
  return integerValue(swapped(call.result, value.integer));
}

// -------------------------------------------------------------------------------------------------

using Fold = std::optional<ConstValue> (*)(const FoldCall &call);

/// By the number of the function.
constexpr Fold kFolds[] = {
#define STC_BUILTIN(enumerator, name, signature, takes, check, fold, ...) Fold fold,
#include "compiler/semantics/builtins.def"
};

} // namespace

std::optional<ConstValue> foldBuiltin(ast::Builtin function,
                                      std::span<const ConstArgument> arguments, const Type *result,
                                      Arena &arena) {
  const Fold fold = kFolds[static_cast<size_t>(function)];
  if (arguments.empty() || fold == nullptr)
    return std::nullopt;
  return fold({arguments, result, arena});
}

} // namespace stc
