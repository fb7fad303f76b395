#ifndef STRIDE_COMPILER_IMPORT_INPUT_FILES_HPP
#define STRIDE_COMPILER_IMPORT_INPUT_FILES_HPP
// From files and folders to a model.

#include "compiler/import/model.hpp"

#include <string>
#include <vector>

namespace stc::import {

/// Reads these files, and of folders all files below them whose ending a format has, by their
/// names; hidden files and folders are left out, and a file or folder that several links lead to is
/// read once. `encoding`: see decoded(). What cannot be read is in Model::unreadable.
[[nodiscard]] Model readFiles(const std::vector<std::string> &paths, const std::string &encoding);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_INPUT_FILES_HPP
