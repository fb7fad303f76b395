// The last words of a process that cannot go on.
#ifndef STRIDE_RUNTIME_TASK_FATAL_HPP
#define STRIDE_RUNTIME_TASK_FATAL_HPP

#include <cstdint>

namespace stride::task {

/// While it lives, an invalid memory access that no guardedCall ends, and abort(), are reported on
/// standard error ("error: fatal: …") and end the process with `exitCode`. Without it they end the
/// process as usual. For the main function of a program; there is one at a time.
class FatalReport {
public:
  explicit FatalReport(int exitCode);
  ~FatalReport();
  FatalReport(const FatalReport &) = delete;
  FatalReport &operator=(const FatalReport &) = delete;
};

/// Says what the calling thread does from now on, for the report; null: no cycle. The name is not
/// copied.
void noteCycle(const char *task, uint64_t cycle) noexcept;

/// Ends the process because of a signal, with a report if there is a FatalReport. Usable in signal
/// handlers; `address` is where an access failed, or null.
[[noreturn]] void endBySignal(int number, const void *address) noexcept;

} // namespace stride::task

#endif
