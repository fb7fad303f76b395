// Mutations of Structured Text for libFuzzer: of tokens mostly, of bytes sometimes.
// STRIDE_FUZZ_BYTES=1: of bytes only.
#include "tests/fuzz/token_mutator.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

extern "C" size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most);

namespace {

const stride::fuzz::TokenMutator &mutator() {
  static const stride::fuzz::TokenMutator one = [] {
    const std::filesystem::path root = STRIDE_SOURCE_DIR;
    return stride::fuzz::TokenMutator(stride::fuzz::readSources(
        {root / "tests/golden", root / "examples", root / "stdlib"}, 12'000));
  }();
  return one;
}

bool onlyBytes() {
  static const bool set = std::getenv("STRIDE_FUZZ_BYTES") != nullptr;
  return set;
}

std::string_view textOf(const uint8_t *data, size_t size) {
  return {reinterpret_cast<const char *>(data), size};
}

size_t store(const std::string &text, uint8_t *out, size_t most) {
  const size_t size = std::min(text.size(), most);
  std::memcpy(out, text.data(), size);
  return size;
}

} // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed) {
  if (onlyBytes() || seed % 8 == 0)
    return LLVMFuzzerMutate(data, size, most);
  return store(mutator().mutate(textOf(data, size), seed, most), data, most);
}

extern "C" size_t LLVMFuzzerCustomCrossOver(const uint8_t *first, size_t firstSize,
                                            const uint8_t *second, size_t secondSize, uint8_t *out,
                                            size_t most, unsigned seed) {
  return store(mutator().cross(textOf(first, firstSize), textOf(second, secondSize), seed, most),
               out, most);
}
