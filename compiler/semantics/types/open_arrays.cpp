// ARRAY[*]: what fits it, where it cannot be used.

#include "compiler/semantics/types/resolve.hpp"

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

using namespace ast;

bool fitsOpenArray(const Type *actual, const OpenArrayType *wanted) {
  if (actual->kind == TypeKind::OpenArray)
    return actual == wanted;
  for (uint32_t i = 0; i < wanted->dimensions; ++i) {
    if (actual->kind != TypeKind::Array)
      return false;
    actual = typeAs<ArrayType>(actual)->element;
  }
  return actual == wanted->element;
}

bool refuseOpenArray(Context &c, Expr *expr, std::string_view action) {
  if (expr->type == nullptr || expr->type->kind != TypeKind::OpenArray)
    return false;
  c.report(Code::OpenArrayWhole, expr->span,
           "cannot " + std::string(action) + " an array of variable length as a whole",
           "its size is only known to the caller")
      .help("work on its elements: `FOR i := LOWER_BOUND(a, 1) TO UPPER_BOUND(a, 1) DO …`");
  return true;
}

} // namespace stc::sema
