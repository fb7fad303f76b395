// `a[i]` and `p^`.

#include "compiler/semantics/expressions/internal.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/expressions/expressions.hpp"

namespace stc::sema {

using namespace ast;

const Type *checkIndex(Context &c, IndexExpr *expr) {
  const Type *type = check(c, expr->base);
  bool bad = isError(type);
  for (size_t i = 0; i < expr->indices.size(); ++i) {
    Expr *index = expr->indices[i];
    const Type *indexType = check(c, index);
    if (bad)
      continue;
    const Type *next = indexStep(type);
    if (next == nullptr) {
      auto &d = c.report(Code::NotIndexable, i == 0 ? expr->base->span : index->span,
                         i == 0 ? typeName(type) + " is not an array"
                                : "too many indices: the array has " + std::to_string(i) +
                                      (i == 1 ? " dimension" : " dimensions"),
                         i == 0 ? "cannot be indexed" : "one index too many");
      if (type->kind == TypeKind::Pointer)
        d.help("nothing is known about what a POINTER TO VOID points to: use POINTER TO BYTE");
      bad = true;
      continue;
    }
    const Type *indexed =
        type->kind == TypeKind::Reference ? typeAs<PointerType>(type)->pointee : type;
    type = next;
    if (isError(indexType))
      continue;
    if (!isInteger(underlying(indexType)) && indexType->kind != TypeKind::AnyInteger) {
      c.report(Code::IndexNotInteger, index->span,
               "an index must be an integer, this is " + typeName(indexType),
               "expected an integer");
      continue;
    }
    if (index->constant != nullptr && (indexed->kind == TypeKind::Array || isString(indexed))) {
      const int64_t value = index->constant->integer;
      const bool isArray = indexed->kind == TypeKind::Array;
      const int64_t low = isArray ? typeAs<ArrayType>(indexed)->low : 0;
      const int64_t high =
          isArray ? typeAs<ArrayType>(indexed)->high : int64_t{typeAs<StringType>(indexed)->length};
      if (value < low || value > high)
        c.report(Code::IndexOutOfRange, index->span,
                 "index " + std::to_string(value) + " is outside of the " +
                     (isArray ? "array" : "string"),
                 "the bounds are " + std::to_string(low) + ".." + std::to_string(high));
    }
    if (indexType->kind == TypeKind::AnyInteger)
      settle(index);
  }
  if (bad)
    return elementaryType(TypeKind::Error);
  return type->kind == TypeKind::Reference ? typeAs<PointerType>(type)->pointee : type;
}

const Type *checkDeref(Context &c, DerefExpr *expr) {
  const Type *base = check(c, expr->base);
  if (isError(base))
    return base;
  if (base->kind != TypeKind::Pointer) {
    c.report(Code::NotAPointer, expr->span, typeName(base) + " is not a pointer",
             "`^` needs a POINTER TO …");
    return elementaryType(TypeKind::Error);
  }
  const Type *pointee = typeAs<PointerType>(base)->pointee;
  if (pointee->kind == TypeKind::None) {
    c.report(Code::NotAPointer, expr->span, "a POINTER TO VOID cannot be followed",
             "nothing is known about what is there")
        .help("assign it to a pointer of the right type first");
    return elementaryType(TypeKind::Error);
  }
  return pointee;
}

} // namespace stc::sema
