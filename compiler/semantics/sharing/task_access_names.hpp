#ifndef STRIDE_COMPILER_SEMANTICS_SHARING_TASK_ACCESS_NAMES_HPP
#define STRIDE_COMPILER_SEMANTICS_SHARING_TASK_ACCESS_NAMES_HPP
// What the expressions of a POU name, for task_access*.cpp.

#include "compiler/semantics/sharing/task_access.hpp"

namespace stc::access {

/// It stands for another variable.
inline bool isAlias(const VarSymbol *v) {
  return v->section == ast::Section::InOut || v->type->kind == TypeKind::Reference;
}

inline const Symbol *symbolOf(const ast::Expr *e) {
  if (e->kind == ast::ExprKind::Name)
    return ast::as<ast::NameExpr>(e)->symbol;
  return e->kind == ast::ExprKind::Member ? ast::as<ast::MemberExpr>(e)->symbol : nullptr;
}

inline bool isNamespaceName(const ast::Expr *e) {
  const Symbol *symbol = symbolOf(e);
  return symbol != nullptr &&
         (symbol->kind == SymbolKind::Library || symbol->kind == SymbolKind::Globals ||
          symbol->kind == SymbolKind::Type || symbol->kind == SymbolKind::Space);
}

/// The variable that an address is kept in: of `p`, `a.p`, `ps[3]`.
inline const VarSymbol *addressVariable(const ast::Expr *e) {
  while (e->kind == ast::ExprKind::Index)
    e = ast::as<ast::IndexExpr>(e)->base;
  const Symbol *symbol = symbolOf(e);
  return symbol != nullptr && symbol->kind == SymbolKind::Variable
             ? static_cast<const VarSymbol *>(symbol)
             : nullptr;
}

inline PlacePath behind(const VarSymbol *v) {
  return v == nullptr ? PlacePath{} : PlacePath{PlacePath::Base::Address, v, {}};
}

} // namespace stc::access

#endif // STRIDE_COMPILER_SEMANTICS_SHARING_TASK_ACCESS_NAMES_HPP
