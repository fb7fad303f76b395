// The data stack of a task: where the variables of a call lie whose addresses ST may get hold of.
// What runs off one of them meets another variable or the end of the data stack, never a return
// address of C++.
// Free of the C++ standard library; see types.h.
#ifndef STRIDE_RUNTIME_IEC_DATA_STACK_H
#define STRIDE_RUNTIME_IEC_DATA_STACK_H

#include "runtime/iec/ctx.h"

namespace stride {

/// A variable on the task's data stack for as long as this object lives; objects end in the reverse
/// order of their beginning. Raises StackOverflow where there is no room.
template <class T> class OnDataStack {
public:
  /// Zeroed memory.
  explicit OnDataStack(Ctx &ctx) : ctx_(ctx), place_(taken(ctx)) {
    __builtin_memset(place_, 0, sizeof(T));
  }
  OnDataStack(Ctx &ctx, const T &value) : ctx_(ctx), place_(taken(ctx)) {
    __builtin_memcpy(place_, &value, sizeof(T));
  }
  ~OnDataStack() { ctx_.dataTop = place_; }
  OnDataStack(const OnDataStack &) = delete;
  OnDataStack &operator=(const OnDataStack &) = delete;

  T &value() { return *reinterpret_cast<T *>(place_); }

private:
  static constexpr uint64_t kGrain = 16;
  static constexpr uint64_t kSize = (sizeof(T) + kGrain - 1) / kGrain * kGrain;
  static_assert(alignof(T) <= kGrain, "places are multiples of 16");

  static char *taken(Ctx &ctx) {
    char *const place = ctx.dataTop;
    if (static_cast<uint64_t>(ctx.dataEnd - place) < kSize) [[unlikely]]
      raise(ctx, ExceptionCode::StackOverflow, nullptr, 0, 0);
    ctx.dataTop = place + kSize;
    return place;
  }

  Ctx &ctx_;
  char *place_;
};

} // namespace stride

#endif
