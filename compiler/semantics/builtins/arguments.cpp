// The arguments of built-in functions: how many, of which types, by which names.

#include "compiler/semantics/builtins/builtin_calls.hpp"

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/builtins/internal.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/fold.hpp"
#include "compiler/semantics/fold_builtins.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;

static const Type *commonBeforeWidening(const CallExpr *expr, size_t first);

bool requireCount(Context &c, CallExpr *expr, size_t least, size_t most) {
  const size_t count = expr->arguments.size();
  if (count >= least && count <= most)
    return true;
  const std::string wanted = least == most ? std::to_string(least)
                             : most == SIZE_MAX
                                 ? "at least " + std::to_string(least)
                                 : std::to_string(least) + " to " + std::to_string(most);
  c.report(Code::WrongArgumentCount, expr->span,
           "`" + calleeName(expr) + "` takes " + wanted +
               (least == 1 && most == 1 ? " argument" : " arguments") + ", not " +
               std::to_string(count),
           "in this call");
  return false;
}

const Type *argumentError(Context &c, CallExpr *expr, size_t index, std::string_view wanted) {
  Expr *value = expr->arguments[index].value;
  c.report(Code::WrongArgumentType, value->span,
           "`" + calleeName(expr) + "` needs " + std::string(wanted) + " here, not " +
               typeName(value->type),
           "expected " + std::string(wanted));
  return elementaryType(TypeKind::Error);
}

const Type *commonOfArguments(Context &c, CallExpr *expr, size_t first) {
  // All one type, else the common number type; untyped constants follow the others.
  Expr *lead = nullptr;
  for (size_t i = first; i < expr->arguments.size(); ++i) {
    Expr *value = expr->arguments[i].value;
    if (isError(value->type))
      return value->type;
    const bool character = lead != nullptr && isCharacter(value->type) &&
                           lead->constant != nullptr && isString(lead->type);
    if (lead == nullptr || character || (isUntyped(lead->type) && !isUntyped(value->type)))
      lead = value;
  }
  const Type *common = lead->type;
  if (isUntyped(common)) {
    const bool real =
        std::any_of(expr->arguments.begin() + static_cast<ptrdiff_t>(first), expr->arguments.end(),
                    [](const Argument &a) { return a.value->type->kind == TypeKind::AnyReal; });
    common = elementaryType(real ? TypeKind::Lreal : TypeKind::Dint);
    if (!real) {
      for (size_t i = first; i < expr->arguments.size(); ++i) {
        if (const Type *both =
                commonNumber(common, smallestInteger(expr->arguments[i].value->constant->integer)))
          common = both;
      }
    }
    // `i := SEL(b, 1, 2)`: the result is as narrow as its constants.
    expr->common = real ? elementaryType(TypeKind::Real) : nullptr;
    for (size_t i = first; i < expr->arguments.size() && !real; ++i) {
      const Type *own = smallestInteger(expr->arguments[i].value->constant->integer);
      expr->common = expr->common == nullptr ? own : commonNumber(expr->common, own);
    }
  }
  for (size_t i = first; i < expr->arguments.size(); ++i) {
    Expr *value = expr->arguments[i].value;
    const Type *t = value->type;
    if (t == common)
      continue;
    if (isNumber(t) && isNumber(common)) {
      const Type *own = t;
      if (isUntyped(t))
        own = value->constant != nullptr && constantFits(*value->constant, t, common) ? common
              : t->kind == TypeKind::AnyReal ? elementaryType(TypeKind::Lreal)
                                             : smallestInteger(value->constant->integer);
      const Type *both = commonNumber(common, own);
      if (both == nullptr)
        return argumentError(c, expr, i, typeName(common));
      common = both;
    } else if (isString(t) && isString(common) && t->kind == common->kind) {
      if (typeAs<StringType>(t)->length > typeAs<StringType>(common)->length)
        common = t;
    } else if (isTimeOrDate(t) && isTimeOrDate(common) &&
               (classify(t, common) == Conversion::Free ||
                classify(common, t) == Conversion::Free)) {
      if (classify(common, t) == Conversion::Free)
        common = t; // TIME with LTIME
    } else if (isCharacter(common) && value->constant != nullptr &&
               constantFits(*value->constant, t, common)) {
      continue;
    } else if (common->kind == TypeKind::Boolean && value->constant != nullptr &&
               constantFits(*value->constant, t, common)) {
      continue;
    } else {
      return argumentError(c, expr, i, typeName(common));
    }
  }
  for (size_t i = first; i < expr->arguments.size(); ++i)
    setTarget(expr->arguments[i].value, common);
  if (isInteger(common) && !isUntyped(lead->type))
    expr->common = commonBeforeWidening(expr, first);
  return common;
}

