#ifndef STRIDE_COMPILER_IMPORT_ENCODING_HPP
#define STRIDE_COMPILER_IMPORT_ENCODING_HPP
// From the bytes of other tools' files to UTF-8.

#include <cstddef>
#include <string>
#include <string_view>

namespace stc::import {

/// A file's text.
struct DecodedText {
  std::string text;     ///< UTF-8 without a byte order mark
  bool assumed = false; ///< nothing in the file says its encoding: it was taken for Windows-1252
  std::string problem;  ///< why there is no text, and the way out; empty: there is one
  size_t line = 1;      ///< of the problem
};

/// `encoding`: a name that iconv knows (`cp1251`, `latin1`, `cp850`, `utf-16le`); empty: UTF-8 or
/// UTF-16 by the byte order mark, UTF-8 if the bytes are valid, else Windows-1252. A byte order
/// mark goes before `encoding`. NUL characters are refused.
[[nodiscard]] DecodedText decoded(std::string_view bytes, const std::string &encoding);

/// Whether iconv knows the name.
[[nodiscard]] bool isEncoding(const std::string &name);

/// The part of `text` up to which it is valid UTF-8; all of it when it is.
[[nodiscard]] size_t validUtf8(std::string_view text);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_ENCODING_HPP
