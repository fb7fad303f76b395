#!/usr/bin/env python3
"""Util's TimerSwitch and its functions for date and time against Python's datetime and calendar: moments in three time zones
from 1970 to 2105, a week of switching around each change of the time, with and without making up for it.

usage: timer_switch.py STRIDE
"""
import calendar
import datetime
import pathlib
import random
import re
import subprocess
import sys
import tempfile

EPOCH = datetime.datetime(1970, 1, 1)
MS = datetime.timedelta(milliseconds=1)
HOUR = 3_600_000
DAY = 24 * HOUR
# (month, which Sunday, hour) at which standard and daylight saving time begin, by the clocks of the other one; the latter's bias
ZONES = {
    "CET": (60, (10, 5, 3), (3, 5, 2), 60),
    "NZ": (720, (4, 1, 3), (9, 5, 2), 60),
    "LHST": (630, (4, 1, 2), (10, 1, 2), 30),  # half an hour
    "IST": (330, None, None, 0),
}


def ms_of(moment):
    return (moment - EPOCH) // MS


def rule(year, month, which, hour):
    """The given Sunday of a month, as local time."""
    days = [week[calendar.SUNDAY] for week in calendar.monthcalendar(year, month) if week[calendar.SUNDAY]]
    return datetime.datetime(year, month, days[min(which, len(days)) - 1], hour)


def changes(zone, year):
    """When standard and daylight saving time begin, in UTC."""
    bias, standard, daylight, more = ZONES[zone]
    return (ms_of(rule(year, *standard)) - (bias + more) * 60_000, ms_of(rule(year, *daylight)) - bias * 60_000)


def is_summer(zone, utc):
    if ZONES[zone][1] is None:
        return False
    year = (EPOCH + datetime.timedelta(milliseconds=utc, minutes=ZONES[zone][0])).year
    events = [(at, k) for y in (year - 1, year) if y >= 1969 for k, at in enumerate(changes(zone, y))]
    return max(e for e in events if e[0] <= utc)[1] == 1


def local(zone, utc):
    bias, _, _, more = ZONES[zone]
    return utc + (bias + (more if is_summer(zone, utc) else 0)) * 60_000


# ---- moments for the functions


def moments():
    random.seed(23)
    last = ms_of(datetime.datetime(2105, 12, 30))
    result = {0, 1, DAY - 1, DAY, last} | {random.randrange(last) for _ in range(500)}
    for year in range(1971, 2105, 9):
        result |= {ms_of(datetime.datetime(year, 12, 31)) + d for d in (-4 * DAY, -1, 0, DAY - 1, DAY, 3 * DAY)}
        for zone in ("CET", "NZ", "LHST"):
            result |= {at + d for at in changes(zone, year) for d in (-1, 0, 1, HOUR - 1, HOUR)}
    return sorted(result)


