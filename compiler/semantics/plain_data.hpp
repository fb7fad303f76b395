#ifndef STRIDE_COMPILER_SEMANTICS_PLAIN_DATA_HPP
#define STRIDE_COMPILER_SEMANTICS_PLAIN_DATA_HPP
// Types by how their values are read and written: in one step, byte by byte, or not at all by
// several tasks.

#include "compiler/semantics/symbols.hpp"

namespace stc {

/// A pointer or an interface.
[[nodiscard]] bool isAddress(const Type *type);
/// A value that fits a register: not a string, not an aggregate.
[[nodiscard]] bool isScalarValue(const Type *type);
/// The members of the type are in one place: whoever writes one writes all.
[[nodiscard]] bool isUnionType(const Type *type);

/// AXIS_REF and the like, for which SE0863 is responsible.
[[nodiscard]] bool isAxisType(const Type *type);
/// Values and addresses only: a copy of its bytes is a copy of it.
[[nodiscard]] bool isPlainData(const Type *type);

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_PLAIN_DATA_HPP
