// SIZEOF, XSIZEOF, LOWER_BOUND and UPPER_BOUND: what is known about types and arrays.

#include "compiler/semantics/builtins/internal.hpp"

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/builtins/builtin_calls.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/fold.hpp"
#include "compiler/semantics/names/names.hpp"
#include "compiler/semantics/types/resolve.hpp"

#include <algorithm>
#include <unordered_set>

namespace stc::sema {

using namespace ast;

const Type *namedType(Context &c, Expr *expr) {
  Symbol *symbol = nullptr;
  if (expr->kind == ExprKind::TypeName)
    return resolveType(c, as<TypeNameExpr>(expr)->name, "type");
  if (expr->kind == ExprKind::Name) {
    const Name &name = as<NameExpr>(expr)->name;
    symbol = lookup(c, name);
    if (symbol == nullptr)
      return findElementaryType(name.id->lower);
    // A variable hides a type of its name only where a value is meant (`TON : TON`).
    if (symbol->kind == SymbolKind::Variable)
      return nullptr;
    if (symbol->kind == SymbolKind::Builtin) // TIME and LTIME are both
      return findElementaryType(name.id->lower);
  } else if (expr->kind == ExprKind::Member && as<MemberExpr>(expr)->bit < 0) {
    auto *member = as<MemberExpr>(expr);
    if (Symbol *space = resolveNamespace(c, member->base);
        space != nullptr && space->kind == SymbolKind::Library)
      symbol = c.names.inLibrary(space->name.id, member->name.id);
  }
  if (symbol == nullptr)
    return nullptr;
  if (symbol->kind == SymbolKind::Type) {
    auto *type = static_cast<TypeSymbol *>(symbol);
    resolve(c, type);
    return type->type;
  }
  if (symbol->kind == SymbolKind::Pou &&
      static_cast<PouSymbol *>(symbol)->decl->kind == DeclKind::FunctionBlock)
    return static_cast<PouSymbol *>(symbol)->type;
  return nullptr;
}

namespace {

/// Blocks held by value have their variables declared before their size is asked for.
template <class Declare>
void declareContained(const Type *type, Declare &&declare, std::unordered_set<const Type *> &seen) {
  while (type->kind == TypeKind::Array)
    type = typeAs<ArrayType>(type)->element;
  if (!seen.insert(type).second)
    return; // a type inside of itself is reported elsewhere
  if (isInstance(type)) {
    PouSymbol *pou = typeAs<PouType>(type)->symbol;
    if (!pou->declared)
      declare(pou);
    for (const VarSymbol *v : pou->variables) {
      if (isField(v) && v->section != Section::InOut && v->type != nullptr)
        declareContained(v->type, declare, seen);
    }
  } else if (type->kind == TypeKind::Structure) {
    const auto *s = typeAs<StructType>(type);
    if (s->base != nullptr)
      declareContained(s->base, declare, seen);
    for (const VarSymbol *v : s->fields) {
      if (v->type != nullptr)
        declareContained(v->type, declare, seen);
    }
  }
}

} // namespace

const Type *checkSizeof(Context &c, CallExpr *expr) {
  const Type *bad = elementaryType(TypeKind::Error);
  if (!requireCount(c, expr) || expr->arguments[0].value == nullptr)
    return bad;
  Expr *value = expr->arguments[0].value;
  const Type *type = namedType(c, value);
  if (type == nullptr)
    type = check(c, value);
  else
    value->type = type;
  if (isError(type))
    return bad;
  if (type->kind == TypeKind::None || type->kind == TypeKind::AnyInteger ||
      type->kind == TypeKind::AnyReal)
    return argumentError(c, expr, 0, "a variable or a type");
  if (refuseOpenArray(c, value, "measure"))
    return bad;
  std::unordered_set<const Type *> seen;
  declareContained(
      type, [&c](PouSymbol *pou) { declare(c, pou); }, seen);
  const uint64_t size = c.storage.of(type).size;
  const auto same = [type](const auto &entry) { return entry.first == type; };
  if (std::none_of(c.program.measured.begin(), c.program.measured.end(), same))
    c.program.measured.emplace_back(type, size);
  expr->constant = c.makeConstant(integerValue(static_cast<int64_t>(size)));
  return elementaryType(TypeKind::AnyInteger);
}

const Type *checkIndexOf(Context &c, CallExpr *expr) {
  const Type *bad = elementaryType(TypeKind::Error);
  if (!requireCount(c, expr) || expr->arguments[0].value == nullptr)
    return bad;
  Expr *value = expr->arguments[0].value;
  Symbol *symbol = value->kind == ExprKind::Name ? lookup(c, as<NameExpr>(value)->name) : nullptr;
  if (symbol == nullptr || symbol->kind != SymbolKind::Pou) {
    if (!isError(check(c, value)))
      return argumentError(c, expr, 0, "the name of a POU");
    return bad;
  }
  value->type = elementaryType(TypeKind::None);
  const auto &pous = symbol->library->pous;
  const auto at = std::find(pous.begin(), pous.end(), symbol) - pous.begin();
  expr->constant = c.makeConstant(integerValue(static_cast<int64_t>(at) + 1));
  return elementaryType(TypeKind::AnyInteger);
}

const Type *checkBoundOf(Context &c, CallExpr *expr, int64_t ArrayType::*bound) {
  const Type *bad = elementaryType(TypeKind::Error);
  Expr *array = expr->arguments[0].value;
  Expr *dimension = expr->arguments[1].value;
  const bool open = array->type->kind == TypeKind::OpenArray;
  if (array->type->kind != TypeKind::Array && !open)
    return argumentError(c, expr, 0, "an array");
  if (!isInteger(underlying(dimension->type)) && dimension->type->kind != TypeKind::AnyInteger)
    return argumentError(c, expr, 1, "the number of a dimension");
  const int64_t dynamic = open ? typeAs<OpenArrayType>(array->type)->dimensions : 0;
  const Type *fixed = open ? typeAs<OpenArrayType>(array->type)->element : array->type;
  int64_t count = dynamic;
  for (const Type *t = fixed; t->kind == TypeKind::Array; t = typeAs<ArrayType>(t)->element)
    ++count;
  if (dimension->constant == nullptr) {
    c.report(Code::NotConstant, dimension->span, "the dimension must be an integer constant",
             "its value is only known at run time")
        .help("write 1 for the first dimension, 2 for the second");
    return bad;
  }
  const int64_t wanted = dimension->constant->integer;
  if (wanted < 1 || wanted > count) {
    c.report(Code::WrongDimension, dimension->span,
             "the array has no dimension " + std::to_string(wanted),
             count == 1 ? "it has one dimension, number 1"
                        : "its dimensions are 1 to " + std::to_string(count));
    return bad;
  }
  if (wanted <= dynamic)
    return elementaryType(TypeKind::Dint);
  const auto *at = typeAs<ArrayType>(fixed);
  for (int64_t i = dynamic + 1; i < wanted; ++i)
    at = typeAs<ArrayType>(at->element);
  expr->constant = c.makeConstant(integerValue(at->*bound));
  return elementaryType(TypeKind::Dint);
}

} // namespace stc::sema
