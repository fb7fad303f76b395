// What lies where in an application's state: from an address back to the variable.
#ifndef STRIDE_RUNTIME_APP_LAYOUT_INDEX_HPP
#define STRIDE_RUNTIME_APP_LAYOUT_INDEX_HPP

#include "runtime/app/abi.h"

#include <cstdint>
#include <string>
#include <vector>

namespace stride::app {

/// True for kinds that hold an address: POINTER, REFERENCE, in-out, interface.
bool isAddressSlot(Kind kind);
/// True for STRING and WSTRING.
bool isString(Kind kind);
/// True for structures, unions, blocks and programs.
bool hasMembers(Kind kind);

/// The base type of a subrange; any other type itself. Pointers do not tell them apart.
inline uint32_t baseType(const StrideAppV1 &app, uint32_t type) {
  return type != kNoIndex && (app.types[type].flags & kTypeRange) != 0 ? app.types[type].element
                                                                       : type;
}

/// What an address in the state means, seen through the type of the variable that holds it.
struct Target {
  enum class Relation : uint8_t {
    None,   ///< Nothing known lies there.
    Start,  ///< The object starts there.
    End,    ///< The object ends there: one past its end.
    Inside, ///< `delta` bytes after the start of an elementary variable.
  };
  Relation relation = Relation::None;
  uint32_t type = kNoIndex; ///< Of the object.
  uint64_t start = 0;       ///< Offset of the object from the start of the state.
  uint64_t delta = 0;
};

/// Finds the objects of one application by their offsets. Immutable; the look-ups do not allocate
/// (but path() does).
class LayoutIndex {
public:
  explicit LayoutIndex(const StrideAppV1 &app);

  /// What an address with this offset stands for when it is held by a variable that points to
  /// `pointee`, which is its own baseType(). In this order: an object of exactly that type that
  /// starts there; one that ends there; the largest object of any type that starts there (programs
  /// excepted: their first variable is meant); a place inside of an elementary variable; the
  /// largest object that ends there.
  Target target(uint64_t offset, uint32_t pointee) const;

  /// True if an object of type `wanted`, which is its own baseType(), starts at the offset; the
  /// first elementary variable of a block does not count.
  bool startsAt(uint64_t offset, uint32_t wanted) const;

  /// `Main.a[2].x`; the empty text where nothing known lies.
  std::string path(const Target &target) const;
  /// The path of the object of a known type that starts there.
  std::string pathOf(uint64_t offset, uint32_t type) const;

  const StrideAppV1 &app() const { return *app_; }

private:
  struct Search;
  /// Members by offset; a type whose members overlap keeps them all in one search.
  const uint32_t *membersBegin(uint32_t type) const { return order_.data() + first_[type]; }
  uint32_t memberCount(uint32_t type) const { return first_[type + 1] - first_[type]; }

  template <class Visit> bool descend(uint32_t type, uint64_t rel, bool end, Visit visit) const;
  template <class Visit> bool descendRoots(uint64_t offset, bool end, Visit visit) const;
  bool appendPath(uint32_t type, uint64_t rel, uint32_t wanted, std::string &path,
                  bool indexOpen) const;

  const StrideAppV1 *app_;
  std::vector<uint32_t> roots_;      ///< By offset, the larger first.
  std::vector<uint64_t> rootReach_;  ///< Largest end of this root and all before it.
  std::vector<uint32_t> first_;      ///< By type: into order_.
  std::vector<uint32_t> order_;      ///< Indices of members, by offset within each type.
  std::vector<uint8_t> overlapping_; ///< By type: its members overlap.
};

} // namespace stride::app

#endif
