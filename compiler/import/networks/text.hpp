#ifndef STRIDE_COMPILER_IMPORT_NETWORKS_TEXT_HPP
#define STRIDE_COMPILER_IMPORT_NETWORKS_TEXT_HPP
// Pieces of Structured Text as texts: words, precedence, names.

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace stc::import::networks {

/// How strongly operators of Structured Text bind.
enum Precedence : int {
  kOr = 1,
  kXor,
  kAnd,
  kEqual,
  kCompare,
  kSum,
  kProduct,
  kPower,
  kUnary,
  kPrimary
};

/// A piece of an expression.
struct Word {
  enum class Kind { Name, Literal, Symbol, End };
  Kind kind = Kind::End;
  std::string text;
  size_t at = 0; ///< offset in the text
};

/// The words of Structured Text without blanks and comments. `T#5s`, `16#FF` and `'…'` are one
/// word, and so is each of `:=`, `=>`, `<=`, `>=`, `<>`, `**`.
[[nodiscard]] std::vector<Word> wordsOf(std::string_view text);

/// The weakest operator outside brackets.
[[nodiscard]] Precedence precedenceOf(std::string_view text);

/// The variables that a text reads, in lower case: `a.b[i]` reads a and i.
[[nodiscard]] std::set<std::string> rootsOf(std::string_view text);

/// Whether it is a name, perhaps with members and indices: something that can be assigned.
[[nodiscard]] bool isVariable(std::string_view text);
[[nodiscard]] bool isIdentifier(std::string_view text);

[[nodiscard]] std::string_view trim(std::string_view text);

} // namespace stc::import::networks

#endif // STRIDE_COMPILER_IMPORT_NETWORKS_TEXT_HPP
