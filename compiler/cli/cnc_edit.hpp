#ifndef STRIDE_COMPILER_CLI_CNC_EDIT_HPP
#define STRIDE_COMPILER_CLI_CNC_EDIT_HPP
// Commands that change CNC programs.

#include "compiler/cli/commands.hpp"

namespace stc::cli {

/// `stride cnc number`, `rotate`, `shift`, `scale`, `mirror`: gives the program to standard output,
/// to another file, or to its own.
int editCnc(const CncOptions &options);

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_CNC_EDIT_HPP
