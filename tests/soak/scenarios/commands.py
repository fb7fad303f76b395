"""Several commands work on one project at once, with different options, while its sources change: each one's result is that of its
own options and of the sources as they were, as if it had been alone; applications are the same byte for byte."""
import itertools
import os
import shutil
import time

import invariants

MAIN = """PROGRAM PLC_PRG
VAR sum : DINT; END_VAR
sum := {sum};
{{IF defined (A)}}sum := sum + 1000000;{{END_IF}}
{{IF defined (B)}}sum := sum + 2000000;{{END_IF}}
END_PROGRAM
"""
PART = """FUNCTION Part{i} : DINT
Part{i} := {value};
{{IF defined (A)}}Part{i} := Part{i} + 10000;{{END_IF}}
END_FUNCTION
FUNCTION_BLOCK Block{i}
VAR n : DINT; END_VAR
n := n + {value};
END_FUNCTION_BLOCK
"""
TEST = """{attribute 'test'}
FUNCTION_BLOCK SumsUp
VAR expected : DINT; END_VAR
PLC_PRG();
ASSERT_GT(PLC_PRG.sum, 0);
END_FUNCTION_BLOCK
"""


class Sources:
    """The project's parts and what the program sums up"""

    def __init__(self, round_, count):
        self.round, self.folder, self.count = round_, round_.folder / "project", count
        self.folder.mkdir()
        # What each part may be: the value now, and the one before when it may still be in use.
        self.values = [[i + 1] for i in range(count)]
        self.put("Main.st", MAIN.format(sum=" + ".join(f"Part{i}()" for i in range(count))))
        self.put("Tests.st", TEST)
        for i in range(count):
            self.put(f"Part{i}.st", PART.format(i=i, value=i + 1))

    def put(self, name, text):
        """As editors do that write safely: no command ever sees half a file."""
        fresh = self.folder / f".{name}.new"
        fresh.write_text(text, encoding="utf-8")
        os.replace(fresh, self.folder / name)

    def edit(self):
        i = self.round.rng.randrange(self.count)
        self.values[i].append(self.round.rng.randrange(1, 1000))
        self.put(f"Part{i}.st", PART.format(i=i, value=self.values[i][-1]))

    def settle(self):
        """No command works any more."""
        self.values = [[v[-1]] for v in self.values]

    def sums(self, defines):
        """What the program may compute"""
        plus = 1000000 * ("A" in defines) + 2000000 * ("B" in defines) + 10000 * self.count * ("A" in defines)
        return {sum(some) + plus for some in itertools.product(*self.values)}


class Job:
    """One command that runs beside others"""

    def __init__(self, round_, sources, number):
        rng, stride = round_.rng, round_.settings.product.stride
        self.round, self.sources = round_, sources
        self.defines = rng.choice([[], [], ["A"], ["B"], ["A", "B"]])
        self.kind = rng.choice(["build", "out", "out", "sim", "sim", "check", "test"])
        self.app = round_.folder / f"out{number}.so"
        self.options = [f"-D{d}" for d in self.defines] + ["-W", "off=lints"]
        if self.kind != "check" and self.kind != "test":
            self.options += rng.choice([[], ["--debug"], ["--unchecked"]])
        more = {"build": [], "out": ["-o", self.app], "sim": ["--for", "20ms", "--quiet", "--print", "PLC_PRG.sum"], "check": [], "test": []}[self.kind]
        self.process = round_.start(stride, "build" if self.kind == "out" else self.kind, sources.folder, *self.options, *more)

    def check(self):
        self.process.finish(600)
        what = f"{' '.join(self.process.arguments[1:])} beside others"
        if not self.round.expect(self.process.code == 0, f"{what}: exit code {self.process.code}: {self.process.out[-500:]}{self.process.err[-1500:]}"):
            return
        out = self.process.out
        if self.kind == "out":
            out = self.round.host("sim", self.app, "--for", "20ms", "--quiet", "--print", "PLC_PRG.sum").out
        if self.kind in ("out", "sim"):
            found = invariants.printed(out).get("PLC_PRG.sum")
            allowed = self.sources.sums(self.defines)
            self.round.expect(found is not None and int(found) in allowed, f"{what}: the sum is {found}, not {sorted(allowed)[:8]}")

    def is_like_alone(self):
        """A build of a copy of the sources, in another place and without what others have cached, gives the same bytes."""
        place = self.round.folder / f"alone-{self.app.stem}"
        shutil.copytree(self.sources.folder, place, ignore=shutil.ignore_patterns("build", ".*"))
        alone = place / "alone.so"
        self.round.stride("build", place, *self.options, "-o", alone, env={"XDG_CACHE_HOME": str(place / "cache")})
        self.round.expect(alone.read_bytes() == self.app.read_bytes(), f"{' '.join(self.options)}: other bytes than a build alone, {place}")
        self.round.counts["compared_builds"] += 1


def play(round_):
    rng = round_.rng
    sources = Sources(round_, round_.choose("parts", rng.randint(2, 12)))
    number = 0
    for _ in range(1 if round_.quick else round_.choose("phases", rng.randint(2, 5))):
        jobs = []
        for _ in range(2 if round_.quick else rng.randint(2, 6)):
            jobs.append(Job(round_, sources, number))
            number += 1
            time.sleep(rng.choice([0, 0, rng.uniform(0, 0.5)]))
        edits = rng.choice([0, 0, 1, 3])
        for _ in range(edits):
            time.sleep(rng.uniform(0, 0.3))
            sources.edit()
        for job in jobs:
            job.check()
        round_.counts["commands"] += len(jobs)
        built = [job for job in jobs if job.kind == "out" and job.process.code == 0]
        if built and not edits:
            rng.choice(built).is_like_alone()
        sources.settle()
        alone = Job(round_, sources, number)
        number += 1
        alone.check()
        sources.edit()
        sources.settle()
