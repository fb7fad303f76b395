#ifndef STRIDE_COMPILER_IMPORT_SCL_TOKENS_HPP
#define STRIDE_COMPILER_IMPORT_SCL_TOKENS_HPP
// Tokens of Siemens SCL. Internal to compiler/import.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace stc::import {

/// What a piece of SCL is.
enum class SclKind {
  Blank,     ///< blanks and ends of lines
  Comment,   ///< with its signs
  Word,      ///< keyword or name
  Quoted,    ///< `"a name"`: of something global
  Local,     ///< `#name`, `#"a name"`
  Literal,   ///< number, or a constant with the name of its type: `T#5s`, `W#16#FF`
  Text,      ///< `'…'`
  Attribute, ///< `{ … }`
  Sign,      ///< all else, one operator each
};

struct SclToken {
  SclKind kind = SclKind::Sign;
  std::string_view text;
  size_t line = 1; ///< from 1
};

/// All of the text, in order: joined, the tokens are the text again.
[[nodiscard]] std::vector<SclToken> sclTokens(std::string_view text);

/// The name without `#` and quotes.
[[nodiscard]] std::string_view sclName(const SclToken &token);
/// Whether the token is this word (in capital letters), in any case of letters.
[[nodiscard]] bool isSclWord(const SclToken &token, std::string_view capital);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_SCL_TOKENS_HPP
