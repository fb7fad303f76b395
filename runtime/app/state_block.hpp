// The memory of an application's state.
#ifndef STRIDE_RUNTIME_APP_STATE_BLOCK_HPP
#define STRIDE_RUNTIME_APP_STATE_BLOCK_HPP

#include "runtime/app/low_memory.hpp"

namespace stride::app {

/// Zeroed pages for one application object.
///
/// They lie below 4 GiB, at the first free of a fixed series of addresses (512 MiB, 1 GiB, ...
/// 3.5 GiB), so that addresses repeat from run to run. When none of them is free the system chooses
/// the place; belowFourGiB() then tells.
class StateBlock {
public:
  StateBlock() = default;
  /// Throws Error when there is no memory.
  explicit StateBlock(size_t size);

  std::byte *data() const { return memory_.data(); }
  size_t size() const { return memory_.size(); }
  bool belowFourGiB() const;

private:
  LowMemory memory_;
};

} // namespace stride::app

#endif
