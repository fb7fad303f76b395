#!/usr/bin/env python3
"""SysLibTime against Python's datetime: a simulation of 140 years whose cycles are almost an hour apart.

usage: clock.py STRIDE
"""
import datetime
import pathlib
import re
import subprocess
import sys
import tempfile

CYCLE = 3_599_877_123  # us
CYCLES = 1_226_000
EVERY = 613
FIELDS = ("Year", "Month", "Day", "Hour", "Minute", "Second", "Milliseconds", "DayOfWeek")
COUNT = CYCLES // EVERY

SOURCE = f"""
PROGRAM Clock
VAR
  cycle, i : DINT;
  now : CurTime;
  exact : CurTimeEx;
  t, u : SysTime64;
  d : SystemTimeDate;
  ms : ARRAY [0..{COUNT - 1}] OF UDINT;
  us, low, both : ARRAY [0..{COUNT - 1}] OF ULINT;
  parts : ARRAY [0..{COUNT - 1}, 0..{len(FIELDS) - 1}] OF UINT;
END_VAR
now(SystemTime := t);
IF cycle MOD {EVERY} = 0 AND i < {COUNT} THEN
  exact(SystemTime := u, TimeDate := d);
  ms[i] := SysTimeGetMs();
  SysTimeGetUs(us[i]);
  low[i] := SHL(DWORD_TO_ULINT(t.ulHigh), 32) + DWORD_TO_ULINT(t.ulLow);
  both[i] := SHL(DWORD_TO_ULINT(d.dwHighMsec), 32) + DWORD_TO_ULINT(d.dwLowMSecs);
  IF u.ulLow <> t.ulLow OR u.ulHigh <> t.ulHigh THEN
    both[i] := 1;
  END_IF;
{"".join(f"  parts[i, {k}] := d.{name};" + chr(10) for k, name in enumerate(FIELDS))}  i := i + 1;
END_IF;
cycle := cycle + 1;
END_PROGRAM
CONFIGURATION Plant
  RESOURCE Plc ON PC
    TASK Slow (INTERVAL := LT#{CYCLE}us, PRIORITY := 1);
    PROGRAM Main WITH Slow : Clock;
  END_RESOURCE
END_CONFIGURATION
"""


def expected(i):
    us = i * EVERY * CYCLE
    at = datetime.datetime(1970, 1, 1) + datetime.timedelta(microseconds=us)
    parts = (at.year, at.month, at.day, at.hour, at.minute, at.second, at.microsecond // 1000, at.isoweekday() % 7)
    values = {"ms": us // 1000 % 2**32, "us": us, "low": us, "both": us}
    return {f"{name}[{i}]": v for name, v in values.items()} | {f"parts[{i},{k}]": v for k, v in enumerate(parts)}


def main():
    stride = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / "clock.st"
        source.write_text(SOURCE, encoding="utf-8")
        names = ",".join(f"Main.{name}" for name in ("ms", "us", "low", "both", "parts"))
        done = subprocess.run([stride, "sim", str(source), "--for", f"LT#{CYCLE * CYCLES}us", "-W", "off=lints", "--print", names],
                              capture_output=True, text=True, cwd=folder, check=False)
    if done.returncode != 0:
        sys.exit(f"{done.stderr[:4000]}\n{stride} gave {done.returncode}")
    values = dict(re.findall(r"^Main\.(\S+(?:, ?\d+\])?) = (\d+)$", done.stdout, re.M))
    values = {name.replace(" ", ""): int(v) for name, v in values.items()}
    wrong = [(name, v, values.get(name)) for i in range(COUNT) for name, v in expected(i).items() if values.get(name) != v]
    for name, v, got in wrong[:20]:
        print(f"{name} must be {v}, is {got}")
    print(f"{COUNT} times, {len(wrong)} wrong values")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
