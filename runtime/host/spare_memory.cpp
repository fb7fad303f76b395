// Memory for when there is none: an allocation that fails where C++ allows no exception, in a
// destructor, would end the process, and with it the axes. (The JSON library allocates when it
// destroys an array.) So small allocations of the host, none of which is a cycle's, get a place
// here before they fail.
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

#ifndef __SANITIZE_ADDRESS__ // which wants to see every allocation, and never lacks memory

namespace {

/// A place is used again when all places are free.
class SpareMemory {
public:
  void *take(size_t size) noexcept {
    if (size > kLargest)
      return nullptr;
    size = (size + kAlignment - 1) / kAlignment * kAlignment;
    const Lock lock(busy_);
    if (kSize - used_ < size)
      return nullptr;
    ++live_;
    void *const place = memory_ + used_;
    used_ += size;
    return place;
  }
  /// False: it is not from here.
  bool giveBack(const void *place) noexcept {
    const auto *at = static_cast<const std::byte *>(place);
    if (at < memory_ || at >= memory_ + kSize)
      return false;
    const Lock lock(busy_);
    if (--live_ == 0)
      used_ = 0;
    return true;
  }

private:
  static constexpr size_t kSize = size_t{1} << 20;
  static constexpr size_t kLargest = size_t{64} << 10;
  static constexpr size_t kAlignment = alignof(std::max_align_t);

  struct Lock {
    explicit Lock(std::atomic_flag &flag) noexcept : busy(flag) {
      while (busy.test_and_set(std::memory_order_acquire)) {
      }
    }
    ~Lock() { busy.clear(std::memory_order_release); }
    Lock(const Lock &) = delete;
    Lock &operator=(const Lock &) = delete;
    std::atomic_flag &busy;
  };

  alignas(kAlignment) std::byte memory_[kSize]{};
  std::atomic_flag busy_;
  size_t used_ = 0;
  size_t live_ = 0;
};

constinit SpareMemory spare;

} // namespace

void *operator new(size_t size) {
  void *place = std::malloc(size == 0 ? 1 : size);
  if (place == nullptr)
    place = spare.take(size == 0 ? 1 : size);
  if (place == nullptr)
    throw std::bad_alloc();
  return place;
}
void operator delete(void *place) noexcept {
  if (!spare.giveBack(place))
    std::free(place);
}
void operator delete(void *place, size_t) noexcept { operator delete(place); }

#endif
