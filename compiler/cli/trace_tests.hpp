#ifndef STRIDE_COMPILER_CLI_TRACE_TESTS_HPP
#define STRIDE_COMPILER_CLI_TRACE_TESTS_HPP
// The simulations of [[test]], whose traces are compared with those that are expected.

#include "compiler/cli/commands.hpp"
#include "compiler/project/build.hpp"
#include "compiler/project/config.hpp"

#include <string>
#include <vector>

namespace stc::cli {

/// What has come out of a test.
struct TraceResult {
  std::string name;
  std::string expected; ///< the file of the trace that is expected, in the project
  std::string failure;  ///< lines of text; empty: the test has passed
  bool isError = false; ///< the simulation has failed
  bool isNew = false;   ///< the trace has become what is expected
  double seconds = 0;   ///< real
};

/// Simulates the application for each of the tests, one after the other, compares, and says on
/// standard output what came out. With `bless` a trace that differs becomes what is expected.
///
/// A trace that is not as expected is left in `build/tests/NAME.csv` of the project.
[[nodiscard]] std::vector<TraceResult> runTraceTests(const ProjectOptions &options,
                                                     const BuildResult &application,
                                                     const std::vector<TraceTest> &tests,
                                                     bool bless);

/// Adds a suite of these results to the JUnit file, or makes it; `isNew`: what there is goes.
/// False: it cannot be written (errno).
[[nodiscard]] bool addToJunit(const std::string &path, bool isNew, const std::string &suite,
                              const std::vector<TraceResult> &results);

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_TRACE_TESTS_HPP
