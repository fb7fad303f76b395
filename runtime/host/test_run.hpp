// `stride-host test`: the unit tests that `stride test` has built.
#ifndef STRIDE_RUNTIME_HOST_TEST_RUN_HPP
#define STRIDE_RUNTIME_HOST_TEST_RUN_HPP

#include "runtime/host/messages.hpp"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace stride::host {

/// Runs each test in an application of its own, in virtual time, and says what came out of it: a
/// line per test, what failed, a summary; a JUnit file.
class TestCommand {
public:
  void declare(CLI::App &command);
  /// The exit code: kExitOk exactly when no test has failed. Throws app::Error for bad input.
  int run(Messages &messages);

private:
  std::string application_;
  std::string root_ = ".";
  std::string suite_;
  std::string files_;
  std::string junit_;
  std::vector<std::string> tests_;
};

} // namespace stride::host

#endif
