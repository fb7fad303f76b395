#ifndef STRIDE_COMPILER_PROJECT_LIBRARY_SOURCES_HPP
#define STRIDE_COMPILER_PROJECT_LIBRARY_SOURCES_HPP
// The texts of libraries of the user's own as trees.

#include "compiler/project/config.hpp"
#include "compiler/semantics/program.hpp"

#include <filesystem>
#include <vector>

namespace stc {

/// Finds, reads and parses the libraries that a project uses: Program::librarySources, uses and
/// parameters. `folder`: the project's. False: something is missing, which has been reported.
bool readLibraries(Program &program, const ProjectConfig &config,
                   const std::filesystem::path &folder, const LibraryIndex &index);

/// Reports what a library cannot hold: what belongs to one application.
void checkLibraryContent(const std::vector<ast::File *> &files, Diagnostics &diagnostics);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_LIBRARY_SOURCES_HPP
