"""Arithmetic of times and dates, and their parts."""
import datetime
from fractions import Fraction

from model import DAY, EPOCH, UNIT, half_away, held, wrap
from numeric import cut
from tables import Table, time_values


def turned(kind, clock, time, way):
    """A time of day after a duration, or before it. Less than a day below the wrap a TIME is one below 0."""
    if way[1] == "TIME" and time > 2**32 - 86400000:
        time -= 2**32
    return (clock * UNIT[kind] + way[0] * time * UNIT[way[1]]) // UNIT[kind] % (DAY // UNIT[kind])


def dates():
    table = Table("dates")
    rnd = table.random

    def pairs(a, b, n=6):
        one, two = time_values(a, rnd, 6), time_values(b, rnd, 6)
        return [(rnd.choice(one), rnd.choice(two)) for _ in range(n)] + [(one[-1], two[0]), (one[0], two[-1]), (one[0], two[0])]

    # one kind with the fraction of the other
    day = 86400000
    for a, b in [(0, -1), (0, 1), (day - 1, 999999), (day - 1, 10**6), (1, -10**6 - 1), (5, 2**63 - 1), (5, -2**63)]:
        table.add("$1 + $2", "TOD LTIME", [a, b], "TOD", turned("TOD", a, b, (1, "LTIME")))
        table.add("$1 - $2", "TOD LTIME", [a, b], "TOD", turned("TOD", a, b, (-1, "LTIME")))
        table.add("$1 + $2", "LTOD LTIME", [a, b], "LTOD", turned("LTOD", a, b, (1, "LTIME")))
    for a, b in [(0, 1), (10**6, 2**32 - 1), (0, 2**32 - 1), (86400 * 10**9 - 1, 1), (5, 2**32 - day), (5, 2**32 - day + 1)]:
        table.add("$1 + $2", "LTOD TIME", [a, b], "LTOD", turned("LTOD", a, b, (1, "TIME")))
        table.add("$1 - $2", "LTOD TIME", [a, b], "LTOD", turned("LTOD", a, b, (-1, "TIME")))
    for p in ("", "L"):
        time, tod, dt, date = p + "TIME", p + "TOD", p + "DT", p + "DATE"
        for a, b in pairs(time, time, 10):
            table.add(f"ADD_{time}($1, $2)", f"{time} {time}", [a, b], time, wrap(time, a + b))
            table.add(f"SUB_{time}($1, $2)", f"{time} {time}", [a, b], time, wrap(time, a - b))
            table.add("$1 < $2", f"{time} {time}", [a, b], "BOOL", int(a < b))
            table.third("ADD($1, $2)", f"{time} {time}", [a, b], time, wrap(time, a + b))
            table.third("LT($1, $2)", f"{time} {time}", [a, b], "BOOL", int(a < b))
            table.add("MAX($1, $2)", f"{time} {time}", [a, b], time, max(a, b))
        for kind in (tod, dt):
            for a, b in pairs(kind, time, 10):
                # exact, then rounded down to the type's unit
                later = turned(kind, a, b, (1, time)) if kind == tod else wrap(kind, (a * UNIT[kind] + b * UNIT[time]) // UNIT[kind])
                table.add(f"ADD_{kind}_{time}($1, $2)", f"{kind} {time}", [a, b], kind, later)
                table.add("$1 + $2", f"{kind} {time}", [a, b], kind, later)
                table.third("ADD($1, $2)", f"{kind} {time}", [a, b], kind, later)
                earlier = turned(kind, a, b, (-1, time)) if kind == tod else wrap(kind, (a * UNIT[kind] - b * UNIT[time]) // UNIT[kind])
                table.add(f"SUB_{kind}_{time}($1, $2)", f"{kind} {time}", [a, b], kind, earlier)
        day = DAY // UNIT[tod]
        for a, b in [(0, 1), (day - 1, 1), (day - 1, 0), (0, day - 1), (day - 1, day), (1, 2 * day - 1), (day // 2, 40 * day)]:
            table.add("$1 + $2", f"{tod} {time}", [a, b], tod, (a + b) % day)
            table.add("$1 - $2", f"{tod} {time}", [a, b], tod, (a - b) % day)
            if b < day:  # a difference below 0 leads back
                table.add("$1 + ($2 - $1)", f"{tod} {tod}", [a, b], tod, b)
                table.add("$1 - ($1 - $2)", f"{tod} {tod}", [a, b], tod, b)
        for kind in (tod, dt, date):
            for a, b in pairs(kind, kind, 10):
                table.add(f"SUB_{kind}_{kind}($1, $2)", f"{kind} {kind}", [a, b], time,
                          wrap(time, (a - b) * UNIT[kind] // UNIT[time]))
        for a in time_values(time, rnd, 4):
            for b in (0, 1, 3, 7, -1 if p else 2, rnd.randint(2, 1000)):
                table.add("$1 * $2", f"{time} INT", [a, b], time, wrap(time, a * b))
                for name in (f"MUL_{time}",) if p else ("MUL_TIME", "MULTIME", "MUL"):
                    table.third(f"{name}($1, $2)", f"{time} INT", [a, b], time, wrap(time, a * b))
                if b != 0:
                    table.add("$1 / $2", f"{time} INT", [a, b], time, wrap(time, cut(a, b)))
                    for name in (f"DIV_{time}",) if p else ("DIV_TIME", "DIVTIME", "DIV"):
                        table.third(f"{name}($1, $2)", f"{time} INT", [a, b], time, wrap(time, cut(a, b)))
    for a in (0, 1, 3, 1000, 86400000):
        for f in (0.5, 0.25, 2.5, 0.0):
            table.add("$1 * $2", "TIME LREAL", [a, f], "TIME", half_away(a * Fraction(f)))
            table.third("MUL_TIME($1, $2)", "TIME LREAL", [a, f], "TIME", half_away(a * Fraction(f)))
            if f:
                table.add("$1 / $2", "TIME LREAL", [a, f], "TIME", half_away(a / Fraction(f)))
                table.third("DIV_TIME($1, $2)", "TIME LREAL", [a, f], "TIME", half_away(a / Fraction(f)))

    days = [datetime.date(*d) for d in ((1970, 1, 1), (1972, 2, 29), (1999, 12, 31), (2000, 2, 28), (2000, 2, 29), (2000, 3, 1),
                                        (2000, 12, 31), (2024, 2, 29), (2038, 1, 19), (2100, 2, 28), (2100, 3, 1), (2106, 2, 6))]
    days += [datetime.date.fromordinal(EPOCH + rnd.randrange(49710)) for _ in range(20)]
    far = [datetime.date(*d) for d in ((1677, 9, 22), (1900, 2, 28), (1900, 3, 1), (1969, 12, 31), (2200, 2, 28), (2262, 4, 10))]
    number = lambda d: d.toordinal() - EPOCH
    for d in days + far:
        for date in ("DATE", "LDATE"):
            if date == "DATE" and d in far:
                continue
            unit = DAY // UNIT[date]
            v = number(d) * unit
            table.add(f"CONCAT_{date}($1, $2, $3)", "INT INT INT", [d.year, d.month, d.day], date, v)
            table.add("DAY_OF_WEEK($1)", date, [v], "INT", d.isoweekday() % 7)
            for part, kind, value in (("YEAR", "UINT", d.year), ("MONTH", "USINT", d.month), ("DAY", "USINT", d.day)):
                table.add(f"SPLIT_{date}($1, {part} => $r)", date, [v], kind, value)
    # parts beyond their ranges carry on
    for y, m, d in ((2023, 13, 1), (2024, 0, 31), (2024, -11, 1), (2024, 3, 0), (2023, 2, 29), (2024, 1, 366), (2000, 25, -3)):
        years, month = divmod(m - 1, 12)
        v = number(datetime.date(y + years, month + 1, 1)) + d - 1
        table.add("CONCAT_DATE($1, $2, $3)", "INT INT INT", [y, m, d], "DATE", v * 86400)
    for _ in range(30):
        h, m, s, ms, us, ns = (rnd.randrange(24), rnd.randrange(60), rnd.randrange(60), rnd.randrange(1000), rnd.randrange(1000),
                               rnd.randrange(1000))
        d = rnd.choice(days)
        tod = ((h * 60 + m) * 60 + s) * 1000 + ms
        ltod = tod * 10**6 + us * 1000 + ns
        dt = number(d) * 86400 + tod // 1000
        if dt >= 2**32:
            continue
        ldt = number(d) * DAY + ltod
        four, six, three = "INT INT INT INT", "INT INT INT INT INT INT", "INT INT INT"
        table.add("CONCAT_TOD($1, $2, $3, $4)", four, [h, m, s, ms], "TOD", tod)
        table.add("CONCAT_LTOD($1, $2, $3, $4, $5, $6)", six, [h, m, s, ms, us, ns], "LTOD", ltod)
        table.add("CONCAT_LTOD($1, $2, $3, $4)", four, [h, m, s, ms], "LTOD", tod * 10**6)
        table.add("CONCAT_DT($1, $2, $3, $4, $5, $6, $7)", f"{three} {four}", [d.year, d.month, d.day, h, m, s, ms], "DT", dt)
        table.add("CONCAT_LDT($1, $2, $3, $4, $5, $6, $7, $8, $9)", f"{three} {six}",
                  [d.year, d.month, d.day, h, m, s, ms, us, ns], "LDT", ldt)
        table.add("CONCAT_DATE_TOD($1, $2)", "DATE TOD", [number(d) * 86400, tod], "DT", dt)
        table.add("CONCAT_DATE_LTOD($1, $2)", "DATE LTOD", [number(d) * 86400, ltod], "LDT", ldt)
        clock = (("HOUR", "USINT", h), ("MINUTE", "USINT", m), ("SECOND", "USINT", s))
        day = (("YEAR", "UINT", d.year), ("MONTH", "USINT", d.month), ("DAY", "USINT", d.day))
        fine = (("MILLISECOND", "UINT", ms), ("MICROSECOND", "UINT", us), ("NANOSECOND", "UINT", ns))
        for kind, v, parts in (("TOD", tod, clock + fine[:1]), ("LTOD", ltod, clock + fine), ("DT", dt, day + clock),
                               ("LDT", ldt, day + clock + fine)):
            part, small, value = rnd.choice(parts)
            table.add(f"SPLIT_{kind}($1, {part} => $r)", kind, [v], small, value)
            part, small, value = rnd.choice(parts)
            table.add(f"SPLIT_{kind}($1, {part} => $r)", kind, [v], small, value)
    for h, m, s, ms in ((24, 0, 0, 0), (25, 1, 2, 3), (0, 0, 0, -1), (-1, 0, 0, 0), (23, 59, 60, 0)):
        tod = (((h * 60 + m) * 60 + s) * 1000 + ms) % 86400000
        table.add("CONCAT_TOD($1, $2, $3, $4)", "INT INT INT INT", [h, m, s, ms], "TOD", tod)
    table.add("CONCAT_DT($1, $2, $3, $4, $5, $6, $7)", "INT INT INT INT INT INT INT", [2106, 2, 7, 6, 28, 15, 999], "DT", 2**32 - 1)
    table.add("CONCAT_DT($1, $2, $3, $4, $5, $6, $7)", "INT INT INT INT INT INT INT", [2106, 2, 7, 6, 28, 16, 0], "DT", 0)
    table.add("CONCAT_DT($1, $2, $3, $4, $5, $6, $7)", "INT INT INT INT INT INT INT", [1970, 1, 1, 0, 0, 1, -1], "DT", 0)
    table.add("CONCAT_DATE($1, $2, $3)", "INT INT INT", [2106, 2, 8], "DATE", held("DATE", 49711 * 86400))
    table.write()
