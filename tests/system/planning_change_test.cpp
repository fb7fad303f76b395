// Online changes of groups with a planning task while they move.
#include "tests/system/run_scene.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace stride::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char *kProject = R"([[task]]
name = "Motion"
interval = "T#2ms"
priority = 1
programs = ["Main"]

[[task]]
name = "Slow"
interval = "T#14ms"
priority = 15
programs = ["Background"]

[[axis]]
name = "X"
kind = "virtual"
sTask = "Motion"
fSWMaxVelocity = 100.0
fSWMaxAcceleration = 800.0
fSWMaxDeceleration = 1000.0
fSWMaxJerk = 9000.0

[[axis]]
name = "Y"
kind = "virtual"
sTask = "Motion"
fSWMaxVelocity = 90.0
fSWMaxAcceleration = 700.0
fSWMaxDeceleration = 900.0
fSWMaxJerk = 8000.0

[[axes_group]]
name = "Portal"
axes = ["X", "Y"]
kinematics = "Kin_Gantry2"
)";

/// A kinematics that a program has written itself.
constexpr const char *kOwn = R"(FUNCTION_BLOCK OwnPortal IMPLEMENTS TRAFO.MC_KIN_REF_SM3
PROPERTY NumAxes : UDINT
GET
NumAxes := 2;
END_GET
END_PROPERTY
METHOD AxesToCartesian : SMC_ERROR
VAR_IN_OUT
  f  : SM3M.SMC_Frame;
  cd : TRAFO.CONFIGDATA;
END_VAR
VAR_IN_OUT CONSTANT
  a : TRAFO.AXISPOS_REF;
END_VAR
f.vT.dX := a.a0;
f.vT.dY := a.a1;
f.vT.dZ := 0;
f.mR.m[0, 0] := 1;
f.mR.m[1, 1] := 1;
f.mR.m[2, 2] := 1;
AxesToCartesian := SMC_ERROR.SMC_NO_ERROR;
END_METHOD
METHOD CartesianToAxes : SMC_ERROR
VAR_IN_OUT
  a : TRAFO.AXISPOS_REF;
END_VAR
VAR_IN_OUT CONSTANT
  f    : SM3M.SMC_Frame;
  aRef : TRAFO.AXISPOS_REF;
  cd   : TRAFO.CONFIGDATA;
END_VAR
a.a0 := f.vT.dX;
a.a1 := f.vT.dY;
CartesianToAxes := SMC_ERROR.SMC_NO_ERROR;
END_METHOD
END_FUNCTION_BLOCK
)";

/// Two lines with a corner, and a third one after a rest.
constexpr const char *kMain = R"(PROGRAM Main
VAR
  Power  : SMC_GroupPower := (Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
  Enable : MC_GroupEnable;
  Tune   : SMC_TuneCPKernel := (fPlanningForecastDuration := 0.1);
  First  : MC_MoveLinearAbsolute := (CoordSystem := SMC_COORD_SYSTEM.MCS, Velocity := 80, Acceleration := 400, Deceleration := 300, Jerk := 5000);
  Second : MC_MoveLinearAbsolute := (CoordSystem := SMC_COORD_SYSTEM.MCS, Velocity := 70, Acceleration := 400, Deceleration := 300, Jerk := 5000,
                                     BufferMode := MC_BUFFER_MODE.BlendingHigh, TransitionMode := MC_TRANSITION_MODE.TMCornerDistance);
  Third  : MC_MoveLinearAbsolute := (CoordSystem := SMC_COORD_SYSTEM.MCS, Velocity := 90, Acceleration := 400, Deceleration := 300, Jerk := 5000,
                                     BufferMode := MC_BUFFER_MODE.Buffered);
  Order  : STRING;
END_VAR
Power(AxisGroup := Portal);
Enable(AxisGroup := Portal, Execute := TRUE);
Tune(AxisGroup := Portal);
First.Position.c.X := 60;
First.Position.c.Y := 30;
Second.Position.c.X := 20;
Second.Position.c.Y := 75;
Second.TransitionParameter[0] := 8;
Third.Position.c.X := 33;
Third.Position.c.Y := 11;
First(AxisGroup := Portal, Execute := Power.Status AND Enable.Done);
Second(AxisGroup := Portal, Execute := First.Execute);
Third(AxisGroup := Portal, Execute := First.Execute);
IF First.Done AND Order = '' THEN
  Order := '1';
END_IF
IF Second.Done AND Order = '1' THEN
  Order := '12';
END_IF
IF Third.Done AND Order = '12' THEN
  Order := '123';
END_IF
END_PROGRAM

PROGRAM Background
VAR
  Count : INT;
END_VAR
Count := Count + 1;
END_PROGRAM
)";

