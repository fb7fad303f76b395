// Memory below 4 GiB.
#ifndef STRIDE_RUNTIME_APP_LOW_MEMORY_HPP
#define STRIDE_RUNTIME_APP_LOW_MEMORY_HPP

#include <cstddef>
#include <cstdint>
#include <span>

namespace stride::app {

/// Zeroed pages that ST has addresses of. They lie below 4 GiB, so that an address fits the DWORD
/// of old programs, with pages without access in front and after them, so that what runs off either
/// end is noticed.
class LowMemory {
public:
  /// Bytes without access on each side.
  static constexpr size_t kGuard = size_t{1} << 20;

  LowMemory() = default;
  /// Takes the first of these addresses that is free; where none is, the system chooses the place
  /// (perhaps above 4 GiB). Addresses must be multiples of 4096, the first ones at least kGuard
  /// apart from what lies below. Throws Error when there is no memory; it calls it `what`.
  LowMemory(size_t size, std::span<const uint64_t> addresses, const char *what);
  LowMemory(LowMemory &&other) noexcept;
  LowMemory &operator=(LowMemory &&other) noexcept;
  LowMemory(const LowMemory &) = delete;
  LowMemory &operator=(const LowMemory &) = delete;
  ~LowMemory();

  std::byte *data() const { return data_; }
  size_t size() const { return size_; }

private:
  std::byte *data_ = nullptr;
  size_t size_ = 0;   ///< As asked for.
  size_t mapped_ = 0; ///< Whole pages, without the guards.
};

inline constexpr uint64_t kFourGiB = uint64_t{1} << 32;
/// States begin at multiples of this, data stacks in the second half of such a part.
inline constexpr uint64_t kPartOfLowMemory = uint64_t{1} << 29;

} // namespace stride::app

#endif
