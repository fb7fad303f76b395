// Calls of the functions that the compiler implements itself.

#include "compiler/semantics/alignment.hpp"
#include "compiler/semantics/checker.hpp"
#include "compiler/semantics/fold.hpp"
#include "compiler/semantics/fold_builtins.hpp"
#include "compiler/semantics/locations.hpp"

#include <algorithm>

namespace stc {

using namespace ast;

namespace {

std::string calleeName(const CallExpr *expr) {
  return std::string(expr->callee->kind == ExprKind::name ? as<NameExpr>(expr->callee)->name.text
                                                          : "this function");
}

bool untyped(const Type *t) {
  return t->kind == TypeKind::anyInteger || t->kind == TypeKind::anyReal;
}
bool isNumber(const Type *t) {
  return isInteger(underlying(t)) || isReal(underlying(t)) || untyped(t);
}

} // namespace

bool Checker::requireCount(CallExpr *expr, std::size_t least, std::size_t most) {
  const std::size_t count = expr->arguments.size();
  if (count >= least && count <= most)
    return true;
  const std::string wanted = least == most ? std::to_string(least)
                             : most == SIZE_MAX
                                 ? "at least " + std::to_string(least)
                                 : std::to_string(least) + " to " + std::to_string(most);
  report(Code::wrongArgumentCount, expr->span,
         "`" + calleeName(expr) + "` takes " + wanted +
             (least == 1 && most == 1 ? " argument" : " arguments") + ", not " +
             std::to_string(count),
         "in this call");
  return false;
}

const Type *Checker::argumentError(CallExpr *expr, std::size_t index, std::string_view wanted) {
  Expr *value = expr->arguments[index].value;
  report(Code::wrongArgumentType, value->span,
         "`" + calleeName(expr) + "` needs " + std::string(wanted) + " here, not " +
             typeName(value->type),
         "expected " + std::string(wanted));
  return elementaryType(TypeKind::error);
}

const Type *Checker::commonOfArguments(CallExpr *expr, std::size_t first) {
  // All one type, else the common number type; untyped constants follow the others.
  Expr *lead = nullptr;
  for (std::size_t i = first; i < expr->arguments.size(); ++i) {
    Expr *value = expr->arguments[i].value;
    if (isError(value->type))
      return value->type;
    const bool character = lead != nullptr && isCharacter(value->type) &&
                           lead->constant != nullptr && isString(lead->type);
    if (lead == nullptr || character || (untyped(lead->type) && !untyped(value->type)))
      lead = value;
  }
  const Type *common = lead->type;
  if (untyped(common)) {
    const bool real = std::any_of(
        expr->arguments.begin() + static_cast<std::ptrdiff_t>(first), expr->arguments.end(),
        [](const Argument &a) { return a.value->type->kind == TypeKind::anyReal; });
    common = elementaryType(real ? TypeKind::lreal : TypeKind::dint);
    if (!real) {
      for (std::size_t i = first; i < expr->arguments.size(); ++i) {
        if (const Type *both =
                commonNumber(common, smallestInteger(expr->arguments[i].value->constant->integer)))
          common = both;
      }
    }
    // `i := SEL(b, 1, 2)`: the result is as narrow as its constants.
    expr->common = real ? elementaryType(TypeKind::real) : nullptr;
    for (std::size_t i = first; i < expr->arguments.size() && !real; ++i) {
      const Type *own = smallestInteger(expr->arguments[i].value->constant->integer);
      expr->common = expr->common == nullptr ? own : commonNumber(expr->common, own);
    }
  }
  for (std::size_t i = first; i < expr->arguments.size(); ++i) {
    Expr *value = expr->arguments[i].value;
    const Type *t = value->type;
    if (t == common)
      continue;
    if (isNumber(t) && isNumber(common)) {
      const Type *own = t;
      if (untyped(t))
        own = value->constant != nullptr && constantFits(*value->constant, t, common) ? common
              : t->kind == TypeKind::anyReal ? elementaryType(TypeKind::lreal)
                                             : smallestInteger(value->constant->integer);
      const Type *both = commonNumber(common, own);
      if (both == nullptr)
        return argumentError(expr, i, typeName(common));
      common = both;
    } else if (isString(t) && isString(common) && t->kind == common->kind) {
      if (typeAs<StringType>(t)->length > typeAs<StringType>(common)->length)
        common = t;
    } else if (isTimeOrDate(t) && isTimeOrDate(common) &&
               (classify(t, common) == Conversion::free ||
                classify(common, t) == Conversion::free)) {
      if (classify(common, t) == Conversion::free)
        common = t; // TIME with LTIME
    } else if (isCharacter(common) && value->constant != nullptr &&
               constantFits(*value->constant, t, common)) {
      continue;
    } else if (common->kind == TypeKind::boolean && value->constant != nullptr &&
               constantFits(*value->constant, t, common)) {
      continue;
    } else {
      return argumentError(expr, i, typeName(common));
    }
  }
  for (std::size_t i = first; i < expr->arguments.size(); ++i)
    setTarget(expr->arguments[i].value, common);
  if (isInteger(common) && !untyped(lead->type))
    expr->common = commonBeforeWidening(expr, first);
  return common;
}

/// `i := MIN(i + 1, j)`: the result may go back to the operands' type, as that of `i + 1` may.
const Type *Checker::commonBeforeWidening(const CallExpr *expr, std::size_t first) {
  const Type *common = nullptr;
  const auto add = [&](const Type *type) {
    common = common == nullptr || type == nullptr ? type : commonNumber(common, type);
    return common != nullptr;
  };
  for (std::size_t i = first; i < expr->arguments.size(); ++i) {
    const Expr *value = expr->arguments[i].value;
    if (!untyped(value->type) &&
        !add(value->common != nullptr ? value->common : underlying(value->type)))
      return nullptr;
  }
  for (std::size_t i = first; i < expr->arguments.size(); ++i) {
    const Expr *value = expr->arguments[i].value;
    if (untyped(value->type) && !constantFits(*value->constant, value->type, common) &&
        !add(smallestInteger(value->constant->integer)))
      return nullptr;
  }
  return common;
}

const Type *Checker::checkConversionCall(CallExpr *expr, const ConversionName &conversion) {
  expr->resolved = Callee::builtin;
  expr->builtin = conversion.function;
  const Type *bad = elementaryType(TypeKind::error);
  for (Argument &a : expr->arguments) {
    if (a.value != nullptr)
      check(a.value, conversion.from);
  }
  if (!placeArguments(expr) || !requireCount(expr, 1, 1) || expr->arguments[0].value == nullptr)
    return bad;
  Expr *value = expr->arguments[0].value;
  const Type *type = value->type;
  if (isError(type))
    return bad;
  if (conversion.from == nullptr && conversion.function != Builtin::convert &&
      !checkSpecialArgument(expr))
    return bad;
  if (type->kind == TypeKind::pointer && conversion.from == nullptr) // the address as a number
    setTarget(value, elementaryType(TypeKind::ulint));
  else if (!isElementary(type) && type->kind != TypeKind::pointer)
    return argumentError(
        expr, 0, conversion.from != nullptr ? typeName(conversion.from) : "an elementary type");
  if (conversion.from != nullptr) {
    // `DINT_TO_INT(i)` takes what converts to DINT silently.
    if (isString(conversion.from) && isString(type)) {
      if (conversion.from->kind != type->kind)
        return argumentError(expr, 0, typeName(conversion.from));
    } else if (type->kind == TypeKind::enumeration && isInteger(conversion.from)) {
      setTarget(value, conversion.from);
    } else {
      coerce(value, conversion.from, "argument of `" + calleeName(expr) + "`");
      if (value->target == nullptr && value->type != conversion.from)
        return bad;
    }
  } else if (untyped(type) && value->target == nullptr) {
    settle(value);
  }
  if (conversion.function != Builtin::convert) {
    foldCall(expr, conversion.to);
    return conversion.to;
  }
  const Type *from = value->target != nullptr ? value->target : value->type;
  if (value->constant != nullptr) {
    const auto own = convertConstant(*value->constant, value->type, from);
    const auto result = own ? foldConversion(*own, from, conversion.to, arena_) : std::nullopt;
    if (result)
      expr->constant = makeConstant(*result);
  }
  return conversion.to;
}

void Checker::foldCall(CallExpr *expr, const Type *result) {
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
  if (const auto value = foldBuiltin(expr->builtin, arguments, result, arena_))
    expr->constant = makeConstant(*value);
}

namespace {

/// The text that an argument is: edition 3 takes a CHAR where a text is put into another.
const Type *textOf(const Argument &a) {
  return a.value->target != nullptr && isString(a.value->target) ? a.value->target : a.value->type;
}

std::uint32_t lengthOf(const Argument &a) { return typeAs<StringType>(textOf(a))->length; }

} // namespace

/// CONCAT(a, b, c) is CONCAT(CONCAT(a, b), c).
void Checker::concatInPairs(CallExpr *expr) {
  for (Argument &a : expr->arguments)
    a.name = {}; // they are in their order
  const std::span<Argument> all = expr->arguments;
  Argument joined = all.front();
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    auto *pair = arena_.make<CallExpr>();
    pair->span = expr->span;
    pair->callee = expr->callee;
    pair->arguments = arena_.copy(std::vector<Argument>{joined, all[i]});
    pair->resolved = Callee::builtin;
    pair->builtin = Builtin::concat;
    pair->type =
        types_.string(textOf(joined)->kind == TypeKind::wstring,
                      std::clamp<std::uint32_t>(lengthOf(joined) + lengthOf(all[i]), 1, 65535));
    foldCall(pair, pair->type);
    joined.value = pair;
  }
  expr->arguments = arena_.copy(std::vector<Argument>{joined, all.back()});
}

