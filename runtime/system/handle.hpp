// Numbers that programs get for files and requests.
#ifndef STRIDE_RUNTIME_SYSTEM_HANDLE_HPP
#define STRIDE_RUNTIME_SYSTEM_HANDLE_HPP

#include <cstddef>
#include <cstdint>

namespace stride::system {

/// A place in a table and a count of how often it has been taken, so that an old number is not
/// taken for a new one. Never 0.
class Handle {
public:
  static constexpr uint32_t kGenerations = 1U << 24;

  Handle(size_t index, uint32_t generation)
      : number_((static_cast<uint32_t>(index) + 1) | generation << kIndexBits) {}
  /// What a program says; its index may be beyond every table.
  explicit Handle(uint32_t number) : number_(number) {}

  uint32_t number() const { return number_; }
  uint32_t index() const { return (number_ & ((1U << kIndexBits) - 1)) - 1; }
  uint32_t generation() const { return number_ >> kIndexBits; }
  static uint32_t next(uint32_t generation) { return (generation + 1) % kGenerations; }

private:
  static constexpr uint32_t kIndexBits = 8;
  uint32_t number_;
};

} // namespace stride::system

#endif
