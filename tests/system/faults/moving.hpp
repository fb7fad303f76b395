// A project whose axis moves for half a second; what it prints tells whether it got there.
#ifndef STRIDE_TESTS_SYSTEM_FAULTS_MOVING_HPP
#define STRIDE_TESTS_SYSTEM_FAULTS_MOVING_HPP

#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <filesystem>
#include <stdexcept>
#include <string>

namespace stride::test {

inline constexpr const char *kMovingProject = R"toml([project]
name = "moving"

[[task]]
name = "Task"
interval = "T#2ms"
priority = 1
programs = ["Main"]

[[bus]]
name = "Bus"
InterfaceType = "Dummy (simulated drives)"
  [[bus.axis_group]]
  name = "AxisGroup"
  sTask = "Task"
  dwCycle = 2000
    [[bus.axis_group.drive]]
    name = "Drive"
    wDriveId = 1
)toml";

/// `done` is TRUE after about 0.4 s.
inline constexpr const char *kMovingProgram = R"(
PROGRAM Main
VAR
  Power : MC_Power;
  Move : MC_MoveAbsolute;
  go : BOOL := TRUE;
  done : BOOL;
END_VAR
VAR RETAIN
  starts : DINT;
END_VAR
VAR
  counted : BOOL;
END_VAR
IF NOT counted THEN
  counted := TRUE;
  starts := starts + 1;
END_IF
Power(Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE, Axis := Drive);
Move(Execute := Power.Status AND go, Position := 10, Velocity := 100, Acceleration := 1000,
     Deceleration := 1000, Axis := Drive);
done := Move.Done;
END_PROGRAM
)";

/// Builds it in the folder, as moving.so.
inline void buildMoving(const std::filesystem::path &folder) {
  std::filesystem::create_directories(folder / "p");
  writeFile(folder / "p" / "stride.toml", kMovingProject);
  writeFile(folder / "p" / "Main.st", kMovingProgram);
  const ProcessResult built = runProcess(
      {STRIDE_BINARY_DIR "/stride", "build", "p", "-o", "moving.so", "-W", "off=lints"}, folder);
  if (built.exitCode != 0)
    throw std::runtime_error(built.err);
}

} // namespace stride::test

#endif
