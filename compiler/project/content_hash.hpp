#pragma once
// Fingerprints of contents, for the build cache.

#include <cstdint>
#include <string>
#include <string_view>

namespace stc {

/// A 128-bit hash (not cryptographic) of a sequence of texts; each text counts with its length.
class ContentHash {
public:
  ContentHash &add(std::string_view text);
  ContentHash &add(std::uint64_t value);
  /// 32 hexadecimal digits.
  [[nodiscard]] std::string hex() const;

private:
  void mix(std::uint64_t word);

  std::uint64_t a_ = 0x9E3779B97F4A7C15U;
  std::uint64_t b_ = 0xC2B2AE3D27D4EB4FU;
};

} // namespace stc
