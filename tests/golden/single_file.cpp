#include "tests/golden/golden.hpp"
#include "tests/support/expectation_block.hpp"
#include "tests/support/text.hpp"

namespace stride::golden {

namespace fs = std::filesystem;

static std::vector<std::string> commandLine(FileKind kind, const std::string &file,
                                            const std::string &source) {
  const bool program = kind == FileKind::kProgram;
  std::string options = test::directive(source, "RUN");
  if (options.empty())
    options = program ? "--for T#10ms --print PLC_PRG" : "--color never";
  const char *command = program ? "sim" : kind == FileKind::kFormat ? "fmt" : "check";
  std::vector<std::string> arguments{command, file};
  for (std::string &word : test::splitWords(options))
    arguments.push_back(std::move(word));
  // Programs show values, often of variables that nothing uses.
  if (program && options.find("-W") == std::string::npos)
    arguments.insert(arguments.end(), {"-W", "off=lints"});
  return arguments;
}

std::string runFile(FileKind kind, const fs::path &file, bool bless) {
  test::GoldenText golden = test::splitExpectation(test::readFile(file));
  if (!golden.source.empty() && golden.source.back() != '\n')
    golden.source += '\n';
  const test::ScratchDirectory scratch;
  const std::string name = file.filename();
  test::writeFile(scratch.path() / name, golden.source);

  const std::vector<std::string> arguments = commandLine(kind, name, golden.source);
  const test::ProcessResult result = runStride(arguments, scratch.path());
  std::string output = outputOf(result, scratch.path());
  if (kind == FileKind::kFormat)
    output += test::readFile(scratch.path() / name);
  const std::string wrongExit = checkExit(result.exitCode, mustFail(file));
  if (bless && wrongExit.empty()) {
    const std::string text = test::joinExpectation(golden.source, output);
    if (text != test::readFile(file))
      test::writeFile(file, text);
    return {};
  }
  const std::string difference = test::diff(golden.expected, output);
  if (wrongExit.empty() && difference.empty())
    return {};
  std::string report = "$ stride";
  for (const std::string &argument : arguments)
    report += ' ' + argument;
  return report + '\n' + wrongExit + (difference.empty() ? output : difference);
}

} // namespace stride::golden
