#include "compiler/semantics/extent.hpp"

#include <algorithm>

namespace stc {

using namespace ast;

namespace {

/// Alignment of function blocks: pointers.
constexpr std::uint32_t kMaxAlign = 8;
/// The processors follow pointers to 8-byte values at multiples of 4.
constexpr std::uint32_t kEnough = 4;

std::uint64_t roundUp(std::uint64_t value, std::uint64_t align) {
  return (value + align - 1) / align * align;
}

} // namespace

unsigned packOf(const Type *type) {
  if (type->kind == TypeKind::structure)
    return typeAs<StructType>(type)->pack;
  return isInstance(type) ? typeAs<PouType>(type)->pack : 0;
}

Extent extentOf(const Type *type) {
  type = underlying(type);
  switch (type->kind) {
  case TypeKind::string:
    return {std::uint64_t{typeAs<StringType>(type)->length} + 1, 1};
  case TypeKind::wstring:
    return {(std::uint64_t{typeAs<StringType>(type)->length} + 1) * 2, 2};
  case TypeKind::array: {
    const auto *array = typeAs<ArrayType>(type);
    const Extent element = extentOf(array->element);
    return {element.size * array->count(), element.align};
  }
  case TypeKind::structure: {
    const auto *s = typeAs<StructType>(type);
    Extent all;
    const auto add = [&](const Extent &member) {
      if (s->isUnion) {
        all.size = std::max(all.size, member.size);
        all.align = std::max(all.align, member.align);
        return;
      }
      const std::uint32_t align =
          s->pack != 0 ? std::min<std::uint32_t>(member.align, s->pack) : member.align;
      all.size = roundUp(all.size, align) + member.size;
      all.align = std::max(all.align, align);
    };
    if (s->base != nullptr)
      add(extentOf(s->base));
    unsigned bits = 0; // BITs in a row: eight share a byte
    for (const VarSymbol *field : s->fields) {
      if (field->type != nullptr && (!field->isBit || bits % 8 == 0))
        add(extentOf(field->type));
      bits = field->isBit ? bits + 1 : 0;
    }
    all.size = roundUp(std::max<std::uint64_t>(all.size, 1), all.align);
    return all;
  }
  case TypeKind::functionBlock:
  case TypeKind::program: {
    const unsigned pack = typeAs<PouType>(type)->pack;
    return {0, pack == 0 ? kMaxAlign : std::min<std::uint32_t>(pack, kMaxAlign)};
  }
  case TypeKind::pointer:
  case TypeKind::reference:
    return {8, 8};
  case TypeKind::boolean:
    return {1, 1};
  default:
    if (const unsigned bytes = bitWidth(type) / 8; bytes != 0)
      return {bytes, bytes};
    return {};
  }
}

unsigned placeAlignment(const Expr *place) {
  const auto natural = [&] { return extentOf(place->type).align; };
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
         placeAlignment(place) < std::min(extentOf(place->type).align, kEnough);
}

} // namespace stc
