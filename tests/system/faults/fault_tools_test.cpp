// Every tool with every call of the system that writes failing in turn: it says so, and what was
// there before is there still.
#include "tests/support/fault_injection.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace stride::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A command in a folder that holds p (a project), a.st, a.cam.toml and t.csv.
struct Tool {
  const char *name;
  std::vector<std::string> arguments;
  unsigned most = 12; ///< Calls of a class that fail, of many.
};

void PrintTo(const Tool &tool, std::ostream *out) { *out << tool.name; }

const std::vector<Tool> &tools() {
  static const std::vector<Tool> all = {
      {"new", {"new", "fresh"}},
      {"fmt", {"fmt", "a.st"}},
      {"fmtStdout", {"fmt", "--diff", "a.st"}},
      {"doc", {"doc", "p", "-o", "pages"}, 6},
      {"plot", {"plot", "t.csv", "-o", "old.svg"}},
      {"camPlot", {"cam", "plot", "a.cam.toml", "-o", "old.svg"}},
      {"camExport", {"cam", "export", "a.cam.toml", "-o", "old.csv"}},
      {"camWrite", {"cam", "write", "a.cam.toml", "-o", "old.bin"}},
      {"camCheck", {"cam", "check", "a.cam.toml"}},
      {"explain", {"explain", "SE0203"}},
      {"check", {"check", "a.st", "--format=json"}},
      {"build", {"build", "p", "-o", "old.so"}, 3},
      {"sim",
       {"sim", "p", "--for", "100ms", "--trace", "Main.n", "--out", "old.csv", "--print", "Main.n",
        "--retain", "kept"},
       8},
      {"simStdout", {"sim", "p", "--for", "100ms", "--trace", "Main.n"}, 4},
      {"test", {"test", "p", "--junit", "old.xml"}, 6},
  };
  return all;
}

constexpr const char *kProgram = R"(/// Counts.
PROGRAM Main
VAR n:DINT; END_VAR
VAR RETAIN r : DINT; END_VAR
n:=n+1;
r := r + 1;
END_PROGRAM

{attribute 'test'}
FUNCTION_BLOCK Adds
ASSERT_EQ(1 + 1, 2);
END_FUNCTION_BLOCK
)";
constexpr const char *kManifest = R"([project]
name = "p"
[[task]]
name = "T"
interval = "T#10ms"
programs = ["Main"]
)";

class FaultyTool : public ::testing::TestWithParam<Tool> {
protected:
  /// The folder as it is before the command; what is built is there, if that is not its matter.
  void prepare() {
    for (const fs::directory_entry &entry : fs::directory_iterator(folder()))
      if (const std::string name = entry.path().filename();
          name != "cache" && (name != "p" || GetParam().name == std::string("build")))
        fs::remove_all(entry.path());
    fs::create_directories(folder() / "p");
    writeFile(folder() / "p" / "stride.toml", kManifest);
    writeFile(folder() / "p" / "Main.st", kProgram);
    writeFile(folder() / "a.st", kProgram);
    fs::copy_file(STRIDE_SOURCE_DIR "/tests/golden/projects/cam_commands/Press.cam.toml",
                  folder() / "a.cam.toml");
    writeFile(folder() / "t.csv", "t,a\n0,1\n0.01,2\n0.02,4\n");
    for (const char *name : {"old.svg", "old.csv", "old.bin", "old.so", "old.xml"})
      writeFile(folder() / name, "old");
  }
  FaultedRun command(const Fault &fault) {
    std::vector<std::string> arguments = GetParam().arguments;
    arguments.insert(arguments.begin(), STRIDE_BINARY_DIR "/stride");
    return runWithFault(arguments, folder(), fault,
                        {{"XDG_CACHE_HOME", (folder() / "cache").string()}});
  }
  /// What the user sees: files beside those of the build.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> found;
    for (const fs::directory_entry &entry : fs::recursive_directory_iterator(folder())) {
      const std::string name = fs::relative(entry.path(), folder()).string();
      if (entry.is_regular_file() && !name.starts_with("cache/") &&
          name.find("build/") == std::string::npos && name.find("kept.") == std::string::npos)
        found[name] = readFile(entry.path());
    }
    return found;
  }
  fs::path folder() const { return scratch_.path(); }

  void failEach(CallClass what, const std::vector<int> &errors) {
    prepare();
    const std::map<std::string, std::string> before = files();
    static_cast<void>(command({what})); // builds
    prepare();
    const FaultedRun good = command({what});
    ASSERT_EQ(good.result.exitCode, 0) << good.result.err;
    const std::map<std::string, std::string> after = files();
    const bool all = std::getenv("STRIDE_ALL_FAULTS") != nullptr;
    const unsigned step = all ? 1 : std::max(1U, good.calls / GetParam().most);
    for (unsigned n = 1; n <= good.calls; n += step) {
      const int error = errors[n / step % errors.size()];
      SCOPED_TRACE("call " + std::to_string(n) + " of " + std::to_string(good.calls) + ", errno " +
                   std::to_string(error));
      prepare();
      const FaultedRun run = command({what, n, error});
      expectSound(run, good);
      expectWhole(before, after, run.result.exitCode == 0);
    }
  }
  static void expectSound(const FaultedRun &run, const FaultedRun &good) {
    EXPECT_FALSE(run.tooLong);
    EXPECT_LT(run.result.exitCode, 70) << run.result.err;
    EXPECT_THAT(run.result.err, Not(AnyOf(HasSubstr("terminate"), HasSubstr("nternal error"))));
    if (run.result.exitCode == 0 && run.result.err.find("warning") == std::string::npos) {
      EXPECT_EQ(run.result.out.empty(), good.result.out.empty());
      EXPECT_EQ(run.result.err.empty(), good.result.err.empty());
    }
  }
  /// Each file is what it was or what it was to become; all of that when the command says so.
  void expectWhole(const std::map<std::string, std::string> &before,
                   const std::map<std::string, std::string> &after, bool done) const {
    const std::map<std::string, std::string> now = files();
    for (const auto &[name, text] : before)
      EXPECT_TRUE(now.count(name) != 0) << name << " is gone";
    for (const auto &[name, text] : now) {
      const auto was = before.find(name);
      const auto is = after.find(name);
      const bool streamed = name == "old.csv" || name == "old.xml"; // by the host, as it runs
      EXPECT_TRUE((was != before.end() && was->second == text) ||
                  (is != after.end() && (is->second == text || name == "old.xml")) ||
                  (!done && streamed))
          << name << " is neither old nor new:\n"
          << text.substr(0, 200);
    }
    for (const auto &[name, text] : after)
      EXPECT_TRUE(!done || now.count(name) != 0) << name << " is missing, and nobody was told";
  }

  ScratchDirectory scratch_;
};

TEST_P(FaultyTool, SaysWhatItCouldNotWrite) {
  if (!canInjectFaults())
    GTEST_SKIP() << "the system lets no calls be intercepted";
  failEach(CallClass::Open, {EACCES, EMFILE, ENOSPC});
  failEach(CallClass::Write, {ENOSPC, EIO, EPIPE});
  failEach(CallClass::Rename, {EACCES, EIO});
  failEach(CallClass::Folder, {EACCES, ENOSPC});
  failEach(CallClass::Resize, {EIO});
  failEach(CallClass::Sync, {EIO});
}

INSTANTIATE_TEST_SUITE_P(Tools, FaultyTool, ::testing::ValuesIn(tools()),
                         [](const ::testing::TestParamInfo<Tool> &info) {
                           return std::string(info.param.name);
                         });

} // namespace
} // namespace stride::test
