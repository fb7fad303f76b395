// Where an address of the old state leads in the new one.
#ifndef STRIDE_RUNTIME_APP_ADDRESS_MAP_HPP
#define STRIDE_RUNTIME_APP_ADDRESS_MAP_HPP

#include "runtime/app/layout_index.hpp"
#include "runtime/app/type_match.hpp"

#include <cstdint>
#include <vector>

namespace stride::app {

/// Maps offsets of the old state to offsets of the new state by path and type. Immutable; map()
/// neither allocates nor throws.
class AddressMap {
public:
  enum class Status : uint8_t {
    Kept,
    Gone,      ///< The new build has no such object.
    OtherType, ///< It has, but of a type to which the pointer must not point.
    Unknown,   ///< No object of the old build lies there.
  };

  /// What the variable that holds the address points to, in both builds.
  struct Slot {
    uint32_t oldPointee; ///< Of an interface: the type of the instances' `type__`.
    uint32_t newPointee;
    bool sameName; ///< Both are the same type.
  };

  /// All must outlive it.
  AddressMap(const TypeMatch &match, const LayoutIndex &oldIndex, const LayoutIndex &newIndex);

  Slot slot(uint32_t oldType, uint32_t newType) const;

  /// `newOffset` is set only with Kept.
  Status map(uint64_t oldOffset, const Slot &slot, uint64_t &newOffset) const noexcept;

private:
  struct Found {
    uint64_t newStart;
    const TypePair *pair;
  };
  const FieldPair *rootAt(uint64_t oldOffset) const noexcept;
  bool find(uint32_t pair, uint64_t rel, uint64_t newStart, uint32_t oldType,
            Found &found) const noexcept;
  bool findField(const FieldPair &field, uint64_t rel, uint64_t newStart, uint32_t oldType,
                 Found &found) const noexcept;
  bool translate(const Target &target, Found &found) const noexcept;
  bool mayPointTo(uint64_t newStart, uint32_t newType, uint32_t newPointee) const noexcept;

  const TypeMatch *match_;
  const LayoutIndex *oldIndex_;
  const LayoutIndex *newIndex_;
  uint32_t oldTypeId_; ///< The type of the members with kSymTypeId; kNoIndex: there are none.
  uint32_t newTypeId_;
  std::vector<uint32_t> roots_;     ///< Into the match's roots, by old offset.
  std::vector<uint64_t> rootReach_; ///< Largest old end of this root and all before it.
};

} // namespace stride::app

#endif
