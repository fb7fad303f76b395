#ifndef STRIDE_TESTS_SYSTEM_RUN_SCENE_HPP
#define STRIDE_TESTS_SYSTEM_RUN_SCENE_HPP
// Programs that are run from outside, by `stride run` and `stride sim`.

#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace stride::test {

namespace fs = std::filesystem;

/// A folder, and commands that work in it.
class Run : public ::testing::Test {
protected:
  ProcessResult command(const std::vector<std::string> &arguments) {
    return runProcess(arguments, scratch_.path(),
                      {{"XDG_CACHE_HOME", (scratch_.path() / "cache").string()},
                       {"HOST", STRIDE_BINARY_DIR "/stride-host"},
                       {"STRIDE", STRIDE_BINARY_DIR "/stride"}});
  }
  ProcessResult stride(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), STRIDE_BINARY_DIR "/stride");
    return command(arguments);
  }
  ProcessResult shell(const std::string &script) { return command({"sh", "-c", script}); }

  void write(const std::string &name, const std::string &text) {
    fs::create_directories((scratch_.path() / name).parent_path());
    writeFile(scratch_.path() / name, text);
  }
  /// Builds `text` as `name`.so.
  void build(const std::string &name, const std::string &text) {
    write(name + ".st", text);
    const ProcessResult result = stride({"build", name + ".st", "-W", "off=lints"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
  }

  ScratchDirectory scratch_;
};

/// Counts in a task of 1 ms.
inline constexpr const char *kCounter = R"(
PROGRAM PLC_PRG
VAR n : DINT; t : TIME; END_VAR
n := n + 1;
t := TIME();
END_PROGRAM
CONFIGURATION C
  TASK Fast (INTERVAL := T#1ms, PRIORITY := 1);
  PROGRAM PLC_PRG WITH Fast;
END_CONFIGURATION
)";

/// Cyclic, event-driven and freewheeling tasks that use each other's variables.
inline constexpr const char *kSeveralTasks = R"(
VAR_GLOBAL n, m, e, free : DINT; go : BOOL; END_VAR
PROGRAM Fast
n := n + 1;
go := n MOD 7 = 0;
END_PROGRAM
PROGRAM Slow
m := m * 3 + n + free;
END_PROGRAM
PROGRAM OnEdge
e := e + m;
END_PROGRAM
PROGRAM Idle
free := free + n;
END_PROGRAM
CONFIGURATION C
  TASK F (INTERVAL := T#1ms, PRIORITY := 1);
  TASK S (INTERVAL := T#5ms, PRIORITY := 9);
  TASK E (SINGLE := go, PRIORITY := 0);
  PROGRAM Fast WITH F;
  PROGRAM Slow WITH S;
  PROGRAM OnEdge WITH E;
  PROGRAM Idle;
END_CONFIGURATION
)";

} // namespace stride::test

#endif // STRIDE_TESTS_SYSTEM_RUN_SCENE_HPP
