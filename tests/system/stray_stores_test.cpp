// Stores through wild pointers: whatever a pointer is made from and wherever it runs to, the
// process survives, says where in the ST it was, brakes the axes and saves what is retained.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace stride::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char *kConfiguration = R"toml(
[project]
name = "stray"
[[task]]
name = "Motion"
interval = "T#2ms"
programs = ["Main"]
[[bus]]
name = "Bus"
InterfaceType = "Dummy (simulated drives)"
  [[bus.axis_group]]
  name = "AxisGroup"
  sTask = "Motion"
  dwCycle = 2000
    [[bus.axis_group.drive]]
    name = "Drive"
    wDriveId = 1
    iMovementType = "linear"
)toml";

/// `kind` says what the pointer is made from.
constexpr const char *kProgram = R"(
TYPE Box : STRUCT a : ARRAY[0..3] OF DINT; END_STRUCT END_TYPE
FUNCTION_BLOCK Block
VAR x : DINT; END_VAR
METHOD Place : POINTER TO DINT
Place := ADR(x);
END_METHOD
END_FUNCTION_BLOCK
FUNCTION Run : BOOL
VAR_INPUT p : POINTER TO DINT; up : BOOL; END_VAR
WHILE TRUE DO
  p^ := -1;
  IF up THEN p := p + 4; ELSE p := p - 4; END_IF
END_WHILE
END_FUNCTION
FUNCTION OfInOut : BOOL
VAR_IN_OUT x : DINT; END_VAR
VAR_INPUT up : BOOL; END_VAR
OfInOut := Run(ADR(x), up);
END_FUNCTION
FUNCTION OfLocals : BOOL
VAR_INPUT kind : INT; up : BOOL; input : DINT; END_VAR
VAR x : DINT; r : REFERENCE TO DINT; box : Box; block : Block; END_VAR
VAR_TEMP t : DINT; END_VAR
CASE kind OF
  1: Run(ADR(x), up);
  2: r REF= x; Run(ADR(r), up);
  3: OfInOut(x, up);
  4: Run(ADR(box.a[2]), up);
  5: Run(block.Place(), up);
  6: Run(ADR(input), up);
  7: Run(ADR(t), up);
  8: Run(ADR(OfLocals), up);
END_CASE
END_FUNCTION
PROGRAM Main
VAR
  kind : INT; up : BOOL;
  power : MC_Power; move : MC_MoveVelocity;
  box : Box; block : Block; p : POINTER TO DINT; n : DINT;
END_VAR
VAR PERSISTENT kept : DINT; END_VAR
VAR_TEMP t : DINT; END_VAR
power(Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE, Axis := Drive);
move(Execute := power.Status, Velocity := 80, Acceleration := 200, Deceleration := 100, Axis := Drive);
n := n + 1;
IF n < 200 THEN RETURN; END_IF
kept := 4711;
IF kind < 10 THEN OfLocals(kind, up, 1); END_IF
CASE kind OF
  10: Run(ADR(t), up);
  11: Run(ADR(n), up);
  12: Run(ADR(box.a[2]), up);
  13: Run(block.Place(), up);
  14: p := __NEW(DINT); Run(p, up);
  20: p := 0;
  21: p := 16#FFFF_FFFF_FFFF_FFFF;
  22: p := 16#FFFF_FFFF;
  23: p := 16#8000_0000_0000_0000;
  24: p := ADR(n) + 16#4000_0000_0000;
  25: p := ADR(n) - 16#4000_0000_0000;
  26: p := ADR(n) + 16#0900_0003;
  27: p := 16#1_0001;
END_CASE
IF kind >= 20 THEN
  p^ := 1; (* wild *)
END_IF
END_PROGRAM
)";

size_t lineOf(std::string_view text, std::string_view what) {
  const std::string_view before = text.substr(0, text.find(what));
  return static_cast<size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
}

class StrayStores : public ::testing::Test {
protected:
  static void SetUpTestSuite() {
    scratch_ = new ScratchDirectory;
    writeFile(scratch_->path() / "stride.toml", kConfiguration);
    writeFile(scratch_->path() / "Main.st", kProgram);
    const ProcessResult built = command({"stride", "build", ".", "-W", "off=lints"});
    ASSERT_EQ(built.exitCode, 0) << built.err;
  }
  static void TearDownTestSuite() {
    delete scratch_;
    scratch_ = nullptr;
  }