const Type *Checker::checkStringBuiltin(CallExpr *expr) {
  const Type *bad = elementaryType(TypeKind::error);
  const auto textType = [&](std::size_t i) { return textOf(expr->arguments[i]); };
  const auto length = [&](std::size_t i) { return lengthOf(expr->arguments[i]); };
  const auto integer = [&](std::size_t i) {
    Expr *value = expr->arguments[i].value;
    if (!isInteger(underlying(value->type)) && value->type->kind != TypeKind::anyInteger)
      return false;
    setTarget(value, elementaryType(TypeKind::dint));
    return true;
  };
  std::size_t strings = 1;
  std::size_t count = 1;
  switch (expr->builtin) {
  case Builtin::len:
    break;
  case Builtin::left:
  case Builtin::right:
    count = 2;
    break;
  case Builtin::mid:
  case Builtin::deleteS:
    count = 3;
    break;
  case Builtin::concat:
    count = strings = std::max<std::size_t>(2, expr->arguments.size());
    break;
  case Builtin::find:
    count = strings = 2;
    break;
  case Builtin::insert:
    count = 3;
    strings = 2;
    break;
  default: // replace
    count = 4;
    strings = 2;
    break;
  }
  if (!requireCount(expr, count, expr->builtin == Builtin::concat ? SIZE_MAX : count))
    return bad;
  // CODESYS has WLEN, WLEFT … for WSTRING only.
  const std::string name = calleeName(expr);
  const bool wideOnly = name.front() == 'W' || name.front() == 'w';
  for (std::size_t i = 0; i < count; ++i) {
    if (isError(expr->arguments[i].value->type))
      return bad;
    Expr *value = expr->arguments[i].value;
    if (isCharacter(underlying(value->type)) && i < strings &&
        (i > 0 || expr->builtin == Builtin::concat))
      setTarget(value, types_.string(underlying(value->type)->kind == TypeKind::wcharT, 1));
    if (wideOnly && i < strings && textType(i)->kind != TypeKind::wstring)
      return argumentError(expr, i, "a WSTRING");
    if (i < strings ? !isString(textType(i)) : !integer(i))
      return argumentError(expr, i, i < strings ? "a string" : "an integer");
    if (i > 0 && i < strings && textType(0)->kind != textType(i)->kind)
      return argumentError(expr, i, typeName(textType(0)));
  }
  if (expr->builtin == Builtin::len || expr->builtin == Builtin::find)
    return elementaryType(length(0) > 32767 ? TypeKind::dint : TypeKind::intT);
  if (expr->builtin == Builtin::concat && count > 2)
    concatInPairs(expr);
  std::uint32_t result = length(0);
  if (expr->builtin == Builtin::concat || expr->builtin == Builtin::insert ||
      expr->builtin == Builtin::replace)
    result = std::min<std::uint32_t>(65535, length(0) + length(1));
  return types_.string(textType(0)->kind == TypeKind::wstring, std::max(result, 1U));
}

