// golden_runner programs|diagnostics|format|plcopen FILE, golden_runner projects FOLDER,
// golden_runner coverage ROOT. With STRIDE_BLESS=1 in the environment expectations are rewritten.
#include "tests/golden/golden.hpp"
#include "tests/support/text.hpp"

#include <cstdlib>
#include <exception>
#include <iostream>
#include <string_view>

namespace stride::golden {

namespace fs = std::filesystem;

test::ProcessResult runStride(const std::vector<std::string> &arguments,
                              const fs::path &directory) {
  std::vector<std::string> command{STRIDE_BINARY_DIR "/stride"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return test::runProcess(command, directory);
}

std::string outputOf(const test::ProcessResult &result, const fs::path &directory) {
  std::string output = result.out;
  if (!output.empty() && output.back() != '\n')
    output += '\n';
  return test::replaceAll(output + result.err, directory.string(), "<dir>");
}

bool mustFail(const fs::path &name) { return name.filename().string().starts_with("fail_"); }

std::string checkExit(int exitCode, bool failure) {
  constexpr int kFirstSignal = 128;
  if (exitCode < kFirstSignal && (exitCode != 0) == failure)
    return {};
  return "exit code " + std::to_string(exitCode) + ", expected " +
         (failure ? "a failure" : "success") + '\n';
}

static std::string runCase(std::string_view kind, const fs::path &path) {
  const char *variable = std::getenv("STRIDE_BLESS");
  const bool bless = variable != nullptr && std::string_view(variable) == "1";
  if (kind == "programs")
    return runFile(FileKind::Program, path, bless);
  if (kind == "diagnostics")
    return runFile(FileKind::Diagnostics, path, bless);
  if (kind == "format")
    return runFile(FileKind::Format, path, bless);
  if (kind == "projects")
    return runProject(path, bless);
  if (kind == "plcopen")
    return runRoundTrip(path);
  if (kind == "coverage")
    return checkCoverage(path);
  return "unknown kind of golden test\n";
}

} // namespace stride::golden

int main(int argc, char **argv) {
  if (argc != 3) {
    std::cerr
        << "usage: golden_runner programs|diagnostics|format|plcopen|projects|coverage PATH\n";
    return 2;
  }
  try {
    const std::string failure = stride::golden::runCase(argv[1], argv[2]);
    if (failure.empty())
      return 0;
    std::cerr << argv[2] << '\n' << failure;
  } catch (const std::exception &error) {
    std::cerr << argv[2] << '\n' << error.what() << '\n';
  }
  return 1;
}
