// Threads for tasks.
#ifndef STRIDE_RUNTIME_TASK_TASK_THREAD_HPP
#define STRIDE_RUNTIME_TASK_TASK_THREAD_HPP

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>

namespace stride::task {

inline constexpr size_t kTaskStack = size_t{8} << 20;
/// A frame that begins on the stack and is not larger than this cannot reach past its end.
inline constexpr size_t kBelowTaskStack = size_t{64} << 20;

/// A thread with a stack of kTaskStack bytes, whatever the system's limits say. It holds what C++
/// puts there, return addresses among it; what ST can have an address of is elsewhere (DataStack).
/// So it lies where the system wants it, which is far above 4 GiB, and kBelowTaskStack bytes below
/// it are without access.
class TaskThread {
public:
  /// Starts `function`. Throws app::Error when the system has no memory or thread for it.
  explicit TaskThread(std::function<void()> function);
  TaskThread(const TaskThread &) = delete;
  TaskThread &operator=(const TaskThread &) = delete;
  /// Waits for its end.
  ~TaskThread();

  /// Waits for its end; what the function threw is passed on.
  void join();

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Calls `function` on such a thread and returns when it has ended; what it throws is passed on.
void runOnTaskThread(const std::function<void()> &function);

} // namespace stride::task

#endif
