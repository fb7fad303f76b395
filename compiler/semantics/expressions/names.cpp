// Plain names in expressions, and what a name on the left of a dot stands for.

#include "compiler/semantics/expressions/expressions.hpp"

#include "compiler/semantics/config/config.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/expressions/internal.hpp"
#include "compiler/semantics/fold.hpp"
#include "compiler/semantics/names/names.hpp"

namespace stc::sema {

using namespace ast;

static const Type *useVariable(Context &c, Expr *expr, VarSymbol *variable) {
  const Type *type = typeOf(c, variable);
  // A constant parameter has the caller's value.
  const bool parameter = variable->section == Section::Input || variable->section == Section::InOut;
  if (variable->isConstant && !parameter && isElementary(type)) {
    checkInitOf(c, variable);
    expr->constant = variable->constant;
  }
  return type->kind == TypeKind::Reference ? typeAs<PointerType>(type)->pointee : type;
}

static const Type *notAValue(Context &c, const Symbol *symbol, const Name &name) {
  auto &d =
      c.report(Code::NotAVariable, name.span, "`" + std::string(name.text) + "` is not a value",
               "this is " + describe(symbol));
  noteDeclaration(d, symbol);
  const auto *pou =
      symbol->kind == SymbolKind::Pou ? static_cast<const PouSymbol *>(symbol) : nullptr;
  if (symbol->kind == SymbolKind::Builtin || (pou != nullptr && pou->isFunction()))
    d.help("call it: `" + std::string(name.text) + "(…)`");
  else if (pou != nullptr)
    d.help((pou->isInterface() ? "declare a variable of it: `x : "
                               : "declare an instance of it: `x : ") +
           std::string(name.text) + ";`");
  return elementaryType(TypeKind::Error);
}

/// A program is a variable of its own; other POUs are no values.
static const Type *usePou(Context &c, PouSymbol *pou, const Name &name) {
  if (pou->isMethod()) {
    auto &d = c.report(Code::MethodNotCalled, name.span,
                       "`" + std::string(name.text) + "` is " + describe(pou) + ", not a value",
                       "it has to be called");
    noteDeclaration(d, pou);
    d.help("call it: `" + std::string(name.text) + "()`");
    return elementaryType(TypeKind::Error);
  }
  if (pou->decl->kind != DeclKind::Program)
    return notAValue(c, pou, name);
  if (pou->isTemplate) {
    reportTemplate(c, name, pou);
    return elementaryType(TypeKind::Error);
  }
  declare(c, pou);
  return pou->type;
}

const Type *useSymbol(Context &c, Expr *expr, Symbol *symbol, const Name &name) {
  switch (symbol->kind) {
  case SymbolKind::Variable:
    return useVariable(c, expr, static_cast<VarSymbol *>(symbol));
  case SymbolKind::Enumerator: {
    const auto *e = static_cast<EnumeratorSymbol *>(symbol);
    expr->constant = c.makeConstant(integerValue(e->value));
    return e->type;
  }
  case SymbolKind::Pou:
    return usePou(c, static_cast<PouSymbol *>(symbol), name);
  case SymbolKind::Property:
    return useProperty(c, expr, static_cast<PropertySymbol *>(symbol), name);
  case SymbolKind::Self: {
    auto *self = static_cast<SelfSymbol *>(symbol);
    declare(c, self->block);
    return c.types.pointer(self->block->type);
  }
  default:
    return notAValue(c, symbol, name);
  }
}

const Type *checkName(Context &c, NameExpr *expr, const Type *expected) {
  Symbol *symbol = lookup(c, expr->name);
  const bool isValue = symbol != nullptr &&
                       (symbol->kind == SymbolKind::Variable || symbol->kind == SymbolKind::Pou ||
                        symbol->kind == SymbolKind::Property || symbol->kind == SymbolKind::Self);
  if (!isValue) {
    const FoundEnumerator found = c.names.enumerator(c.scope, expr->name.id, expected);
    if (EnumeratorSymbol *e = found.enumerator) {
      if (found.isAmbiguous) {
        auto &d =
            c.report(Code::AmbiguousName, expr->name.span,
                     "`" + std::string(expr->name.text) + "` is an enumerator of several types",
                     "which one is meant?");
        std::vector<EnumeratorSymbol *> candidates;
        if (found.other != nullptr)
          candidates = {e, found.other};
        else if (const auto own = c.scope.module->enumerators.find(expr->name.id);
                 own != c.scope.module->enumerators.end())
          candidates = own->second;
        for (EnumeratorSymbol *other : candidates)
          d.label(other->name.span, "of `" + typeName(other->type) + "`");
        d.help("write the type too: `" + typeName(e->type) + "." + std::string(expr->name.text) +
               "`");
        return elementaryType(TypeKind::Error);
      }
      symbol = e;
    }
  }
  if (symbol == nullptr && expr->name.id->lower == "null") { // edition 3: the pointer to nothing
    expr->constant = c.makeConstant({});
    return c.types.pointer(elementaryType(TypeKind::None));
  }
  if (symbol == nullptr) {
    if (!reportUnqualified(c, expr->name, expected))
      reportUnknown(c, expr->name, Sought::Value);
    return elementaryType(TypeKind::Error);
  }
  expr->symbol = symbol;
  if (symbol->kind == SymbolKind::Variable)
    expr->common = static_cast<const VarSymbol *>(symbol)->common;
  return useSymbol(c, expr, symbol, expr->name);
}

Symbol *resolveNamespace(Context &c, Expr *expr) {
  if (expr->kind == ExprKind::Name) {
    auto *name = as<NameExpr>(expr);
    Symbol *symbol = lookup(c, name->name);
    if (symbol != nullptr && symbol->kind == SymbolKind::Variable &&
        isElementary(typeOf(c, static_cast<VarSymbol *>(symbol)))) {
      // `color : Color := Color.red`: a variable without members does not hide a type, list or
      // library.
      Symbol *other = lookupDeclared(c, name->name);
      if (other == symbol || other == nullptr)
        other = lookupInLibraries(c, name->name);
      if (other != nullptr && other->kind == SymbolKind::Type)
        symbol = other;
    }
    // `SysTime.SysTimeGetMs()`, although SYSTIME is a type: one without enumerators has no members.
    if (symbol != nullptr && symbol->kind == SymbolKind::Type) {
      const Type *type = static_cast<const TypeSymbol *>(symbol)->type;
      Symbol *library = type == nullptr || type->kind == TypeKind::Enumeration
                            ? nullptr
                            : c.names.library(c.scope, name->name);
      symbol = library == nullptr ? symbol : library;
    }
    // `GVL.x`, although a variable or a POU may have the list's name, is not decided here: the
    // value wins.
    if (symbol != nullptr &&
        (symbol->kind == SymbolKind::Type || symbol->kind == SymbolKind::Library ||
         symbol->kind == SymbolKind::Globals || symbol->kind == SymbolKind::Space)) {
      name->symbol = symbol;
      return symbol;
    }
    return nullptr;
  }
  if (expr->kind == ExprKind::Member) { // Library.Enum.value, Library.GVL.x
    auto *member = as<MemberExpr>(expr);
    if (member->bit >= 0)
      return nullptr;
    Symbol *base = resolveNamespace(c, member->base);
    if (base == nullptr)
      return nullptr;
    Symbol *symbol = nameInSpace(c, base, member->name);
    if (symbol != nullptr &&
        (symbol->kind == SymbolKind::Type || symbol->kind == SymbolKind::Space ||
         symbol->kind == SymbolKind::Globals)) {
      member->symbol = symbol;
      return symbol;
    }
  }
  return nullptr;
}

void followSelf(Context &c, Expr *&expr) {
  if (expr->kind != ExprKind::Name)
    return;
  const Name &name = as<NameExpr>(expr)->name;
  if (name.id->lower != "this" && name.id->lower != "super")
    return;
  const Symbol *symbol = lookup(c, name);
  if (symbol == nullptr || symbol->kind != SymbolKind::Self)
    return;
  auto *deref = c.arena.make<DerefExpr>();
  deref->span = expr->span;
  deref->base = expr;
  expr = deref;
}

} // namespace stc::sema
