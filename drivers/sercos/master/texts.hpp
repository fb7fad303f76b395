// Numbers in messages for people, without memory elsewhere.
#ifndef STRIDE_DRIVERS_SERCOS_MASTER_TEXTS_HPP
#define STRIDE_DRIVERS_SERCOS_MASTER_TEXTS_HPP

#include "drivers/sercos/protocol/idn.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace stride::sercos {

/// "S-0-0047".
class IdnName {
public:
  explicit IdnName(Idn idn) : text_(idnText(idn)) {}
  // NOLINTNEXTLINE(google-explicit-constructor): a part of a Message
  operator std::string_view() const { return {text_.data(), text_.size()}; }

private:
  IdnText text_;
};

/// "16#7005", with four digits.
class WordText {
public:
  explicit WordText(uint16_t word);
  // NOLINTNEXTLINE(google-explicit-constructor): a part of a Message
  operator std::string_view() const { return {text_.data(), text_.size()}; }

private:
  std::array<char, 7> text_{};
};

/// "-12".
class NumberText {
public:
  explicit NumberText(int64_t number);
  // NOLINTNEXTLINE(google-explicit-constructor): a part of a Message
  operator std::string_view() const { return {text_.data(), length_}; }

private:
  std::array<char, 20> text_{};
  size_t length_ = 0;
};

} // namespace stride::sercos

#endif
