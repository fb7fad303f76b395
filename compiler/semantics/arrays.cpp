// ARRAY[*] and UNION: what may be declared with them and how they are used.

#include "compiler/semantics/checker.hpp"
#include "compiler/semantics/held.hpp"

namespace stc {

using namespace ast;

const Type *Checker::resolveOpenArray(ArrayTypeExpr *expr, const Type *element) {
  const Type *bad = elementaryType(TypeKind::error);
  for (ArrayRange &range : expr->ranges) {
    if (range.low != nullptr) {
      report(Code::openArrayNotAllowed, range.span,
             "an array has either bounds or `*` in all of its dimensions", "bounds beside a `*`")
          .help("write `*` for each dimension, or give all bounds");
      return bad;
    }
  }
  if (expr != openArrayAllowed_) {
    report(Code::openArrayNotAllowed, expr->span,
           "an array of variable length is only possible as a VAR_IN_OUT",
           "there is no caller's array to take the bounds from")
        .help("give the bounds, or pass the array as a VAR_IN_OUT of this type");
    return bad;
  }
  if (isError(element))
    return bad;
  return types_.openArray(element, static_cast<std::uint32_t>(expr->ranges.size()));
}

bool Checker::fitsOpenArray(const Type *actual, const OpenArrayType *wanted) {
  if (actual->kind == TypeKind::openArray)
    return actual == wanted;
  for (std::uint32_t i = 0; i < wanted->dimensions; ++i) {
    if (actual->kind != TypeKind::array)
      return false;
    actual = typeAs<ArrayType>(actual)->element;
  }
  return actual == wanted->element;
}

bool Checker::refuseOpenArray(Expr *expr, std::string_view action) {
  if (expr->type == nullptr || expr->type->kind != TypeKind::openArray)
    return false;
  report(Code::openArrayWhole, expr->span,
         "cannot " + std::string(action) + " an array of variable length as a whole",
         "its size is only known to the caller")
      .help("work on its elements: `FOR i := LOWER_BOUND(a, 1) TO UPPER_BOUND(a, 1) DO …`");
  return true;
}

namespace {

/// Something in a value of the type that cannot be in a union: a block or a reference.
const Type *forbiddenInUnion(const Type *type) {
  const Type *result = nullptr;
  anyHeld(type, [&](const Type *t, const VarSymbol *) {
    if (!isInstance(t) && t->kind != TypeKind::reference)
      return Held::inside;
    result = t;
    return Held::found;
  });
  return result;
}

} // namespace

void Checker::checkUnion(const StructType *type) {
  const VarSymbol *initialised = nullptr;
  for (const VarSymbol *f : type->fields) {
    if (isError(f->type))
      continue;
    if (const Type *inner = forbiddenInUnion(f->type)) {
      auto &d = report(
          Code::unionMember, f->name.span,
          std::string(inner->kind == TypeKind::reference ? "a reference" : "a block instance") +
              " cannot share its memory with other members of a UNION",
          inner == f->type ? "this is " + typeName(f->type)
                           : "there is a " + typeName(inner) + " in it");
      d.help("move it out of the UNION, or hold a POINTER TO it");
    }
    if (f->decl->init == nullptr)
      continue;
    if (initialised != nullptr) {
      auto &d = report(Code::unionInit, f->decl->init->span,
                       "only one member of a UNION can have an initial value",
                       "this would overwrite the other one");
      d.label(initialised->decl->init->span, "the first initial value");
    } else {
      initialised = f;
    }
  }
}

} // namespace stc
