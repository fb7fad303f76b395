// An object given to a cyclic thread without a lock.
#ifndef STRIDE_RUNTIME_MONITOR_HANDOVER_HPP
#define STRIDE_RUNTIME_MONITOR_HANDOVER_HPP

#include <atomic>
#include <memory>
#include <utility>

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
    collect();
    delete current_;
  }

  /// Publisher: from its next take() on the cyclic thread uses this one.
  void publish(std::unique_ptr<T> next) {
    delete offered_.exchange(new Version{std::move(next)}, std::memory_order_acq_rel);
    collect();
  }
  /// Publisher: the newest version is in use.
  bool taken() const noexcept { return offered_.load(std::memory_order_acquire) == nullptr; }
  /// Publisher: deletes what is no longer used.
  void collect() {
    for (Version *version = given_.exchange(nullptr, std::memory_order_acq_rel); version;)
      delete std::exchange(version, version->older);
  }

  /// Cyclic thread: the newest version; null before the first one.
  T *take() noexcept {
    if (offered_.load(std::memory_order_relaxed) != nullptr) {
      if (Version *next = offered_.exchange(nullptr, std::memory_order_acq_rel)) {
        if (current_ != nullptr)
          giveBack(current_);
        current_ = next;
      }
    }
    return current();
  }
  /// Cyclic thread: what the last take() returned.
  T *current() const noexcept { return current_ != nullptr ? current_->value.get() : nullptr; }

private:
  struct Version {
    std::unique_ptr<T> value;
    Version *older = nullptr; ///< given back before this one
  };

  /// Again only when the publisher has just collected.
  void giveBack(Version *version) noexcept {
    version->older = given_.load(std::memory_order_relaxed);
    while (!given_.compare_exchange_weak(version->older, version, std::memory_order_release,
                                         std::memory_order_relaxed)) {
    }
  }

  std::atomic<Version *> offered_{nullptr};
  std::atomic<Version *> given_{nullptr}; ///< a list
  Version *current_ = nullptr;            ///< of the cyclic thread
};

} // namespace stride::monitor

#endif
