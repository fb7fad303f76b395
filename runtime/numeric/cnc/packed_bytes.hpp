// Bytes as text, as the compiler writes them into generated programs: each run of up to 255 bytes
// of 0 becomes 0 and its length; six bits make a character of base64, the highest first. Free of
// the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PACKED_BYTES_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PACKED_BYTES_HPP

#include <stdint.h>

namespace stride::cnc {

/// The characters by value.
inline constexpr char kPackedLetters[] =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Reads bytes one after the other. The text may stand in pieces of `piece` characters, each of
/// which ends with 0; a shorter piece is the last one.
struct Unpacker {
  const uint8_t *text;
  uint32_t piece;
  uint32_t at;    ///< Of the character in its piece.
  uint32_t bits;  ///< What has been read and not given yet.
  uint32_t count; ///< How many bits these are.
  uint32_t zeros; ///< How many bytes of 0 are still to come.
};

/// The beginning of a text.
Unpacker startUnpacking(const void *text, uint32_t piece) noexcept;

/// The next `count` bytes. False: the text ends before, or has other characters.
bool unpack(Unpacker &unpacker, void *bytes, int64_t count) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PACKED_BYTES_HPP
