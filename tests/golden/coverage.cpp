#include "tests/golden/golden.hpp"
#include "tests/support/expectation_block.hpp"
#include "tests/support/text.hpp"

namespace stride::golden {

namespace fs = std::filesystem;

// All expected outputs below `root` in one text.
static std::string allExpectations(const fs::path &root) {
  std::string all;
  for (const fs::directory_entry &entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() == ".st")
      all += test::splitExpectation(test::readFile(entry.path())).expected;
    else if (entry.path().extension() == ".txt")
      all += test::readFile(entry.path());
  }
  // What needs a broken tool chain is shown by the system tests.
  for (const fs::directory_entry &entry : fs::directory_iterator(root.parent_path() / "system"))
    if (entry.path().extension() == ".cpp")
      all += test::readFile(entry.path());
  return all;
}

std::string checkCoverage(const fs::path &root) {
  const test::ProcessResult list = runStride({"explain", "--list"}, root);
  if (list.exitCode != 0 || list.out.empty())
    return "`stride explain --list` failed or printed nothing\n" + list.err;
  const std::string expectations = allExpectations(root);
  std::string report;
  for (const std::string &line : test::splitLines(list.out)) {
    const std::string code = line.substr(0, line.find(' '));
    if (expectations.find("[" + code + "]") == std::string::npos)
      report += code + " has no golden test\n";
    const test::ProcessResult text = runStride({"explain", code}, root);
    if (text.exitCode != 0 || test::splitLines(test::canonical(text.out)).size() < 2)
      report += code + " has no text in `stride explain`\n";
  }
  return report;
}

} // namespace stride::golden
