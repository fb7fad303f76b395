// What a symbol server does in the cycles of one task.
#ifndef STRIDE_RUNTIME_MONITOR_SYMBOL_CHANNEL_HPP
#define STRIDE_RUNTIME_MONITOR_SYMBOL_CHANNEL_HPP

#include "runtime/monitor/handover.hpp"
#include "runtime/monitor/symbol_server.hpp"
#include "runtime/task/cycle_hook.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace stride::monitor {

/// The lock-free way between the server's threads (one at a time, under its mutex) and one task.
class SymbolChannel {
public:
  struct ForceList {
    std::vector<SymbolServer::Forced> forced;
  };
  struct RecorderSlot {
    std::shared_ptr<Recorder> recorder;
  };

  SymbolChannel() : outer_(*this), inner_(*this) {}

  task::CycleHook &outer() { return outer_; }
  task::CycleHook &inner() { return inner_; }

  /// Server: there is room for one more; only push() takes it away.
  bool hasRoom() const noexcept {
    return head_.load(std::memory_order_relaxed) - tail_.load(std::memory_order_acquire) !=
           queue_.size();
  }
  /// Server, with hasRoom().
  void push(SymbolRequest::Part &part) noexcept {
    const size_t head = head_.load(std::memory_order_relaxed);
    queue_[head % queue_.size()] = &part;
    head_.store(head + 1, std::memory_order_release);
  }
  /// Server, while the task is in no cycle: takes the next part out of the queue, or null.
  SymbolRequest::Part *pop() noexcept {
    const size_t tail = tail_.load(std::memory_order_acquire);
    if (head_.load(std::memory_order_relaxed) == tail)
      return nullptr;
    SymbolRequest::Part *part = queue_[tail % queue_.size()];
    tail_.store(tail + 1, std::memory_order_release);
    return part;
  }

  Handover<ForceList> forces;
  Handover<RecorderSlot> recorder;
  WriteLog *log = nullptr; ///< Before the first cycle.

private:
  /// Sees the end of the cycle: reads and the recorder.
  class Outer final : public task::CycleHook {
  public:
    explicit Outer(SymbolChannel &channel) : channel_(&channel) {}
    void beforePous(Ctx &) override {}
    void afterPous(Ctx &ctx) override;

  private:
    SymbolChannel *channel_;
  };
  /// Next to the POUs: writes and forces.
  class Inner final : public task::CycleHook {
  public:
    explicit Inner(SymbolChannel &channel) : channel_(&channel) {}
    void beforePous(Ctx &ctx) override;
    void afterPous(Ctx &ctx) override;

  private:
    SymbolChannel *channel_;
  };

  void serve(bool writes, const Ctx &ctx) noexcept;
  void applyForces(const ForceList *list, const Ctx &ctx, bool behindPous) noexcept;
  bool store(const app::Symbol &symbol, std::byte *state, const std::byte *value, size_t size,
             bool behindPous) noexcept;

  std::array<SymbolRequest::Part *, SymbolServer::kMostWaiting> queue_{};
  std::atomic<size_t> head_{0}; // parts put in so far
  std::atomic<size_t> tail_{0}; // parts taken out so far
  Outer outer_;
  Inner inner_;
};

} // namespace stride::monitor

#endif
