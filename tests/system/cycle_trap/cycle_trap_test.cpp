// No example allocates, locks or waits inside of a cycle, by the real clock and in virtual time.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"
#include "tests/system/files/file_program.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace stride::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// Examples, and the golden projects that run for their motion, tasks and configuration.
std::vector<std::string> projects() {
  std::vector<std::string> found;
  for (const char *root : {"/examples", "/tests/golden/projects"})
    for (const fs::directory_entry &entry :
         fs::directory_iterator(std::string(STRIDE_SOURCE_DIR) + root)) {
      const std::string name = entry.path().filename().string();
      if (name == "quick_stop") // ends with an exception, for which there is memory
        continue;
      if (name == "Engraving") // reads a file, which simulation does within the cycle
        continue;
      if (entry.is_directory() && fs::exists(entry.path() / "stride.toml") &&
          name.rfind("fail_", 0) != 0 && name.rfind("warn_", 0) != 0)
        found.push_back(entry.path().string());
    }
  std::sort(found.begin(), found.end());
  return found;
}

class CycleTrap : public ::testing::TestWithParam<std::string> {
protected:
  /// Builds the project; false when it cannot be built as it stands.
  bool build(const std::string &project) {
    return runProcess({STRIDE_BINARY_DIR "/stride", "build", project, "-o",
                       (scratch_.path() / "app.so").string(), "-W", "off=lints"},
                      scratch_.path())
               .exitCode == 0;
  }
  ProcessResult host(std::vector<std::string> arguments,
                     const std::vector<std::pair<std::string, std::string>> &environment = {}) {
    arguments.insert(arguments.begin() + 1, "app.so");
    arguments.insert(arguments.begin(), STRIDE_BINARY_DIR "/tests/cycle_trap_host");
    return runProcess(arguments, scratch_.path(), environment);
  }
  ScratchDirectory scratch_;
};

TEST_P(CycleTrap, NothingIsAllocatedOrLockedInACycle) {
  ASSERT_TRUE(build(GetParam()));
  const ProcessResult run = host({"run", "--for", "300ms", "--quiet"});
  EXPECT_THAT(run.err, Not(HasSubstr("TRAP")));
  EXPECT_EQ(run.exitCode, 0) << run.err;
  // In virtual time what programs ask of files is done within their cycle, so that runs repeat.
  for (const char *name : {"/admin_write_params_to_file", "/axis_diagnostic_log", "/cam_files",
                           "/cnc_queue_files", "/cnc_read_file", "/cnc_compile", "/cnc_preprocess",
                           "/nc_coordinates", "/nc_read_file2", "/nc_jumps", "/can_own_pdos",
                           "/can_parameter_file", "/can_parameter_reload", "/sercos_parameters"})
    if (GetParam().ends_with(name))
      return;
  const ProcessResult sim = host({"sim", "--for", "5s", "--quiet"});
  EXPECT_THAT(sim.err, Not(HasSubstr("TRAP")));
  EXPECT_EQ(sim.exitCode, 0) << sim.err;
}

INSTANTIATE_TEST_SUITE_P(Projects, CycleTrap, ::testing::ValuesIn(projects()),
                         [](const ::testing::TestParamInfo<std::string> &info) {
                           return fs::path(info.param).filename().string();
                         });

using CycleTrapExample = CycleTrap;

TEST_P(CycleTrapExample, NorWhileItIsServedScriptedTracedAndRecorded) {
  ASSERT_TRUE(build(GetParam()));
  writeFile(scratch_.path() / "a.script",
            "at T#100ms: force Ipo.p := 20\nat T#200ms: release Ipo.p\n");
  const std::string host = STRIDE_BINARY_DIR "/tests/cycle_trap_host";
  const ProcessResult result = runProcess(
      {"sh", "-c",
       host +
           " run app.so --for 800ms --listen unix:s --script a.script --record r "
           "--retain keep --trace Drive.fSetPosition --out t.csv & p=$!; sleep 0.3\n" +
           host + " ctl unix:s read Drive.fSetPosition; " + host + " ctl unix:s stats; wait $p"},
      scratch_.path());
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.err, Not(HasSubstr("TRAP")));
  EXPECT_THAT(result.out, HasSubstr("Drive.fSetPosition"));
}

