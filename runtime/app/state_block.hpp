// The memory of an application's state.
#ifndef STRIDE_RUNTIME_APP_STATE_BLOCK_HPP
#define STRIDE_RUNTIME_APP_STATE_BLOCK_HPP

#include <cstddef>
#include <cstdint>

namespace stride::app {

/// Zeroed pages for one application object.
///
/// They lie below 4 GiB, so that ADR fits the DWORD of old programs, at the first free of a fixed
/// series of addresses (512 MiB, 1 GiB, ... 3.5 GiB), so that addresses repeat from run to run.
/// When none of them is free the system chooses the place; belowFourGiB() then tells.
class StateBlock {
public:
  StateBlock() = default;
  /// Throws Error when there is no memory.
  explicit StateBlock(std::size_t size);
  StateBlock(StateBlock &&other) noexcept;
  StateBlock &operator=(StateBlock &&other) noexcept;
  StateBlock(const StateBlock &) = delete;
  StateBlock &operator=(const StateBlock &) = delete;
  ~StateBlock();

  std::byte *data() const { return data_; }
  std::size_t size() const { return size_; }
  bool belowFourGiB() const;

private:
  std::byte *data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t mapped_ = 0;
};

} // namespace stride::app

#endif