bool Checker::placeArguments(CallExpr *expr) {
  const std::size_t count = expr->arguments.size();
  std::vector<Argument> placed(count);
  std::vector<bool> taken(count, false);
  bool named = false;
  for (std::size_t i = 0; i < count; ++i) {
    const Argument &a = expr->arguments[i];
    std::size_t position = i;
    if (a.name) {
      named = true;
      const auto formal = formalPosition(expr->builtin, a.name.id->lower);
      if (!formal || a.output || a.value == nullptr) {
        report(Code::unknownParameter, a.span,
               "`" + calleeName(expr) + "` has no " + (a.output ? "output" : "input") + " `" +
                   std::string(a.name.text) + "`",
               "unknown parameter")
            .help("give the arguments without names, in their order");
        return false;
      }
      position = *formal;
    } else if (named) {
      report(Code::mixedArguments, a.span, "a positional argument cannot follow a named one",
             "name this argument");
      return false;
    }
    if (position >= count) {
      report(Code::wrongArgumentCount, expr->span,
             "`" + calleeName(expr) + "` lacks arguments: `" + std::string(a.name.text) +
                 "` is number " + std::to_string(position + 1),
             "in this call");
      return false;
    }
    if (taken[position]) {
      report(Code::duplicateArgument, a.span, "this argument is given twice", "given again here");
      return false;
    }
    taken[position] = true;
    placed[position] = a;
  }
  if (named)
    std::copy(placed.begin(), placed.end(), expr->arguments.begin());
  return true;
}

