#ifndef STRIDE_COMPILER_SYNTAX_LITERALS_HPP
#define STRIDE_COMPILER_SYNTAX_LITERALS_HPP
// Values of literals. Internal to compiler/syntax.

#include "compiler/source/arena.hpp"
#include "compiler/source/diagnostic.hpp"
#include "compiler/syntax/ast.hpp"

#include <string_view>

namespace stc {

/// Reads literals' texts into values; reports malformed ones.
class LiteralReader {
public:
  LiteralReader(Arena &arena, Diagnostics &diagnostics)
      : arena_(arena), diagnostics_(diagnostics) {}

  // Each reads `text` (which lies at `span`) into `out` and returns false after reporting an error.

  /// `42`, `16#FF`
  bool integer(std::string_view text, Span span, ast::Literal &out);
  /// `1.5e-3`
  bool real(std::string_view text, Span span, ast::Literal &out);
  /// `'…'` or `"…"`. With `asBytes` (`UTF8#'…'`) each byte of the source's UTF-8 becomes a
  /// character of the STRING.
  bool string(std::string_view text, Span span, ast::Literal &out, bool asBytes = false);
  /// What stands after the prefix and `#`, which is in lower case: `t`, `ltime`, `d`, `tod`,
  /// `ldt`, …
  bool timeOrDate(std::string_view prefix, std::string_view value, Span span, ast::Literal &out);

private:
  bool duration(std::string_view value, bool isLong, Span span, ast::Literal &out);
  struct Duration;
  bool durationPart(std::string_view &rest, Duration &duration);
  bool fail(Code code, Span span, std::string message, std::string label = {});

  Arena &arena_;
  Diagnostics &diagnostics_;
};

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_LITERALS_HPP
