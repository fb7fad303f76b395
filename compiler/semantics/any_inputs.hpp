#ifndef STRIDE_COMPILER_SEMANTICS_ANY_INPUTS_HPP
#define STRIDE_COMPILER_SEMANTICS_ANY_INPUTS_HPP
// Inputs declared ANY, ANY_NUM …: which types they take, and what `TypeClass` says of one.

#include "compiler/semantics/types.hpp"

#include <cstdint>
#include <string_view>

namespace stc {

/// The generic types of IEC 61131-3.
enum class AnyGroup : uint8_t {
  None,
  Any,
  Elementary,
  Magnitude,
  Num,
  Real,
  Int,
  Signed,
  Unsigned,
  Bit,
  Text,
  Date
};

/// What `any_num` is in a declaration.
[[nodiscard]] AnyGroup findAnyGroup(std::string_view lowerName);
[[nodiscard]] bool isInGroup(AnyGroup group, const Type *type);
/// The value of `__SYSTEM.TYPE_CLASS` for a variable's type.
[[nodiscard]] uint32_t typeClassOf(const Type *type);

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_ANY_INPUTS_HPP
