#ifndef STRIDE_COMPILER_SEMANTICS_SHARING_TASK_ACCESS_NAMES_HPP
#define STRIDE_COMPILER_SEMANTICS_SHARING_TASK_ACCESS_NAMES_HPP
// What the sources task_access*.cpp have in common: what the expressions of a POU name, and what is
// known of their places so far.

#include "compiler/semantics/sharing/task_access.hpp"

namespace stc::access {

/// Reads one POU, or initial values.
struct Reader {
  Storage &storage;
  PouAccess out;
  AccessDetail detail = AccessDetail::Places;
};

void value(Reader &r, const ast::Expr *e);
void target(Reader &r, const ast::Expr *e);
void access(Reader &r, const ast::Expr *e, unsigned scalar, unsigned whole);
void note(Reader &r, PlacePath place, unsigned flags, Span span, const ast::Expr *named = nullptr);
void image(Reader &r, const ast::Expr *e, bool writes);
void call(Reader &r, const ast::CallExpr *e);
void accessor(Reader &r, const ast::Expr *object, const Symbol *property, bool writes, Span span);
void escape(Reader &r, const ast::Expr *e);
void flow(Reader &r, const VarSymbol *target, const ast::Expr *value);
/// The same of a value that a variable begins with, also of its parts.
void initialValue(Reader &r, const VarSymbol *variable, const ast::Expr *init);
/// Goes on to something inside of the place.
inline void enter(const Reader &r, PlacePath &place, AccessStep step) {
  if (r.detail == AccessDetail::Places)
    place.steps.push_back(step);
}
/// The place, after its indices and the pointers on the way to it have been read.
PlacePath place(Reader &r, const ast::Expr *e, bool walk);

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
