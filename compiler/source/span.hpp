#ifndef STRIDE_COMPILER_SOURCE_SPAN_HPP
#define STRIDE_COMPILER_SOURCE_SPAN_HPP
// Places in source text.

#include <cstdint>

namespace stc {

/// Index of a file in the Sources; 0 is "no file".
using FileId = uint32_t;

/// A half-open byte range [begin, end) of one source file.
struct Span {
  FileId file = 0;
  uint32_t begin = 0;
  uint32_t end = 0;

  [[nodiscard]] bool valid() const { return file != 0; }
  /// The smallest span that holds both (both in the same file; an invalid one is ignored).
  [[nodiscard]] Span to(Span other) const {
    if (!valid())
      return other;
    if (!other.valid() || other.file != file)
      return *this;
    return {file, begin < other.begin ? begin : other.begin, end > other.end ? end : other.end};
  }
  bool operator==(const Span &) const = default;
};

/// 1-based line and column (columns count code points, a tab is one).
struct LineColumn {
  uint32_t line = 0;
  uint32_t column = 0;
};

} // namespace stc

#endif // STRIDE_COMPILER_SOURCE_SPAN_HPP
