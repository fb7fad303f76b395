// Which of the applications of a run the names on the command line mean.
#ifndef STRIDE_RUNTIME_HOST_APPLICATION_OPTIONS_HPP
#define STRIDE_RUNTIME_HOST_APPLICATION_OPTIONS_HPP

#include "runtime/app/application.hpp"
#include "runtime/host/options.hpp"

#include <memory>
#include <string>
#include <vector>

namespace stride::host {

/// What the options of a run say about one application.
struct ApplicationOptions {
  std::vector<std::string> print;
  std::vector<std::string> trace;
  std::string out;    ///< File of its trace; empty or "-": standard output.
  std::string script; ///< File; empty: none.
};

/// By application: `NAME:PATH` is a variable of the application NAME, `PATH` of the first one that
/// has it; `NAME=FILE` is the script of NAME, `FILE` of the first one. Throws app::Error for what
/// there is not, or twice.
std::vector<ApplicationOptions>
optionsByApplication(const std::vector<std::unique_ptr<app::Application>> &applications,
                     const RunOptions &options);

} // namespace stride::host

#endif
