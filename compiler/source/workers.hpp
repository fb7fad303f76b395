#ifndef STRIDE_COMPILER_SOURCE_WORKERS_HPP
#define STRIDE_COMPILER_SOURCE_WORKERS_HPP
// Work on several processors at once.

#include <cstddef>
#include <functional>

namespace stc {

/// How much is done at once where nothing else is said: the number in the environment variable
/// STRIDE_JOBS, or one for each processor.
[[nodiscard]] unsigned defaultJobs();

/// Threads for one list of items after the other. Between two lists there are none, so that nothing
/// has to be ended.
class Workers {
public:
  /// `most` threads at once, the caller's among them; 0: defaultJobs(), and none for little work.
  explicit Workers(unsigned most = 0)
      : most_(most == 0 ? defaultJobs() : most), least_(most == 0 ? kWorthThreads : 0) {}

  /// How many threads work on so many items, the caller's among them: 1 or more. `bytes`: all text
  /// that is read for them.
  [[nodiscard]] unsigned threadsFor(size_t items, size_t bytes) const;
  /// Calls `work` once for each item, on any thread and in any order, and waits for all. `thread`
  /// is below `threads`, and is given to no two calls at once. Of exceptions that of the
  /// first item is thrown, as if they were worked on one after the other.
  static void each(size_t items, unsigned threads,
                   const std::function<void(size_t item, unsigned thread)> &work);

private:
  /// Reading so many bytes takes longer than starting a thread, by far.
  static constexpr size_t kWorthThreads = size_t{32} * 1024;

  unsigned most_;
  size_t least_; ///< bytes for which a second thread is started
};

} // namespace stc

#endif // STRIDE_COMPILER_SOURCE_WORKERS_HPP
