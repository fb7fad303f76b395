// A failed check of the running ST program.
#ifndef STRIDE_RUNTIME_APP_ST_EXCEPTION_HPP
#define STRIDE_RUNTIME_APP_ST_EXCEPTION_HPP

#include "runtime/iec/ctx.h"

#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>

namespace stride {

/// Fills `calls` with the calling thread's call path, see StException::calls. Usable in a signal
/// handler, where the interrupted code is part of the path. Returns how many.
size_t captureCalls(uintptr_t *calls, size_t size) noexcept;

/// Thrown by raise() through the host API; caught at the task's root. Holds no memory of its own,
/// so throwing it needs no more than the language's reserve.
class StException : public std::exception {
public:
  StException(ExceptionCode code, const char *file, uint32_t line, uint32_t col,
              const char *detail) noexcept;

  ExceptionCode code() const noexcept { return code_; }
  /// Position in the ST source, 1-based; file is null when it is not known.
  const char *file() const noexcept { return file_; }
  uint32_t line() const noexcept { return line_; }
  uint32_t column() const noexcept { return col_; }
  /// More about it ("index 9 is outside 1..3"), or an empty text.
  const char *detail() const noexcept { return detail_; }
  /// What the code means: "division by zero".
  const char *what() const noexcept override;

  /// Notes the calling thread's call path, innermost first, from here outwards.
  void captureCalls() noexcept { callCount_ = stride::captureCalls(calls_, kMaxCalls); }
  void setCalls(const uintptr_t *calls, size_t count) noexcept;
  /// Addresses within the machine instructions that were being executed, innermost first; a 0 where
  /// calls in the middle were left out. Empty when nothing was noted.
  std::span<const uintptr_t> calls() const noexcept { return {calls_, callCount_}; }

  static constexpr size_t kMaxCalls = 48;

private:
  ExceptionCode code_;
  uint32_t line_;
  uint32_t col_;
  const char *file_;
  char detail_[160];
  uintptr_t calls_[kMaxCalls];
  size_t callCount_ = 0;
};

/// What an exception code means, in lower case without a full stop.
const char *describe(ExceptionCode code) noexcept;

} // namespace stride

#endif
