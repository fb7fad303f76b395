#include "runtime/bus/axis_driver.hpp"

#include <algorithm>
#include <charconv>

namespace stride::bus {

ByteString::ByteString(std::string_view text) {
  assign({reinterpret_cast<const uint8_t *>(text.data()), text.size()});
}

void ByteString::assign(std::span<const uint8_t> bytes) {
  size_ = static_cast<uint8_t>(std::min(bytes.size(), kMost));
  std::copy_n(bytes.data(), size_, bytes_.data());
}

std::string_view ByteString::text() const {
  return {reinterpret_cast<const char *>(bytes_.data()), size_};
}

void Message::append(std::string_view text) {
  const size_t count = std::min(text.size(), text_.size() - length_);
  std::copy_n(text.data(), count, text_.data() + length_);
  length_ += count;
}

void Message::append(uint32_t number) {
  std::array<char, 10> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  append(std::string_view(digits.data(), static_cast<size_t>(end - digits.data())));
}

} // namespace stride::bus
