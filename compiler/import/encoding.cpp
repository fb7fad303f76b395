#include "compiler/import/encoding.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <iconv.h>

#include <fmt/format.h>

namespace stc::import {

namespace {

constexpr const char *kAssumed = "CP1252";
constexpr std::string_view kWayOut =
    "; name the encoding of the file: --encoding cp1251, latin1, cp850, …";

/// A conversion of iconv, closed at its end.
class Conversion {
public:
  explicit Conversion(const std::string &from) : handle_(::iconv_open("UTF-8", from.c_str())) {}
  ~Conversion() {
    if (isOpen())
      ::iconv_close(handle_);
  }
  Conversion(const Conversion &) = delete;
  Conversion &operator=(const Conversion &) = delete;

  [[nodiscard]] bool isOpen() const {
    return handle_ != reinterpret_cast<::iconv_t>(-1); // NOLINT(performance-no-int-to-ptr)
  }

  /// How many bytes could be converted; less than all: the next one means nothing.
  size_t convert(std::string_view bytes, std::string &text) {
    std::array<char, 1 << 14> block;               // NOLINT(cppcoreguidelines-pro-type-member-init)
    char *from = const_cast<char *>(bytes.data()); // NOLINT(cppcoreguidelines-pro-type-const-cast)
    size_t left = bytes.size();
    while (left != 0) {
      char *to = block.data();
      size_t room = block.size();
      const size_t result = ::iconv(handle_, &from, &left, &to, &room);
      text.append(block.data(), block.size() - room);
      if (result == static_cast<size_t>(-1) && errno != E2BIG)
        break;
    }
    return bytes.size() - left;
  }

private:
  ::iconv_t handle_;
};

size_t lineOf(std::string_view text, size_t place) {
  return 1 + static_cast<size_t>(
                 std::count(text.begin(), text.begin() + static_cast<ptrdiff_t>(place), '\n'));
}

DecodedText convert(std::string_view bytes, const std::string &encoding) {
  DecodedText result;
  Conversion conversion(encoding);
  if (!conversion.isOpen()) {
    result.problem = fmt::format("there is no encoding `{}`", encoding);
    return result;
  }
  const size_t done = conversion.convert(bytes, result.text);
  if (done != bytes.size()) {
    result.problem = fmt::format("its byte 16#{:02X} is no character of {}{}",
                                 static_cast<unsigned char>(bytes[done]), encoding, kWayOut);
    result.line = lineOf(bytes, done);
  }
  return result;
}

/// Windows-1252. Its five bytes without a meaning become the control characters of Latin-1: in
/// comments of files that are something else they do no harm.
DecodedText assumed(std::string_view bytes) {
  DecodedText result;
  result.assumed = true;
  Conversion conversion(kAssumed);
  while (!bytes.empty()) {
    const size_t done = conversion.isOpen() ? conversion.convert(bytes, result.text) : 0;
    bytes.remove_prefix(done);
    if (bytes.empty())
      break;
    const auto byte = static_cast<unsigned char>(bytes.front());
    if (byte < 0x80) {
      result.text += bytes.front();
    } else {
      result.text += static_cast<char>(0xC0U | (byte >> 6U));
      result.text += static_cast<char>(0x80U | (byte & 0x3FU));
    }
    bytes.remove_prefix(1);
  }
  return result;
}

struct Mark {
  std::string_view bytes;
  const char *encoding;
};
constexpr std::array<Mark, 3> kMarks = {
    {{"\xEF\xBB\xBF", "UTF-8"}, {"\xFF\xFE", "UTF-16LE"}, {"\xFE\xFF", "UTF-16BE"}}};

DecodedText convertAny(std::string_view bytes, const std::string &encoding) {
  for (const Mark &mark : kMarks)
    if (bytes.starts_with(mark.bytes))
      return convert(bytes.substr(mark.bytes.size()), mark.encoding);
  if (!encoding.empty())
    return convert(bytes, encoding);
  if (validUtf8(bytes) != bytes.size())
    return assumed(bytes);
  DecodedText result;
  result.text = bytes;
  return result;
}

} // namespace

size_t validUtf8(std::string_view text) {
  size_t at = 0;
  const auto byte = [&](size_t place) {
    return place < text.size() ? static_cast<unsigned char>(text[place]) : 0U;
  };
  const auto follows = [&](size_t place, unsigned low, unsigned high) {
    return byte(place) >= low && byte(place) <= high;
  };
  while (at < text.size()) {
    const unsigned lead = byte(at);
    size_t length = 1;
    if (lead >= 0x80) {
      length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
      // Neither longer forms than needed, nor surrogates, nor beyond U+10FFFF.
      const unsigned low = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
      const unsigned high = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
      bool good = lead >= 0xC2 && lead <= 0xF4 && follows(at + 1, low, high);
      for (size_t i = 2; i < length; ++i)
        good = good && follows(at + i, 0x80, 0xBF);
      if (!good)
        return at;
    }
    at += length;
  }
  return text.size();
}

bool isEncoding(const std::string &name) { return Conversion(name).isOpen(); }

DecodedText decoded(std::string_view bytes, const std::string &encoding) {
  DecodedText result = convertAny(bytes, encoding);
  if (!result.problem.empty())
    return result;
  if (const size_t nul = result.text.find('\0'); nul != std::string::npos) {
    result.line = lineOf(result.text, nul);
    result.problem = "it has a NUL character here: it is no text, or of another encoding; name "
                     "that: --encoding utf-16le";
    result.text.clear();
  }
  return result;
}

} // namespace stc::import
