// Stacks for tasks: below 4 GiB, as the rest of the application's memory.
#ifndef STRIDE_RUNTIME_TASK_LOW_STACK_HPP
#define STRIDE_RUNTIME_TASK_LOW_STACK_HPP

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>

namespace stride::task {

inline constexpr std::size_t kTaskStack = std::size_t{8} << 20;

/// A thread whose stack of kTaskStack bytes lies below 4 GiB, so that the address of a local
/// variable fits the DWORD of old programs, and at the first free of a fixed series of addresses
/// (below 1 GiB, 1.5 GiB ... 4 GiB), so that addresses repeat from run to run. Where none of them
/// is free the system chooses the place. A page without access lies below the stack.
class LowThread {
public:
  /// Starts `function`. Throws app::Error when the system has no memory or thread for it.
  explicit LowThread(std::function<void()> function);
  LowThread(const LowThread &) = delete;
  LowThread &operator=(const LowThread &) = delete;
  /// Waits for its end.
  ~LowThread();

  /// Waits for its end; what the function threw is passed on.
  void join();

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Calls `function` on such a thread and returns when it has ended; what it throws is passed on.
void runOnLowStack(const std::function<void()> &function);

} // namespace stride::task

#endif
