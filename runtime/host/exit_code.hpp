// How stride-host ends.
#ifndef STRIDE_RUNTIME_HOST_EXIT_CODE_HPP
#define STRIDE_RUNTIME_HOST_EXIT_CODE_HPP

namespace stride::host {

/// Exit codes of stride-host.
enum ExitCode : int {
  kExitOk = 0,         ///< The run reached its end, or was asked to end (run).
  kExitBadInput = 1,   ///< Command line, application, names, values or files are bad.
  kExitException = 2,  ///< An application was stopped by an exception.
  kExitFatal = 3,      ///< The runtime itself could not go on: its memory is damaged.
  kExitIncomplete = 4, ///< The run reached its end, but output that was asked for is not complete.
  kExitInterrupted =
      130 ///< Ctrl-C or SIGTERM ended a simulation; the trace up to then is complete.
};

} // namespace stride::host

#endif
