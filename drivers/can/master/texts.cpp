#include "drivers/can/master/texts.hpp"

#include <algorithm>
#include <charconv>

namespace stride::can {

HexText::HexText(uint32_t value, unsigned digits) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  constexpr unsigned kMost = 8;
  unsigned count = std::clamp(digits, 1U, kMost);
  while (count < kMost && value >> 4U * count != 0)
    ++count;
  text_ = {'1', '6', '#'};
  length_ = 3;
  for (unsigned place = count; place > 0; --place)
    text_[length_++] = kDigits[value >> 4U * (place - 1) & 0xFU];
}

ObjectText::ObjectText(Object object) {
  const HexText index(object.index, 4);
  const std::string_view digits = index;
  std::copy(digits.begin(), digits.end(), text_.begin());
  text_[digits.size()] = ':';
  char *const from = text_.data() + digits.size() + 1;
  length_ = static_cast<size_t>(
      std::to_chars(from, text_.data() + text_.size(), unsigned{object.sub}).ptr - text_.data());
}

} // namespace stride::can