const Type *Checker::checkBuiltin(CallExpr *expr, const Type *expected) {
  const Type *bad = elementaryType(TypeKind::error);
  bool failed = !placeArguments(expr);
  if (expr->builtin == Builtin::sizeofT) // its argument may be a type
    return failed ? bad : checkSizeof(expr);
  if (expr->builtin == Builtin::newT)
    return failed ? bad : checkNew(expr);
  if (expr->builtin == Builtin::indexOf)
    return failed ? bad : checkIndexOf(expr);
  if (expr->builtin >= Builtin::add && expr->builtin <= Builtin::modulo)
    return failed ? bad : checkOperatorCall(expr);
  for (Argument &a : expr->arguments) {
    if (a.value != nullptr && isError(check(a.value, expected)))
      failed = true;
  }
  if (failed)
    return bad;
  for (const Argument &a : expr->arguments) {
    const bool asked = expr->builtin == Builtin::lowerBound ||
                       expr->builtin == Builtin::upperBound || expr->builtin == Builtin::adr;
    if (!asked && refuseOpenArray(a.value, "use"))
      return bad;
  }
  const auto value = [&](std::size_t i) { return expr->arguments[i].value; };
  const auto type = [&](std::size_t i) { return underlying(value(i)->type); };
  const auto own = [&](std::size_t i) {
    return untyped(value(i)->type) ? settle(value(i)) : type(i);
  };
  if (isAssertion(expr->builtin)) {
    const Type *boolean = elementaryType(TypeKind::boolean);
    const std::size_t values = assertedValues(expr->builtin);
    if (!requireCount(expr, values == 0 ? 1 : values, values + 1))
      return bad;
    const std::span<Argument> all = expr->arguments;
    if (all.size() > values && type(values)->kind != TypeKind::string)
      return argumentError(expr, values, "a STRING");
    if (values == 1) {
      coerce(value(0), boolean, "the condition of an assertion");
      return boolean;
    }
    for (std::size_t i = 0; i < values; ++i) {
      if (values == 3) {
        if (!isNumber(type(i)))
          return argumentError(expr, i, "a number");
        setTarget(value(i), elementaryType(TypeKind::lreal));
      } else if (!isNumber(type(i)) && !isElementary(type(i)) &&
                 type(i)->kind != TypeKind::enumeration) {
        return argumentError(expr, i, "a value of an elementary type or an enumeration");
      }
    }
    if (values == 2) {
      expr->arguments = all.first(2);
      const Type *common = commonOfArguments(expr, 0);
      expr->arguments = all;
      expr->common = nullptr;
      if (isError(common))
        return bad;
    }
    return boolean;
  }
  using enum Builtin;
  switch (expr->builtin) {
  case abs: {
    if (!requireCount(expr, 1, 1))
      return bad;
    if (!isNumber(type(0)) && type(0)->kind != TypeKind::ltime)
      return argumentError(expr, 0, "a number");
    const Type *t = own(0);
    setTarget(value(0), t);
    return t;
  }
  case sqrt:
  case ln:
  case log:
  case exp:
  case sin:
  case cos:
  case tan:
  case asin:
  case acos:
  case atan: {
    if (!requireCount(expr, 1, 1))
      return bad;
    if (!isNumber(type(0)))
      return argumentError(expr, 0, "a number");
    const Type *result =
        type(0)->kind == TypeKind::real ? type(0) : elementaryType(TypeKind::lreal);
    if (untyped(type(0))) // `r := SQRT(2.0)` is silent, as `r := 2.0` is
      expr->common = elementaryType(TypeKind::real);
    setTarget(value(0), result);
    return result;
  }
  case atan2:
  case expt: {
    if (!requireCount(expr, 2, 2))
      return bad;
    for (std::size_t i = 0; i < 2; ++i) {
      if (!isNumber(type(i)))
        return argumentError(expr, i, "a number");
    }
    const bool real =
        type(0)->kind == TypeKind::real && (type(1)->kind == TypeKind::real || untyped(type(1)));
    const Type *result = elementaryType(real ? TypeKind::real : TypeKind::lreal);
    if (untyped(type(0)) && untyped(type(1)))
      expr->common = elementaryType(TypeKind::real);
    setTarget(value(0), result);
    setTarget(value(1), result);
    return result;
  }
  case trunc: {
    if (!requireCount(expr, 1, 1))
      return bad;
    if (!isReal(type(0)) && type(0)->kind != TypeKind::anyReal)
      return argumentError(expr, 0, "REAL or LREAL");
    own(0);
    return elementaryType(TypeKind::dint);
  }
  case min:
  case max:
    if (!requireCount(expr, 2, SIZE_MAX))
      return bad;
    for (std::size_t i = 0; i < expr->arguments.size(); ++i) {
      if (!isElementary(type(i)))
        return argumentError(expr, i, "a value that can be compared");
    }
    return commonOfArguments(expr, 0);
  case limit:
    if (!requireCount(expr, 3, 3))
      return bad;
    for (std::size_t i = 0; i < expr->arguments.size(); ++i) {
      if (!isElementary(type(i)))
        return argumentError(expr, i, "a value that can be compared");
    }
    return commonOfArguments(expr, 0);
  case sel:
    if (!requireCount(expr, 3, 3))
      return bad;
    coerce(value(0), elementaryType(TypeKind::boolean), "the selector of SEL");
    return commonOfArguments(expr, 1);
  case mux:
    if (!requireCount(expr, 2, SIZE_MAX))
      return bad;
    if (!isInteger(type(0)) && type(0)->kind != TypeKind::anyInteger)
      return argumentError(expr, 0, "an integer");
    own(0);
    return commonOfArguments(expr, 1);
  case move: {
    if (!requireCount(expr, 1, 1))
      return bad;
    const Type *t = untyped(value(0)->type) ? settle(value(0)) : value(0)->type;
    return t;
  }
  case shl:
  case shr:
  case rol:
  case ror: {
    if (!requireCount(expr, 2, 2))
      return bad;
    if (!isInteger(type(0)) && type(0)->kind != TypeKind::anyInteger)
      return argumentError(expr, 0, "a bit string or an integer");
    if (!isInteger(type(1)) && type(1)->kind != TypeKind::anyInteger)
      return argumentError(expr, 1, "an integer");
    const Type *t = own(0);
    if (value(0)->type->kind == TypeKind::anyInteger) // a pattern, not a number
      t = elementaryType(value(0)->constant->integer < 0 ||
                                 value(0)->constant->integer > 0xFFFFFFFFLL
                             ? TypeKind::lword
                             : TypeKind::dword);
    value(0)->target = nullptr;
    setTarget(value(0), t);
    own(1);
    return t;
  }
  case len:
  case left:
  case right:
  case mid:
  case concat:
  case insert:
  case deleteS:
  case replace:
  case find:
    return checkStringBuiltin(expr);
  case isValid:
  case isValidBcd:
  case bigEndian:
  case littleEndian:
    return checkPatternCall(expr);
  case time:
  case ltime:
    if (!requireCount(expr, 0, 0))
      return bad;
    return elementaryType(expr->builtin == time ? TypeKind::time : TypeKind::ltime);
  case adr: {
    if (!requireCount(expr, 1, 1))
      return bad;
    Expr *place = value(0);
    if (rejectProperty(place, "take the address of"))
      return bad;
    const bool isPlace = place->kind == ExprKind::name || place->kind == ExprKind::member ||
                         place->kind == ExprKind::index || place->kind == ExprKind::deref ||
                         place->kind == ExprKind::direct;
    if (isPlace && isBitPlace(place)) {
      report(Code::wrongArgumentType, place->span, "a single bit has no address", "this is a bit")
          .help("take the address of the variable that holds it");
      return bad;
    }
    if (!isPlace || (place->constant != nullptr && isElementary(place->type)))
      return argumentError(expr, 0, "a variable");
    if (place->type->kind == TypeKind::openArray)
      return types_.pointer(typeAs<OpenArrayType>(place->type)->element);
    // What is misaligned can be copied byte by byte only.
    return types_.pointer(isMisaligned(place) ? elementaryType(TypeKind::byte) : place->type);
  }
  case bitadr:
    return checkBitAddress(expr);
  case queryInterface:
  case queryPointer:
    return checkQuery(expr);
  case deleteT:
    return checkDelete(expr);
  case ini:
    return checkIni(expr);
  case newT:
  case indexOf:
    break;
  case isValidRef:
    return checkIsValidRef(expr);
  case lowerBound:
  case upperBound:
    return checkBound(expr);
  default: // operators and conversions have been dealt with
    break;
  }
  return bad;
}

} // namespace stc