def function_values(utc):
    at = EPOCH + datetime.timedelta(milliseconds=utc)
    iso = at.isocalendar()
    values = [at.year, at.month, at.day, at.hour, at.minute, at.second, at.microsecond // 1000, at.isoweekday(), iso[0], iso[1],
              iso[2], utc, utc // DAY * 86400, utc % DAY, int(calendar.isleap(at.year))]
    for zone in ZONES:
        values += [local(zone, utc), 1 + is_summer(zone, utc)]
    return values


# ---- the switch


def schedules():
    random.seed(7)
    result = []
    for k in range(45):
        first = random.randrange(0, DAY, 60_000)
        last = min(first + random.randrange(60_000, 6 * HOUR), DAY - 1) if k % 3 else random.randrange(0, first + 1, 1_000)
        result.append((random.choice((0, 1, 32)) if k < 9 else k % 32 + 1, first, last, random.choice((0, 31, 96, 1, 64, 2, 84))))
    return result


SCHEDULES = schedules()
SPEEDS = (0, 150_000)  # ms/h: at once, within a day


def switch_moments(zone):
    result = set()
    for at in sorted(changes(zone, 2026)):
        result |= {at - 3 * DAY + k * 1_397_123 for k in range(5 * DAY // 1_397_123)} | {at - 1, at, at + 1}
        for _, first, last, _ in SCHEDULES:  # at, before and after the limits, on the day before the change
            day = (local(zone, at) // DAY - 1) * DAY
            utc = [day + t + d - (local(zone, at - DAY) - (at - DAY)) for t in (first, last) for d in (-1, 0, 1)]
            result |= set(utc)
    return sorted(result)


def switched(time, weekday):
    on = 0
    for switch, first, last, days in SCHEDULES:
        days = [d for d in range(7) if days >> d & 1] or range(7)
        if first <= last:
            active = weekday in days and first <= time <= last
        else:
            active = weekday in days and time >= first or (weekday - 1) % 7 in days and time <= last
        if active and switch:
            on |= 1 << (switch - 1)
    return on


def switch_values(zone, speed):
    begun, size, summer = 0, 0, None  # a difference: since when, how large at first
    for utc in switch_moments(zone):
        left = abs(size) - speed * (utc - begun) // HOUR if size else 0
        size = size if left > 0 else 0
        diff = max(left, 0) * (1 if size > 0 else -1)
        now = is_summer(zone, utc)
        if summer is not None and now != summer and speed:
            assert diff == 0  # the last change is long over
            size = ZONES[zone][3] * 60_000 * (1 if now else -1)
            begun, diff = utc, size
        summer = now
        time = local(zone, utc) - diff
        weekday = (EPOCH + datetime.timedelta(milliseconds=time)).weekday()
        yield [switched(time % DAY, weekday), diff, weekday + 1, time // DAY * 86400, time % DAY, 1 + now]


# ---- the program


def zone_text(zone):
    bias, standard, daylight, more = ZONES[zone]
    if standard is None:
        return f"(iBias := {bias}, asgPeriod := [(sName := '{zone}')])"
    parts = [f"(sName := '{name}', dtDate := (uiMonth := {m}, eWeekday := WEEKDAY.SUNDAY, uiDay := {n}, uiHour := {h}), iBias := {b})"
             for name, (m, n, h), b in ((zone, standard, 0), (zone + "S", daylight, more))]
    return f"(iBias := {bias}, asgPeriod := [{', '.join(parts)}])"


def program(times, runs):
    parts = "uiYear => y, uiMonth => mo, uiDay => d, uiHour => h, uiMinute => mi, uiSecond => s, uiMilliseconds => ms, eWeekday => wd"
    stores = ["y", "mo", "d", "h", "mi", "s", "ms", "TO_ULINT(wd)", "iy", "iw", "TO_ULINT(iwd)",
              "JoinDateTime(y, mo, d, h, mi, s, ms)", "DATE_TO_ULINT(date)", "TOD_TO_ULINT(time)", "BOOL_TO_ULINT(IsLeapYear(y))"]
    body = [f"SplitDateTime(t[i], {parts});", "WeekOfYear(t[i], uiYear => iy, uiWeek => iw, eWeekday => iwd);",
            "SeparateDateTime(t[i], datDate => date, todTime => time);"]
    body += [f"f[i, {k}] := {value};" for k, value in enumerate(stores)]
    for k, zone in enumerate(ZONES):
        body += [f"f[i, {len(stores) + 2 * k}] := LocalDateTime(zone{zone}, t[i], ePeriod => p);",
                 f"f[i, {len(stores) + 2 * k + 1}] := TO_ULINT(p);"]
    table = ", ".join(f"(usiSwitch := {n}, todFirstOn := UDINT_TO_TOD({a}), todLastOn := UDINT_TO_TOD({b}), byDayFlags := {d})"
                      for n, a, b, d in SCHEDULES)
    switches, calls = [], []
    for k, (zone, speed, moment) in enumerate(runs):
        given = "" if zone == "CET" else f", tzTimeZone := zone{zone}"  # the default
        switches += [f"  clock{k} : Clock;", f"  switch{k} : TimerSwitch := (itfDateTimeProvider := clock{k}, tCompensationSpeed := T#{speed}ms);",
                     f"  t{k} : ARRAY [0..{len(moment) - 1}] OF ULINT := [{', '.join(map(str, moment))}];",
                     f"  r{k} : ARRAY [0..{len(moment) - 1}, 0..5] OF LINT;"]
        calls += [f"FOR i := 0 TO {len(moment) - 1} DO", f"  clock{k}.now := t{k}[i];",
                  f"  switch{k}(xEnable := TRUE, aslSchedule := plan{given});"]
        calls += [f"  r{k}[i, {n}] := {value};" for n, value in enumerate((
            f"DWORD_TO_LINT(switch{k}.dwSwitches)", f"switch{k}.liClockDiff", f"TO_LINT(switch{k}.eWeekDay)",
            f"DATE_TO_LINT(switch{k}.datToday)", f"TOD_TO_LINT(switch{k}.todNow)", f"TO_LINT(switch{k}.ePeriod)"))]
        calls += ["END_FOR"]
    lines = ["FUNCTION_BLOCK Clock IMPLEMENTS IDateTimeProvider", "VAR_INPUT now : ULINT; END_VAR", "METHOD GetDateTime : ULINT",
             "VAR_OUTPUT eErrorID : ERROR; END_VAR", "GetDateTime := now;", "END_METHOD", "END_FUNCTION_BLOCK", "PROGRAM Main", "VAR",
             "  i : DINT; y, iy : YEAR; mo : MONTH; d : DAY; h : HOUR; mi : MINUTE; s : SECOND; ms : MILLISECOND; iw : WEEK;",
             "  wd, iwd : WEEKDAY; p : PERIOD; date : DATE; time : TOD; done : BOOL; now : ARRAY [0..4] OF ULINT; n : DINT;",
             *[f"  zone{zone} : TimeZone := {zone_text(zone)};" for zone in ZONES],
             f"  plan : ARRAY [1..{len(SCHEDULES)}] OF Schedule := [{table}];",
             f"  t : ARRAY [0..{len(times) - 1}] OF ULINT := [{', '.join(map(str, times))}];",
             f"  f : ARRAY [0..{len(times) - 1}, 0..{len(stores) + 2 * len(ZONES) - 1}] OF ULINT;", *switches, "END_VAR",
             "now[n] := GetDateTime(); n := n + 1;", "IF done THEN RETURN; END_IF", "done := TRUE;",
             f"FOR i := 0 TO {len(times) - 1} DO", *body, "END_FOR", *calls, "END_PROGRAM"]
    return "\n".join(lines) + "\n"


def main():
    stride = str(pathlib.Path(sys.argv[1]).resolve())
    times = moments()
    runs = [(zone, speed, switch_moments(zone)) for zone in ("CET", "LHST") for speed in SPEEDS]
    expected = {f"f[{i},{k}]": v for i, utc in enumerate(times) for k, v in enumerate(function_values(utc))}
    for n, (zone, speed, _) in enumerate(runs):
        expected |= {f"r{n}[{i},{k}]": v for i, row in enumerate(switch_values(zone, speed)) for k, v in enumerate(row)}
    expected |= {f"now[{i}]": 10 * i for i in range(5)}  # the system's clock is virtual in a simulation
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / "timer_switch.st"
        source.write_text(program(times, runs), encoding="utf-8")
        names = ",".join(f"Main.{name}" for name in ("f", "now", *(f"r{n}" for n in range(len(runs)))))
        done = subprocess.run([stride, "sim", str(source), "--for", "50ms", "-W", "off=all-warnings", "-W", "off=lints", "--print", names],
                              capture_output=True, text=True, cwd=folder, check=False)
    if done.returncode != 0:
        sys.exit(f"{done.stderr[:4000]}\n{stride} gave {done.returncode}")
    values = {name.replace(" ", ""): int(v) for name, v in re.findall(r"^Main\.(\S+(?:, ?\d+\])?) = (-?\d+)$", done.stdout, re.M)}
    wrong = [(name, v, values.get(name)) for name, v in expected.items() if values.get(name) != v]
    for name, v, got in wrong[:20]:
        print(f"{name} must be {v}, is {got}")
    print(f"{len(expected)} values, {len(wrong)} wrong")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
