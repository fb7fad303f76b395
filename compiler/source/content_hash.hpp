#ifndef STRIDE_COMPILER_SOURCE_CONTENT_HASH_HPP
#define STRIDE_COMPILER_SOURCE_CONTENT_HASH_HPP
// Fingerprints of contents: of what the build cache keeps.

#include <blake2.h>
#include <cstdint>
#include <string>
#include <string_view>

namespace stc {

/// BLAKE2b-256 (RFC 7693) of a sequence of texts; each text counts with its length, so that their
/// boundaries matter.
class ContentHash {
public:
  ContentHash();
  ContentHash &add(std::string_view text);
  ContentHash &add(uint64_t value);
  /// 64 hexadecimal digits of what was added so far.
  [[nodiscard]] std::string hex() const;

private:
  blake2b_state state_;
};

/// BLAKE2b-256 of the bytes alone, as `b2sum -l 256` prints it.
[[nodiscard]] std::string blake2b256(std::string_view bytes);

} // namespace stc

#endif // STRIDE_COMPILER_SOURCE_CONTENT_HASH_HPP
