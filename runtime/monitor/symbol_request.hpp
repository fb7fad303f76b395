// Values to be read or written together while an application runs.
#ifndef STRIDE_RUNTIME_MONITOR_SYMBOL_REQUEST_HPP
#define STRIDE_RUNTIME_MONITOR_SYMBOL_REQUEST_HPP

#include "runtime/app/symbols.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace stride::monitor {

/// A name and an ST literal for it.
using NamedValue = std::pair<std::string, std::string>;

/// Prepared outside of the cycle, done in it. SymbolServer makes them; the values are there when
/// done() says so.
class SymbolRequest {
public:
  /// One variable. Of a write the value is what is to be written.
  struct Value {
    app::Symbol symbol;
    size_t offset = 0; ///< Of its bytes in the request's memory.
    size_t size = 0;
    bool reached = false; ///< False: a pointer on the way to it was null.
  };

  bool done() const noexcept { return open_.load(std::memory_order_acquire) == 0; }
  /// It was never done: the run has ended, or another build has taken the application's place.
  bool dropped() const noexcept { return dropped_.load(std::memory_order_acquire); }

  const std::vector<Value> &values() const { return values_; }
  const std::byte *bytes(const Value &value) const { return memory_.data() + value.offset; }
  /// When the last part was done, of the task's clock. [ns]
  int64_t timeNs() const noexcept { return timeNs_.load(std::memory_order_relaxed); }

private:
  friend class SymbolServer;
  friend class SymbolChannel;

  /// The values that one task serves: those whose numbers are [first, last) in order_.
  struct Part {
    SymbolRequest *request = nullptr;
    uint32_t task = 0;
    size_t first = 0;
    size_t last = 0;
    size_t bytes = 0;
  };

  bool writes_ = false;
  uint64_t build_ = 0; ///< Of the server when this was made.
  std::vector<Value> values_;
  std::vector<size_t> order_; ///< Numbers of values_, those of a task together.
  std::vector<std::byte> memory_;
  std::vector<Part> parts_;
  std::atomic<size_t> open_{0}; ///< Parts that are not done.
  std::atomic<bool> dropped_{false};
  std::atomic<int64_t> timeNs_{0};
};

} // namespace stride::monitor

#endif
