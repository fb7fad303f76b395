// `stride-host run`: applications by the real clock.
#ifndef STRIDE_RUNTIME_HOST_REAL_RUN_HPP
#define STRIDE_RUNTIME_HOST_REAL_RUN_HPP

#include "runtime/app/application.hpp"
#include "runtime/host/exit_code.hpp"
#include "runtime/host/messages.hpp"
#include "runtime/host/options.hpp"

#include <memory>
#include <vector>

namespace stride::host {

/// Runs them side by side until the time is over, SIGINT or SIGTERM comes, or all have stopped with
/// an exception. SIGUSR1 shows the statistics. Values to print go to standard output. What cannot
/// be written does not end a run; SIGINT, SIGTERM, SIGUSR1 and SIGHUP stay blocked. Throws
/// app::Error for bad input.
ExitCode runReal(std::vector<std::unique_ptr<app::Application>> applications,
                 const RunOptions &options, Messages &messages);

} // namespace stride::host

#endif
