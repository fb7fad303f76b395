// Numbers and texts in files: little-endian, without padding.
#ifndef STRIDE_RUNTIME_APP_BYTE_STREAM_HPP
#define STRIDE_RUNTIME_APP_BYTE_STREAM_HPP

#include "runtime/app/error.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace stride::app {

static_assert(std::endian::native == std::endian::little,
              "states and the files made of them are little-endian");

/// Appends to a growing buffer.
class ByteWriter {
public:
  template <class T>
  requires std::is_integral_v<T>
  void number(T value) { raw(std::as_bytes(std::span(&value, 1))); }
  void text(std::string_view text) {
    number(static_cast<uint32_t>(text.size()));
    raw(std::as_bytes(std::span(text)));
  }
  void raw(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  std::vector<std::byte> take() { return std::move(bytes_); }
  size_t size() const { return bytes_.size(); }

private:
  std::vector<std::byte> bytes_;
};

/// Reads what a ByteWriter wrote; throws Error at the end of the bytes.
class ByteReader {
public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  requires std::is_integral_v<T> T number() {
    T value;
    std::memcpy(&value, raw(sizeof value).data(), sizeof value);
    return value;
  }
  /// A number of entries, each of at least `least` bytes: what cannot be there is no reason to
  /// reserve memory.
  uint32_t count(size_t least) {
    const auto value = number<uint32_t>();
    if (value > left() / least)
      throw Error("it ends too early");
    return value;
  }
  std::string_view text() {
    const std::span<const std::byte> own = raw(number<uint32_t>());
    return {reinterpret_cast<const char *>(own.data()), own.size()};
  }
  std::span<const std::byte> raw(size_t size) {
    if (size > left())
      throw Error("it ends too early");
    const std::span<const std::byte> own = bytes_.subspan(at_, size);
    at_ += size;
    return own;
  }
  size_t left() const { return bytes_.size() - at_; }

private:
  std::span<const std::byte> bytes_;
  size_t at_ = 0;
};

} // namespace stride::app

#endif
