#ifndef STRIDE_COMPILER_PROJECT_JOB_POOL_HPP
#define STRIDE_COMPILER_PROJECT_JOB_POOL_HPP
// Running compilers in parallel.

#include <functional>
#include <string>
#include <vector>

namespace stc {

/// A command to run.
struct Job {
  std::vector<std::string> command; ///< program (looked up in PATH) and arguments
  std::string title;                ///< for progress
  std::string folder = {};          ///< where it runs; empty: in ours
  std::string temporary = {};       ///< for its temporary files; empty: as we have it
};

/// How a command ended.
struct JobResult {
  int status = 0;     ///< exit code; 128 + n after signal n; 127 when it could not be started
  std::string output; ///< what it printed on both streams
};

/// Runs all jobs, at most `limit` (0: as many as there are processors) at a time, and waits for
/// them. After a failure no further job is started (its status is then -1). `started` is called
/// before each job with its index.
[[nodiscard]] std::vector<JobResult> runJobs(const std::vector<Job> &jobs,
                                             const std::function<void(size_t)> &started = {},
                                             unsigned limit = 0);

/// The command as a shell would take it.
[[nodiscard]] std::string shellQuoted(const std::vector<std::string> &command);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_JOB_POOL_HPP
