#ifndef STRIDE_COMPILER_CLI_CNC_PROJECT_HPP
#define STRIDE_COMPILER_CLI_CNC_PROJECT_HPP
// What the project of a CNC file says of it, for commands on the file alone.

#include "compiler/assets/cnc/cnc_source.hpp"

#include <string>

namespace stc::cli {

/// The section [[cnc]] about a file, of the project that it lies in; defaults where there is none.
/// `softMotion3` is as the command says (`2.3`, `3`, or nothing), or the project. What is wrong
/// with the project is not reported: it is not what is looked at.
[[nodiscard]] CncSettings projectSettings(const std::string &path, const std::string &softMotion);

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_CNC_PROJECT_HPP
