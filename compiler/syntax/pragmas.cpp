#include "compiler/syntax/pragmas.hpp"

#include "compiler/source/identifier.hpp"

#include <algorithm>
#include <iterator>

namespace stc {

namespace {

constexpr PragmaRow kPragmas[] = {
#define STC_PRAGMA(enumerator, word, example, text) {word, example, text},
#include "compiler/syntax/pragmas.def"
};

constexpr bool isPragmaOnce(const PragmaRow &row) {
  return row.example.empty() == row.text.empty() &&
         std::count_if(std::begin(kPragmas), std::end(kPragmas),
                       [&](const PragmaRow &other) { return other.word == row.word; }) == 1;
}
static_assert(std::all_of(std::begin(kPragmas), std::end(kPragmas), isPragmaOnce),
              "a word stands twice in pragmas.def, or has an example without a text");

} // namespace

std::span<const PragmaRow> pragmaRows() { return kPragmas; }

PragmaWord findPragma(std::string_view word) {
  const auto found =
      std::find_if(std::begin(kPragmas), std::end(kPragmas),
                   [&](const PragmaRow &row) { return equalIgnoringCase(row.word, word); });
  return found == std::end(kPragmas) ? PragmaWord::None
                                     : static_cast<PragmaWord>(found - std::begin(kPragmas) + 1);
}

} // namespace stc
