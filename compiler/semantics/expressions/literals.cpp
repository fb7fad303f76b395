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

const Type *checkLiteral(Context &c, Literal *expr) {
  ConstValue value;
  const Type *type = nullptr;
  switch (expr->literal) {
  case LiteralKind::boolean:
    type = elementaryType(TypeKind::boolean);
    value.integer = static_cast<std::int64_t>(expr->integer);
    break;
  case LiteralKind::integer: {
    const std::uint64_t most = std::uint64_t{1} << 63U;
    const bool untyped = expr->integer < most || (expr->negative && expr->integer == most);
    type = elementaryType(untyped ? TypeKind::anyInteger : TypeKind::ulint);
    value.integer =
        static_cast<std::int64_t>(expr->negative && untyped ? 0 - expr->integer : expr->integer);
    break;
  }
  case LiteralKind::real:
    type = elementaryType(TypeKind::anyReal);
    value.kind = ConstKind::real;
    value.real = expr->negative ? -expr->real : expr->real;
    break;
  case LiteralKind::string:
  case LiteralKind::wstring:
    type = c.types.string(expr->literal == LiteralKind::wstring,
                          static_cast<std::uint32_t>(std::max<std::size_t>(
                              textLength(expr->text, expr->literal == LiteralKind::wstring), 1)));
    value.kind = ConstKind::string;
    value.text = expr->text;
    break;
  case LiteralKind::time:
    type = elementaryType(TypeKind::time);
    break;
  case LiteralKind::ltime:
    type = elementaryType(TypeKind::ltime);
    break;
  case LiteralKind::date:
    type = elementaryType(TypeKind::date);
    break;
  case LiteralKind::ldate:
    type = elementaryType(TypeKind::ldate);
    break;
  case LiteralKind::tod:
    type = elementaryType(TypeKind::tod);
    break;
  case LiteralKind::ltod:
    type = elementaryType(TypeKind::ltod);
    break;
  case LiteralKind::dt:
    type = elementaryType(TypeKind::dt);
    break;
  case LiteralKind::ldt:
    type = elementaryType(TypeKind::ldt);
    break;
  }
  if (isTimeOrDate(type))
    value.integer = static_cast<std::int64_t>(expr->integer);
  if (expr->typeName) {
    const Type *named = findElementaryType(expr->typeName.id->lower);
    if (named == nullptr) {
      reportUnknown(c, expr->typeName, true);
      return elementaryType(TypeKind::error);
    }
    if (!constantFits(value, type, named)) {
      c.report(Code::constantOverflow, expr->span,
               "`" + std::string(c.program.sources.text(expr->span)) + "` is not a value of " +
                   typeName(named),
               "does not fit");
      return elementaryType(TypeKind::error);
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
  if (symbol == nullptr || symbol->kind != SymbolKind::type) {
    if (symbol == nullptr)
      reportUnknown(c, expr->typeName, true);
    else
      c.report(Code::notAType, expr->typeName.span,
               "`" + std::string(expr->typeName.text) + "` is not a type",
               "this is " + describe(symbol));
    return elementaryType(TypeKind::error);
  }
  auto *type = static_cast<TypeSymbol *>(symbol);
  resolve(c, type);
  if (type->type->kind == TypeKind::enumeration) {
    if (EnumeratorSymbol *e = findEnumerator(typeAs<EnumType>(type->type), expr->enumerator.id)) {
      expr->symbol = e;
      return useSymbol(c, expr, e, expr->enumerator);
    }
  }
  if (!isError(type->type)) {
    auto &d = c.report(Code::unknownEnumerator, expr->enumerator.span,
                       "`" + std::string(type->name.text) + "` has no enumerator `" +
                           std::string(expr->enumerator.text) + "`",
                       "not one of its values");
    helpMembers(d, expr->enumerator, memberNames(type->type));
  }
  return elementaryType(TypeKind::error);
}

} // namespace stc::sema
