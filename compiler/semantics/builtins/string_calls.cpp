// LEN, LEFT, CONCAT … on STRING and WSTRING.

#include "compiler/semantics/builtins/internal.hpp"

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/builtins/builtin_calls.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/expressions/expressions.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;

namespace {

uint32_t lengthOf(const Argument &a) { return typeAs<StringType>(textOf(a))->length; }

} // namespace

/// CONCAT(a, b, c) is CONCAT(CONCAT(a, b), c).
static void concatInPairs(Context &c, CallExpr *expr) {
  for (Argument &a : expr->arguments)
    a.name = {}; // they are in their order
  const std::span<Argument> all = expr->arguments;
  Argument joined = all.front();
  for (size_t i = 1; i + 1 < all.size(); ++i) {
    auto *pair = c.arena.make<CallExpr>();
    pair->span = expr->span;
    pair->callee = expr->callee;
    pair->arguments = c.arena.copy(std::vector<Argument>{joined, all[i]});
    pair->resolved = Callee::Builtin;
    pair->builtin = Builtin::Concat;
    pair->type =
        c.types.string(textOf(joined)->kind == TypeKind::Wstring,
                       std::clamp<uint32_t>(lengthOf(joined) + lengthOf(all[i]), 1, 65535));
    foldCall(c, pair, pair->type);
    joined.value = pair;
  }
  expr->arguments = c.arena.copy(std::vector<Argument>{joined, all.back()});
}

const Type *checkStringBuiltin(Context &c, CallExpr *expr) {
  const Type *bad = elementaryType(TypeKind::Error);
  const auto textType = [&](size_t i) { return textOf(expr->arguments[i]); };
  const auto length = [&](size_t i) { return lengthOf(expr->arguments[i]); };
  const auto integer = [&](size_t i) {
    Expr *value = expr->arguments[i].value;
    if (!isInteger(underlying(value->type)) && value->type->kind != TypeKind::AnyInteger)
      return false;
    setTarget(value, elementaryType(TypeKind::Dint));
    return true;
  };
  size_t strings = 1;
  size_t count = 1;
  switch (expr->builtin) {
  case Builtin::Len:
    break;
  case Builtin::Left:
  case Builtin::Right:
    count = 2;
    break;
  case Builtin::Mid:
  case Builtin::Delete:
    count = 3;
    break;
  case Builtin::Concat:
    count = strings = std::max<size_t>(2, expr->arguments.size());
    break;
  case Builtin::Find:
    count = strings = 2;
    break;
  case Builtin::Insert:
    count = 3;
    strings = 2;
    break;
  default: // replace
    count = 4;
    strings = 2;
    break;
  }
  if (!requireCount(c, expr, count, expr->builtin == Builtin::Concat ? SIZE_MAX : count))
    return bad;
  // CODESYS has WLEN, WLEFT … for WSTRING only.
  const std::string name = calleeName(expr);
  const bool wideOnly = name.front() == 'W' || name.front() == 'w';
  for (size_t i = 0; i < count; ++i) {
    if (isError(expr->arguments[i].value->type))
      return bad;
    Expr *value = expr->arguments[i].value;
    if (isCharacter(underlying(value->type)) && i < strings &&
        (i > 0 || expr->builtin == Builtin::Concat))
      setTarget(value, c.types.string(underlying(value->type)->kind == TypeKind::Wchar, 1));
    if (wideOnly && i < strings && textType(i)->kind != TypeKind::Wstring)
      return argumentError(c, expr, i, "a WSTRING");
    if (i < strings ? !isString(textType(i)) : !integer(i))
      return argumentError(c, expr, i, i < strings ? "a string" : "an integer");
    if (i > 0 && i < strings && textType(0)->kind != textType(i)->kind)
      return argumentError(c, expr, i, typeName(textType(0)));
  }
  if (expr->builtin == Builtin::Len || expr->builtin == Builtin::Find)
    return elementaryType(length(0) > 32767 ? TypeKind::Dint : TypeKind::Int);
  if (expr->builtin == Builtin::Concat && count > 2)
    concatInPairs(c, expr);
  uint32_t result = length(0);
  if (expr->builtin == Builtin::Concat || expr->builtin == Builtin::Insert ||
      expr->builtin == Builtin::Replace)
    result = std::min<uint32_t>(65535, length(0) + length(1));
  return c.types.string(textType(0)->kind == TypeKind::Wstring, std::max(result, 1U));
}

} // namespace stc::sema
