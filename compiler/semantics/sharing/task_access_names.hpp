#pragma once
// What the expressions of a POU name, for task_access*.cpp.

#include "compiler/semantics/sharing/task_access.hpp"

namespace stc::access {

/// It stands for another variable.
inline bool isAlias(const VarSymbol *v) {
  return v->section == ast::Section::inOut || v->type->kind == TypeKind::reference;
}

inline const Symbol *symbolOf(const ast::Expr *e) {
  if (e->kind == ast::ExprKind::name)
    return ast::as<ast::NameExpr>(e)->symbol;
  return e->kind == ast::ExprKind::member ? ast::as<ast::MemberExpr>(e)->symbol : nullptr;
}

inline bool isNamespaceName(const ast::Expr *e) {
  const Symbol *symbol = symbolOf(e);
  return symbol != nullptr &&
         (symbol->kind == SymbolKind::library || symbol->kind == SymbolKind::globals ||
          symbol->kind == SymbolKind::type || symbol->kind == SymbolKind::space);
}

/// The variable that an address is kept in: of `p`, `a.p`, `ps[3]`.
inline const VarSymbol *addressVariable(const ast::Expr *e) {
  while (e->kind == ast::ExprKind::index)
    e = ast::as<ast::IndexExpr>(e)->base;
  const Symbol *symbol = symbolOf(e);
  return symbol != nullptr && symbol->kind == SymbolKind::variable
             ? static_cast<const VarSymbol *>(symbol)
             : nullptr;
}

inline PlacePath behind(const VarSymbol *v) {
  return v == nullptr ? PlacePath{} : PlacePath{PlacePath::Base::address, v, {}};
}

} // namespace stc::access
