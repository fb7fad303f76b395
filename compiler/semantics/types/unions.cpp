// UNION: what its members may be.

#include "compiler/semantics/types/resolve.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/held.hpp"

namespace stc::sema {

using namespace ast;

namespace {

/// Something in a value of the type that cannot be in a union: a block or a reference.
const Type *forbiddenInUnion(const Type *type) {
  const Type *result = nullptr;
  anyHeld(type, [&](const Type *t, const VarSymbol *) {
    if (!isInstance(t) && t->kind != TypeKind::Reference)
      return Held::Inside;
    result = t;
    return Held::Found;
  });
  return result;
}

} // namespace

void checkUnion(Context &c, const StructType *type) {
  const VarSymbol *initialised = nullptr;
  for (const VarSymbol *f : type->fields) {
    if (isError(f->type))
      continue;
    if (const Type *inner = forbiddenInUnion(f->type)) {
      auto &d = c.report(
          Code::UnionMember, f->name.span,
          std::string(inner->kind == TypeKind::Reference ? "a reference" : "a block instance") +
              " cannot share its memory with other members of a UNION",
          inner == f->type ? "this is " + typeName(f->type)
                           : "there is a " + typeName(inner) + " in it");
      d.help("move it out of the UNION, or hold a POINTER TO it");
    }
    if (f->decl->init == nullptr)
      continue;
    if (initialised != nullptr) {
      auto &d = c.report(Code::UnionInit, f->decl->init->span,
                         "only one member of a UNION can have an initial value",
                         "this would overwrite the other one");
      d.label(initialised->decl->init->span, "the first initial value");
    } else {
      initialised = f;
    }
  }
}

} // namespace stc::sema
