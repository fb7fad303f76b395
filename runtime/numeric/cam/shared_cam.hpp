// A cam of segments that one task writes and others read, without locks and without waiting: two
// copies, written by turns; a reader that was overtaken tries again. Free of the C++ standard
// library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_CAM_SHARED_CAM_HPP
#define STRIDE_RUNTIME_NUMERIC_CAM_SHARED_CAM_HPP

#include "runtime/numeric/cam/curve.hpp"

#include <stddef.h>
#include <stdint.h>

namespace stride::cam {

/// What belongs to a copy besides its segments.
struct SharedHead {
  double start;  ///< [master u]
  double end;    ///< [master u]
  int64_t count; ///< Of segments.
};

/// Where a shared cam lies. All of it is 0 at first.
struct SharedCam {
  Segment *copies[2];
  SharedHead *heads; ///< Two.
  uint32_t *written; ///< Number of the last complete cam; its copy is that number modulo 2.
  uint32_t *begun;   ///< Number of the last cam that was begun.
  uint32_t *writing; ///< 1 while somebody writes.
};

namespace detail {

/// Word by word, so that a reader may look while it happens. Every word is released after `begun`:
/// who sees it sees that, too.
inline void publish(void *to, const void *from, size_t bytes) noexcept {
  for (size_t i = 0; i < bytes; i += sizeof(uintptr_t)) {
    uintptr_t word;
    __builtin_memcpy(&word, static_cast<const char *>(from) + i, sizeof word);
    __atomic_store_n(reinterpret_cast<uintptr_t *>(static_cast<char *>(to) + i), word,
                     __ATOMIC_RELEASE);
  }
}

inline void look(void *to, const void *from, size_t bytes) noexcept {
  for (size_t i = 0; i < bytes; i += sizeof(uintptr_t)) {
    const uintptr_t word = __atomic_load_n(
        reinterpret_cast<const uintptr_t *>(static_cast<const char *>(from) + i), __ATOMIC_ACQUIRE);
    __builtin_memcpy(static_cast<char *>(to) + i, &word, sizeof word);
  }
}

} // namespace detail

/// One cam on its way in.
class SharedWriter {
public:
  explicit SharedWriter(const SharedCam &cam) noexcept : cam_(cam) {
    isOpen_ = __atomic_exchange_n(cam.writing, 1U, __ATOMIC_ACQUIRE) == 0;
    if (!isOpen_)
      return;
    number_ = __atomic_load_n(cam.written, __ATOMIC_RELAXED) + 1;
    if (number_ == 0) // means: none yet
      number_ = 2;
    __atomic_store_n(cam.begun, number_, __ATOMIC_RELAXED);
  }
  ~SharedWriter() {
    if (isOpen_)
      __atomic_store_n(cam_.writing, 0U, __ATOMIC_RELEASE);
  }
  SharedWriter(const SharedWriter &) = delete;
  SharedWriter &operator=(const SharedWriter &) = delete;

  /// Not while another one writes.
  [[nodiscard]] bool isOpen() const noexcept { return isOpen_; }
  void put(int32_t index, const Segment &segment) noexcept {
    detail::publish(&cam_.copies[number_ & 1U][index], &segment, sizeof segment);
  }
  /// From now on readers get this cam.
  void finish(const SharedHead &head) noexcept {
    detail::publish(&cam_.heads[number_ & 1U], &head, sizeof head);
    __atomic_store_n(cam_.written, number_, __ATOMIC_RELEASE);
  }

private:
  SharedCam cam_;
  uint32_t number_ = 0;
  bool isOpen_;
};

enum class SharedResult : uint8_t {
  Good,
  None,     ///< Nothing has been written yet.
  TooSmall, ///< `capacity` is less than `head.count`.
  Overtaken ///< `target` holds nothing of use.
};

/// Copies the last complete cam to `target`. Tries it at most three times: a try fails only if the
/// cam has been written twice, or nearly, while it was copied.
inline SharedResult readShared(const SharedCam &cam, Segment *target, int64_t capacity,
                               SharedHead &head) noexcept {
  for (int attempt = 0; attempt < 3; ++attempt) {
    const uint32_t number = __atomic_load_n(cam.written, __ATOMIC_ACQUIRE);
    if (number == 0)
      return SharedResult::None;
    const auto isWhole = [&] { return __atomic_load_n(cam.begun, __ATOMIC_RELAXED) - number <= 1; };
    detail::look(&head, &cam.heads[number & 1U], sizeof head);
    if (!isWhole())
      continue;
    if (head.count > capacity)
      return SharedResult::TooSmall;
    detail::look(target, cam.copies[number & 1U],
                 sizeof(Segment) * static_cast<size_t>(head.count));
    if (isWhole())
      return SharedResult::Good;
  }
  return SharedResult::Overtaken;
}

static_assert(sizeof(Segment) % sizeof(uintptr_t) == 0 &&
              sizeof(SharedHead) % sizeof(uintptr_t) == 0);

} // namespace stride::cam

#endif
