// Numbers in messages for people, without memory elsewhere.
#ifndef STRIDE_DRIVERS_CAN_MASTER_TEXTS_HPP
#define STRIDE_DRIVERS_CAN_MASTER_TEXTS_HPP

#include "drivers/can/plan/objects.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace stride::can {

/// "16#60640020"; with at least so many digits.
class HexText {
public:
  explicit HexText(uint32_t value, unsigned digits = 1);
  // NOLINTNEXTLINE(google-explicit-constructor): a part of a Message
  operator std::string_view() const { return {text_.data(), length_}; }

private:
  std::array<char, 12> text_{};
  size_t length_ = 0;
};

/// ", axis 2" of one that is not the first of its device; else nothing.
class AxisText {
public:
  explicit AxisText(uint8_t axis) {
    if (axis > 0)
      text_[7] = static_cast<char>('0' + axis % 10);
    length_ = axis > 0 ? text_.size() : 0;
  }
  // NOLINTNEXTLINE(google-explicit-constructor): a part of a Message
  operator std::string_view() const { return {text_.data(), length_}; }

private:
  std::array<char, 8> text_{',', ' ', 'a', 'x', 'i', 's', ' ', '0'};
  size_t length_;
};

/// "16#1018:2".
class ObjectText {
public:
  explicit ObjectText(Object object);
  // NOLINTNEXTLINE(google-explicit-constructor): a part of a Message
  operator std::string_view() const { return {text_.data(), length_}; }

private:
  std::array<char, 12> text_{};
  size_t length_ = 0;
};

} // namespace stride::can

#endif