constexpr const char *kTrace =
    " --trace X.fSetPosition,Y.fSetPosition,X.fSetVelocity,Y.fSetVelocity,"
    "X.fSetAcceleration,Y.fSetAcceleration --print Main.Order ";
constexpr double kCycle = 0.002; // [s]

struct Row {
  double time, place[2], velocity[2], acceleration[2];
};

class PlanningChange : public Run {
protected:
  void SetUp() override {
    buildAs("old", true, "");
    buildAs("new", true, "  Unrelated : ARRAY[0..999] OF LREAL := [1000(1.5)];\n");
  }

  /// `aside`: with a planning task. `insert`: after the first VAR.
  void buildAs(const std::string &name, bool aside, const std::string &insert) {
    write("p/stride.toml", std::string(kProject) + (aside ? "planning_task = \"Slow\"\n" : ""));
    std::string text = kMain;
    text.insert(text.find("VAR\n") + 4, insert);
    write("p/Main.st", text);
    const ProcessResult built = stride({"build", "p", "-o", name + ".so", "-W", "off=lints"});
    ASSERT_EQ(built.exitCode, 0) << built.err;
  }

  /// Likewise, and the program sets a kinematics of its own.
  void buildOwnAs(const std::string &name, bool aside) {
    std::string project = kProject;
    const std::string block = "kinematics = \"Kin_Gantry2\"\n";
    project.erase(project.find(block), block.size());
    std::string text = kMain;
    text.insert(text.find("VAR\n") + 4, "  Own : OwnPortal;\n  SetKin : MC_SetKinTransform;\n");
    text.insert(text.find("Power(AxisGroup"),
                "SetKin(AxisGroup := Portal, KinTransform := Own, Execute := TRUE);\n");
    write("own/stride.toml", project + (aside ? "planning_task = \"Slow\"\n" : ""));
    write("own/Main.st", kOwn + text);
    const ProcessResult built = stride({"build", "own", "-o", name + ".so", "-W", "off=lints"});
    ASSERT_EQ(built.exitCode, 0) << built.err;
  }

  ProcessResult simulate(const std::string &application, const std::string &more) {
    return shell("\"$HOST\" sim " + application + ".so --for 4s" + kTrace + more);
  }

  std::vector<Row> rows(const std::string &file) {
    std::istringstream text(readFile(scratch_.path() / file));
    std::string line;
    std::getline(text, line);
    std::vector<Row> rows;
    while (std::getline(text, line)) {
      Row row{};
      EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf", &row.time, &row.place[0],
                            &row.place[1], &row.velocity[0], &row.velocity[1], &row.acceleration[0],
                            &row.acceleration[1]),
                7);
      rows.push_back(row);
    }
    return rows;
  }
};

/// The greatest distance of the places of one trace from the polygon of those of another one.
double apart(const std::vector<Row> &places, const std::vector<Row> &path) {
  double most = 0;
  for (const Row &at : places) {
    double least = HUGE_VAL;
    for (size_t i = 1; i < path.size(); ++i) {
      const Row &a = path[i - 1];
      const double dx = path[i].place[0] - a.place[0];
      const double dy = path[i].place[1] - a.place[1];
      const double square = dx * dx + dy * dy;
      const double along =
          square > 0 ? ((at.place[0] - a.place[0]) * dx + (at.place[1] - a.place[1]) * dy) / square
                     : 0;
      const double part = std::clamp(along, 0.0, 1.0);
      least = std::min(least, std::hypot(at.place[0] - a.place[0] - part * dx,
                                         at.place[1] - a.place[1] - part * dy));
    }
    most = std::max(most, least);
  }
  return most;
}

/// Limits of both axes; nothing jumps.
void expectSmooth(const std::vector<Row> &rows) {
  const double velocity[] = {100, 90};
  const double acceleration[] = {800, 700};
  const double jerk[] = {9000, 8000};
  ASSERT_FALSE(rows.empty());
  for (size_t i = 1; i < rows.size(); ++i)
    for (int k = 0; k < 2; ++k) {
      const Row &now = rows[i];
      const Row &before = rows[i - 1];
      const double by = 0.5 * kCycle * (before.velocity[k] + now.velocity[k]);
      EXPECT_LE(std::fabs(now.velocity[k]), velocity[k] * (1 + 1e-6)) << now.time;
      EXPECT_LE(std::fabs(now.acceleration[k]), acceleration[k] * (1 + 1e-6)) << now.time;
      EXPECT_LE(std::fabs(now.acceleration[k] - before.acceleration[k]),
                jerk[k] * kCycle * (1 + 1e-4))
          << now.time;
      EXPECT_LE(std::fabs(now.place[k] - before.place[k] - by),
                jerk[k] * kCycle * kCycle * kCycle / 6 + 1e-9)
          << now.time;
    }
}

