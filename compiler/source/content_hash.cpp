#include "compiler/source/content_hash.hpp"

#include <array>

namespace stc {

namespace {

constexpr size_t kBytes = 32;

void update(blake2b_state &state, std::string_view bytes) {
  ::blake2b_update(&state, reinterpret_cast<const uint8_t *>(bytes.data()), bytes.size());
}

std::string finish(blake2b_state state) {
  std::array<uint8_t, kBytes> hash{};
  ::blake2b_final(&state, hash.data(), hash.size());
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string digits;
  for (const uint8_t byte : hash) {
    digits += kDigits[byte >> 4U];
    digits += kDigits[byte & 15U];
  }
  return digits;
}

} // namespace

ContentHash::ContentHash() { ::blake2b_init(&state_, kBytes); }

ContentHash &ContentHash::add(uint64_t value) {
  std::array<char, sizeof(value)> bytes{};
  for (size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = static_cast<char>(value >> (8 * i));
  update(state_, {bytes.data(), bytes.size()});
  return *this;
}

ContentHash &ContentHash::add(std::string_view text) {
  add(static_cast<uint64_t>(text.size()));
  update(state_, text);
  return *this;
}

std::string ContentHash::hex() const { return finish(state_); }

std::string blake2b256(std::string_view bytes) {
  blake2b_state state;
  ::blake2b_init(&state, kBytes);
  update(state, bytes);
  return finish(state);
}

} // namespace stc
