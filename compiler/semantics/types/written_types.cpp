// Types as written become types.

#include "compiler/semantics/types/resolve.hpp"

#include "compiler/semantics/classes/classes.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/fold.hpp"
#include "compiler/semantics/names/names.hpp"
#include "compiler/semantics/types/internal.hpp"

namespace stc::sema {

using namespace ast;

static const Type *resolveNamed(Context &c, NamedTypeExpr *expr);
static const Type *resolveArray(Context &c, ArrayTypeExpr *expr, std::string_view hint);
static const Type *resolveString(Context &c, StringTypeExpr *expr);
static const Type *resolveSubrange(Context &c, SubrangeTypeExpr *expr, std::string_view hint);
static const Type *resolvePointer(Context &c, PointerTypeExpr *expr, std::string_view hint);

static const Type *resolveOpenArray(Context &c, ArrayTypeExpr *expr, const Type *element) {
  const Type *bad = elementaryType(TypeKind::Error);
  for (ArrayRange &range : expr->ranges) {
    if (range.low != nullptr) {
      c.report(Code::OpenArrayNotAllowed, range.span,
               "an array has either bounds or `*` in all of its dimensions", "bounds beside a `*`")
          .help("write `*` for each dimension, or give all bounds");
      return bad;
    }
  }
  if (expr != c.openArrayAllowed) {
    c.report(Code::OpenArrayNotAllowed, expr->span,
             "an array of variable length is only possible as a VAR_IN_OUT",
             "there is no caller's array to take the bounds from")
        .help("give the bounds, or pass the array as a VAR_IN_OUT of this type");
    return bad;
  }
  if (isError(element))
    return bad;
  return c.types.openArray(element, static_cast<uint32_t>(expr->ranges.size()));
}

namespace {

constexpr int64_t kMaxArrayElements = int64_t{1} << 28;

constexpr int64_t kMaxStringLength = 65535;

} // namespace

const Type *resolveType(Context &c, TypeExpr *expr, std::string_view hint) {
  switch (expr->kind) {
  case TypeExprKind::Named:
    return resolveNamed(c, as<NamedTypeExpr>(expr));
  case TypeExprKind::Array:
    return resolveArray(c, as<ArrayTypeExpr>(expr), hint);
  case TypeExprKind::String:
    return resolveString(c, as<StringTypeExpr>(expr));
  case TypeExprKind::Subrange:
    return resolveSubrange(c, as<SubrangeTypeExpr>(expr), hint);
  case TypeExprKind::Pointer:
  case TypeExprKind::Reference:
    return resolvePointer(c, as<PointerTypeExpr>(expr), hint);
  case TypeExprKind::Enumeration: {
    // An enumeration in line gets a name of its own, made of the variable's.
    TypeSymbol &symbol = c.program.typeStorage.emplace_back();
    symbol.kind = SymbolKind::Type;
    symbol.name.text = c.arena.copy(hint);
    symbol.name.id = c.program.interner.intern(hint);
    symbol.name.span = expr->span;
    symbol.library = c.scope.module->library;
    const Type *type = makeEnum(c, as<EnumTypeExpr>(expr), &symbol);
    symbol.library->types.push_back(&symbol);
    return type;
  }
  case TypeExprKind::Inferred: // checkAssign() gives it
  case TypeExprKind::Error:
    break;
  }
  return elementaryType(TypeKind::Error);
}

/// The type is written as BIT, and BIT is not the name of a type of the program.
static bool namesBit(Context &c, const TypeExpr *expr) {
  if (expr->kind != TypeExprKind::Named || as<NamedTypeExpr>(expr)->path.size() != 1)
    return false;
  const Name &name = as<NamedTypeExpr>(expr)->path.front();
  if (name.id->lower != "bit")
    return false;
  const Symbol *own = lookupDeclared(c, name);
  return own == nullptr || own->kind == SymbolKind::Variable;
}

const Type *resolveMember(Context &c, VarSymbol *variable, std::string_view hint) {
  const VarDecl *decl = variable->decl;
  if (!namesBit(c, decl->type))
    return resolveType(c, decl->type, hint);
  if (decl->address != nullptr) {
    c.report(Code::BitNotPossible, decl->type->span, "a BIT cannot have an address of its own",
             "declared with AT")
        .help("write `BOOL`: a BOOL at `%IX0.0` is a single bit");
    return elementaryType(TypeKind::Boolean);
  }
  variable->isBit = !variable->isConstant;
  return elementaryType(TypeKind::Boolean);
}

/// The elementary type that a plain name stands for; null: it is none of them.
static const Type *elementaryNamed(Context &c, const Name &name) {
  const auto [it, fresh] = c.elementary.emplace(name.id, nullptr);
  if (!fresh)
    return it->second;
  const Type *type = findElementaryType(name.id->lower);
  if (type != nullptr && isCharacter(type)) { // V2.3 programs have types of this name
    const Symbol *own = c.scope.module->find(name.id);
    if (own != nullptr && own->kind == SymbolKind::Type)
      type = nullptr;
  }
  it->second = type;
  return type;
}

/// What a plain name stands for where a type is meant; null: nothing.
static Symbol *lookupType(Context &c, const Name &name) {
  // Types are not hidden by variables of the same name (`TON : TON`).
  Symbol *symbol = lookupDeclared(c, name);
  if (symbol == nullptr || symbol->kind == SymbolKind::Variable) {
    Symbol *inLibrary = lookupInLibraries(c, name);
    symbol = inLibrary != nullptr ? inLibrary : symbol;
  }
  if (symbol == nullptr && c.scope.pou != nullptr && c.scope.pou->scope.contains(name.id))
    symbol = c.scope.pou->scope.at(name.id);
  return symbol;
}

static void reportNoType(Context &c, const NamedTypeExpr *expr, const Name &name) {
  if (!namesBit(c, expr)) {
    reportUnknown(c, name, Sought::Type);
    return;
  }
  c.report(Code::BitNotPossible, name.span, "there is no BIT here",
           "only fields of a STRUCT or UNION and variables of a FUNCTION_BLOCK can be BIT")
      .note("a BIT shares its byte with others and has no address, so that there are no arrays of "
            "BIT and no pointers to it")
      .help("write `BOOL`");
}

/// The type that a symbol is, as the name at `expr` may use it; null (reported): it is no type.
static const Type *typeOfSymbol(Context &c, const NamedTypeExpr *expr, const Name &name) {
  Symbol *symbol = expr->symbol;
  if (symbol->kind == SymbolKind::Type) {
    auto *type = static_cast<TypeSymbol *>(symbol);
    resolve(c, type);
    return type->type;
  }
  if (symbol->kind == SymbolKind::Pou) {
    auto *pou = static_cast<PouSymbol *>(symbol);
    if (pou->isBlock() || pou->isInterface()) {
      link(c, pou);
      if (pou->space == nullptr) // of a namespace: see nameInSpace()
        requireAccess(c, name.span, pou, pou, pou->decl->access);
      return pou->type;
    }
    if (c.programTypes && pou->decl->kind == DeclKind::Program)
      return pou->type;
  }
  const auto *variable =
      symbol->kind == SymbolKind::Variable ? static_cast<const VarSymbol *>(symbol) : nullptr;
  if (variable != nullptr && variable->decl != nullptr && variable->decl->type == expr) {
    reportUnknown(c, name, Sought::Type); // `Axis : Axis`
    return elementaryType(TypeKind::Error);
  }
  auto &d = c.report(Code::NotAType, name.span, "`" + std::string(name.text) + "` is not a type",
                     "this is " + describe(symbol));
  noteDeclaration(d, symbol);
  return elementaryType(TypeKind::Error);
}

static const Type *resolveNamed(Context &c, NamedTypeExpr *expr) {
  const Name &name = expr->path.back();
  if (expr->path.size() == 1) {
    if (const Type *type = elementaryNamed(c, name))
      return type;
    expr->symbol = lookupType(c, name);
    if (expr->symbol == nullptr)
      reportNoType(c, expr, name);
  } else {
    expr->symbol = lookupPath(c, expr->path, true);
  }
  return expr->symbol == nullptr ? elementaryType(TypeKind::Error) : typeOfSymbol(c, expr, name);
}

static const Type *resolveArray(Context &c, ArrayTypeExpr *expr, std::string_view hint) {
  const Type *type = resolveType(c, expr->element, hint);
  for (const ArrayRange &range : expr->ranges) {
    if (range.low == nullptr)
      return resolveOpenArray(c, expr, type);
  }
  int64_t total = 1;
  for (size_t i = expr->ranges.size(); i-- > 0;) {
    ArrayRange &range = expr->ranges[i];
    const auto low = constantInteger(c, range.low, "an array bound");
    const auto high = constantInteger(c, range.high, "an array bound");
    if (!low || !high || isError(type))
      return elementaryType(TypeKind::Error);
    int64_t count = 0;
    if (*high < *low || __builtin_sub_overflow(*high, *low, &count) || count >= kMaxArrayElements ||
        __builtin_mul_overflow(total, count + 1, &total) || total > kMaxArrayElements) {
      auto &d = c.report(Code::InvalidArrayBounds, range.span,
                         *high < *low ? "the upper bound " + std::to_string(*high) +
                                            " is below the lower bound " + std::to_string(*low)
                                      : std::string("the array is too large"),
                         *high < *low ? "these bounds hold no element"
                                      : "more than 268,435,456 elements");
      if (*high < *low)
        d.help("write the lower bound first: `" + std::to_string(*high) + ".." +
               std::to_string(*low) + "`");
      return elementaryType(TypeKind::Error);
    }
    type = c.types.array(type, *low, *high);
  }
  return type;
}

static const Type *resolveString(Context &c, StringTypeExpr *expr) {
  if (expr->length == nullptr)
    return c.types.string(expr->wide, 80);
  const auto length = constantInteger(c, expr->length, "the length of a string");
  if (!length)
    return elementaryType(TypeKind::Error);
  if (*length < 1 || *length > kMaxStringLength) {
    c.report(Code::InvalidStringLength, expr->length->span,
             "a string cannot have the length " + std::to_string(*length),
             "1 to 65535 is possible");
    return elementaryType(TypeKind::Error);
  }
  return c.types.string(expr->wide, static_cast<uint32_t>(*length));
}

static const Type *resolveSubrange(Context &c, SubrangeTypeExpr *expr, std::string_view hint) {
  const Type *base = resolveType(c, expr->base, hint);
  const auto low = constantInteger(c, expr->low, "a bound of the range");
  const auto high = constantInteger(c, expr->high, "a bound of the range");
  if (isError(base) || !low || !high)
    return elementaryType(TypeKind::Error);
  if (!isInteger(base)) {
    c.report(Code::InvalidSubrange, expr->base->span,
             typeName(base) + " cannot be limited to a range", "an integer type is expected here");
    return elementaryType(TypeKind::Error);
  }
  const Type *any = elementaryType(TypeKind::AnyInteger);
  const bool fits =
      constantFits(integerValue(*low), any, base) && constantFits(integerValue(*high), any, base);
  if (*high < *low || !fits) {
    c.report(
        Code::InvalidSubrange, expr->low->span.to(expr->high->span),
        *high < *low ? "the range holds no value" : "the range does not fit into " + typeName(base),
        *high < *low ? "the upper bound is below the lower one"
                     : typeName(base) + " goes from " + std::to_string(integerRange(base).low) +
                           " to " + std::to_string(integerRange(base).high));
    return elementaryType(TypeKind::Error);
  }
  return c.types.subrange(base, *low, *high);
}

static const Type *resolvePointer(Context &c, PointerTypeExpr *expr, std::string_view hint) {
  const bool isPointer = expr->kind == TypeExprKind::Pointer;
  const Type *pointee = nullptr;
  if (isPointer && expr->pointee->kind == TypeExprKind::Named) {
    const auto *named = as<NamedTypeExpr>(expr->pointee);
    if (named->path.size() == 1 && named->path.front().id->lower == "void" &&
        c.scope.module->find(named->path.front().id) == nullptr)
      pointee = elementaryType(TypeKind::None);
  }
  if (pointee == nullptr)
    pointee = resolveType(c, expr->pointee, hint);
  if (isError(pointee))
    return pointee;
  if (pointee->kind == TypeKind::Reference) {
    auto &d = c.report(Code::InvalidIndirection, expr->pointee->span,
                       std::string(isPointer ? "a pointer" : "a reference") +
                           " to a REFERENCE is not possible",
                       "a reference has no place of its own");
    d.help(std::string("write `") + (isPointer ? "POINTER" : "REFERENCE") + " TO " +
           typeName(typeAs<PointerType>(pointee)->pointee) + "`");
    return elementaryType(TypeKind::Error);
  }
  return isPointer ? c.types.pointer(pointee) : c.types.reference(pointee);
}

} // namespace stc::sema
