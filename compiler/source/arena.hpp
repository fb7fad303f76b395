#ifndef STRIDE_COMPILER_SOURCE_ARENA_HPP
#define STRIDE_COMPILER_SOURCE_ARENA_HPP
// Bump allocation for syntax trees and symbol tables.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace stc {

/// Memory that is freed as a whole. Objects in it are never destroyed, so they must not need it.
class Arena {
public:
  template <class T, class... Args> T *make(Args &&...args) {
    static_assert(std::is_trivially_destructible_v<T>);
    return ::new (allocate(sizeof(T), alignof(T))) T{std::forward<Args>(args)...};
  }

  /// A copy of the elements that lives as long as the arena.
  template <class T> std::span<T> copy(const std::vector<T> &from) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (from.empty())
      return {};
    const size_t bytes =
        from.size() * sizeof(T); // NOLINT(bugprone-sizeof-expression): T may be a pointer
    auto *data = static_cast<T *>(allocate(bytes, alignof(T)));
    std::memcpy(static_cast<void *>(data), from.data(), bytes);
    return {data, from.size()};
  }

  std::string_view copy(std::string_view text) {
    if (text.empty())
      return {};
    auto *data = static_cast<char *>(allocate(text.size(), 1));
    std::memcpy(data, text.data(), text.size());
    return {data, text.size()};
  }

  void *allocate(size_t size, size_t align) {
    auto at = (reinterpret_cast<uintptr_t>(cursor_) + align - 1) & ~(align - 1);
    if (cursor_ == nullptr || at + size > reinterpret_cast<uintptr_t>(end_)) {
      addBlock(size + align);
      at = (reinterpret_cast<uintptr_t>(cursor_) + align - 1) & ~(align - 1);
    }
    cursor_ = reinterpret_cast<std::byte *>(at + size);
    return reinterpret_cast<void *>(at);
  }

  /// What lives in `other` lives in this one from now on; `other` is empty.
  void adopt(Arena &&other) {
    blocks_.reserve(blocks_.size() + other.blocks_.size());
    for (Block &block : other.blocks_)
      blocks_.push_back(std::move(block));
    bytes_ += other.bytes_;
    other = Arena();
  }

  /// Bytes reserved from the heap.
  [[nodiscard]] size_t bytes() const { return bytes_; }

private:
  struct Free {
    void operator()(std::byte *block) const { std::free(block); } // NOLINT: of aligned_alloc()
  };
  using Block = std::unique_ptr<std::byte, Free>;

  /// Makes room for an object of that many bytes.
  void addBlock(size_t least);

  std::vector<Block> blocks_;
  std::byte *cursor_ = nullptr;
  std::byte *end_ = nullptr;
  size_t bytes_ = 0;
};

} // namespace stc

#endif // STRIDE_COMPILER_SOURCE_ARENA_HPP
