// What an expression becomes when it is read: instructions in reverse Polish notation, as bytes.
// They hold no addresses, so that they may lie anywhere. Free of the C++ standard library.
#ifndef STRIDE_RUNTIME_NUMERIC_NC_CODE_HPP
#define STRIDE_RUNTIME_NUMERIC_NC_CODE_HPP

#include "runtime/numeric/nc/nc_error.hpp"

namespace stride::nc {

/// SMC_GVar_Type: what a value is.
enum class ValueType : uint8_t {
  Bool,
  Real, ///< LREAL
  Text, ///< STRING, 255 bytes.
  Any,  ///< Of a function: all arguments that are Any are of one type.
};

/// Instructions; what follows an instruction stands at its side.
enum class Op : uint8_t {
  Number, ///< 8 bytes: an LREAL
  True,
  False,
  Text,     ///< 1 byte: how many characters; the characters
  Local,    ///< 1 byte: which one of the program's
  Variable, ///< 1 byte: type; 2 bytes: which one of the list
  Negate,
  Not,
  Add,
  Subtract,
  Multiply,
  Divide,
  Modulo,
  Equal,
  Unequal,
  Greater,
  Less,
  GreaterEqual,
  LessEqual,
  And,
  Xor,
  Or,
  Pi,
  Sin,
  Cos,
  Tan,
  Asin,
  Acos,
  Atan,
  Abs,
  Sqrt,
  Exp,
  Ln,
  Log,
  Trunc,
  Expt,
  Min,
  Max,
  Concat,
  Select,
};

/// Memory for instructions. What does not fit is only counted.
struct CodeWriter {
  uint8_t *bytes;
  int32_t capacity;
  int32_t size;
};

inline void putBytes(CodeWriter &writer, const void *bytes, int32_t count) noexcept {
  if (writer.size + count <= writer.capacity)
    __builtin_memcpy(writer.bytes + writer.size, bytes, static_cast<uint64_t>(count));
  writer.size += count;
}

template <class Value> void put(CodeWriter &writer, Value value) noexcept {
  putBytes(writer, &value, sizeof value);
}

template <class Value> Value load(const uint8_t *bytes) noexcept {
  Value value;
  __builtin_memcpy(&value, bytes, sizeof value);
  return value;
}

} // namespace stride::nc

#endif // STRIDE_RUNTIME_NUMERIC_NC_CODE_HPP
