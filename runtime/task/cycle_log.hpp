// What a program has to say in a cycle, for somebody else to show.
#ifndef STRIDE_RUNTIME_TASK_CYCLE_LOG_HPP
#define STRIDE_RUNTIME_TASK_CYCLE_LOG_HPP

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stride::task {

/// Lines of text from any number of tasks. Putting one in neither allocates, locks nor waits: when
/// nobody has taken the others yet, it is counted only.
class CycleLog {
public:
  static constexpr size_t kLines = 64;
  static constexpr size_t kLineSize = 1024; ///< Longer ones are cut. [bytes]

  void put(const char *text) noexcept;
  /// The lines since the last call in their order, and how many are missing. From one thread, not a
  /// task's.
  std::vector<std::string> take();

private:
  enum State : uint32_t { kFree, kFilling, kFull };
  struct Line {
    std::atomic<uint32_t> state{kFree};
    uint64_t number = 0;
    char text[kLineSize];
  };

  std::array<Line, kLines> lines_;
  std::atomic<uint64_t> next_{0};
  std::atomic<uint64_t> lost_{0};
};

} // namespace stride::task

#endif
