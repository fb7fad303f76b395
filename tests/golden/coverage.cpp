#include "tests/golden/golden.hpp"
#include "tests/support/expectation_block.hpp"
#include "tests/support/text.hpp"

#include <regex>

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

// Every case that must fail says with its first lines what is wrong and where:
//     error[SE0301]: cannot find `x`
//      --> fail_x.st:3:1
static std::string checkFirstLines(const fs::path &folder) {
  std::string report;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("fail_") || entry.path().extension() != ".st")
      continue;
    const std::vector<std::string> lines =
        test::splitLines(test::splitExpectation(test::readFile(entry.path())).expected);
    static const std::regex kCode(R"((error|warning|note)\[SE\d{4}\]: .+)");
    static const std::regex kPlace(R"( *--> \S+:\d+:\d+)");
    // A file that is no text has no lines.
    const bool placed = lines.size() > 1 && std::regex_match(lines[1], kPlace);
    const bool whole = !lines.empty() && lines[0].starts_with("error[SE0102]");
    if (lines.empty() || !std::regex_match(lines[0], kCode) || !(placed || whole))
      report += name + " does not begin with a code and a place\n";
  }
  return report;
}

std::string checkCoverage(const fs::path &root) {
  const test::ProcessResult list = runStride({"explain", "--list"}, root);
  if (list.exitCode != 0 || list.out.empty())
    return "`stride explain --list` failed or printed nothing\n" + list.err;
  const std::string expectations = allExpectations(root);
  std::string report;
  for (const std::string &line : test::splitLines(list.out)) {
    const std::string code = line.substr(0, line.find(' '));
    if (code.starts_with("SE") && expectations.find("[" + code + "]") == std::string::npos)
      report += code + " has no golden test\n";
    const test::ProcessResult text = runStride({"explain", code}, root);
    if (text.exitCode != 0 || test::splitLines(test::canonical(text.out)).size() < 2)
      report += code + " has no text in `stride explain`\n";
  }
  return report + checkFirstLines(root / "diagnostics");
}

} // namespace stride::golden
