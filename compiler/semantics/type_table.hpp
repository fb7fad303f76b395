#ifndef STRIDE_COMPILER_SEMANTICS_TYPE_TABLE_HPP
#define STRIDE_COMPILER_SEMANTICS_TYPE_TABLE_HPP
// Makes types unique, so that equality of types is equality of pointers.

#include "compiler/semantics/types.hpp"
#include "compiler/source/arena.hpp"

#include <map>
#include <tuple>
#include <utility>

namespace stc {

/// The one object of an elementary type (also error, none, anyInteger, anyReal; STRING and WSTRING
/// of length 80).
[[nodiscard]] const Type *elementaryType(TypeKind kind);

/// The elementary type of that lower-case name (`int`, `tod`, `time_of_day`), or null.
[[nodiscard]] const Type *findElementaryType(std::string_view lowerName);

/// Smallest and largest value of an integer, bit-string or BOOL type, as the 64-bit pattern
/// ConstValue uses. For ULINT and LWORD `high` is -1 (all ones).
struct IntegerRange {
  int64_t low;
  int64_t high;
};
[[nodiscard]] IntegerRange integerRange(const Type *t);

/// Derived types, unique within one table; they live in the arena.
class TypeTable {
public:
  explicit TypeTable(Arena &arena) : arena_(arena) {}

  const Type *string(bool wide, uint32_t length);
  const Type *array(const Type *element, int64_t low, int64_t high);
  const Type *openArray(const Type *element, uint32_t dimensions);
  const Type *pointer(const Type *pointee);
  const Type *reference(const Type *pointee);
  const Type *subrange(const Type *base, int64_t low, int64_t high);

private:
  Arena &arena_;
  std::map<std::pair<bool, uint32_t>, const Type *> strings_;
  std::map<std::tuple<const Type *, int64_t, int64_t>, const Type *> arrays_;
  std::map<std::pair<const Type *, uint32_t>, const Type *> openArrays_;
  std::map<const Type *, const Type *> pointers_;
  std::map<const Type *, const Type *> references_;
  std::map<std::tuple<const Type *, int64_t, int64_t>, const Type *> subranges_;
};

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_TYPE_TABLE_HPP
