#ifndef STRIDE_COMPILER_PROJECT_FORMAT_PROJECT_HPP
#define STRIDE_COMPILER_PROJECT_FORMAT_PROJECT_HPP
// Formatting files as their project wants it.

#include "compiler/source/diagnostic.hpp"
#include "compiler/source/sources.hpp"
#include "compiler/syntax/conditions.hpp"
#include "compiler/syntax/format.hpp"
#include "compiler/toml/schema.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace stc {

/// A source file and its formatted form, both with the bytes of the file's encoding.
struct FormattedFile {
  std::filesystem::path path;
  std::string name;     ///< as messages show it
  bool outside = false; ///< found in a folder, from which a link leads to it
  std::string before;
  std::string after; ///< equal to `before` when it cannot be formatted
};

/// What stride.toml says for formatting: the nearest one in `place` or a folder around it.
struct FormatSettings {
  std::filesystem::path folder;    ///< of the stride.toml; empty: there is none
  std::vector<ConfigName> sources; ///< as ProjectConfig::sources
  FormatStyle style;
  std::vector<Define> defines;
};
[[nodiscard]] FormatSettings readFormatSettings(const std::filesystem::path &place,
                                                Sources &sources, Diagnostics &diagnostics);

/// Formats all sources of a project folder, or one source file. Files with syntax errors stay as
/// they are, and the errors are reported. The encoding of a file (UTF-8 with or without a byte
/// order mark, Latin-1) is kept. Throws std::logic_error when formatting would change what a file
/// says.
[[nodiscard]] std::vector<FormattedFile> formatPath(const std::filesystem::path &path,
                                                    Sources &sources, Diagnostics &diagnostics);

/// Fills `files[].after`; the files belong together.
void formatFiles(std::vector<FormattedFile> &files, const FormatSettings &settings,
                 Sources &sources, Diagnostics &diagnostics);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_FORMAT_PROJECT_HPP
