// `stride-host sim`: an application in virtual time.
#ifndef STRIDE_RUNTIME_HOST_SIMULATION_HPP
#define STRIDE_RUNTIME_HOST_SIMULATION_HPP

#include "runtime/app/application.hpp"
#include "runtime/host/options.hpp"

namespace stride::host {

/// Exit codes of stride-host.
enum ExitCode : int {
  kExitOk = 0,           ///< The run reached its end.
  kExitBadInput = 1,     ///< Command line, application, names, values or files are bad.
  kExitException = 2,    ///< The application was stopped by an exception.
  kExitInterrupted = 130 ///< Ctrl-C or SIGTERM ended the run; the trace up to then is complete.
};

/// Runs it: trace, values to set, values to print (standard output), messages (standard error).
/// Throws app::Error for bad input.
ExitCode simulate(app::Application &application, const SimOptions &options);

} // namespace stride::host

#endif
