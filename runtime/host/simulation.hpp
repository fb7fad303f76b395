// `stride-host sim`: an application in virtual time.
#ifndef STRIDE_RUNTIME_HOST_SIMULATION_HPP
#define STRIDE_RUNTIME_HOST_SIMULATION_HPP

#include "runtime/app/application.hpp"
#include "runtime/host/exit_code.hpp"
#include "runtime/host/messages.hpp"
#include "runtime/host/options.hpp"

#include <memory>

namespace stride::host {

/// Runs it: trace, values to set, values to print (standard output), messages (standard error).
/// Throws app::Error for bad input.
ExitCode simulate(std::unique_ptr<app::Application> application, const SimOptions &options,
                  Messages &messages);

} // namespace stride::host

#endif
