// Bytes as text: what runtime/numeric/cnc/packed_bytes.hpp reads.

#include "compiler/assets/cnc/internal.hpp"

#include "runtime/numeric/cnc/packed_bytes.hpp"

namespace stc::gcode {

namespace {

/// Of a piece, so that no string of the generated program is too long.
constexpr size_t kMostLetters = 16'000;

class Packer {
public:
  void add(uint8_t byte) {
    constexpr uint8_t kMostZeros = 255;
    if (byte != 0)
      flush();
    if (byte != 0)
      put(byte);
    else if (++zeros_ == kMostZeros)
      flush();
  }

  std::vector<std::string> finish() {
    flush();
    if (count_ > 0)
      letter(bits_ << (kLetterBits - count_));
    return std::move(pieces_);
  }

private:
  static constexpr uint32_t kLetterBits = 6;
  static constexpr uint32_t kByteBits = 8;

  /// Writes the zeros that there have been.
  void flush() {
    if (zeros_ == 0)
      return;
    put(0);
    put(zeros_);
    zeros_ = 0;
  }

  void put(uint8_t byte) {
    bits_ = bits_ << kByteBits | byte;
    for (count_ += kByteBits; count_ >= kLetterBits;) {
      count_ -= kLetterBits;
      letter(bits_ >> count_);
    }
  }

  void letter(uint32_t value) {
    if (pieces_.empty() || pieces_.back().size() == kMostLetters)
      pieces_.emplace_back();
    pieces_.back() += stride::cnc::kPackedLetters[value & ((1U << kLetterBits) - 1)];
  }

  std::vector<std::string> pieces_;
  uint32_t bits_ = 0;
  uint32_t count_ = 0;
  uint8_t zeros_ = 0;
};

} // namespace

std::vector<std::string> packed(std::string_view bytes) {
  Packer packer;
  for (const char byte : bytes)
    packer.add(static_cast<uint8_t>(byte));
  return packer.finish();
}

} // namespace stc::gcode
