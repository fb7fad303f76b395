#!/usr/bin/env python3
"""generate_axes.py COUNT FOLDER: a project with so many drives, of which a program moves eleven."""

import pathlib
import sys

PROGRAM = """PROGRAM Main
VAR CONSTANT
  Last : INT := 10;
END_VAR
VAR
  Power : ARRAY[0..Last] OF MC_Power;
  Move : ARRAY[0..Last] OF MC_MoveAbsolute;
  Arrived : INT;
  i : INT;
  Drive : DINT;
END_VAR

Arrived := 0;
FOR i := 0 TO Last DO
  Drive := i * (g_DRIVESTRUCT.wDriveCount - 1) / Last;
  Power[i](Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE,
           Axis := g_DRIVESTRUCT.apDrive[Drive]^);
  Move[i](Execute := Power[i].Status, Position := 1 + Drive, Velocity := 100000,
          Acceleration := 1000000, Deceleration := 1000000, Axis := g_DRIVESTRUCT.apDrive[Drive]^);
  IF Move[i].Done THEN
    Arrived := Arrived + 1;
  END_IF
END_FOR
END_PROGRAM
"""

HEAD = """[project]
name = "many_axes"

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
"""


def drive(number):
    """Some are rotary, so that not all have the same parameters."""
    text = f"""
    [[bus.axis_group.drive]]
    name = "Drive{number}"
    wDriveId = {number}
"""
    if number % 100 == 0:
        return text + f'    iMovementType = "rotary"\n    fPositionPeriod = {number * 20}.0\n'
    return text + (f'    iMovementType = "linear"\n    bSWLimitEnable = true\n'
                   f'    fSWLimitNegative = -1.0\n    fSWLimitPositive = {20000 + number}.0\n')


def main():
    count = int(sys.argv[1])
    folder = pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "Main.st").write_text(PROGRAM)
    (folder / "stride.toml").write_text(HEAD + "".join(drive(i + 1) for i in range(count)))


main()
