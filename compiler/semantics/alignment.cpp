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
  if (type->kind == TypeKind::structure)
    return typeAs<StructType>(type)->pack;
  return isInstance(type) ? typeAs<PouType>(type)->pack : 0;
}

unsigned alignmentOf(const Type *type) {
  type = underlying(type);
  while (type->kind == TypeKind::array)
    type = typeAs<ArrayType>(type)->element;
  type = underlying(type);
  const auto limited = [type](unsigned align) {
    const unsigned pack = packOf(type);
    return pack == 0 ? align : std::min(align, pack);
  };
  switch (type->kind) {
  case TypeKind::string:
    return 1;
  case TypeKind::wstring:
    return 2;
  case TypeKind::structure: {
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
  case TypeKind::functionBlock:
  case TypeKind::program:
    return limited(kMaxAlign);
  case TypeKind::pointer:
  case TypeKind::reference:
    return 8;
  default:
    return std::max(bitWidth(type) / 8, 1U);
  }
}

unsigned placeAlignment(const Expr *place) {
  const auto natural = [&] { return alignmentOf(place->type); };
  switch (place->kind) {
  case ExprKind::direct: {
    const Location *at = as<DirectExpr>(place)->location;
    return at == nullptr || at->byte == 0 ? kMaxAlign : at->byte & (0U - at->byte);
  }
  case ExprKind::name:
  case ExprKind::member: {
    const Symbol *symbol =
        place->kind == ExprKind::name ? as<NameExpr>(place)->symbol : as<MemberExpr>(place)->symbol;
    if (symbol == nullptr || symbol->kind != SymbolKind::variable)
      return natural();
    const auto *variable = static_cast<const VarSymbol *>(symbol);
    if (variable->section == Section::inOut || variable->type->kind == TypeKind::reference)
      return natural();
    if (const Location *at = variable->location; at != nullptr && !at->isSlot)
      return at->byte == 0 ? kMaxAlign : at->byte & (0U - at->byte);
    unsigned result = natural();
    if (variable->owner != nullptr && variable->owner->type != nullptr &&
        variable->owner->type->pack != 0 && variable->section != Section::temp)
      result = std::min(result, variable->owner->type->pack);
    if (place->kind == ExprKind::member && variable->globals == nullptr) {
      const Expr *base = as<MemberExpr>(place)->base;
      if (base->type != nullptr && (base->type->kind == TypeKind::structure ||
                                    base->type->kind == TypeKind::functionBlock)) {
        const unsigned pack = packOf(base->type);
        result = std::min(result, placeAlignment(base));
        if (pack != 0)
          result = std::min(result, pack);
      }
    }
    return result;
  }
  case ExprKind::index:
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
