#ifndef STRIDE_COMPILER_PROJECT_AXES_GROUP_SOURCES_HPP
#define STRIDE_COMPILER_PROJECT_AXES_GROUP_SOURCES_HPP
// The groups of [[axes_group]] as Structured Text.

#include "compiler/project/config.hpp"

#include <string>

namespace stc {

/// Declares a global variable for each group: an AXIS_GROUP_REF_SM3 that has its axes, kinematics,
/// tool and coordinate systems. Its kinematics is its output `Trafo`. A hidden program, which is
/// the last one of the task of its axes, lets it go on in each cycle. What is wrong is reported;
/// then the result is not to be used.
[[nodiscard]] SyntheticSource axesGroupDeclarations(Program &program, ProjectConfig &config,
                                                    const std::vector<ast::File *> &files,
                                                    const LibraryIndex &index);

/// How a run traces a group: what it writes into a variable, and what it records.
struct GroupTrace {
  std::string name;
  std::string assignment; ///< `Robot.bTrace=TRUE`
  std::string columns;    ///< names with commas between them
};
[[nodiscard]] GroupTrace groupTrace(const AxesGroupConfig &group);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_AXES_GROUP_SOURCES_HPP
