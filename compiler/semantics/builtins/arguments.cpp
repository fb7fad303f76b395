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

bool requireCount(Context &c, CallExpr *expr) {
  const auto [what, least, most, formals] = builtinRow(expr->builtin).takes;
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

/// The argument that the others follow: not an untyped constant, if there is another.
static Expr *leadOf(const CallExpr *expr, size_t first) {
  Expr *lead = nullptr;
  for (size_t i = first; i < expr->arguments.size(); ++i) {
    Expr *value = valueOf(expr, i);
    if (isError(value->type))
      return value;
    const bool character = lead != nullptr && isCharacter(value->type) &&
                           lead->constant != nullptr && isString(lead->type);
    if (lead == nullptr || character || (isUntyped(lead->type) && !isUntyped(value->type)))
      lead = value;
  }
  return lead;
}

/// The type of a call whose arguments are untyped constants. `i := SEL(b, 1, 2)`: the result is as
/// narrow as they are.
static const Type *typeOfUntyped(CallExpr *expr, size_t first) {
  for (size_t i = first; i < expr->arguments.size(); ++i) {
    if (valueOf(expr, i)->type->kind == TypeKind::AnyReal) {
      expr->common = elementaryType(TypeKind::Real);
      return elementaryType(TypeKind::Lreal);
    }
  }
  const Type *common = elementaryType(TypeKind::Dint);
  expr->common = nullptr;
  for (size_t i = first; i < expr->arguments.size(); ++i) {
    const Type *own = smallestInteger(valueOf(expr, i)->constant->integer);
    if (const Type *both = commonNumber(common, own))
      common = both;
    expr->common = expr->common == nullptr ? own : commonNumber(expr->common, own);
  }
  return common;
}

/// The type of both, numbers; null: there is none.
static const Type *commonWithNumber(const Type *common, const Expr *value) {
  const Type *own = value->type;
  if (isUntyped(own))
    own = value->constant != nullptr && constantFits(*value->constant, own, common) ? common
          : own->kind == TypeKind::AnyReal ? elementaryType(TypeKind::Lreal)
                                           : smallestInteger(value->constant->integer);
  return commonNumber(common, own);
}

/// The type that `common` becomes with one more argument; null: they have none in common.
static const Type *commonWith(const Type *common, const Expr *value) {
  const Type *t = value->type;
  if (t == common)
    return common;
  if (isNumber(t) && isNumber(common))
    return commonWithNumber(common, value);
  if (isString(t) && isString(common) && t->kind == common->kind)
    return typeAs<StringType>(t)->length > typeAs<StringType>(common)->length ? t : common;
  if (isTimeOrDate(t) && isTimeOrDate(common)) {
    if (classify(common, t) == Conversion::Free)
      return t; // TIME with LTIME
    if (classify(t, common) == Conversion::Free)
      return common;
  }
  const bool takesConstants = isCharacter(common) || common->kind == TypeKind::Boolean;
  return takesConstants && value->constant != nullptr && constantFits(*value->constant, t, common)
             ? common
             : nullptr;
}

const Type *commonOfArguments(Context &c, CallExpr *expr, size_t first) {
  const Type *lead = leadOf(expr, first)->type;
  if (isError(lead))
    return lead;
  const Type *common = isUntyped(lead) ? typeOfUntyped(expr, first) : lead;
  for (size_t i = first; i < expr->arguments.size(); ++i) {
    const Type *both = commonWith(common, valueOf(expr, i));
    if (both == nullptr)
      return argumentError(c, expr, i, typeName(common));
    common = both;
  }
  for (size_t i = first; i < expr->arguments.size(); ++i)
    setTarget(valueOf(expr, i), common);
  if (isInteger(common) && !isUntyped(lead))
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
  bool shuffled = false; // `MAX(IN1 := 1, 2)` is in order
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
      shuffled = shuffled || position != i;
    } else if (shuffled) {
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
