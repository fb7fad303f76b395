// Literals and what types they take from their place.

#include "compiler/semantics/expressions/internal.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/fold.hpp"
#include "compiler/semantics/fold_builtins.hpp"
#include "compiler/semantics/names/names.hpp"
#include "compiler/semantics/types/resolve.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;

/// The type and the value of a literal without its prefix.
static const Type *valueOfLiteral(Context &c, const Literal *expr, ConstValue &value) {
  const auto ofType = [&](TypeKind kind) {
    value.integer = static_cast<int64_t>(expr->integer);
    return elementaryType(kind);
  };
  switch (expr->literal) {
  case LiteralKind::Boolean:
    return ofType(TypeKind::Boolean);
  case LiteralKind::Integer: {
    const uint64_t most = uint64_t{1} << 63U;
    const bool untyped = expr->integer < most || (expr->negative && expr->integer == most);
    value.integer =
        static_cast<int64_t>(expr->negative && untyped ? 0 - expr->integer : expr->integer);
    return elementaryType(untyped ? TypeKind::AnyInteger : TypeKind::Ulint);
  }
  case LiteralKind::Real:
    value.kind = ConstKind::Real;
    value.real = expr->negative ? -expr->real : expr->real;
    return elementaryType(TypeKind::AnyReal);
  case LiteralKind::String:
  case LiteralKind::Wstring: {
    const bool wide = expr->literal == LiteralKind::Wstring;
    value.kind = ConstKind::String;
    value.text = expr->text;
    return c.types.string(wide,
                          static_cast<uint32_t>(std::max<size_t>(textLength(expr->text, wide), 1)));
  }
  case LiteralKind::Time:
    return ofType(TypeKind::Time);
  case LiteralKind::Ltime:
    return ofType(TypeKind::Ltime);
  case LiteralKind::Date:
    return ofType(TypeKind::Date);
  case LiteralKind::Ldate:
    return ofType(TypeKind::Ldate);
  case LiteralKind::Tod:
    return ofType(TypeKind::Tod);
  case LiteralKind::Ltod:
    return ofType(TypeKind::Ltod);
  case LiteralKind::Dt:
    return ofType(TypeKind::Dt);
  case LiteralKind::Ldt:
    return ofType(TypeKind::Ldt);
  }
  return elementaryType(TypeKind::Error);
}

/// `x#3`, where `x` is no type whose values are written so.
static void reportPrefix(Context &c, const Name &name, const Symbol *symbol) {
  if (symbol == nullptr)
    reportUnknown(c, name, Sought::Type);
  else if (symbol->kind != SymbolKind::Type)
    c.report(Code::NotAType, name.span, "`" + std::string(name.text) + "` is not a type",
             "this is " + describe(symbol));
  else
    c.report(Code::NotAType, name.span,
             "no value of `" + std::string(name.text) + "` is written like this",
             "only elementary types stand before a `#` with a number")
        .help("write the number alone");
}

/// `INT#b`
static void reportNoLiteral(Context &c, const EnumLiteralExpr *expr) {
  const std::string type = typeName(findElementaryType(expr->typeName.id->lower));
  const std::string name(expr->enumerator.text);
  auto &d = c.report(Code::UnknownName, expr->enumerator.span,
                     "`" + name + "` is not a literal of " + type,
                     "a number, a text or a time stands after `" + type + "#`");
  d.suggest("convert a variable: `TO_" + type + "(" + name + ")`", expr->span,
            "TO_" + type + "(" + name + ")");
}

const Type *checkLiteral(Context &c, Literal *expr) {
  ConstValue value;
  const Type *type = valueOfLiteral(c, expr, value);
  if (expr->typeName) {
    const Type *named = findElementaryType(expr->typeName.id->lower);
    if (named == nullptr) {
      reportPrefix(c, expr->typeName, lookup(c, expr->typeName));
      return elementaryType(TypeKind::Error);
    }
    if (type != named && !constantFits(value, type, named)) {
      c.report(Code::ConstantOverflow, expr->span,
               "`" + std::string(c.program.sources.text(expr->span)) + "` is not a value of " +
                   typeName(named),
               "does not fit");
      return elementaryType(TypeKind::Error);
    }
    value = convertConstant(value, type, named).value_or(value);
    if (!isString(named)) // `STRING#'…'` is as long as its text
      type = named;
  }
  expr->constant = c.makeConstant(value);
  return type;
}

const Type *checkEnumLiteral(Context &c, EnumLiteralExpr *expr) {
  Symbol *symbol = lookup(c, expr->typeName);
  if (symbol == nullptr || symbol->kind != SymbolKind::Type) {
    if (symbol == nullptr && findElementaryType(expr->typeName.id->lower) != nullptr)
      reportNoLiteral(c, expr);
    else
      reportPrefix(c, expr->typeName, symbol);
    return elementaryType(TypeKind::Error);
  }
  auto *type = static_cast<TypeSymbol *>(symbol);
  resolve(c, type);
  if (type->type->kind == TypeKind::Enumeration) {
    if (EnumeratorSymbol *e = findEnumerator(typeAs<EnumType>(type->type), expr->enumerator.id)) {
      expr->symbol = e;
      return useSymbol(c, expr, e, expr->enumerator);
    }
  }
  if (!isError(type->type)) {
    auto &d = c.report(Code::UnknownEnumerator, expr->enumerator.span,
                       "`" + std::string(type->name.text) + "` has no enumerator `" +
                           std::string(expr->enumerator.text) + "`",
                       "not one of its values");
    helpMembers(d, expr->enumerator, memberNames(type->type));
  }
  return elementaryType(TypeKind::Error);
}

} // namespace stc::sema
