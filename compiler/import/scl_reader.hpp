#ifndef STRIDE_COMPILER_IMPORT_SCL_READER_HPP
#define STRIDE_COMPILER_IMPORT_SCL_READER_HPP
// Sources of Siemens SCL: `.scl`, `.udt`, `.db`.

#include "compiler/import/model.hpp"

#include <string>
#include <string_view>

namespace stc::import {

/// Whether the text is an SCL source rather than other ST.
[[nodiscard]] bool isScl(std::string_view text);

/// Adds the blocks of a source, rewritten word by word: names lose `#` and quotes, headers and
/// regions become comments, structures without a name become types. What has no counterpart stays
/// as it is, so that the compiler refuses it, and is named in a remark.
void readScl(const std::string &file, std::string_view text, Model &model);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_SCL_READER_HPP
