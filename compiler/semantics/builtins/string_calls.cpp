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

/// What a number of characters becomes: a type in which it does not fall below 0 when it is large.
static const Type *countTypeOf(const Expr *value, const Type *kind) {
  if (!isInteger(kind))
    kind = smallestInteger(value->constant->integer);
  if (isUnsigned64(kind))
    return elementaryType(TypeKind::Ulint);
  const bool isLong = bitWidth(kind) > 32 || (bitWidth(kind) == 32 && !isSignedInteger(kind));
  return elementaryType(isLong ? TypeKind::Lint : TypeKind::Dint);
}

/// Whether the arguments are texts and numbers of characters; what is not has been reported.
static bool areTexts(Context &c, CallExpr *expr, size_t texts, bool characterFirst) {
  // CODESYS has WLEN, WLEFT … for WSTRING only.
  const std::string name = calleeName(expr);
  const bool wideOnly = name.front() == 'W' || name.front() == 'w';
  const auto refuse = [&](size_t i, std::string_view wanted) {
    argumentError(c, expr, i, wanted);
    return false;
  };
  for (size_t i = 0; i < expr->arguments.size(); ++i) {
    Expr *value = valueOf(expr, i);
    const Type *kind = kindOf(expr, i);
    if (isError(value->type))
      return false;
    if (i >= texts) {
      if (!isInteger(kind) && value->type->kind != TypeKind::AnyInteger)
        return refuse(i, "an integer");
      setTarget(value, countTypeOf(value, kind));
      continue;
    }
    if (isCharacter(kind) && (i > 0 || characterFirst))
      setTarget(value, c.types.string(kind->kind == TypeKind::Wchar, 1));
    const Type *text = textOf(expr->arguments[i]);
    if (wideOnly && text->kind != TypeKind::Wstring)
      return refuse(i, "a WSTRING");
    if (!isString(text))
      return refuse(i, "a string");
    const Type *first = textOf(expr->arguments[0]);
    if (first->kind != text->kind)
      return refuse(i, typeName(first));
  }
  return true;
}

/// With room for the first `texts` arguments.
static const Type *joinedType(Context &c, const CallExpr *expr, size_t texts) {
  uint32_t length = 0;
  for (size_t i = 0; i < texts; ++i)
    length += lengthOf(expr->arguments[i]);
  const bool isWide = textOf(expr->arguments[0])->kind == TypeKind::Wstring;
  return c.types.string(isWide, std::clamp<uint32_t>(length, 1, 65535));
}

const Type *checkTexts(Context &c, CallExpr *expr, size_t texts) {
  return areTexts(c, expr, texts, false) ? joinedType(c, expr, texts)
                                         : elementaryType(TypeKind::Error);
}

const Type *checkTextsForNumber(Context &c, CallExpr *expr, size_t texts) {
  if (!areTexts(c, expr, texts, false))
    return elementaryType(TypeKind::Error);
  return elementaryType(lengthOf(expr->arguments[0]) > 32767 ? TypeKind::Dint : TypeKind::Int);
}

const Type *checkConcat(Context &c, CallExpr *expr) {
  if (!areTexts(c, expr, expr->arguments.size(), true))
    return elementaryType(TypeKind::Error);
  if (expr->arguments.size() > 2)
    concatInPairs(c, expr);
  return joinedType(c, expr, 2);
}

} // namespace stc::sema
