// Tokens of a line: what expressions and declarations consist of. Free of the C++ standard
// library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_NC_TOKEN_HPP
#define STRIDE_RUNTIME_NUMERIC_NC_TOKEN_HPP

#include "runtime/numeric/nc/program_line.hpp"

namespace stride::nc {

/// Characters of a name at most: of a variable, a local variable, a subprogram.
inline constexpr int32_t kMostName = 80;
/// Characters of a text at most.
inline constexpr int32_t kMostText = 255;

enum class TokenKind : uint8_t {
  End,
  Name,     ///< Letters, digits, `_`.
  Number,   ///< Without a sign.
  Variable, ///< `$name$`
  Local,    ///< `#name`
  Text,     ///< `'…'`
  Symbol,   ///< One of + - * / = < > , : ! ? or `<>`, `<=`, `>=`, `:=`: `symbol`.
  Open,     ///< `{`, and `(` where it is no comment.
  Close,
  Bad, ///< `error`
};

/// A symbol of two characters as a number.
constexpr uint16_t symbol(char first, char second = 0) noexcept {
  return static_cast<uint16_t>(static_cast<uint8_t>(first) |
                               static_cast<uint32_t>(static_cast<uint8_t>(second)) << 8U);
}

struct Token {
  TokenKind kind;
  uint16_t symbol;
  int32_t start;  ///< Index of its first character; of names between signs: of the name.
  int32_t length; ///< Of the name or the text.
  int32_t at;     ///< Index where the token begins.
  int32_t end;    ///< Index after it.
  double number;
  Error error;
};

/// The token that begins at this index, or after the blanks there.
Token tokenAt(const ProgramLine &line, int32_t index) noexcept;

/// Index of the first character from `index` on that is no blank.
int32_t skipBlanks(const ProgramLine &line, int32_t index) noexcept;

/// Whether a name is this word, in any case; `word` is in upper case.
bool isWordText(const ProgramLine &line, const Token &token, const char *word) noexcept;

inline bool isLetter(char c) noexcept { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
inline bool isDigit(char c) noexcept { return c >= '0' && c <= '9'; }
inline char upperCase(char c) noexcept {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

} // namespace stride::nc

#endif // STRIDE_RUNTIME_NUMERIC_NC_TOKEN_HPP
