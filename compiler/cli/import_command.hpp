#ifndef STRIDE_COMPILER_CLI_IMPORT_COMMAND_HPP
#define STRIDE_COMPILER_CLI_IMPORT_COMMAND_HPP
// `stride import`: a project made of files of another tool.

#include "compiler/cli/terminal.hpp"

#include <string>
#include <vector>

namespace stc::cli {

struct ImportOptions {
  std::vector<std::string> paths; ///< files and folders
  std::string out;                ///< folder of the project; empty: named after the first path
  std::string encoding;           ///< of files that do not say it; empty: see import::decoded()
  std::string addressing;         ///< `words`, `bytes`; empty: as the format has it
  std::string configuration;      ///< the target's .cfg file; empty: none
  bool force = false;             ///< write into a folder that is there
  bool strict = false;            ///< write nothing when something would be left out
  bool library = false;           ///< make a library
  bool format = false;            ///< format the sources
  Output output;
};

/// Exit codes: 0: nothing was left out, and the project has no errors; 1: something was left out,
/// or has errors, or the project could not be written; 2: none of the files could be read.
int importCommand(const ImportOptions &options);

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_IMPORT_COMMAND_HPP
