#ifndef STRIDE_COMPILER_SEMANTICS_STORAGE_HPP
#define STRIDE_COMPILER_SEMANTICS_STORAGE_HPP
// How large the types are in memory. The generated structures say the same to C++: app.cpp asserts
// it for every type whose size the program has asked for.

#include "compiler/semantics/symbols.hpp"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace stc {

/// A variable of each instance (VAR_TEMP and VAR_STAT are not).
[[nodiscard]] inline bool isOwn(const VarSymbol *v) {
  return v->section != ast::Section::Temp && v->section != ast::Section::Stat &&
         v->section != ast::Section::External;
}
/// It lies in the process image, at the same place for all instances.
[[nodiscard]] inline bool isPlaced(const VarSymbol *v) {
  return v->location != nullptr && !v->location->isSlot;
}
/// The instance holds its place in the process image (`AT %I*`).
[[nodiscard]] inline bool isSlot(const VarSymbol *v) {
  return v->location != nullptr && v->location->isSlot;
}
/// Kept in each instance.
[[nodiscard]] inline bool isField(const VarSymbol *v) { return isOwn(v) && !isPlaced(v); }

/// So many bytes a variable has at most.
inline constexpr uint64_t kMaxTypeBytes = uint64_t{1} << 31U;

/// Size and alignment in bytes.
struct StorageExtent {
  uint64_t size = 1;
  uint64_t align = 1;
  bool operator==(const StorageExtent &) const = default;
};

/// Computes and remembers the layout of types: natural alignment, members in the order of the
/// declaration, the base of EXTENDS as the first one. Blocks must have been declared.
class Storage {
public:
  [[nodiscard]] StorageExtent of(const Type *type);
  /// Where a field lies in its structure, block or program (its own fields, not those of a base).
  [[nodiscard]] uint64_t offset(const Type *owner, const VarSymbol *field);
  /// The same of a BIT, and its number in the byte.
  struct BitPlace {
    uint64_t byte;
    unsigned bit;
  };
  [[nodiscard]] BitPlace bit(const Type *owner, const VarSymbol *field);

private:
  /// Puts members after each other.
  struct Layout {
    StorageExtent extent{0, 1};
    uint64_t pack = 0; ///< largest alignment of members; 0: natural
    unsigned bits = 0; ///< of the last byte that are taken by BIT; 0: it is none of theirs
    uint64_t add(StorageExtent member);
    /// A BIT: in the byte of the one before it, when that has a bit left.
    uint64_t addBit();
    [[nodiscard]] StorageExtent finish() const;
  };
  StorageExtent compute(const Type *type);
  StorageExtent field(const VarSymbol *v);
  Layout members(const Type *owner, const VarSymbol *until, BitPlace &place);

  std::unordered_map<const Type *, StorageExtent> known_;
};

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_STORAGE_HPP
