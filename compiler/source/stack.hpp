#ifndef STRIDE_COMPILER_SOURCE_STACK_HPP
#define STRIDE_COMPILER_SOURCE_STACK_HPP
// How much of the stack is left: for recursions whose depth the input decides.

#include <cstddef>

namespace stc {

/// What is kept for everything that does not ask.
inline constexpr size_t kStackReserve = size_t{1} << 20U;

/// Where the stack of the calling thread ends; null when that is not known.
[[nodiscard]] const char *endOfStack();

/// Less than kStackReserve bytes are left before `end`.
[[nodiscard]] inline bool stackIsShort(const char *end) {
  const auto *here = static_cast<const char *>(__builtin_frame_address(0));
  return end != nullptr && static_cast<size_t>(here - end) < kStackReserve;
}

} // namespace stc

#endif // STRIDE_COMPILER_SOURCE_STACK_HPP
