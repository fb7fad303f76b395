#include "compiler/semantics/lookup/references.hpp"

#include "compiler/syntax/visit.hpp"

#include <algorithm>
#include <functional>
#include <tuple>

namespace stc {

using namespace ast;

namespace {

using Use = References::Use;

/// Collects the names of a program. Expressions wait in a list: sums of thousands of terms lean to
/// the left, so that their depth is no measure of what a stack holds.
class Collector {
public:
  explicit Collector(std::vector<Use> &out) : out_(out) {}

  void library(const Library &library);
  /// An entry of VAR_CONFIG or VAR_ACCESS.
  void entry(const VarDecl *decl);

private:
  void name(const Symbol *symbol, const Name &at) {
    if (symbol != nullptr && at.span.valid())
      out_.push_back({symbol, at.span});
  }
  void expression(Expr *expr);
  void node(const Expr *expr);
  void arguments(std::span<const Argument> arguments);
  void items(std::span<const AggregateItem> items);
  void type(const TypeExpr *type);
  void variable(const VarDecl *decl);
  void body(Block block);
  void pou(const PouSymbol *pou);
  void typeDeclaration(const TypeSymbol *symbol);

  std::vector<Use> &out_;
  std::vector<Expr *> pending_;
};

void Collector::arguments(std::span<const Argument> arguments) {
  for (const Argument &argument : arguments)
    name(argument.parameter, argument.name);
}

void Collector::items(std::span<const AggregateItem> items) {
  for (const AggregateItem &item : items) {
    name(item.symbol, item.field);
    this->items(item.values);
  }
}

void Collector::node(const Expr *expr) {
  switch (expr->kind) {
  case ExprKind::Name:
    return name(as<NameExpr>(expr)->symbol, as<NameExpr>(expr)->name);
  case ExprKind::Member:
    return name(as<MemberExpr>(expr)->symbol, as<MemberExpr>(expr)->name);
  case ExprKind::Call:
    return arguments(as<CallExpr>(expr)->arguments);
  case ExprKind::Aggregate:
    return items(as<AggregateExpr>(expr)->items);
  case ExprKind::EnumLiteral: {
    const auto *literal = as<EnumLiteralExpr>(expr);
    name(literal->symbol, literal->enumerator);
    if (literal->symbol != nullptr && literal->symbol->kind == SymbolKind::Enumerator)
      name(static_cast<const EnumeratorSymbol *>(literal->symbol)->type->symbol, literal->typeName);
    return;
  }
  case ExprKind::TypeName:
    return type(as<TypeNameExpr>(expr)->name);
  case ExprKind::Literal:
  case ExprKind::Index:
  case ExprKind::Deref:
  case ExprKind::Unary:
  case ExprKind::Binary:
  case ExprKind::Direct:
  case ExprKind::Error:
    return;
  }
}

void Collector::expression(Expr *expr) {
  if (expr == nullptr)
    return;
  const size_t first = pending_.size(); // types inside of expressions hold expressions, too
  pending_.push_back(expr);
  while (pending_.size() > first) {
    const Expr *next = pending_.back();
    pending_.pop_back();
    node(next);
    forEachChild(next, [this](Expr *child) { pending_.push_back(child); });
  }
}

void Collector::type(const TypeExpr *type) {
  switch (type->kind) {
  case TypeExprKind::Named: {
    const auto *named = as<NamedTypeExpr>(type);
    name(named->symbol, named->path.back());
    const auto values = [this](std::span<const Argument> list) {
      arguments(list);
      for (const Argument &argument : list)
        expression(argument.value);
    };
    values(named->arguments);
    for (const std::span<Argument> &element : named->elements)
      values(element);
    return;
  }
  case TypeExprKind::Array:
    for (const ArrayRange &range : as<ArrayTypeExpr>(type)->ranges) {
      expression(range.low);
      expression(range.high);
    }
    return this->type(as<ArrayTypeExpr>(type)->element);
  case TypeExprKind::String:
    return expression(as<StringTypeExpr>(type)->length);
  case TypeExprKind::Pointer:
  case TypeExprKind::Reference:
    return this->type(as<PointerTypeExpr>(type)->pointee);
  case TypeExprKind::Subrange:
    this->type(as<SubrangeTypeExpr>(type)->base);
    expression(as<SubrangeTypeExpr>(type)->low);
    return expression(as<SubrangeTypeExpr>(type)->high);
  case TypeExprKind::Enumeration:
    for (const EnumeratorDecl &enumerator : as<EnumTypeExpr>(type)->enumerators)
      expression(enumerator.value);
    if (as<EnumTypeExpr>(type)->base != nullptr)
      this->type(as<EnumTypeExpr>(type)->base);
    return;
  case TypeExprKind::Inferred:
  case TypeExprKind::Error:
    return;
  }
}

void Collector::variable(const VarDecl *decl) {
  if (decl->type != nullptr)
    type(decl->type);
  expression(decl->init);
}

void Collector::body(Block block) {
  for (const Stmt *stmt : block)
    forEachChild(
        stmt, [this](Expr *expr) { expression(expr); }, [this](Block inner) { body(inner); });
}

void Collector::pou(const PouSymbol *pou) {
  const PouDecl *decl = pou->decl;
  if (pou->base != nullptr && !decl->base.empty())
    name(pou->base, decl->base.back());
  for (const NamePath &path : decl->interfaces)
    for (const PouSymbol *interface : pou->interfaces)
      if (interface->name.id == path.back().id)
        name(interface, path.back());
  for (const VarDecl *v : decl->variables)
    variable(v);
  if (decl->returnType != nullptr)
    type(decl->returnType);
  body(decl->body);
  for (const PropertySymbol *property : pou->properties)
    type(property->decl->type);
  for (const PouSymbol *method : pou->methods)
    this->pou(method);
}

void Collector::typeDeclaration(const TypeSymbol *symbol) {
  if (symbol->decl == nullptr)
    return;
  switch (symbol->decl->kind) {
  case DeclKind::Structure: {
    const auto *decl = as<StructDecl>(symbol->decl);
    const auto *type =
        symbol->type->kind == TypeKind::Structure ? typeAs<StructType>(symbol->type) : nullptr;
    if (type != nullptr && type->base != nullptr)
      name(type->base->symbol, decl->base.back());
    for (const VarDecl *field : decl->fields)
      variable(field);
    return;
  }
  case DeclKind::Enumeration:
    type(as<EnumDecl>(symbol->decl)->type);
    return expression(as<EnumDecl>(symbol->decl)->init);
  case DeclKind::Alias:
    type(as<AliasDecl>(symbol->decl)->type);
    return expression(as<AliasDecl>(symbol->decl)->init);
  default:
    return;
  }
}

void Collector::library(const Library &library) {
  for (const TypeSymbol *symbol : library.types)
    typeDeclaration(symbol);
  for (const GlobalsSymbol *list : library.globals)
    for (const VarSymbol *v : list->variables)
      if (v->decl != nullptr)
        variable(v->decl);
  for (const PouSymbol *symbol : library.pous)
    pou(symbol);
}

void Collector::entry(const VarDecl *decl) {
  expression(decl->path);
  variable(decl);
}

std::tuple<FileId, uint32_t> placeOf(const Use &use) { return {use.span.file, use.span.begin}; }

bool isBefore(const Use &a, const Use &b) { return placeOf(a) < placeOf(b); }

bool isSymbolBefore(const Use &a, const Use &b) {
  const std::less<> before;
  return a.symbol != b.symbol ? before(a.symbol, b.symbol) : isBefore(a, b);
}

bool isSame(const Use &a, const Use &b) { return a.symbol == b.symbol && a.span == b.span; }

} // namespace

References::References(const Program &program) {
  Collector collector(bySymbol_);
  for (const auto &library : program.libraries)
    collector.library(*library);
  for (const SlotPlace &slot : program.slotPlaces) {
    if (slot.decl != nullptr)
      collector.entry(slot.decl);
  }
  for (const AccessPath &access : program.accessPaths)
    collector.entry(access.decl);
  // `a, b : INT` is one type for two variables.
  std::sort(bySymbol_.begin(), bySymbol_.end(), isSymbolBefore);
  bySymbol_.erase(std::unique(bySymbol_.begin(), bySymbol_.end(), isSame), bySymbol_.end());
  byPlace_ = bySymbol_;
  std::sort(byPlace_.begin(), byPlace_.end(), isBefore);
}

std::span<const References::Use> References::of(const Symbol *symbol) const {
  const auto [first, last] = std::equal_range(
      bySymbol_.begin(), bySymbol_.end(), Use{symbol, {}},
      [](const Use &a, const Use &b) { return std::less<>()(a.symbol, b.symbol); });
  return {first, last};
}

const Symbol *References::at(FileId file, uint32_t offset) const {
  auto it = std::upper_bound(byPlace_.begin(), byPlace_.end(), Use{nullptr, {file, offset, offset}},
                             isBefore);
  if (it == byPlace_.begin())
    return nullptr;
  --it;
  return it->span.file == file && offset <= it->span.end ? it->symbol : nullptr;
}

} // namespace stc
