#ifndef STRIDE_COMPILER_CLI_RUN_PROJECT_HPP
#define STRIDE_COMPILER_CLI_RUN_PROJECT_HPP
// From a project to a run of it: what the commands that become stride-host have in common.

#include "compiler/cli/commands.hpp"
#include "compiler/project/build.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stc::cli {

/// Opens and builds the project and shows its diagnostics; nothing when there is nothing to run.
/// `exitCode` is that of the command then. `hostArguments`: what the user has said for the run; its
/// folder for files gets those that the project's CNC programs become, too.
[[nodiscard]] std::optional<BuildResult> buildToRun(const ProjectOptions &options, BuildUse use,
                                                    int &exitCode,
                                                    const std::vector<std::string> &hostArguments);

/// What stride-host is given to do `command` (sim, run) with the application; `own`: what the user
/// has said. Nothing: links of the project lead out of it, or there is no place for its socket,
/// which is shown.
[[nodiscard]] std::optional<std::vector<std::string>>
hostArgumentsOf(const ProjectOptions &options, const std::string &command,
                const BuildResult &result, const std::vector<std::string> &own);

/// Replaces this program by another one; returns only when that fails. The first of the arguments
/// is the name by which it knows itself. `remedy`: what to do then.
int become(const std::string &program, std::vector<std::string> arguments, const Output &output,
           std::string_view remedy = {});

/// Where stride-host is.
[[nodiscard]] std::string hostProgram();

/// Runs stride-host, which writes to this program's outputs, and returns its exit code.
int runHost(std::vector<std::string> arguments, const Output &output);

/// Becomes stride-host; returns only when that fails. Before a run signals that it takes must be
/// held: the first of them would end it.
int becomeHost(std::vector<std::string> arguments, const Output &output);
void holdSignalsOfRuns();

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_RUN_PROJECT_HPP
