#ifndef STRIDE_COMPILER_IMPORT_ST_WORDS_HPP
#define STRIDE_COMPILER_IMPORT_ST_WORDS_HPP
// Words of ST (or IL, or textual SFC) without its grammar: enough to find and to replace names.

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace stc::import {

/// A piece of a source text.
struct StWord {
  enum class Kind {
    Name,    ///< an identifier or a keyword
    Number,  ///< also `16#FF`, `5ms`: what begins with a digit
    Address, ///< `%IX0.3`
    Sign,    ///< one character that is none of the others
  };
  Kind kind = Kind::Sign;
  size_t begin = 0;
  size_t end = 0;
};

/// All pieces in order; comments (nested, as Stride reads them), texts, and pragmas are left out.
[[nodiscard]] std::vector<StWord> wordsOf(std::string_view text);

/// Replaces the pieces for which `by` gives a text; the rest stays to the letter.
[[nodiscard]] std::string
replaceWords(std::string_view text,
             const std::function<std::string(const StWord &, std::string_view)> &by);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_ST_WORDS_HPP
