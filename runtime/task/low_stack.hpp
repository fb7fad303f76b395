// Stacks for tasks: below 4 GiB, as the rest of the application's memory.
#ifndef STRIDE_RUNTIME_TASK_LOW_STACK_HPP
#define STRIDE_RUNTIME_TASK_LOW_STACK_HPP

#include <cstddef>
#include <functional>

namespace stride::task {

inline constexpr std::size_t kTaskStack = std::size_t{8} << 20;

/// Calls `function` on a thread of its own and returns when it has ended; what it throws is passed
/// on. The thread's stack of kTaskStack bytes lies below 4 GiB, so that the address of a local
/// variable fits the DWORD of old programs, and at the first free of a fixed series of addresses
/// (below 1 GiB, 1.5 GiB ... 4 GiB), so that addresses repeat from run to run. Where none of them
/// is free the system chooses the place. A page without access lies below the stack.
void runOnLowStack(const std::function<void()> &function);

} // namespace stride::task

#endif
