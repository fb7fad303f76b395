// Variables declared `AT %I*`: which of them an object holds.

#include "compiler/semantics/config/internal.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/declarations/declarations.hpp"

namespace stc::sema {

using namespace ast;

/// Calls `visit(member)` for what an instance of the type holds by value.
template <class Visit> void visitHeld(Context &c, const Type *type, Visit &&visit) {
  if (type->kind == TypeKind::Structure) {
    const auto *s = typeAs<StructType>(type);
    if (s->base != nullptr)
      visitHeld(c, s->base, visit);
    for (VarSymbol *field : s->fields)
      visit(field);
  } else if (isInstance(type)) {
    PouSymbol *pou = typeAs<PouType>(type)->symbol;
    declare(c, pou);
    if (pou->base != nullptr)
      visitHeld(c, pou->base->type, visit);
    for (VarSymbol *v : pou->variables) {
      if (v->section != Section::InOut && v->section != Section::Temp &&
          v->section != Section::Stat)
        visit(v);
    }
  }
}

bool hasSlots(Context &c, const Type *type) {
  while (type->kind == TypeKind::Array)
    type = typeAs<ArrayType>(type)->element;
  if (type->kind != TypeKind::Structure && !isInstance(type))
    return false;
  const auto [it, fresh] = c.hasSlots.try_emplace(type, false);
  if (!fresh)
    return it->second;
  bool result = false;
  visitHeld(c, type, [&](VarSymbol *v) {
    result = result || (v->location != nullptr && v->location->isSlot) ||
             (v->type != nullptr && hasSlots(c, v->type));
  });
  c.hasSlots[type] = result;
  return result;
}

void collectSlots(Context &c, const Type *type, StatePath &path, std::vector<SlotPlace> &out) {
  if (type->kind == TypeKind::Array) {
    const auto *array = typeAs<ArrayType>(type);
    for (uint64_t i = 0;
         hasSlots(c, array->element) && i < array->count() && out.size() <= kMaxSlots; ++i) {
      path.steps.push_back({nullptr, i});
      collectSlots(c, array->element, path, out);
      path.steps.pop_back();
    }
    return;
  }
  if (!hasSlots(c, type))
    return;
  visitHeld(c, type, [&](VarSymbol *v) {
    if (out.size() > kMaxSlots) // instances in instances soon are too many to list
      return;
    path.steps.push_back({v, 0});
    if (v->location != nullptr && v->location->isSlot)
      out.push_back({path, v, {}, nullptr, false});
    else if (v->type != nullptr)
      collectSlots(c, v->type, path, out);
    path.steps.pop_back();
  });
}

} // namespace stc::sema
