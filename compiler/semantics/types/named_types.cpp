// Named types: structures, enumerations and aliases become types.

#include "compiler/semantics/types/resolve.hpp"

#include "compiler/semantics/attributes.hpp"
#include "compiler/semantics/config/config.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/fold.hpp"
#include "compiler/semantics/names/names.hpp"
#include "compiler/semantics/types/internal.hpp"
#include "compiler/syntax/parser.hpp"

#include <unordered_map>

namespace stc::sema {

using namespace ast;

static void resolveStruct(Context &c, TypeSymbol *symbol, StructDecl *decl);

void resolve(Context &c, TypeSymbol *symbol) {
  if (symbol->type != nullptr)
    return;
  if (symbol->resolving) {
    auto &d = c.report(Code::RecursiveType, symbol->name.span,
                       "type `" + std::string(symbol->name.text) + "` is defined by itself",
                       "this definition is a circle");
    d.help("break the circle, for instance with POINTER TO");
    symbol->type = elementaryType(TypeKind::Error);
    return;
  }
  if (isTooDeep(c, symbol->name)) {
    symbol->type = elementaryType(TypeKind::Error);
    return;
  }
  symbol->resolving = true;
  const ScopeGuard guard(c, {&c.names.moduleOf(symbol), nullptr, symbol->decl});
  switch (symbol->decl->kind) {
  case DeclKind::Structure:
    resolveStruct(c, symbol, as<StructDecl>(symbol->decl));
    break;
  case DeclKind::Enumeration: {
    auto *decl = as<EnumDecl>(symbol->decl);
    symbol->init = decl->init;
    symbol->type = makeEnum(c, decl->type, symbol);
    break;
  }
  default: {
    auto *decl = as<AliasDecl>(symbol->decl);
    const Type *type = resolveType(c, decl->type, symbol->name.text);
    if (symbol->type == nullptr) // a circle has set it to error
      symbol->type = type;
    symbol->init = decl->init;
    break;
  }
  }
  symbol->resolving = false;
  symbol->library->types.push_back(symbol);
}

/// Makes `type` extend `base`, unless that makes too long a chain.
static void extendStruct(Context &c, StructType *type, const Name &baseName,
                         const StructType *base) {
  if (base->bases >= kMaxNesting) {
    c.report(Code::TooDeep, baseName.span,
             "`" + std::string(baseName.text) + "` extends too many other structures",
             "more than " + std::to_string(kMaxNesting));
    return;
  }
  type->base = base;
  type->bases = base->bases + 1;
  type->symbol->fields = base->symbol->fields;
}

/// A UNION that extends another one has its members, too: all of them share their memory.
static void extendUnion(Context &c, StructType *type, const StructType *base,
                        std::vector<VarSymbol *> &fields) {
  for (const VarSymbol *f : base->fields) {
    auto *own = c.arena.make<VarSymbol>(*f);
    fields.push_back(own);
    for (const auto &[name, field] : base->symbol->fields) { // it may have an alias
      if (field == f)
        type->symbol->fields.emplace(name, own);
    }
  }
}

/// What the type extends; a UNION's members are added to `fields`.
static void resolveBase(Context &c, StructType *type, const StructDecl *decl,
                        std::vector<VarSymbol *> &fields) {
  const Name &name = decl->base.back();
  const std::string base(name.text);
  Symbol *symbol = lookupPath(c, decl->base, true);
  if (symbol == nullptr)
    return; // reported
  if (symbol->kind != SymbolKind::Type) {
    auto &d = c.report(Code::WrongBase, name.span, "`" + base + "` is not a structure",
                       "this is " + describe(symbol));
    noteDeclaration(d, symbol);
    return;
  }
  auto *baseSymbol = static_cast<TypeSymbol *>(symbol);
  const bool circle = baseSymbol->resolving;
  resolve(c, baseSymbol);
  if (isError(baseSymbol->type))
    return;
  const auto *structure = !circle && baseSymbol->type->kind == TypeKind::Structure
                              ? typeAs<StructType>(baseSymbol->type)
                              : nullptr;
  if (structure != nullptr && structure->isUnion == type->isUnion) {
    if (type->isUnion)
      extendUnion(c, type, structure, fields);
    else
      extendStruct(c, type, name, structure);
    return;
  }
  const std::string wanted = type->isUnion ? "UNION" : "structure";
  c.report(circle ? Code::RecursiveType : Code::WrongBase, name.span,
           circle ? "`" + std::string(type->symbol->name.text) + "` extends itself"
                  : "`" + base + "` is not a " + wanted,
           "a " + wanted + " can only extend another " + wanted);
}

static void resolveStruct(Context &c, TypeSymbol *symbol, StructDecl *decl) {
  auto *type = c.arena.make<StructType>();
  type->kind = TypeKind::Structure;
  type->symbol = symbol;
  type->isUnion = decl->isUnion;
  symbol->type = type; // members may point back to it
  type->pack = packMode(c.reporter, decl->attributes,
                        symbol->library->isUser ? c.program.settings.pack : symbol->library->pack);
  std::vector<VarSymbol *> fields;
  if (!decl->base.empty())
    resolveBase(c, type, decl, fields);
  for (VarDecl *f : decl->fields) {
    VarSymbol *field = makeVariable(c.arena, f, c.names.moduleOf(symbol), nullptr);
    field->home = decl;
    const auto [it, fresh] = symbol->fields.emplace(f->name.id, field);
    if (!fresh) {
      auto &d = c.report(Code::DuplicateName, f->name.span,
                         "the field `" + std::string(f->name.text) + "` is declared twice",
                         "declared again here");
      d.label(it->second->name.span, "first declared here");
      continue;
    }
    const std::string hint = std::string(symbol->name.text) + "__" + std::string(f->name.text);
    field->type = resolveMember(c, field, hint);
    if (f->address != nullptr)
      placeVariable(c, field);
    fields.push_back(field);
    for (const Attribute &a : f->attributes) { // a second name of the same field
      if (a.id == AttributeId::Alias)
        symbol->fields.emplace(c.program.interner.intern(a.value), field);
    }
  }
  type->fields = c.arena.copy(fields);
}

static const Type *baseOfEnum(Context &c, const EnumTypeExpr *expr) {
  const Type *otherwise = elementaryType(TypeKind::Int);
  if (expr->base == nullptr)
    return otherwise;
  const Type *base = resolveType(c, expr->base, {});
  if (isInteger(base))
    return base;
  if (!isError(base))
    c.report(Code::WrongBase, expr->base->span,
             "an enumeration cannot be based on " + typeName(base),
             "an integer or bit-string type is expected here");
  return otherwise;
}

/// `next` is the value that an enumerator has by its place.
static EnumeratorSymbol *makeEnumerator(Context &c, const EnumeratorDecl &e,
                                        const TypeSymbol *symbol, const EnumType *type,
                                        int64_t next) {
  auto *enumerator = c.arena.make<EnumeratorSymbol>();
  enumerator->kind = SymbolKind::Enumerator;
  enumerator->name = e.name;
  enumerator->library = symbol->library;
  enumerator->space = symbol->space;
  enumerator->type = type;
  enumerator->value = next;
  if (e.value != nullptr)
    enumerator->value = constantInteger(c, e.value, "the value of an enumerator").value_or(next);
  if (!constantFits(integerValue(enumerator->value), elementaryType(TypeKind::AnyInteger),
                    type->base))
    c.report(Code::ConstantOverflow, e.name.span,
             "the value " + std::to_string(enumerator->value) + " of `" + std::string(e.name.text) +
                 "` does not fit into " + typeName(type->base))
        .help("give the enumeration a larger base type: `(…) DINT`");
  return enumerator;
}

/// The enumerators, each name once; names that need no type before them can be looked up then.
static std::vector<EnumeratorSymbol *> makeEnumerators(Context &c, const EnumTypeExpr *expr,
                                                       const TypeSymbol *symbol,
                                                       const EnumType *type) {
  Module &module = c.names.moduleOf(symbol);
  const bool isQualified =
      symbol->decl != nullptr && hasAttribute(symbol->decl->attributes, AttributeId::QualifiedOnly);
  std::vector<EnumeratorSymbol *> list;
  std::unordered_map<Ident, EnumeratorSymbol *> seen;
  int64_t next = 0;
  for (const EnumeratorDecl &e : expr->enumerators) {
    EnumeratorSymbol *enumerator = makeEnumerator(c, e, symbol, type, next);
    next = enumerator->value + 1;
    const auto [it, fresh] = seen.emplace(e.name.id, enumerator);
    if (!fresh) {
      auto &d = c.report(Code::DuplicateName, e.name.span,
                         "the enumerator `" + std::string(e.name.text) + "` is declared twice",
                         "declared again here");
      d.label(it->second->name.span, "first declared here");
      continue;
    }
    list.push_back(enumerator);
    if (!isQualified)
      (symbol->space == nullptr ? module.enumerators : symbol->space->enumerators)[e.name.id]
          .push_back(enumerator);
  }
  return list;
}

const EnumType *makeEnum(Context &c, EnumTypeExpr *expr, TypeSymbol *symbol) {
  auto *type = c.arena.make<EnumType>();
  type->kind = TypeKind::Enumeration;
  type->symbol = symbol;
  symbol->type = type;
  type->base = elementaryType(TypeKind::Int);
  type->base = baseOfEnum(c, expr);
  const auto has = [&](AttributeId attribute) {
    return symbol->decl != nullptr && hasAttribute(symbol->decl->attributes, attribute);
  };
  type->strict = has(AttributeId::Strict);
  type->named = has(AttributeId::ToString);
  const std::vector<EnumeratorSymbol *> list = makeEnumerators(c, expr, symbol, type);
  type->enumerators = c.arena.copy(list);
  type->initial = list.empty() ? nullptr : list.front();
  if (symbol->init != nullptr) {
    check(c, symbol->init, type);
    coerce(c, symbol->init, type, "the initial value");
    if (symbol->init->constant != nullptr && !isError(symbol->init->type)) {
      for (EnumeratorSymbol *e : list) {
        if (e->value == symbol->init->constant->integer)
          type->initial = e;
      }
    }
  }
  type->qualifiedOnly =
      has(AttributeId::QualifiedOnly); // its own declaration may use the plain names
  return type;
}

void resolveEnumerations(Context &c, Module &module) {
  for (size_t i = 0; i < module.declaredTypes.size(); ++i) { // the list may grow meanwhile
    if (module.declaredTypes[i]->decl->kind == DeclKind::Enumeration)
      resolve(c, module.declaredTypes[i]);
  }
}

} // namespace stc::sema
