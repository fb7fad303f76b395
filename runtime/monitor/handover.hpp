// An object given to a cyclic thread without a lock.
#ifndef STRIDE_RUNTIME_MONITOR_HANDOVER_HPP
#define STRIDE_RUNTIME_MONITOR_HANDOVER_HPP

#include <atomic>
#include <memory>

namespace stride::monitor {

/// One thread publishes new versions of a T, another one, in its cycle, uses the newest. What is no
/// longer used is deleted by the first one: the cyclic thread neither allocates nor frees.
template <class T> class Handover {
public:
  Handover() = default;
  Handover(const Handover &) = delete;
  Handover &operator=(const Handover &) = delete;
  /// When the cyclic thread has ended.
  ~Handover() {
    delete offered_.load();
    delete given_.load();
    delete current_;
  }

  /// Publisher: from its next take() on the cyclic thread uses this one.
  void publish(std::unique_ptr<T> next) {
    delete offered_.exchange(next.release(), std::memory_order_acq_rel);
    collect();
  }
  /// Publisher: the newest version is in use.
  bool taken() const noexcept { return offered_.load(std::memory_order_acquire) == nullptr; }
  /// Publisher: deletes what is no longer used.
  void collect() { delete given_.exchange(nullptr, std::memory_order_acq_rel); }

  /// Cyclic thread: the newest version; null before the first one.
  T *take() noexcept {
    // A version that the publisher has not fetched yet occupies the only place to give it back.
    if (offered_.load(std::memory_order_relaxed) != nullptr &&
        given_.load(std::memory_order_acquire) == nullptr) {
      if (T *next = offered_.exchange(nullptr, std::memory_order_acq_rel)) {
        given_.store(current_, std::memory_order_release);
        current_ = next;
      }
    }
    return current_;
  }
  /// Cyclic thread: what the last take() returned.
  T *current() const noexcept { return current_; }

private:
  std::atomic<T *> offered_{nullptr};
  std::atomic<T *> given_{nullptr};
  T *current_ = nullptr; // of the cyclic thread
};

} // namespace stride::monitor

#endif
