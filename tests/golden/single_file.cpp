#include "tests/golden/golden.hpp"
#include "tests/support/expectation_block.hpp"
#include "tests/support/text.hpp"

#include <stdexcept>

namespace stride::golden {

namespace fs = std::filesystem;

static std::vector<std::string> commandLine(FileKind kind, const std::string &file,
                                            const std::string &source) {
  const bool program = kind == FileKind::Program;
  std::string options = test::directive(source, "RUN");
  if (options.empty())
    options = program ? "--for T#10ms --print PLC_PRG" : "--color never";
  const char *command = program ? "sim" : kind == FileKind::Format ? "fmt" : "check";
  std::vector<std::string> arguments{command, file};
  for (std::string &word : test::splitWords(options))
    arguments.push_back(std::move(word));
  // Programs show values, often of variables that nothing uses.
  if (program && options.find("-W") == std::string::npos)
    arguments.insert(arguments.end(), {"-W", "off=lints"});
  return arguments;
}

#ifdef STRIDE_ONE_MODE
constexpr bool kOneMode = true;
#else
constexpr bool kOneMode = false;
#endif

/// The options of every mode that the file is run in; the first one is the usual one.
static std::vector<std::vector<std::string>> modesOf(const std::string &source) {
  const std::string modes = test::directive(source, "MODES");
  if (modes.empty() || kOneMode)
    return {{}};
  if (modes == "checked")
    return {{}, {"--debug"}};
  if (modes == "all")
    return {{}, {"--debug"}, {"--unchecked"}, {"--debug", "--unchecked"}};
  throw std::runtime_error("MODES is all or checked, not " + modes);
}

namespace {

/// What a run has printed, and what is wrong with its exit code.
struct Printed {
  std::string command;
  std::string output;
  std::string wrongExit;
};

} // namespace

static Printed runOnce(FileKind kind, const fs::path &file, const std::string &source,
                       const std::vector<std::string> &mode) {
  const test::ScratchDirectory scratch;
  const std::string name = file.filename();
  test::writeFile(scratch.path() / name, source);
  std::vector<std::string> arguments = commandLine(kind, name, source);
  arguments.insert(arguments.end(), mode.begin(), mode.end());
  const test::ProcessResult result = runStride(arguments, scratch.path());
  Printed run;
  run.output = outputOf(result, scratch.path());
  if (kind == FileKind::Format)
    run.output += test::readFile(scratch.path() / name);
  run.wrongExit = checkExit(result.exitCode, mustFail(file));
  run.command = "$ stride";
  for (const std::string &argument : arguments)
    run.command += ' ' + argument;
  return run;
}

std::string runFile(FileKind kind, const fs::path &file, bool bless) {
  test::GoldenText golden = test::splitExpectation(test::readFile(file));
  if (!golden.source.empty() && golden.source.back() != '\n')
    golden.source += '\n';
  std::string wrong;
  for (const std::vector<std::string> &mode : modesOf(golden.source)) {
    const Printed run = runOnce(kind, file, golden.source, mode);
    if (bless && mode.empty() && run.wrongExit.empty()) {
      golden.expected = run.output; // the other modes must print it, too
      const std::string text = test::joinExpectation(golden.source, run.output);
      if (text != test::readFile(file))
        test::writeFile(file, text);
      continue;
    }
    const std::string difference = test::diff(golden.expected, run.output);
    if (!run.wrongExit.empty() || !difference.empty())
      wrong += run.command + '\n' + run.wrongExit + (difference.empty() ? run.output : difference);
  }
  return wrong;
}

} // namespace stride::golden