/// `i := MIN(i + 1, j)`: the result may go back to the operands' type, as that of `i + 1` may.
static const Type *commonBeforeWidening(const CallExpr *expr, size_t first) {
  const Type *common = nullptr;
  const auto add = [&](const Type *type) {
    common = common == nullptr || type == nullptr ? type : commonNumber(common, type);
    return common != nullptr;
  };
  for (size_t i = first; i < expr->arguments.size(); ++i) {
    const Expr *value = expr->arguments[i].value;
    if (!isUntyped(value->type) &&
        !add(value->common != nullptr ? value->common : underlying(value->type)))
      return nullptr;
  }
  for (size_t i = first; i < expr->arguments.size(); ++i) {
    const Expr *value = expr->arguments[i].value;
    if (isUntyped(value->type) && !constantFits(*value->constant, value->type, common) &&
        !add(smallestInteger(value->constant->integer)))
      return nullptr;
  }
  return common;
}

void foldCall(Context &c, CallExpr *expr, const Type *result) {
  if (isError(result) || expr->constant != nullptr)
    return;
  std::vector<ConstArgument> arguments;
  for (const Argument &a : expr->arguments) {
    if (a.value == nullptr || a.value->constant == nullptr)
      return;
    const Type *type = a.value->target != nullptr ? a.value->target : a.value->type;
    const auto value = convertConstant(*a.value->constant, a.value->type, type);
    if (!value)
      return;
    arguments.push_back({*value, type});
  }
  if (const auto value = foldBuiltin(expr->builtin, arguments, result, c.arena))
    expr->constant = c.makeConstant(*value);
}

const Type *textOf(const Argument &a) {
  return a.value->target != nullptr && isString(a.value->target) ? a.value->target : a.value->type;
}

bool placeArguments(Context &c, CallExpr *expr) {
  const size_t count = expr->arguments.size();
  std::vector<Argument> placed(count);
  std::vector<bool> taken(count, false);
  bool named = false;
  for (size_t i = 0; i < count; ++i) {
    const Argument &a = expr->arguments[i];
    size_t position = i;
    if (a.name) {
      named = true;
      const auto formal = formalPosition(expr->builtin, a.name.id->lower);
      if (!formal || a.output || a.value == nullptr) {
        c.report(Code::UnknownParameter, a.span,
                 "`" + calleeName(expr) + "` has no " + (a.output ? "output" : "input") + " `" +
                     std::string(a.name.text) + "`",
                 "unknown parameter")
            .help("give the arguments without names, in their order");
        return false;
      }
      position = *formal;
    } else if (named) {
      c.report(Code::MixedArguments, a.span, "a positional argument cannot follow a named one",
               "name this argument");
      return false;
    }
    if (position >= count) {
      c.report(Code::WrongArgumentCount, expr->span,
               "`" + calleeName(expr) + "` lacks arguments: `" + std::string(a.name.text) +
                   "` is number " + std::to_string(position + 1),
               "in this call");
      return false;
    }
    if (taken[position]) {
      c.report(Code::DuplicateArgument, a.span, "this argument is given twice", "given again here");
      return false;
    }
    taken[position] = true;
    placed[position] = a;
  }
  if (named)
    std::copy(placed.begin(), placed.end(), expr->arguments.begin());
  return true;
}

} // namespace stc::sema
