#include "compiler/semantics/plain_data.hpp"

#include "compiler/semantics/held.hpp"

namespace stc {

bool isAddress(const Type *type) {
  return type->kind == TypeKind::Pointer || type->kind == TypeKind::Interface;
}

bool isScalarValue(const Type *type) {
  return (isElementary(type) && !isString(type)) || isAddress(type);
}

bool isAxisType(const Type *type) {
  if (type == nullptr || type->kind != TypeKind::Structure)
    return false;
  const std::string_view name = typeAs<StructType>(type)->symbol->name.id->lower;
  return name == "axis_ref" || name == "smc_axisgroup_ref";
}

bool isUnionType(const Type *type) {
  return type->kind == TypeKind::Structure && typeAs<StructType>(type)->isUnion;
}

bool isPlainData(const Type *type) {
  return !anyHeld(type, [](const Type *t, const VarSymbol *v) {
    if ((v != nullptr && v->location != nullptr) || isAxisType(t))
      return Held::Found;
    if (t->kind == TypeKind::Structure)
      return Held::Inside;
    return isScalarValue(t) || isString(t) ? Held::Over : Held::Found;
  });
}

} // namespace stc
