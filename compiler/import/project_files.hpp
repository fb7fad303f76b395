#ifndef STRIDE_COMPILER_IMPORT_PROJECT_FILES_HPP
#define STRIDE_COMPILER_IMPORT_PROJECT_FILES_HPP
// The project folder that an import makes, in memory.

#include "compiler/import/model.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stc::import {

struct ProjectFile {
  std::string path; ///< relative to the project's folder, with `/`
  std::string text;
};

/// What the user wants of it.
struct ProjectSettings {
  std::string name;
  bool library = false; ///< a library instead of an application: neither tasks nor drives
};

/// A source for each object, in the order of the model, the variables of inputs and outputs, texts
/// that are kept, and last stride.toml. No two paths are the same, whether or not capital letters
/// count, and none leaves the folder.
[[nodiscard]] std::vector<ProjectFile> projectFiles(const Model &model,
                                                    const ProjectSettings &settings);

/// The text as a string of TOML.
[[nodiscard]] std::string tomlText(std::string_view text);
/// The number as a float of TOML, which tells 1.0 from 1. It must be finite.
[[nodiscard]] std::string tomlNumber(double value);
/// A number of another tool (`007`, `.5`, `5.`, `1E3`) as one of TOML: an integer stays one. None:
/// it is no finite number as a whole.
[[nodiscard]] std::optional<std::string> tomlNumber(std::string_view text);

/// Where texts that are kept go, below the project's folder.
inline constexpr const char *kKeptFolder = "import/kept/";

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_PROJECT_FILES_HPP
