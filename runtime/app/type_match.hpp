// Which variable of one build is which variable of another: by name and type.
#ifndef STRIDE_RUNTIME_APP_TYPE_MATCH_HPP
#define STRIDE_RUNTIME_APP_TYPE_MATCH_HPP

#include "runtime/app/abi.h"

#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace stride::app {

/// How a value of an old type becomes one of a new type.
enum class Carry : uint8_t {
  Bytes,    ///< Elementary values that mean the same.
  Slot,     ///< An address.
  Fields,   ///< Structures, blocks, programs: field by field.
  Elements, ///< Arrays: the common indices.
  Union,    ///< The bytes of the largest common field.
  Number,   ///< Elementary values, to a type that holds every value of the old one.
  Text,     ///< A string of another length.
  Names,    ///< An enumeration: by the enumerators' names.
  Initial,  ///< Nothing is kept: the new initial value.
};

/// Why a field with a counterpart does not take its value over.
enum class Hold : uint8_t {
  No,       ///< It does.
  Constant, ///< CONSTANT: the new build's value holds.
  Asked,    ///< {attribute 'init_on_onlchange'}
  TypeId,   ///< A number of the new build.
  Filtered, ///< Not among the variables asked for.
};

/// Two fields, or roots, that are the same variable.
struct FieldPair {
  uint64_t oldOffset;
  uint64_t newOffset;
  uint32_t pair;      ///< Into TypeMatch::pairs().
  uint32_t oldMember; ///< Into the old member (root) table.
  uint32_t newMember; ///< Into the new member (root) table.
  Hold hold;
  bool renamed;
};

/// A new or a dropped field.
struct LoneField {
  uint64_t offset;
  uint32_t member; ///< Into the member (root) table of its build.
};

/// One enumerator's number in both builds.
struct EnumeratorMove {
  int64_t from;
  int64_t to;
  bool gone; ///< The new build has no such enumerator: the initial value.
};

/// Two types of which one follows the other.
struct TypePair {
  uint32_t oldType;
  uint32_t newType;
  Carry carry = Carry::Initial;
  bool bitwise = false;           ///< The bytes can be copied as they are, address slots apart.
  bool hasSlots = false;          ///< It or something inside it is Carry::Slot.
  bool ranged = false;            ///< A value outside of the new subrange is not taken.
  bool whole = true;              ///< Everything inside is taken, not only the variables asked for.
  bool changedName = false;       ///< Structures: the type has another name.
  std::vector<FieldPair> fields;  ///< Fields, Union: by new offset, inherited ones included.
  std::vector<FieldPair> bases;   ///< Fields: embedded bases of the same type, as objects.
  std::vector<LoneField> added;   ///< Fields, Union.
  std::vector<LoneField> dropped; ///< Fields, Union.
  std::vector<EnumeratorMove> moves; ///< Names: by `from`.
  uint64_t oldFirst = 0;             ///< Arrays: number of the first common element.
  uint64_t newFirst = 0;             ///< Arrays
  uint64_t count = 0;                ///< Arrays: common elements.
  uint32_t element = kNoIndex;       ///< Arrays with common elements, also with Initial.
  uint64_t bytes = 0;                ///< Union: common bytes.
  std::vector<uint32_t> byOldOffset; ///< Fields: indices of fields.
};

/// A type that objects of __NEW may have in both builds.
struct PoolType {
  uint64_t hash; ///< TypeDesc::layoutHash
  uint32_t pair; ///< Into TypeMatch::pairs().
};

/// The root that holds the objects of __NEW, or null.
const RootDesc *poolRoot(const StrideAppV1 &app);

/// What is wanted of a match.
struct MatchOptions {
  /// Only variables that have one of these SymbolFlags, or are inside of one that has; 0: all.
  uint32_t only = 0;
  /// Address slots are taken over. Without: they keep their initial value.
  bool addresses = true;
  /// What lies between fields is padding, which may be copied with them. Without: it may be
  /// variables that the descriptions leave out.
  bool padding = true;
};

/// The pairing of two builds. Names match case-insensitively, with {attribute 'renamed_from'} of
/// the new build; types by what they consist of. Both descriptions must outlive it and be valid.
class TypeMatch {
public:
  TypeMatch(const StrideAppV1 &oldApp, const StrideAppV1 &newApp, MatchOptions options = {});

  const StrideAppV1 &oldApp() const { return *old_; }
  const StrideAppV1 &newApp() const { return *new_; }
  const MatchOptions &options() const { return options_; }
  const std::vector<TypePair> &pairs() const { return pairs_; }
  const TypePair &pair(uint32_t index) const { return pairs_[index]; }

  /// Roots with a counterpart, by new offset.
  const std::vector<FieldPair> &roots() const { return roots_; }
  const std::vector<LoneField> &addedRoots() const { return addedRoots_; }
  const std::vector<LoneField> &droppedRoots() const { return droppedRoots_; }

  /// Types with the same layout in both builds, by hash; empty where a build has no pool.
  const std::vector<PoolType> &poolTypes() const { return poolTypes_; }

  /// The type has the same name in both builds, or an attribute says that it was renamed.
  bool sameTypeName(uint32_t oldType, uint32_t newType) const;

private:
  struct Field;
  uint32_t pairOf(uint32_t oldType, uint32_t newType, bool whole);
  void fill(TypePair &pair);
  void fillStructure(TypePair &pair);
  void fillUnion(TypePair &pair);
  void fillArray(TypePair &pair);
  void fillEnumeration(TypePair &pair);
  void fillSlot(TypePair &pair) const;
  void matchFields(const std::vector<Field> &oldFields, const std::vector<Field> &newFields,
                   bool whole, std::vector<FieldPair> &fields, std::vector<LoneField> &added,
                   std::vector<LoneField> &dropped);
  void matchRoots();
  void matchPools();
  Hold holdOf(uint32_t flags, bool whole, uint32_t pair) const;
  bool extends(const StrideAppV1 &app, uint32_t type, const char *base) const;
  bool sameFamily(uint32_t oldType, uint32_t newType) const;
  bool anything(uint32_t pair) const;

  const StrideAppV1 *old_;
  const StrideAppV1 *new_;
  MatchOptions options_;
  std::vector<TypePair> pairs_;
  std::unordered_map<uint64_t, uint32_t> indices_;
  std::vector<FieldPair> roots_;
  std::vector<LoneField> addedRoots_;
  std::vector<LoneField> droppedRoots_;
  std::vector<PoolType> poolTypes_;
};

/// Equal in ST, where case does not matter. Both may be null.
bool sameName(const char *a, const char *b);

/// A type that is a subrange, and its values as an int64_t tells them apart.
bool isInRange(const TypeDesc &range, int64_t value);

/// Every value of `from` is one of `to` (numbers with numbers, times with times).
bool keepsEveryValue(Kind from, Kind to);

} // namespace stride::app

#endif
