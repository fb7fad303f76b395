#include "runtime/app/st_exception.hpp"

#include <unwind.h>

#include <algorithm>
#include <cstring>

namespace stride {

namespace {

/// The innermost calls in the first part of the array; of the others the outermost ones, in turn in
/// the places after.
struct Capture {
  uintptr_t *calls;
  size_t inner;
  size_t outer;
  size_t count; ///< of all calls
};

_Unwind_Reason_Code captureOne(struct _Unwind_Context *context, void *argument) {
  auto *capture = static_cast<Capture *>(argument);
  int beforeInstruction = 0;
  uintptr_t address = _Unwind_GetIPInfo(context, &beforeInstruction);
  if (address == 0)
    return _URC_END_OF_STACK;
  if (beforeInstruction == 0)
    --address; // of a return address: within the call
  const size_t place = capture->count < capture->inner
                           ? capture->count
                           : capture->inner + (capture->count - capture->inner) % capture->outer;
  capture->calls[place] = address;
  ++capture->count;
  return _URC_NO_REASON;
}

} // namespace

size_t captureCalls(uintptr_t *calls, size_t size) noexcept {
  const size_t inner = size / 2;
  const size_t outer = size - inner - 1;
  Capture capture{calls, inner, outer, 0};
  _Unwind_Backtrace(captureOne, &capture);
  if (capture.count <= inner + outer)
    return capture.count;
  // The oldest of the outer ones comes first, after the gap.
  std::rotate(calls + inner, calls + inner + (capture.count - inner) % outer,
              calls + inner + outer);
  std::move_backward(calls + inner, calls + inner + outer, calls + size);
  calls[inner] = 0;
  return size;
}

StException::StException(ExceptionCode code, const char *file, uint32_t line, uint32_t col,
                         const char *detail) noexcept
    : code_(code), line_(line), col_(col), file_(file), detail_{}, calls_{} {
  if (detail != nullptr)
    std::strncpy(detail_, detail, sizeof detail_ - 1);
}

void StException::setCalls(const uintptr_t *calls, size_t count) noexcept {
  callCount_ = std::min(count, kMaxCalls);
  std::copy_n(calls, callCount_, calls_);
}

const char *StException::what() const noexcept { return describe(code_); }

const char *describe(ExceptionCode code) noexcept {
  switch (code) {
  case ExceptionCode::None:
    return "no exception";
#define STRIDE_EXCEPTION(number, name, what, text)                                                 \
  case ExceptionCode::name:                                                                        \
    static_assert(static_cast<uint32_t>(ExceptionCode::name) == (number));                         \
    return what;
#include "runtime/common/exception_codes.def"
#undef STRIDE_EXCEPTION
  }
  return "unknown exception";
}

} // namespace stride