  static ProcessResult command(std::vector<std::string> arguments) {
    arguments[0] = STRIDE_BINARY_DIR "/" + arguments[0];
    return runProcess(arguments, scratch_->path(),
                      {{"XDG_CACHE_HOME", (scratch_->path() / "cache").string()}});
  }
  static ProcessResult simulate(int kind, bool up, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {
        "stride-host",   "sim",
        "build/app.so",  "--for",
        "T#3s",          "--quiet",
        "--set",         "T#0ms,Main.kind=" + std::to_string(kind),
        "--set",         up ? "T#0ms,Main.up=TRUE" : "T#0ms,Main.up=FALSE",
        "--loop-budget", "1000000000"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return command(arguments);
  }

  static ScratchDirectory *scratch_;
};

ScratchDirectory *StrayStores::scratch_ = nullptr;

TEST_F(StrayStores, RunningOffAVariableIsAnExceptionAtItsPlace) {
  const std::string place = "Main.st:" + std::to_string(lineOf(kProgram, "  p^ := -1;"));
  for (const int kind : {1, 2, 3, 4, 5, 6, 7, 8, 10, 11, 12, 13, 14}) {
    for (const bool up : {true, false}) {
      const ProcessResult result = simulate(kind, up);
      EXPECT_EQ(result.exitCode, 2) << "kind " << kind << (up ? " up" : " down") << result.err;
      EXPECT_THAT(result.err,
                  AllOf(HasSubstr("error: access through an invalid pointer at " + place),
                        HasSubstr("in Run at " + place), HasSubstr("task Motion")))
          << "kind " << kind << (up ? " up" : " down");
    }
  }
}

TEST_F(StrayStores, WildAddressesAreExceptionsAtTheirPlaceAndStopTheAxis) {
  const std::string place = "Main.st:" + std::to_string(lineOf(kProgram, "  p^ := 1; (* wild"));
  for (int kind = 20; kind <= 27; ++kind) {
    const ProcessResult result = simulate(kind, true, {"--print", "Drive.fSetVelocity"});
    EXPECT_EQ(result.exitCode, 2) << "kind " << kind << result.err;
    EXPECT_THAT(result.err, AllOf(HasSubstr(place), HasSubstr("task Motion"),
                                  HasSubstr("drive 'Drive' is in error stop")))
        << "kind " << kind;
    EXPECT_THAT(result.out, HasSubstr("Drive.fSetVelocity = 0")) << "kind " << kind;
  }
}

TEST_F(StrayStores, RetainedDataAreSaved) {
  const ProcessResult stopped = simulate(24, true, {"--retain", "kept"});
  EXPECT_EQ(stopped.exitCode, 2) << stopped.err;
  const ProcessResult again = command({"stride-host", "sim", "build/app.so", "--for", "T#4ms",
                                       "--quiet", "--retain", "kept", "--print", "Main.kept"});
  EXPECT_EQ(again.exitCode, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("Main.kept = 4711"));
}

TEST_F(StrayStores, OtherApplicationsGoOn) {
  writeFile(scratch_->path() / "Good.st", "PROGRAM PLC_PRG\nVAR n : DINT; late : BOOL; END_VAR\n"
                                          "n := n + 1;\nlate := TIME() > T#1s;\nEND_PROGRAM\n");
  writeFile(scratch_->path() / "Bad.st",
            "FUNCTION Run : BOOL\nVAR_INPUT p : POINTER TO DINT; END_VAR\n"
            "WHILE TRUE DO p^ := 7; p := p + 4; END_WHILE\nEND_FUNCTION\n"
            "PROGRAM PLC_PRG\nVAR n : DINT; END_VAR\nn := n + 1;\n"
            "IF n > 5 THEN Run(ADR(n)); END_IF\nEND_PROGRAM\n");
  for (const char *file : {"Good.st", "Bad.st"}) {
    const ProcessResult built = command({"stride", "build", file, "-W", "off=lints"});
    ASSERT_EQ(built.exitCode, 0) << built.err;
  }
  // The bad one lies below the good one in memory.
  const ProcessResult result = command({"stride-host", "run", "Bad.so", "Good.so", "--for",
                                        "1500ms", "--quiet", "--print", "Good:PLC_PRG.late"});
  EXPECT_EQ(result.exitCode, 2) << result.err;
  EXPECT_THAT(result.err, HasSubstr("error: "));
  EXPECT_THAT(result.err, HasSubstr("access through an invalid pointer at Bad.st:3"));
  EXPECT_THAT(result.out, HasSubstr("PLC_PRG.late = TRUE"));
}

} // namespace
} // namespace stride::test
