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

/// A source for each object, stride.toml, and last import-report.md. No two paths are the same,
/// whether or not capital letters count. `name`: of the project.
[[nodiscard]] std::vector<ProjectFile> projectFiles(const Model &model, const std::string &name);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_PROJECT_FILES_HPP
