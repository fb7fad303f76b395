// Running a command and catching what it prints.
#ifndef STRIDE_TESTS_SUPPORT_PROCESS_HPP
#define STRIDE_TESTS_SUPPORT_PROCESS_HPP

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace stride::test {

/// What a finished command left behind.
struct ProcessResult {
  int exitCode = 0; ///< the exit status; 128 + n when signal n ended it
  std::string out;  ///< standard output
  std::string err;  ///< standard error
};

/// Runs `arguments` (the first is the program, looked up in PATH) in `directory` with no standard
/// input, no colour and `environment` added to ours, and waits for its end. The command is killed
/// when we are. Throws std::runtime_error when it cannot be started.
ProcessResult runProcess(const std::vector<std::string> &arguments,
                         const std::filesystem::path &directory,
                         const std::vector<std::pair<std::string, std::string>> &environment = {});

/// As runProcess, but as the first process on a terminal of its own, which all three files are;
/// what it shows is `out`.
ProcessResult
runOnTerminal(const std::vector<std::string> &arguments, const std::filesystem::path &directory,
              const std::vector<std::pair<std::string, std::string>> &environment = {});

} // namespace stride::test

#endif // STRIDE_TESTS_SUPPORT_PROCESS_HPP
