#ifndef STRIDE_COMPILER_SYNTAX_LITERAL_TEXT_HPP
#define STRIDE_COMPILER_SYNTAX_LITERAL_TEXT_HPP
// What all kinds of literals need to be read. Internal to compiler/syntax.

#include "compiler/source/identifier.hpp"
#include "compiler/syntax/characters.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace stc {

inline constexpr uint64_t kMax64 = std::numeric_limits<uint64_t>::max();

/// 0 to 35 for a digit or a letter; 99: neither.
inline int digitValue(char c) {
  if (isDigit(c))
    return c - '0';
  const char lower = lowerCase(c);
  return lower >= 'a' && lower <= 'z' ? lower - 'a' + 10 : 99;
}

/// In backquotes; the beginning of a long text.
inline std::string quoteLiteral(std::string_view text) {
  std::string out(text.substr(0, 60));
  return "`" + out + (text.size() > 60 ? "…`" : "`");
}

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_LITERAL_TEXT_HPP
