#include "drivers/sercos/master/texts.hpp"

#include <charconv>

namespace stride::sercos {

WordText::WordText(uint16_t word) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  text_ = {'1', '6', '#'};
  for (size_t i = 0; i < 4; ++i)
    text_[3 + i] = kDigits[word >> 4 * (3 - i) & 0xFU];
}

NumberText::NumberText(int64_t number) {
  length_ = static_cast<size_t>(
      std::to_chars(text_.data(), text_.data() + text_.size(), number).ptr - text_.data());
}

} // namespace stride::sercos
