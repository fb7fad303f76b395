// Implicit conversions and what is said about those that are not.

#include "compiler/semantics/expressions/expressions.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/expressions/internal.hpp"
#include "compiler/semantics/fold_builtins.hpp"

namespace stc::sema {

using namespace ast;

namespace {

std::string upper(std::string text) {
  for (char &c : text) {
    if (c >= 'a' && c <= 'z')
      c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

/// `DINT_TO_INT`, or nothing when no such function exists.
std::string conversionFunction(const Type *from, const Type *to) {
  from = underlying(from);
  to = underlying(to);
  if (!isElementary(from) || !isElementary(to) || from == to)
    return {};
  const auto plain = [](const Type *t) {
    return t->kind == TypeKind::String    ? std::string("STRING")
           : t->kind == TypeKind::Wstring ? std::string("WSTRING")
                                          : upper(typeName(t));
  };
  return plain(from) + "_TO_" + plain(to);
}

/// The expression's text where it is short enough to be shown inside of a proposal, else `…`.
std::string excerpt(const Sources &sources, const Expr *expr) {
  const std::string_view text = sources.text(expr->span);
  const bool usable =
      !text.empty() && text.size() <= 40 && text.find('\n') == std::string_view::npos;
  return usable ? std::string(text) : "…";
}

/// `INT`, `an integer constant`
std::string found(const Type *type) {
  const std::string_view article = type->kind == TypeKind::AnyInteger ? "an "
                                   : type->kind == TypeKind::AnyReal  ? "a "
                                                                      : "";
  return std::string(article) + typeName(type);
}

/// Something that ADR can be asked of, or a pointer can be followed from, without parentheses.
bool isPath(const Expr *expr) {
  return expr->kind == ExprKind::Name || expr->kind == ExprKind::Member ||
         expr->kind == ExprKind::Index || expr->kind == ExprKind::Deref;
}

int rank(Conversion c) { return static_cast<int>(c); }

} // namespace

bool isAxisField(const Expr *expr) {
  if (expr->kind != ExprKind::Member)
    return false;
  const Type *base = as<MemberExpr>(expr)->base->type;
  if (base != nullptr && base->kind == TypeKind::Reference)
    base = typeAs<PointerType>(base)->pointee;
  return base != nullptr && base->kind == TypeKind::Structure &&
         typeAs<StructType>(base)->symbol->name.id->lower == "axis_ref";
}

bool narrowsTo(const VarSymbol *variable, const Type *type) {
  if (variable == nullptr || variable->decl == nullptr)
    return false;
  const auto &attributes = variable->decl->attributes;
  return std::any_of(attributes.begin(), attributes.end(), [type](const Attribute &a) {
    return a.id == AttributeId::NarrowsTo && a.value == typeName(type);
  });
}

void setTarget(Expr *expr, const Type *type) {
  if (type != expr->type)
    expr->target = type;
}

const Type *settle(Expr *expr) {
  if (expr->type->kind == TypeKind::AnyReal) {
    expr->target = elementaryType(TypeKind::Lreal);
  } else if (expr->type->kind == TypeKind::AnyInteger) {
    const Type *smallest = smallestInteger(expr->constant->integer);
    expr->target = bitWidth(smallest) > 32 ? smallest : elementaryType(TypeKind::Dint);
    if (smallest->kind == TypeKind::Udint)
      expr->target = smallest;
  }
  return expr->target != nullptr ? expr->target : expr->type;
}

static bool isStrict(const Type *t) {
  return t->kind == TypeKind::Enumeration && typeAs<EnumType>(t)->strict;
}

static void reportStrict(Context &c, const Expr *expr, const Type *type, std::string_view what) {
  const Type *from = expr->type;
  const Type *named = isStrict(type) ? type : from;
  const std::string prefix = what.empty() ? std::string() : std::string(what) + ": ";
  auto &d =
      c.report(Code::StrictEnumeration, expr->span,
               prefix + "`" + typeName(named) + "` is a strict enumeration: no conversion from " +
                   typeName(from) + " to " + typeName(type),
               "this is " + typeName(from));
  noteDeclaration(d, typeAs<EnumType>(named)->symbol);
  if (isStrict(type))
    d.help("use one of its enumerators: `" + typeName(type) + ".…`");
  else
    d.help("convert it if its number is meant: `TO_" + upper(typeName(underlying(type))) + "(…)`");
}

/// Warns of a text that is longer than the STRING it becomes.
static void checkTextLength(Context &c, const Expr *expr, const Type *type) {
  if (expr->constant->kind != ConstKind::String || !isString(type))
    return;
  const auto length = typeAs<StringType>(type)->length;
  const bool wide = type->kind == TypeKind::Wstring;
  const size_t wanted = textLength(expr->constant->text, wide);
  if (wanted > length)
    c.report(Code::StringCut, expr->span,
             "the text has " + std::to_string(wanted) + " characters but " + typeName(type) +
                 " holds " + std::to_string(length),
             "the end is cut off")
        .help("declare the string longer: `" + std::string(wide ? "W" : "") + "STRING(" +
              std::to_string(wanted) + ")`");
}

/// An integer that is none of the type's values.
static void reportOverflow(Context &c, const Expr *expr, const Type *type) {
  const IntegerRange range = integerRange(type);
  c.report(Code::ConstantOverflow, expr->span,
           "the constant " + std::to_string(expr->constant->integer) + " does not fit into " +
               typeName(type),
           typeName(underlying(type)) + " holds " + std::to_string(range.low) + " to " +
               (range.high == -1 ? "18446744073709551615" : std::to_string(range.high)));
}

/// A constant without type that is none of the type's values.
static void reportUntyped(Context &c, Expr *expr, const Type *type, std::string_view what) {
  const Type *from = expr->type;
  if (from->kind == TypeKind::AnyInteger && isInteger(underlying(type)) &&
      type->kind != TypeKind::Enumeration) {
    reportOverflow(c, expr, type);
    return;
  }
  const Type *own = from->kind == TypeKind::AnyReal ? elementaryType(TypeKind::Lreal)
                                                    : smallestInteger(expr->constant->integer);
  const Conversion kind = classify(own, type);
  reportConversion(c, expr, from, type, kind == Conversion::Lossy ? Conversion::Narrowing : kind,
                   what);
}

/// SEL and MUX of constants, all of which are values of the type: `b := SEL(d, 0, 255)`.
static bool choosesConstant(const Expr *expr, const Type *type) {
  const auto *call = expr->kind == ExprKind::Call ? as<CallExpr>(expr) : nullptr;
  if (call == nullptr || call->resolved != Callee::Builtin ||
      (call->builtin != Builtin::Sel && call->builtin != Builtin::Mux))
    return false;
  const auto choices = call->arguments.subspan(1);
  return std::all_of(choices.begin(), choices.end(), [type](const Argument &a) {
    return a.value->constant != nullptr && isUntyped(a.value->type) &&
           constantFits(*a.value->constant, a.value->type, type);
  });
}

/// A shift of a constant whose bits the narrower type has: `w := SHL(16#8001, 1)`.
static bool shiftsConstant(const Expr *expr, const Type *type) {
  const auto *call = expr->kind == ExprKind::Call ? as<CallExpr>(expr) : nullptr;
  const bool shifts = call != nullptr && call->resolved == Callee::Builtin &&
                      (call->builtin == Builtin::Shl || call->builtin == Builtin::Shr ||
                       call->builtin == Builtin::Rol || call->builtin == Builtin::Ror);
  if (!shifts || call->arguments[0].value->type->kind != TypeKind::AnyInteger ||
      !isInteger(underlying(type)) || bitWidth(type) >= bitWidth(expr->type))
    return false;
  const int64_t pattern = call->arguments[0].value->constant->integer;
  return pattern >= 0 && pattern >> bitWidth(type) == 0;
}

/// The member or pin that the expression reads, or null.
static const VarSymbol *memberOf(const Expr *expr) {
  if (expr->kind != ExprKind::Member)
    return nullptr;
  const Symbol *symbol = as<MemberExpr>(expr)->symbol;
  return symbol != nullptr && symbol->kind == SymbolKind::Variable
             ? static_cast<const VarSymbol *>(symbol)
             : nullptr;
}

/// How the value becomes one of the type, by what is known about it.
static Conversion conversionOf(const Expr *expr, const Type *type) {
  const Type *from = expr->type;
  // Reading one into a REAL is not worth a warning.
  if (from->kind == TypeKind::Lreal && type->kind == TypeKind::Real && isAxisField(expr))
    return Conversion::Free;
  const Conversion conversion = classify(from, type);
  if (conversion == Conversion::Narrowing && narrowsTo(memberOf(expr), type))
    return Conversion::Free;
  if (conversion != Conversion::Free && (choosesConstant(expr, type) || shiftsConstant(expr, type)))
    return Conversion::Free;
  // `i := i + 1` computes in DINT, but stays silent because all operands are INT.
  if (expr->common == nullptr || expr->common == from)
    return conversion;
  const Conversion ofCommon =
      expr->common == type ? Conversion::Identity : classify(expr->common, type);
  if (rank(ofCommon) >= rank(conversion))
    return conversion;
  return ofCommon == Conversion::Identity ? Conversion::Free : ofCommon;
}

/// A product is computed in its operands' type, however large the variable is that takes it.
static void checkProduct(Context &c, const Expr *expr, const Type *type) {
  const Type *from = expr->type;
  if (expr->kind != ExprKind::Binary || as<BinaryExpr>(expr)->op != BinaryOp::Multiply ||
      !isInteger(from) || !isInteger(underlying(type)) || bitWidth(type) <= bitWidth(from))
    return;
  auto &d = c.report(Code::ComputedNarrow, expr->span,
                     "this product is computed in " + typeName(from) +
                         " and only then widened to " + typeName(type),
                     "wraps beyond " + std::to_string(bitWidth(from)) + " bits");
  d.help("convert an operand first: `" + conversionFunction(from, type) + "(…) * …`");
}

void coerce(Context &c, Expr *expr, const Type *type, std::string_view what) {
  const Type *from = expr->type;
  if (isError(from) || isError(type) || from == type)
    return;
  if (type->kind == TypeKind::Reference)
    type = typeAs<PointerType>(type)->pointee;
  if (from == type || coercePointer(c, expr, type, what) || coerceToInterface(c, expr, type))
    return;
  if (isStrict(type) || (isStrict(from) && classify(from, type) != Conversion::Free)) {
    reportStrict(c, expr, type, what);
    return;
  }
  if (expr->constant != nullptr && constantFits(*expr->constant, from, type)) {
    checkTextLength(c, expr, type);
    setTarget(expr, type);
    return;
  }
  if (isUntyped(from)) {
    reportUntyped(c, expr, type, what);
    return;
  }
  // No check of a constant is made at run time.
  if (expr->constant != nullptr && expr->constant->kind == ConstKind::Integer &&
      type->kind == TypeKind::Subrange && isInteger(underlying(from))) {
    reportOverflow(c, expr, type);
    return;
  }
  const Conversion conversion = conversionOf(expr, type);
  checkProduct(c, expr, type);
  if (conversion == Conversion::Narrowing || conversion == Conversion::Forbidden ||
      conversion == Conversion::Lossy)
    reportConversion(c, expr, from, type, conversion, what);
  if (conversion != Conversion::Forbidden && conversion != Conversion::Narrowing)
    setTarget(expr, type);
}

namespace {

/// The text of a literal in other quotes.
std::string requoted(const Context &c, const Expr *literal, char quote) {
  std::string source(c.program.sources.text(literal->span));
  if (source.size() >= 2)
    source.front() = source.back() = quote;
  return source;
}

/// Suggests the call of the function that converts.
void suggestCall(const Context &c, Diagnostic &d, const Expr *expr, const std::string &function,
                 const std::string &why) {
  d.suggest(why + ": `" + function + "(" + excerpt(c.program.sources, expr) + ")`", expr->span,
            function + "(" + std::string(c.program.sources.text(expr->span)) + ")");
}

void reportLossy(Context &c, const Expr *expr, const Type *from, const Type *to,
                 const std::string &prefix) {
  const std::string function = conversionFunction(from, to);
  auto &d = c.report(Code::LossyConversion, expr->span,
                     prefix + "implicit conversion from " + typeName(from) + " to " + typeName(to) +
                         " may change the value",
                     "this is " + typeName(from));
  if (to->kind == TypeKind::Enumeration)
    d.help("assign one of the enumerators of " + typeName(to));
  else if (!function.empty())
    suggestCall(c, d, expr, function, "say that it is meant");
}

void reportNarrowing(Context &c, const Expr *expr, const Type *from, const Type *to,
                     const std::string &prefix) {
  const std::string function = conversionFunction(from, to);
  auto &d = c.report(Code::NarrowingConversion, expr->span,
                     prefix + "cannot convert from " + typeName(from) + " to " + typeName(to) +
                         " implicitly",
                     "this is " + found(from) + ", " + typeName(to) + " is expected");
  if (from->kind == TypeKind::AnyReal && isInteger(underlying(to)))
    d.help("write it without a fraction, or convert it: `LREAL_TO_" +
           upper(typeName(underlying(to))) + "(…)`");
  else if (to->kind == TypeKind::Boolean && expr->constant != nullptr)
    d.help("write TRUE or FALSE");
  else if (to->kind == TypeKind::Boolean)
    d.help("compare it: `… <> 0`, or convert it" +
           (function.empty() ? "" : ": `" + function + "(…)`"));
  else if (to->kind == TypeKind::Time && from->kind == TypeKind::AnyInteger)
    d.help("write a duration with its unit: `T#" + excerpt(c.program.sources, expr) + "ms`");
  else if (expr->kind == ExprKind::Literal && from->kind == TypeKind::Wstring &&
           to->kind == TypeKind::String && !function.empty())
    d.suggest("a STRING stands in single quotes", expr->span, requoted(c, expr, '\''));
  else if (expr->kind == ExprKind::Literal && from->kind == TypeKind::String &&
           to->kind == TypeKind::Wstring)
    d.suggest("a WSTRING stands in double quotes", expr->span, requoted(c, expr, '"'));
  else if (!function.empty() && from->kind != TypeKind::AnyInteger)
    suggestCall(c, d, expr, function, "convert it");
}

void reportOtherType(Context &c, const Expr *expr, const Type *from, const Type *to,
                     const std::string &prefix) {
  auto &d = c.report(Code::TypeMismatch, expr->span,
                     prefix + "expected " + typeName(to) + ", found " + found(from),
                     "this is " + found(from));
  const auto pointee = [](const Type *type) {
    return type->kind == TypeKind::Pointer ? typeAs<PointerType>(type)->pointee : nullptr;
  };
  const std::string text = excerpt(c.program.sources, expr);
  const std::string source(c.program.sources.text(expr->span));
  if (isInstance(from) && isElementary(to))
    d.help("name one of its outputs: `….Q`");
  else if (pointee(to) == from && isPath(expr))
    d.suggest("take its address: `ADR(" + text + ")`", expr->span, "ADR(" + source + ")");
  else if (pointee(from) != nullptr && isPath(expr) &&
           (pointee(from) == to || classify(pointee(from), to) == Conversion::Free))
    d.suggest("follow the pointer: `" + text + "^`", expr->span, source + "^");
}

} // namespace

void reportConversion(Context &c, Expr *expr, const Type *from, const Type *to,
                      Conversion conversion, std::string_view what) {
  const std::string prefix = what.empty() ? std::string() : std::string(what) + ": ";
  if (conversion == Conversion::Lossy)
    reportLossy(c, expr, from, to, prefix);
  else if (conversion == Conversion::Narrowing)
    reportNarrowing(c, expr, from, to, prefix);
  else
    reportOtherType(c, expr, from, to, prefix);
}

} // namespace stc::sema
