#include "compiler/semantics/storage.hpp"

#include "compiler/semantics/alignment.hpp"
#include "compiler/semantics/hierarchy.hpp"

#include <algorithm>

namespace stc {

namespace {

/// Sizes end here: no sum of them overflows, and what is so large has been reported.
constexpr uint64_t kMaxStorage = uint64_t{1} << 48U;

} // namespace

uint64_t Storage::Layout::add(StorageExtent member) {
  if (pack != 0)
    member.align = std::min(member.align, pack);
  const uint64_t at = (extent.size + member.align - 1) / member.align * member.align;
  extent.size = std::min(at + member.size, kMaxStorage);
  extent.align = std::max(extent.align, member.align);
  bits = 0;
  return at;
}

uint64_t Storage::Layout::addBit() {
  constexpr unsigned kBitsOfByte = 8;
  if (bits == 0 || bits == kBitsOfByte)
    add({1, 1});
  ++bits;
  return extent.size - 1;
}

StorageExtent Storage::Layout::finish() const {
  if (extent.size == 0) // C++ gives every object an address of its own
    return {1, 1};
  return {(extent.size + extent.align - 1) / extent.align * extent.align, extent.align};
}

StorageExtent Storage::of(const Type *type) {
  const auto found = known_.find(type);
  if (found != known_.end())
    return found->second;
  known_.emplace(type, StorageExtent{}); // a type inside of itself has been reported
  const StorageExtent result = compute(type);
  known_[type] = result;
  return result;
}

StorageExtent Storage::field(const VarSymbol *v) {
  if (v->type->kind == TypeKind::OpenArray) // its address and the bounds
    return {8 + uint64_t{16} * typeAs<OpenArrayType>(v->type)->dimensions, 8};
  if (isSlot(v))
    return {4, 4};
  if (v->section == ast::Section::InOut)
    return {8, 8};
  return of(v->type);
}

Storage::Layout Storage::members(const Type *owner, const VarSymbol *until, BitPlace &place) {
  Layout layout;
  layout.pack = packOf(owner);
  const bool isUnion = owner->kind == TypeKind::Structure && typeAs<StructType>(owner)->isUnion;
  const auto add = [&](const VarSymbol *v) {
    if (isUnion) {
      const StorageExtent member = field(v);
      layout.extent.size = std::max(layout.extent.size, member.size);
      layout.extent.align = std::max(layout.extent.align, member.align);
      return;
    }
    const uint64_t at = v->isBit ? layout.addBit() : layout.add(field(v));
    if (v == until)
      place = {at, v->isBit ? layout.bits - 1 : 0};
  };
  if (owner->kind == TypeKind::Structure) {
    const auto *s = typeAs<StructType>(owner);
    if (s->base != nullptr)
      layout.add(of(s->base));
    for (const VarSymbol *v : s->fields)
      add(v);
    return layout;
  }
  const PouSymbol *pou = typeAs<PouType>(owner)->symbol;
  if (pou->base != nullptr)
    layout.add(of(pou->base->type));
  if (carriesTypeId(pou))
    layout.add({4, 4});
  for (const VarSymbol *v : pou->variables) {
    if (isField(v))
      add(v);
  }
  return layout;
}

uint64_t Storage::offset(const Type *owner, const VarSymbol *field) {
  return bit(owner, field).byte;
}

Storage::BitPlace Storage::bit(const Type *owner, const VarSymbol *field) {
  BitPlace place{};
  members(owner, field, place);
  return place;
}

StorageExtent Storage::compute(const Type *type) {
  switch (type->kind) {
  case TypeKind::Error:
  case TypeKind::None:
  case TypeKind::Boolean:
    return {1, 1};
  case TypeKind::String:
    return {typeAs<StringType>(type)->length + uint64_t{1}, 1};
  case TypeKind::Wstring:
    return {2 * (typeAs<StringType>(type)->length + uint64_t{1}), 2};
  case TypeKind::Array: {
    const auto *array = typeAs<ArrayType>(type);
    const StorageExtent element = of(array->element);
    uint64_t size = 0;
    if (__builtin_mul_overflow(element.size, array->count(), &size))
      size = kMaxStorage;
    return {std::min(size, kMaxStorage), element.align};
  }
  case TypeKind::Structure:
  case TypeKind::FunctionBlock:
  case TypeKind::Program: {
    BitPlace ignored{};
    return members(type, nullptr, ignored).finish();
  }
  default: {
    const uint64_t bytes = bitWidth(type) / 8;
    return {bytes, bytes};
  }
  }
}

} // namespace stc
