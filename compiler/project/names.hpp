#pragma once
// Names of Structured Text, as far as the configuration has to do with them.

#include "compiler/source/identifier.hpp"

#include <string>
#include <string_view>

namespace stc {

[[nodiscard]] bool equalIgnoringCase(std::string_view a, std::string_view b);

/// A word that can never be an identifier, whatever its case.
[[nodiscard]] bool isReservedWord(std::string_view text);
/// Letters, digits and single underscores, beginning with a letter or underscore, no reserved word.
[[nodiscard]] bool isIdentifier(std::string_view text);

} // namespace stc
