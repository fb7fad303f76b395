#ifndef STRIDE_COMPILER_IMPORT_SCL_VIEWS_HPP
#define STRIDE_COMPILER_IMPORT_SCL_VIEWS_HPP
// Views of Siemens SCL (`b AT w : Array[0..1] of Byte`) whose parts are smaller than the variable.
// Internal to compiler/import.

#include "compiler/import/scl_tokens.hpp"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace stc::import {

/// The variable as a bit string, and where the parts of a view lie in it. A CPU of Siemens stores
/// the high byte first: byte 0 of a view of a WORD is `.%B1` of the WORD.
struct SclViewParts {
  std::string_view type; ///< bit string of the variable's size
  /// What stands for a part, without the point before it (`13`, `%B1`, `%W0`): by the index without
  /// leading zeros, or by the member's name in lower case.
  std::map<std::string, std::string, std::less<>> parts;
};

/// The parts of a view of type `as`: an array of BOOL, BYTE or WORD with literal bounds, or a
/// structure of such members, whose text `TYPE … STRUCT … END_STRUCT` is `structure` (else empty).
/// `of`: the variable's elementary type of 1 to 8 bytes. Nothing: another view, or it is larger.
[[nodiscard]] std::optional<SclViewParts>
sclViewParts(std::string_view as, std::string_view structure, std::string_view of);

/// The part that is named after token `at` of a view: by `[5]` or `.member`. `end` is after it.
/// Null: another use of the view.
[[nodiscard]] const std::string *
sclViewPartAt(const SclViewParts &view, std::span<const SclToken> tokens, size_t at, size_t &end);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_SCL_VIEWS_HPP