// At instants when both tasks are due, when one of them is, and between cycles.
TEST_F(PlanningChange, AnUnrelatedChangeChangesNoBit) {
  ASSERT_EQ(simulate("old", "--out without.csv").exitCode, 0);
  std::string changes;
  for (int i = 0; i < 41; ++i)
    changes +=
        " --change T#" + std::to_string(71 + 69 * i) + "ms," + (i % 2 == 0 ? "new.so" : "old.so");
  const ProcessResult result = simulate("old", "--out with.csv --print Main.Unrelated[3]" +
                                                   changes + " && cmp without.csv with.csv");
  EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_EQ(result.out, "Main.Order = '123'\nMain.Unrelated[3] = 1.5\n");
}

// The planning task is taken away or given, while the group begins, goes through the corner, and
// brakes; the path and its movements stay.
TEST_F(PlanningChange, APlanningTaskComesAndGoes) {
  buildAs("own", false, "");
  ASSERT_EQ(simulate("own", "--out path.csv").exitCode, 0);
  const std::vector<Row> path = rows("path.csv");
  for (const int instant : {20, 200, 701, 1500}) {
    SCOPED_TRACE(instant);
    const std::string change = " --change T#" + std::to_string(instant) + "ms,";
    const ProcessResult taken = simulate("old", "--out taken.csv" + change + "own.so");
    EXPECT_EQ(taken.out, "Main.Order = '123'\n");
    EXPECT_THAT(taken.err, IsEmpty());
    expectSmooth(rows("taken.csv"));
    EXPECT_LE(apart(rows("taken.csv"), path), 1e-3); // chords of cycles are no arcs
    const ProcessResult given =
        simulate("own", "--out given.csv --print Portal__planning.aState[1]" + change + "old.so");
    EXPECT_THAT(given.out, ContainsRegex("Main.Order = '123'\nPortal__planning.* = [1-9]"));
    EXPECT_THAT(given.err, IsEmpty());
    expectSmooth(rows("given.csv"));
    EXPECT_LE(apart(rows("given.csv"), path), 1e-3);
  }
}

// A program's own kinematics is not asked in two tasks: who gets a planning task on the way goes on
// without it, and a group that has one from the start is refused.
TEST_F(PlanningChange, OwnKinematicsStayInTheTaskOfTheAxes) {
  buildOwnAs("own", false);
  buildOwnAs("aside", true);
  const ProcessResult without = simulate("own", "--out without.csv");
  EXPECT_EQ(without.out, "Main.Order = '123'\n") << without.err;
  const ProcessResult with =
      simulate("own", "--out with.csv --change T#701ms,aside.so && cmp without.csv with.csv");
  EXPECT_EQ(with.exitCode, 0) << with.out;
  EXPECT_THAT(with.err, IsEmpty());
  EXPECT_EQ(simulate("aside", "--out x.csv --print Main.SetKin.ErrorID").out,
            "Main.Order = ''\nMain.SetKin.ErrorID = SMC_AXIS_GROUP_NOT_WITH_PLANNING_TASK\n");
}

// With threads: the axes' task and the one that plans run when the change comes.
TEST_F(PlanningChange, ThreadsGoOnAlongThePath) {
  ASSERT_EQ(simulate("old", "--out path.csv").exitCode, 0);
  std::string changes;
  for (int i = 0; i < 12; ++i)
    changes += std::string("sleep 0.13; rm live.so; cp ") + (i % 2 == 0 ? "new.so" : "old.so") +
               " live.so; kill -HUP $p\n";
  const ProcessResult result =
      shell(std::string("cp old.so live.so\n\"$HOST\" run live.so --for 5s --out live.csv") +
            kTrace + "& p=$!\nsleep 0.4\n" + changes + "wait $p");
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out, "Main.Order = '123'\n") << result.err;
  EXPECT_THAT(result.err, HasSubstr("note: online change done"));
  EXPECT_LE(apart(rows("live.csv"), rows("path.csv")), 1e-3);
}

} // namespace
} // namespace stride::test
