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
