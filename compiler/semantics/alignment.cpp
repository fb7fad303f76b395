#include "compiler/semantics/alignment.hpp"

#include <algorithm>

namespace stc {

using namespace ast;

namespace {

/// Alignment of function blocks: pointers.
constexpr unsigned kMaxAlign = 8;
/// The processors follow pointers to 8-byte values at multiples of 4.
constexpr unsigned kEnough = 4;

} // namespace

unsigned packOf(const Type *type) {
  if (type->kind == TypeKind::Structure)
    return typeAs<StructType>(type)->pack;
  return isInstance(type) ? typeAs<PouType>(type)->pack : 0;
}

unsigned alignmentOf(const Type *type) {
  type = underlying(type);
  while (type->kind == TypeKind::Array)
    type = typeAs<ArrayType>(type)->element;
  type = underlying(type);
  const auto limited = [type](unsigned align) {
    const unsigned pack = packOf(type);
    return pack == 0 ? align : std::min(align, pack);
  };
  switch (type->kind) {
  case TypeKind::String:
    return 1;
  case TypeKind::Wstring:
    return 2;
  case TypeKind::Structure: {
    const auto *s = typeAs<StructType>(type);
    if (s->alignment != 0)
      return s->alignment;
    s->alignment = 1; // of a structure inside of itself, which is reported
    unsigned align = s->base == nullptr ? 1 : alignmentOf(s->base);
    for (const VarSymbol *field : s->fields) {
      if (field->type != nullptr)
        align = std::max(align, alignmentOf(field->type));
    }
    align = s->isUnion ? align : limited(align);
    s->alignment = s->symbol->resolving ? 0 : align; // not all fields are known
    return align;
  }
  case TypeKind::FunctionBlock:
  case TypeKind::Program:
    return limited(kMaxAlign);
  case TypeKind::Pointer:
  case TypeKind::Reference:
    return 8;
  default:
    return std::max(bitWidth(type) / 8, 1U);
  }
}

unsigned placeAlignment(const Expr *place) {
  const auto natural = [&] { return alignmentOf(place->type); };
  switch (place->kind) {
  case ExprKind::Direct: {
    const Location *at = as<DirectExpr>(place)->location;
    return at == nullptr || at->byte == 0 ? kMaxAlign : at->byte & (0U - at->byte);
  }
  case ExprKind::Name:
  case ExprKind::Member: {
    const Symbol *symbol =
        place->kind == ExprKind::Name ? as<NameExpr>(place)->symbol : as<MemberExpr>(place)->symbol;
    if (symbol == nullptr || symbol->kind != SymbolKind::Variable)
      return natural();
    const auto *variable = static_cast<const VarSymbol *>(symbol);
    if (variable->section == Section::InOut || variable->type->kind == TypeKind::Reference)
      return natural();
    if (const Location *at = variable->location; at != nullptr && !at->isSlot)
      return at->byte == 0 ? kMaxAlign : at->byte & (0U - at->byte);
    unsigned result = natural();
    if (variable->owner != nullptr && variable->owner->type != nullptr &&
        variable->owner->type->pack != 0 && variable->section != Section::Temp)
      result = std::min(result, variable->owner->type->pack);
    if (place->kind == ExprKind::Member && variable->globals == nullptr) {
      const Expr *base = as<MemberExpr>(place)->base;
      if (base->type != nullptr && (base->type->kind == TypeKind::Structure ||
                                    base->type->kind == TypeKind::FunctionBlock)) {
        const unsigned pack = packOf(base->type);
        result = std::min(result, placeAlignment(base));
        if (pack != 0)
          result = std::min(result, pack);
      }
    }
    return result;
  }
  case ExprKind::Index:
    return std::min(natural(), placeAlignment(as<IndexExpr>(place)->base));
  default:
    return natural();
  }
}

bool isMisaligned(const Expr *place) {
  return place->type != nullptr &&
         placeAlignment(place) < std::min(alignmentOf(place->type), kEnough);
}

} // namespace stc
