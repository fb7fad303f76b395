// The objects of __NEW in an online change.
#ifndef STRIDE_RUNTIME_APP_POOL_CARRY_HPP
#define STRIDE_RUNTIME_APP_POOL_CARRY_HPP

#include "runtime/app/type_match.hpp"
#include "runtime/iec/pool.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace stride::app {

/// Takes the objects over whose type has the same layout in both builds, each at its place in the
/// pool. All others are given back. Nothing but the constructor allocates or throws.
class PoolCarry {
public:
  explicit PoolCarry(const TypeMatch &match);

  /// Both builds have a pool.
  bool present() const { return oldPool_ != nullptr && newPool_ != nullptr; }

  /// Fills the new, unused pool. Returns the number of objects that are given up.
  uint64_t copy(const std::byte *oldState, std::byte *newState) const noexcept;

  /// Calls f(pair, element in the old state, element in the new state) for each element of each
  /// object that was taken over.
  template <class F>
  void eachElement(const std::byte *oldState, std::byte *newState, F f) const noexcept {
    if (!present())
      return;
    eachBlock(newState, [&](uint64_t at, const PoolBlock &block) {
      const PoolType *type = typeOf(block.typeHash);
      for (uint64_t i = 0; type != nullptr && i < block.count; ++i) {
        const uint64_t place = at + sizeof(PoolBlock) + i * block.elementSize;
        f(type->pair, oldState + oldPool_->offset + place, newState + newPool_->offset + place);
      }
    });
  }

  /// True for an offset from the start of the old state that lies in the old pool.
  bool contains(uint64_t oldOffset) const noexcept {
    return present() && oldOffset - oldPool_->offset < oldSize_;
  }
  /// Where the offset leads; false if its object was given up.
  bool map(uint64_t oldOffset, const std::byte *newState, uint64_t &newOffset) const noexcept;

private:
  struct TypeId {
    uint64_t offset;
    uint32_t id;
  };
  const PoolType *typeOf(uint64_t hash) const noexcept;
  /// The pool within a state.
  static const BYTE *bytes(const std::byte *state, const RootDesc *pool) noexcept;
  /// Calls f(place in the pool, header) for each object of the new pool.
  template <class F> void eachBlock(const std::byte *newState, F f) const noexcept {
    const BYTE *const memory = bytes(newState, newPool_);
    for (uint64_t at = pool::next(memory, newSize_, 0); at < newSize_;
         at = pool::next(memory, newSize_, at + sizeof(PoolBlock))) {
      PoolBlock block;
      std::memcpy(&block, memory + at, sizeof block);
      f(at, block);
    }
  }
  bool collectIds(uint32_t newType, uint64_t offset, uint32_t id, std::vector<TypeId> &ids) const;

  const TypeMatch *match_;
  const RootDesc *oldPool_;
  const RootDesc *newPool_;
  uint64_t oldSize_ = 0;
  uint64_t newSize_ = 0;
  std::vector<std::vector<TypeId>> ids_; ///< By index of the match's pool types.
  std::vector<bool> known_;              ///< By the same: all type ids are known.
};

} // namespace stride::app

#endif
