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
      !known_[static_cast<size_t>(found - types.begin())])
    return nullptr;
  return &*found;
}

const BYTE *PoolCarry::bytes(const std::byte *state, const RootDesc *pool) noexcept {
  return reinterpret_cast<const BYTE *>(state) + pool->offset;
}

uint64_t PoolCarry::copy(const std::byte *oldState, std::byte *newState) const noexcept {
  if (!present())
    return 0;
  const BYTE *const from = bytes(oldState, oldPool_);
  BYTE *const to = reinterpret_cast<BYTE *>(newState) + newPool_->offset;
  std::memset(to, 0, pool::wholeSize(newSize_));
  uint64_t lost = 0;
  for (uint64_t at = pool::next(from, oldSize_, 0); at < oldSize_;
       at = pool::next(from, oldSize_, at + sizeof(PoolBlock))) {
    PoolBlock block;
    std::memcpy(&block, from + at, sizeof block);
    const PoolType *type = typeOf(block.typeHash);
    if (type == nullptr || at + block.size > newSize_) {
      ++lost;
      continue;
    }
    std::memcpy(to + at, from + at, block.size);
    pool::enter(to, newSize_, at);
    const auto index = static_cast<size_t>(type - match_->poolTypes().data());
    for (uint64_t i = 0; i < block.count; ++i) {
      for (const TypeId &id : ids_[index])
        std::memcpy(to + at + sizeof block + i * block.elementSize + id.offset, &id.id,
                    sizeof id.id);
    }
  }
  return lost;
}

bool PoolCarry::map(uint64_t oldOffset, const std::byte *newState,
                    uint64_t &newOffset) const noexcept {
  const uint64_t place = oldOffset - oldPool_->offset;
  bool found = false;
  eachBlock(newState, [&](uint64_t at, const PoolBlock &block) {
    // One past the last element belongs to the object.
    found = found || (place >= at + sizeof block && place <= at + block.size);
  });
  if (found)
    newOffset = newPool_->offset + place;
  return found;
}

} // namespace stride::app
