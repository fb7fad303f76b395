#ifndef STRIDE_COMPILER_IMPORT_READER_HPP
#define STRIDE_COMPILER_IMPORT_READER_HPP
// Which reader reads which file.

#include "compiler/import/model.hpp"

#include <span>
#include <string>
#include <string_view>

namespace stc::import {

/// A format that projects are imported from. Rows of a table in reader.cpp.
struct Format {
  std::string_view name;       ///< as documents call it
  std::string_view extensions; ///< in lower case with the dot, apart by a blank: `.exp .txt`
  /// Whether the beginning of the content is of this format; for files whose ending several
  /// formats have.
  bool (*matches)(std::string_view text);
  /// Adds what the file holds to the model; `text` is UTF-8. What is not imported becomes a remark
  /// in Model::leftOut. A file that cannot be read as a whole adds to Model::unreadable.
  void (*read)(const std::string &file, std::string_view text, Model &model);
};

/// All formats, for documents and messages.
[[nodiscard]] std::span<const Format> formats();

/// What to read a file with.
struct FormatChoice {
  const Format *format = nullptr; ///< none: the file is refused
  std::string refusal;            ///< why, and the way out
  bool known = false;             ///< refused, but it is a file of a project tool
};

/// By the ending of the name, then by the content.
[[nodiscard]] FormatChoice formatOf(std::string_view file, std::string_view text);

/// As formatOf when only the name is known: whether a folder's file is worth reading at all.
[[nodiscard]] bool hasKnownExtension(std::string_view file);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_READER_HPP