TEST_P(CycleTrapExample, NorWhileVariablesAreForced) {
  ASSERT_TRUE(build(GetParam()));
  const std::string host = STRIDE_BINARY_DIR "/tests/cycle_trap_host";
  const ProcessResult result = runProcess(
      {"sh", "-c",
       host + " run app.so --for 800ms --listen unix:s --quiet & p=$!; sleep 0.3\n" + host +
           " ctl unix:s force Ipo.p=20; " + host + " ctl unix:s write Ipo.p=30; " + host +
           " ctl unix:s unforce Ipo.p; " + host + " ctl unix:s change; wait $p"},
      scratch_.path());
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.err, Not(HasSubstr("TRAP")));
  EXPECT_THAT(result.err, HasSubstr("note: online change done"));
}

INSTANTIATE_TEST_SUITE_P(Example, CycleTrapExample,
                         ::testing::Values(STRIDE_SOURCE_DIR "/examples/PLCopenSingle"));

using CycleTrapInStop = CycleTrap;

TEST_P(CycleTrapInStop, NorWhileThePlcStopsAndStarts) {
  ASSERT_TRUE(build(GetParam()));
  writeFile(scratch_.path() / "a.script", "at T#100ms: stop\nat T#200ms: start\n");
  const std::string host = STRIDE_BINARY_DIR "/tests/cycle_trap_host";
  const ProcessResult result = runProcess(
      {"sh", "-c",
       host +
           " run app.so --for 60s --listen unix:s --quiet --script a.script & p=$!; sleep 0.4\n" +
           host + " ctl unix:s stop; " + host + " ctl unix:s start; " + host +
           " ctl unix:s stop; " + host + " ctl unix:s end; wait $p"},
      scratch_.path());
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.err, Not(HasSubstr("TRAP")));
  EXPECT_THAT(result.out, HasSubstr(": in STOP at "));
}

INSTANTIATE_TEST_SUITE_P(Projects, CycleTrapInStop,
                         ::testing::Values(STRIDE_SOURCE_DIR "/tests/golden/projects/csy_stop",
                                           STRIDE_SOURCE_DIR "/tests/golden/projects/plc_stop_axes",
                                           STRIDE_SOURCE_DIR "/tests/golden/projects/plc_stop_io"));

/// Virtual time waits for the disk; the real clock never does.
TEST(CycleTrapOfFiles, NothingIsAllocatedOrLockedInACycleThatWorksWithThem) {
  const ScratchDirectory scratch;
  fs::create_directory(scratch.path() / "p");
  writeFile(scratch.path() / "p" / "stride.toml", kFileProject);
  writeFile(scratch.path() / "p" / "Main.st", kFileProgram);
  const ProcessResult result =
      runProcess({"sh", "-c",
                  STRIDE_BINARY_DIR "/stride build p -o app.so -W off=lints && " STRIDE_BINARY_DIR
                                    "/tests/cycle_trap_host run app.so --for 1500ms --quiet "
                                    "--record r --print PLC_PRG.rounds,PLC_PRG.wrong"},
                 scratch.path());
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.err, Not(HasSubstr("TRAP")));
  EXPECT_THAT(result.out, HasSubstr("PLC_PRG.wrong = 0\n"));
  EXPECT_THAT(result.out, Not(HasSubstr("PLC_PRG.rounds = 0\n")));
}

using CycleTrapItself = CycleTrap;

TEST_P(CycleTrapItself, IsSprung) {
  ASSERT_TRUE(build(GetParam()));
  const ProcessResult run =
      host({"run", "--for", "300ms", "--quiet"}, {{"STRIDE_TRAP_SELF_TEST", "1"}});
  EXPECT_EQ(run.exitCode, 99);
  EXPECT_THAT(run.err, HasSubstr("TRAP: pthread_mutex_lock inside of a cycle"));
}

INSTANTIATE_TEST_SUITE_P(Example, CycleTrapItself,
                         ::testing::Values(STRIDE_SOURCE_DIR "/examples/PLCopenSingle"));

} // namespace
} // namespace stride::test
