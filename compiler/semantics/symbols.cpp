#include "compiler/semantics/symbols.hpp"

#include "compiler/semantics/type_table.hpp"

namespace stc {

using namespace ast;

std::vector<VarSymbol *> PouSymbol::parameters() const {
  std::vector<VarSymbol *> list;
  if (base != nullptr)
    list = base->parameters();
  for (VarSymbol *v : variables) {
    if (v->section == Section::Input || v->section == Section::Output ||
        v->section == Section::InOut)
      list.push_back(v);
  }
  return list;
}

bool givesReference(const Expr *expr) {
  if (expr->kind != ExprKind::Call)
    return false;
  const auto *call = as<CallExpr>(expr);
  return (call->resolved == Callee::Function || call->resolved == Callee::Method) &&
         call->pou->result != nullptr && call->pou->result->type->kind == TypeKind::Reference;
}

const Type *elementBeforeReference(const IndexExpr *expr) {
  const Type *type = expr->base->type;
  for (size_t i = 0; i < expr->indices.size() && type != nullptr; ++i)
    type = indexStep(type);
  return type != nullptr ? type : elementaryType(TypeKind::Error);
}

} // namespace stc
