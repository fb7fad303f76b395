#ifndef STRIDE_COMPILER_CLI_TRACE_TYPES_HPP
#define STRIDE_COMPILER_CLI_TRACE_TYPES_HPP
// What the project that a trace comes from says of its columns.

#include "compiler/plot/plot.hpp"

#include <string>

namespace stc::cli {

/// Gives the columns types, names of states and units. `project`: as the user has named it; empty:
/// the one that the file `trace` lies in, or the current folder. Where there is none, or it has
/// errors, the columns' names are all that is known.
void describeTrace(plot::Trace &trace, const std::string &project, const std::string &file);

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_TRACE_TYPES_HPP
