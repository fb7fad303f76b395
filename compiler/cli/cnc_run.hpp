#ifndef STRIDE_COMPILER_CLI_CNC_RUN_HPP
#define STRIDE_COMPILER_CLI_CNC_RUN_HPP
// What `stride cnc run` and `stride cnc plot` do with a program that has been read.

#include "compiler/assets/cnc/cnc_source.hpp"
#include "compiler/cli/commands.hpp"

#include <string>

namespace stc::cli {

/// Drives the program and writes the set positions of each cycle; `says` becomes a summary. What is
/// wrong is reported.
void runCnc(const std::string &file, CncProgram &program, const CncOptions &options,
            Diagnostics &diagnostics, std::string &says);

/// Drives the program and draws its path, velocity, acceleration and jerk.
void plotCnc(const std::string &file, CncProgram &program, const CncOptions &options,
             Diagnostics &diagnostics, std::string &says);

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_CNC_RUN_HPP
