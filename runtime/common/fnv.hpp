// FNV-1a: a quick hash for tables and names. What must not collide on purpose needs another one.
#ifndef STRIDE_RUNTIME_COMMON_FNV_HPP
#define STRIDE_RUNTIME_COMMON_FNV_HPP

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace stride::common {

/// FNV-1a in 32 or 64 bits. Source: RFC 9923.
template <std::unsigned_integral T>
requires(sizeof(T) == 4 || sizeof(T) == 8) class Fnv1a {
public:
  constexpr Fnv1a &add(unsigned char byte) {
    value_ = (value_ ^ byte) * kPrime;
    return *this;
  }
  constexpr Fnv1a &add(std::string_view text) {
    for (const char c : text)
      add(static_cast<unsigned char>(c));
    return *this;
  }
  constexpr Fnv1a &add(std::span<const std::byte> bytes) {
    for (const std::byte byte : bytes)
      add(static_cast<unsigned char>(byte));
    return *this;
  }
  [[nodiscard]] constexpr T value() const { return value_; }

private:
  static constexpr T kPrime = static_cast<T>(sizeof(T) == 8 ? 0x100000001B3ULL : 0x01000193ULL);
  T value_ = static_cast<T>(sizeof(T) == 8 ? 0xCBF29CE484222325ULL : 0x811C9DC5ULL);
};

} // namespace stride::common

#endif
