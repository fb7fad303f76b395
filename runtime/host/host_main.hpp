// The program around one or no built-in application.
#ifndef STRIDE_RUNTIME_HOST_HOST_MAIN_HPP
#define STRIDE_RUNTIME_HOST_HOST_MAIN_HPP

#include "runtime/app/abi.h"

namespace stride::host {

/// Reads the command line and runs it; returns the exit code. With `builtIn` (an application linked
/// into this program) no application is named on the command line.
int hostMain(int argc, const char *const *argv, const StrideAppV1 *builtIn);

} // namespace stride::host

#endif
