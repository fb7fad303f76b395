#ifndef STRIDE_COMPILER_PROJECT_CNC_CONFIG_HPP
#define STRIDE_COMPILER_PROJECT_CNC_CONFIG_HPP
// The CNC programs of a project.

#include "compiler/project/config.hpp"
#include "compiler/semantics/program.hpp"
#include "compiler/toml/schema.hpp"

#include <vector>

namespace stc {

/// Reads a section [[cnc]].
void readCncSection(const CheckedSection &section, ProjectConfig &config, Diagnostics &diagnostics);

/// Reads and checks the CNC files, and declares their variables. What is wrong is reported; the
/// caller asks the diagnostics.
[[nodiscard]] SyntheticSource declareCncPrograms(Program &program, const ProjectConfig &config,
                                                 const std::vector<FileId> &cncFiles,
                                                 const std::vector<ast::File *> &files);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_CNC_CONFIG_HPP
