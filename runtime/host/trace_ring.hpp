// The trace of a run by the real clock: taken in the cycle, written elsewhere.
#ifndef STRIDE_RUNTIME_HOST_TRACE_RING_HPP
#define STRIDE_RUNTIME_HOST_TRACE_RING_HPP

#include "runtime/host/trace_writer.hpp"
#include "runtime/task/cycle_hook.hpp"

#include <atomic>
#include <cstddef>
#include <vector>

namespace stride::host {

/// Takes a row at the end of each cycle of its task. Rows wait in a ring until another thread
/// writes them; where that is too slow, rows are lost and counted, and the cycle is not delayed.
class TraceRing final : public task::CycleHook {
public:
  /// `columns` lives longer. `rows`: how many may wait.
  TraceRing(const app::TraceColumns &columns, size_t rows);

  void beforePous(Ctx &) override {}
  void afterPous(Ctx &ctx) override;

  /// Writes the rows that wait, as far as the writer can take them. From one thread.
  void drain(TraceWriter &writer);
  uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }
  /// Rows that wait.
  uint64_t waiting() const { return taken_.load() - written_.load(); }

private:
  std::byte *place(uint64_t number) { return memory_.data() + number % rows_ * rowSize_; }

  const app::TraceColumns *columns_;
  size_t rows_;
  size_t rowSize_;
  std::vector<std::byte> memory_;
  std::atomic<uint64_t> taken_{0};   // rows put in so far
  std::atomic<uint64_t> written_{0}; // rows taken out so far
  std::atomic<uint64_t> lost_{0};
};

} // namespace stride::host

#endif
