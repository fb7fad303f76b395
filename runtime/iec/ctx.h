// The context that every POU call passes along, and how a failed check leaves the cycle.
// Free of the C++ standard library; see types.h.
#ifndef STRIDE_RUNTIME_IEC_CTX_H
#define STRIDE_RUNTIME_IEC_CTX_H

#include "runtime/iec/types.h"

namespace stride {

/// Why a cycle was left. The values are stable: they appear in messages and in recordings.
enum class ExceptionCode : uint32_t {
  None = 0,
  DivisionByZero = 1,  ///< Integer division or MOD by zero.
  IndexOutOfRange = 2, ///< An array index outside the declared bounds.
  NullPointer = 3,     ///< A null POINTER, REFERENCE or interface was used.
  UnboundInOut = 4,    ///< A VAR_IN_OUT was used that no caller has bound.
  RangeViolation = 5,  ///< A value outside the subrange type it was assigned to.
  EndlessLoop = 6,     ///< A loop used up the cycle's budget of iterations.
  StackOverflow = 7,   ///< Calls nested too deeply.
  AccessViolation = 8, ///< A pointer to memory that is not the application's.
  OutOfMemory = 9,     ///< __NEW found no place in its pool.
  AbstractCall = 10,   ///< A method without an implementation was called.
  User = 11,           ///< Raised by the program itself.
  Internal = 12,       ///< A defect of Stride itself.
  Watchdog = 13,       ///< A cycle took longer than the task's watchdog allows.
};

struct Ctx;
struct SystemApi;

/// An exception that __TRY has caught. Plain data on the stack of the body.
struct Caught {
  ExceptionCode code;
  uint32_t line;
  uint32_t col;
  const char *file;
  char detail[160];
};

/// What the host offers to an application. The application only ever calls through this table,
/// so that app.so needs no symbol from the host.
struct HostApi {
  uint32_t size;  ///< sizeof(HostApi) of the host, so that later members can be tested for.
  uint32_t flags; ///< Reserved, 0.
  void *self;     ///< The host's own object, not touched by the application.
  /// Leaves the cycle with an exception; never returns. `detail` may be null.
  void (*raise)(Ctx *ctx, ExceptionCode code, const char *file, uint32_t line, uint32_t col,
                const char *detail);
  /// The loop budget is used up: returns a new budget (> 0), or 0 when the loop must end.
  int64_t (*refillLoopBudget)(Ctx *ctx);
  /// A line of text for the operator (an online warning). Callable from the cycle.
  void (*log)(Ctx *ctx, uint32_t severity, const char *text);
  /// Called while a C++ exception is being handled: says which one of ST's it is. What ST may not
  /// catch (an endless loop, anything that is not of ST) goes on, so that it does not return. Null:
  /// nothing can be caught.
  void (*caught)(Ctx *ctx, Caught *out) = nullptr;
  /// What the system libraries need (runtime/system/system_api.h); null: nothing of that.
  const SystemApi *system = nullptr;
};

/// One task's view of the running application. Plain data; the host owns it.
struct Ctx {
  void *state;            ///< The application object (all globals, programs and configuration).
  int64_t cycleStartNs;   ///< Start of this cycle; constant within the cycle. Starts at 0.
  int64_t taskIntervalNs; ///< The task's period (for a freewheeling task: its virtual period).
  uint64_t cycle;         ///< Number of this cycle of this task, from 0.
  int64_t loopBudget;     ///< Loop iterations left before the host is asked.
  const HostApi *host;    ///< Null only in tools that evaluate without a host.
  uint32_t taskIndex;     ///< Index into the application's task table.
  BOOL firstCycle;        ///< 1 in the task's first cycle.
  BOOL keepRetains; ///< During init: retained values will be put back (bInitRetains is FALSE).
  BOOL inCopyCode;  ///< During init, exit and reinit: it is an online change (bInCopyCode).
  BOOL softMotion3; ///< During init: softmotion = "3" decides about defaults. The application says
                    ///< so.
  char *dataTop;    ///< Where the thread's data stack is free (data_stack.h), a multiple of 16.
  char *dataEnd;    ///< Its end. Both null: there is none. Set while the host calls.
};

/// Leaves the current cycle: does not return. The position is that in the ST source (1-based).
[[noreturn]] __attribute__((cold)) void raise(Ctx &ctx, ExceptionCode code, const char *file,
                                              uint32_t line, uint32_t col);

/// As raise, with a short text that says more (for instance the index and the bounds).
[[noreturn]] __attribute__((cold)) void raiseDetail(Ctx &ctx, ExceptionCode code, const char *file,
                                                    uint32_t line, uint32_t col,
                                                    const char *detail);

/// In a handler: what was caught (see HostApi::caught).
__attribute__((cold)) void caught(Ctx &ctx, Caught &out);
/// Goes on with an exception that was caught, after __FINALLY.
[[noreturn]] __attribute__((cold)) void raiseAgain(Ctx &ctx, const Caught &exception);
/// The number of __SYSTEM.ExceptionCode.
uint32_t exceptionNumber(ExceptionCode code);

/// Out-of-line parts of the checks: they word the detail and raise.
[[noreturn]] __attribute__((cold)) void raiseIndex(Ctx &ctx, int64_t index, int64_t lo, int64_t hi,
                                                   const char *file, uint32_t line, uint32_t col);
[[noreturn]] __attribute__((cold)) void raiseRange(Ctx &ctx, int64_t value, int64_t lo, int64_t hi,
                                                   const char *file, uint32_t line, uint32_t col);
/// A pointer to nothing: NullPointer, or AccessViolation where it is not 0.
[[noreturn]] __attribute__((cold)) void raisePointer(Ctx &ctx, const void *pointer,
                                                     const char *file, uint32_t line, uint32_t col);
/// Asks the host for more loop budget, or leaves the cycle.
__attribute__((cold)) void loopBudgetSpent(Ctx &ctx, const char *file, uint32_t line, uint32_t col);

/// At every loop's back edge: counts the cycle's budget down.
inline void loopTick(Ctx &ctx, const char *file, uint32_t line, uint32_t col) {
  if (--ctx.loopBudget < 0) [[unlikely]]
    loopBudgetSpent(ctx, file, line, col);
}
/// Stands for the context within a loop that keeps variables in C++ locals: `save` puts them back.
/// That happens before the cycle is left and before the context is handed to anyone, so that the
/// locals need not outlive a call: they stay in registers.
template <class Save> struct LoopContext {
  Ctx &ctx;
  Save save;

  operator Ctx &() const {
    save();
    return ctx;
  }
};
template <class Save> LoopContext(Ctx &, Save) -> LoopContext<Save>;

/// The loop budget within one call of a POU: a copy that the compiler can keep in a register. A
/// loop is written as two: the inner one runs while there is budget and contains no call for it, so
/// that its variables stay in registers; the outer one asks for more. done() takes what was used
/// from ctx.loopBudget when the call ends, so that loops around calls count too.
struct LoopBudget {
  int64_t left;
  int64_t start;

  explicit LoopBudget(const Ctx &ctx) : left(ctx.loopBudget), start(left) {}
  /// After the inner loop; `more` says that it ended for lack of budget.
  template <class C> void refill(bool more, C &ctx, const char *file, uint32_t line, uint32_t col) {
    if (more && left <= 0) [[unlikely]] {
      Ctx &own = ctx;
      loopBudgetSpent(own, file, line, col);
      left = start = own.loopBudget;
    }
  }
  void done(Ctx &ctx) const { ctx.loopBudget -= start - left; }
};

/// An object of the application at its place in the state.
template <class T> inline T &root(Ctx &ctx, uint64_t place) {
  return *reinterpret_cast<T *>(static_cast<char *>(ctx.state) + place);
}

} // namespace stride

#endif
