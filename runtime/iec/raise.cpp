// The cold ends of the checks.
#include "runtime/iec/ctx.h"
#include "runtime/iec/text.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace stride {

namespace {

/// A short text built without allocation.
class Detail {
public:
  Detail &operator<<(const char *text) {
    const size_t room = sizeof(buffer_) - 1 - length_;
    const size_t n = std::min(std::strlen(text), room);
    std::memcpy(buffer_ + length_, text, n);
    length_ += n;
    buffer_[length_] = 0;
    return *this;
  }
  Detail &operator<<(int64_t value) {
    char digits[text::kBufferSize];
    text::formatSigned(digits, value);
    return *this << digits;
  }
  const char *text() const { return buffer_; }

private:
  char buffer_[160] = {};
  size_t length_ = 0;
};

} // namespace

void raiseDetail(Ctx &ctx, ExceptionCode code, const char *file, uint32_t line, uint32_t col,
                 const char *detail) {
  if (ctx.host != nullptr && ctx.host->raise != nullptr)
    ctx.host->raise(&ctx, code, file, line, col, detail);
  std::abort(); // no host to report to, or one that broke its promise not to return
}

void raise(Ctx &ctx, ExceptionCode code, const char *file, uint32_t line, uint32_t col) {
  raiseDetail(ctx, code, file, line, col, nullptr);
}

void caught(Ctx &ctx, Caught &out) {
  if (ctx.host == nullptr || ctx.host->size < sizeof(HostApi) || ctx.host->caught == nullptr)
    throw;
  ctx.host->caught(&ctx, &out);
}

void raiseAgain(Ctx &ctx, const Caught &exception) {
  raiseDetail(ctx, exception.code, exception.file, exception.line, exception.col,
              exception.detail[0] == 0 ? nullptr : exception.detail);
}

uint32_t exceptionNumber(ExceptionCode code) {
  switch (code) {
  case ExceptionCode::None:
    return 0;
  case ExceptionCode::DivisionByZero:
    return 0x102;
  case ExceptionCode::IndexOutOfRange:
    return 0x101;
  case ExceptionCode::NullPointer:
  case ExceptionCode::UnboundInOut:
  case ExceptionCode::AccessViolation:
    return 0x51;
  case ExceptionCode::RangeViolation:
    return 0x103;
  case ExceptionCode::StackOverflow:
    return 0x54;
  case ExceptionCode::OutOfMemory:
    return 0x1C;
  case ExceptionCode::AbstractCall:
    return 0x50;
  case ExceptionCode::EndlessLoop:
  case ExceptionCode::Watchdog:
    return 0x10;
  case ExceptionCode::User:
    return 0x10000;
  case ExceptionCode::Internal:
    break;
  }
  return 0xFFFF'FFFF;
}

void raiseIndex(Ctx &ctx, int64_t index, int64_t lo, int64_t hi, const char *file, uint32_t line,
                uint32_t col) {
  Detail detail;
  detail << "index " << index << " is outside " << lo << ".." << hi;
  raiseDetail(ctx, ExceptionCode::IndexOutOfRange, file, line, col, detail.text());
}

void raiseRange(Ctx &ctx, int64_t value, int64_t lo, int64_t hi, const char *file, uint32_t line,
                uint32_t col) {
  Detail detail;
  detail << "value " << value << " is outside " << lo << ".." << hi;
  raiseDetail(ctx, ExceptionCode::RangeViolation, file, line, col, detail.text());
}

void raisePointer(Ctx &ctx, const void *pointer, const char *file, uint32_t line, uint32_t col) {
  if (pointer == nullptr)
    raise(ctx, ExceptionCode::NullPointer, file, line, col);
  Detail detail;
  detail << "there is no variable at address " << reinterpret_cast<int64_t>(pointer);
  raiseDetail(ctx, ExceptionCode::AccessViolation, file, line, col, detail.text());
}

void loopBudgetSpent(Ctx &ctx, const char *file, uint32_t line, uint32_t col) {
  if (ctx.host != nullptr && ctx.host->refillLoopBudget != nullptr) {
    const int64_t budget = ctx.host->refillLoopBudget(&ctx);
    if (budget > 0) {
      ctx.loopBudget = budget - 1;
      return;
    }
  }
  raise(ctx, ExceptionCode::EndlessLoop, file, line, col);
}

} // namespace stride
