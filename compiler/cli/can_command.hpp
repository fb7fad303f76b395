#ifndef STRIDE_COMPILER_CLI_CAN_COMMAND_HPP
#define STRIDE_COMPILER_CLI_CAN_COMMAND_HPP
// `stride can`: what needs no bus. The rest is stride-can, which these commands become.

#include "compiler/cli/commands.hpp"

#include <string>
#include <vector>

namespace stc::cli {

struct CanOptions {
  std::string file; ///< import: EDS, DCF or XDD
  std::string out;  ///< import: where the section goes; empty: standard output
  std::string name; ///< import: of the drive
  int node = 0;     ///< import: wDriveId; 0: what a DCF says, else 1
  std::string dcf;  ///< plan: folder for concise DCFs; empty: none
};

/// `stride can plan`: PDOs, bits and share of the bus of each axis group on CAN.
int canPlanCommand(const ProjectOptions &options, const CanOptions &can);

/// `stride can import`: a section of stride.toml for the device of an electronic data sheet.
int canImportCommand(const CanOptions &can);

/// Becomes stride-can with these arguments.
int becomeCanTool(std::vector<std::string> arguments);

/// `stride can simulate PROJECT …`, `monitor INTERFACE --project PROJECT …`: with the built
/// application in place of the project.
int canProjectCommand(const std::string &command, const ProjectOptions &options,
                      std::vector<std::string> before, std::vector<std::string> after);

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_CAN_COMMAND_HPP
