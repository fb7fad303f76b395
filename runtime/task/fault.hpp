// How a cycle ended, and the guard that turns bad memory accesses into such an end.
#ifndef STRIDE_RUNTIME_TASK_FAULT_HPP
#define STRIDE_RUNTIME_TASK_FAULT_HPP

#include "runtime/app/st_exception.hpp"
#include "runtime/iec/ctx.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace stride::task {

/// An exception that stopped the application.
struct Fault {
  StException exception;
  std::string task;
  uint64_t cycle = 0;
  int64_t timeNs = 0;
  uint64_t looks = 0; ///< How often loops of the cycle had looked at the clock and gone on.
};

/// One line: what, where in the ST, in which task and cycle, and what explains it:
/// "division by zero at src/a.st:38:21 (task Fast, cycle 12, at T#120ms); stride explain SR0001".
/// `place` stands for the position of an exception that does not know its own.
std::string describe(const Fault &fault, std::string_view place = {});

/// While it lives, invalid memory accesses and stack overflows of this thread inside guardedCall
/// end the call instead of the process: signal handlers, on a stack of their own. Elsewhere they
/// end the process (fatal.hpp). It also holds the thread's data stack. Every thread that runs
/// cycles has one; the handlers, which belong to the process, come with the first and go with the
/// last.
class MemoryGuard {
public:
  MemoryGuard();
  ~MemoryGuard();
  MemoryGuard(const MemoryGuard &) = delete;
  MemoryGuard &operator=(const MemoryGuard &) = delete;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Bytes of a data stack (runtime/iec/data_stack.h). It lies below 4 GiB, at the first free of a
/// fixed series of addresses, so that addresses repeat from run to run.
inline constexpr size_t kDataStack = size_t{8} << 20;

/// The data stack of a thread with a MemoryGuard; empty for others.
struct DataStackRange {
  uintptr_t low = 0;
  uintptr_t high = 0;
};
DataStackRange dataStack() noexcept;

/// Touches the first so many bytes, before real time begins.
void touchDataStack(size_t bytes) noexcept;

/// Calls run(&ctx) with the thread's data stack. Returns what stopped it, if something did. Never
/// allocates. Within such a call there may be another one.
std::optional<StException> guardedCall(void (*run)(Ctx *), Ctx &ctx);

/// The host's table for applications in simulation: raise throws StException, an endless loop ends
/// when its budget is used up, log lines go to standard error. That may wait: TaskSet has another
/// log for cycles.
const HostApi &hostApi();

} // namespace stride::task

#endif
