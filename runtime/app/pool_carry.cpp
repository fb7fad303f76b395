#include "runtime/app/pool_carry.hpp"

#include "runtime/app/layout_index.hpp"

#include <algorithm>
#include <cstring>

namespace stride::app {

PoolCarry::PoolCarry(const TypeMatch &match)
    : match_(&match), oldPool_(poolRoot(match.oldApp())), newPool_(poolRoot(match.newApp())) {
  if (!present())
    return;
  oldSize_ = match.oldApp().types[oldPool_->type].size;
  newSize_ = match.newApp().types[newPool_->type].size;
  for (const PoolType &type : match.poolTypes()) {
    std::vector<TypeId> ids;
    const uint32_t own = match.pair(type.pair).newType;
    known_.push_back(collectIds(own, 0, match.newApp().types[own].typeId, ids));
    ids_.push_back(std::move(ids));
  }
}

/// The places of `type__` in an object, with the numbers of the new build. An embedded base has the
/// number of its heir. False if a number is not known.
bool PoolCarry::collectIds(uint32_t newType, uint64_t offset, uint32_t id,
                           std::vector<TypeId> &ids) const {
  const StrideAppV1 &app = match_->newApp();
  const TypeDesc &type = app.types[newType];
  bool known = true;
  if (type.kind == Kind::Array) {
    for (uint64_t i = 0; i < type.elementCount; ++i)
      known = collectIds(type.element, offset + i * app.types[type.element].size,
                         app.types[type.element].typeId, ids) &&
              known;
    return known;
  }
  if (!hasMembers(type.kind))
    return true;
  for (uint32_t i = 0; i < type.memberCount; ++i) {
    const MemberDesc &member = app.members[type.firstMember + i];
    const uint64_t at = offset + member.offset;
    if ((member.flags & kSymTypeId) != 0) {
      ids.push_back({at, id});
      known = known && id != 0;
    } else {
      const bool base = (member.flags & kSymBase) != 0;
      known = collectIds(member.type, at, base ? id : app.types[member.type].typeId, ids) && known;
    }
  }
  return known;
}

const PoolType *PoolCarry::typeOf(uint64_t hash) const noexcept {
  const std::vector<PoolType> &types = match_->poolTypes();
  const auto found =
      std::lower_bound(types.begin(), types.end(), hash,
                       [](const PoolType &type, uint64_t wanted) { return type.hash < wanted; });
  if (found == types.end() || found->hash != hash ||
      !known_[static_cast<std::size_t>(found - types.begin())])
    return nullptr;
  return &*found;
}

/// False behind the last block that has been used.
bool PoolCarry::blockAt(const std::byte *newState, uint64_t at, PoolBlock &block) const noexcept {
  if (at + sizeof block > newSize_)
    return false;
  std::memcpy(&block, newState + newPool_->offset + at, sizeof block);
  return block.size != 0;
}

uint64_t PoolCarry::copy(const std::byte *oldState, std::byte *newState) const noexcept {
  if (!present())
    return 0;
  const std::byte *const from = oldState + oldPool_->offset;
  std::byte *const to = newState + newPool_->offset;
  std::memset(to, 0, newSize_);
  uint64_t lost = 0;
  for (uint64_t at = 0; at + sizeof(PoolBlock) <= std::min(oldSize_, newSize_);) {
    PoolBlock block;
    std::memcpy(&block, from + at, sizeof block);
    if (block.size == 0)
      break; // never used, up to the end
    const uint64_t own = block.size;
    const PoolType *type = block.typeHash == 0 ? nullptr : typeOf(block.typeHash);
    if (at + own > newSize_) {
      type = nullptr;
      block.size = newSize_ - at;
    }
    if (type != nullptr) {
      std::memcpy(to + at, from + at, own);
      const auto index = static_cast<std::size_t>(type - match_->poolTypes().data());
      for (uint64_t i = 0; i < block.count; ++i) {
        for (const TypeId &id : ids_[index])
          std::memcpy(to + at + sizeof block + i * block.elementSize + id.offset, &id.id,
                      sizeof id.id);
      }
    } else {
      lost += block.typeHash != 0 ? 1 : 0;
      block = {block.size, 0, 0, 0};
      std::memcpy(to + at, &block, sizeof block);
    }
    at += own;
  }
  return lost;
}

bool PoolCarry::map(uint64_t oldOffset, const std::byte *newState,
                    uint64_t &newOffset) const noexcept {
  const uint64_t place = oldOffset - oldPool_->offset;
  PoolBlock block;
  for (uint64_t at = 0; blockAt(newState, at, block) && at <= place; at += block.size) {
    if (place < at + sizeof block || place > at + block.size)
      continue;
    newOffset = newPool_->offset + place;
    return block.typeHash != 0;
  }
  return false;
}

} // namespace stride::app
