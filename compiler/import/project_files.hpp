#ifndef STRIDE_COMPILER_IMPORT_PROJECT_FILES_HPP
#define STRIDE_COMPILER_IMPORT_PROJECT_FILES_HPP
// The project folder that an import makes, in memory.

#include "compiler/import/model.hpp"

#include <string>
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

/// Where texts that are kept go, below the project's folder.
inline constexpr const char *kKeptFolder = "import/kept/";

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_PROJECT_FILES_HPP
