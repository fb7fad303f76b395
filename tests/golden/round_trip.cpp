// A program exported as PLCopen XML and imported again prints what it printed before.
#include "tests/golden/golden.hpp"
#include "tests/support/expectation_block.hpp"
#include "tests/support/text.hpp"

namespace stride::golden {

namespace fs = std::filesystem;

std::string runRoundTrip(const fs::path &file) {
  const test::GoldenText golden = test::splitExpectation(test::readFile(file));
  const test::ScratchDirectory scratch;
  const std::string name = file.filename();
  fs::create_directories(scratch.path() / "from");
  test::writeFile(scratch.path() / "from" / name, golden.source);
  const auto run = [&](const std::vector<std::string> &arguments, const fs::path &folder) {
    const test::ProcessResult result = runStride(arguments, folder);
    return result.exitCode == 0 ? std::string() : outputOf(result, scratch.path());
  };
  const fs::path from = scratch.path() / "from";
  if (const std::string wrong =
          run({"export", "plcopen", name, "-o", "all.xml", "-W", "off=all-warnings"}, from);
      !wrong.empty())
    return "stride export plcopen\n" + wrong;
  // With exit code 1 something would have been left out.
  if (const std::string wrong = run({"import", "all.xml", "-o", "../to"}, from); !wrong.empty())
    return "stride import\n" + wrong + test::readFile(scratch.path() / "to" / "import-report.md");
  std::string options = test::directive(golden.source, "RUN");
  if (options.empty())
    options = "--for T#10ms --print PLC_PRG";
  std::vector<std::string> arguments{"sim", ".", "-W", "off=lints"};
  for (std::string &word : test::splitWords(options))
    arguments.push_back(std::move(word));
  const test::ProcessResult result = runStride(arguments, scratch.path() / "to");
  const std::string difference =
      test::diff(golden.expected, outputOf(result, scratch.path() / "to"));
  return difference.empty() ? difference : "stride sim\n" + difference;
}

} // namespace stride::golden
