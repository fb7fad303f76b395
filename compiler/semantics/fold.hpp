#ifndef STRIDE_COMPILER_SEMANTICS_FOLD_HPP
#define STRIDE_COMPILER_SEMANTICS_FOLD_HPP
// Arithmetic on constants, with the meaning the generated code has.

#include "compiler/semantics/constant.hpp"
#include "compiler/semantics/types.hpp"
#include "compiler/syntax/ast.hpp"

#include <optional>

namespace stc {

/// Cuts a 64-bit pattern to the width of an integer, bit-string, BOOL, time or date type and
/// extends it again (sign for signed types, zero for the others).
[[nodiscard]] int64_t wrapTo(const Type *type, int64_t value);

/// The value of `from` as a value of `to`: the meaning of X_TO_Y. Nothing for strings.
[[nodiscard]] std::optional<ConstValue> convertConstant(const ConstValue &value, const Type *from,
                                                        const Type *to);

/// `left op right`, both already of type `type` (anyInteger and anyReal included); comparisons give
/// 0 or 1. Nothing when it cannot be known here: division by zero, overflow of an untyped constant,
/// strings.
[[nodiscard]] std::optional<ConstValue> foldBinary(ast::BinaryOp op, const ConstValue &left,
                                                   const ConstValue &right, const Type *type);

/// `op value`, the value of type `type`.
[[nodiscard]] std::optional<ConstValue> foldUnary(ast::UnaryOp op, const ConstValue &value,
                                                  const Type *type);

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_FOLD_HPP
