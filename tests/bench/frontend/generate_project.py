#!/usr/bin/env python3
"""Writes a project of realistic Structured Text for the front end's benchmarks.

usage: generate_project.py LINES FOLDER [--one-file]

FOLDER gets stride.toml and one .st file per function block (or everything in Main.st with --one-file). The text is the
same for the same arguments.
"""
import argparse
import pathlib
import random

STATES = ["idle", "starting", "running", "stopping", "failed"]


def block(n: int, rng: random.Random) -> list[str]:
    """One function block of about 130 lines: a station of a machine."""
    out = [
        f"/// Station {n} of the line: conveys parts, counts them and watches its drive.",
        f"FUNCTION_BLOCK Station{n}",
        "VAR_INPUT",
        "  xEnable : BOOL;             (* released by the operator *)",
        "  xReset : BOOL;",
        f"  rSetSpeed : REAL := {rng.randint(10, 900)}.5;  // mm/s",
        "  iRecipe : INT := 1;",
        "  tTimeout : TIME := T#2s500ms;",
        "END_VAR",
        "VAR_OUTPUT",
        "  xBusy : BOOL;",
        "  xError : BOOL;",
        "  iErrorId : INT;",
        "  diParts : DINT;",
        "END_VAR",
        "VAR",
        "  eState : StationState := StationState.idle;",
        "  tonStart, tonStop : TON;",
        "  trigPart : R_TRIG;",
        "  arSpeeds : ARRAY [0..9] OF REAL := [10.0, 20.5, 8(30.25)];",
        "  aSamples : ARRAY [0..31] OF SampleData;",
        "  iIndex, iCount : INT;",
        "  rSum, rMean, rActual : REAL;",
        "  wStatus : WORD := 16#00FF;",
        "  sMessage : STRING(40) := 'station ready';",
        "END_VAR",
        "VAR CONSTANT",
        "  cLast : INT := 31;",
        f"  cLimit : REAL := {rng.randint(100, 999)}.0;",
        "END_VAR",
        "",
        "// Edges and timers first, so that the states below see this cycle's values.",
        "trigPart(CLK := xEnable AND wStatus.3);",
        "tonStart(IN := eState = StationState.starting, PT := tTimeout);",
        "tonStop(IN := eState = StationState.stopping, PT := T#500ms);",
        "",
        "CASE eState OF",
        "  StationState.idle:",
        "    xBusy := FALSE;",
        "    IF xEnable AND NOT xError THEN",
        "      eState := StationState.starting;",
        "      sMessage := 'starting';",
        "    END_IF;",
        "  StationState.starting:",
        "    xBusy := TRUE;",
        "    rActual := rActual + (rSetSpeed - rActual) * 0.1;",
        "    IF tonStart.Q THEN",
        "      IF rActual >= rSetSpeed * 0.95 THEN",
        "        eState := StationState.running;",
        "      ELSE",
        "        eState := StationState.failed;",
        f"        iErrorId := {n % 1000 + 1};",
        "      END_IF;",
        "    END_IF;",
        "  StationState.running:",
        "    IF trigPart.Q THEN",
        "      diParts := diParts + 1;",
        "    END_IF;",
        "    IF NOT xEnable THEN",
        "      eState := StationState.stopping;",
        "    END_IF;",
        "  StationState.stopping:",
        "    rActual := rActual * 0.5;",
        "    IF tonStop.Q OR rActual < 0.01 THEN",
        "      eState := StationState.idle;",
        "    END_IF;",
        "ELSE",
        "  xError := TRUE;",
        "  IF xReset THEN",
        "    xError := FALSE;",
        "    iErrorId := 0;",
        "    eState := StationState.idle;",
        "  END_IF;",
        "END_CASE;",
        "",
        "(* The mean over the last samples; outliers do not count. *)",
        "rSum := 0.0;",
        "iCount := 0;",
        "FOR iIndex := 0 TO cLast DO",
        "  IF aSamples[iIndex].xValid AND ABS(aSamples[iIndex].rValue) < cLimit THEN",
        "    rSum := rSum + aSamples[iIndex].rValue;",
        "    iCount := iCount + 1;",
        "  END_IF;",
        "END_FOR;",
        "IF iCount > 0 THEN",
        "  rMean := rSum / INT_TO_REAL(iCount);",
        "END_IF;",
    ]
    for k in range(rng.randint(6, 14)):
        a, b = rng.randint(0, 31), rng.randint(0, 9)
        out += [
            f"aSamples[{a}].rValue := arSpeeds[{b}] * {rng.randint(1, 50)}.25 + rMean / {k + 2}.0 - rActual;",
            f"aSamples[{a}].xValid := rActual > {rng.randint(0, 200)}.0 AND (rMean <= cLimit OR xEnable);",
        ]
        if k % 3 == 0:
            out += [
                f"IF iRecipe = {k} OR iRecipe > {k + 10} THEN",
                f"  wStatus := wStatus AND 16#{rng.randint(0, 65535):04X};",
                "ELSIF iRecipe < 0 THEN",
                f"  arSpeeds[{b}] := MAX(rSetSpeed, LIMIT(0.0, rMean, cLimit)); // clamp",
                "END_IF;",
            ]
    out += [
        "WHILE iIndex > 0 AND iCount < 100 DO",
        "  iIndex := iIndex - 1;",
        "  iCount := iCount + iIndex MOD 3;",
        "END_WHILE;",
        "END_FUNCTION_BLOCK",
        "",
    ]
    return out


def types() -> list[str]:
    return [
        "/// State of one station.",
        "TYPE StationState :",
        "(",
        ",\n".join(f"  {name} := {i}" for i, name in enumerate(STATES)),
        ");",
        "END_TYPE",
        "",
        "TYPE SampleData :",
        "STRUCT",
        "  xValid : BOOL;",
        "  rValue : REAL := 1.5;",
        "END_STRUCT",
        "END_TYPE",
        "",
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("lines", type=int)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--one-file", action="store_true")
    arguments = parser.parse_args()
    rng = random.Random(1)
    blocks: list[list[str]] = []
    lines = 0
    while lines < arguments.lines:
        blocks.append(block(len(blocks), rng))
        lines += len(blocks[-1]) + 2
    program = ["PROGRAM Main", "VAR"]
    program += [f"  station{n} : Station{n};" for n in range(len(blocks))]
    program += ["END_VAR"]
    program += [f"station{n}(xEnable := TRUE, iRecipe := {n % 20});" for n in range(len(blocks))]
    program += ["END_PROGRAM", ""]
    folder = arguments.folder
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "stride.toml").write_text(
        '[project]\nname = "Generated"\n\n[[task]]\nname = "MainTask"\ninterval = "T#10ms"\nprograms = ["Main"]\n')
    if arguments.one_file:
        text = "\n".join(sum(blocks, types()) + program)
        (folder / "Main.st").write_text(text)
        return
    (folder / "Types.st").write_text("\n".join(types()))
    for n, one in enumerate(blocks):
        (folder / f"Station{n}.st").write_text("\n".join(one))
    (folder / "Main.st").write_text("\n".join(program))


if __name__ == "__main__":
    main()
