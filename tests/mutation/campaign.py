"""Builds the mutated copy, finds out which test reaches which mutant, and runs those."""

import hashlib
import json
import os
import re
import signal
import subprocess
import sys
import time
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import draw
import emission
from tree import write_tree

HERE = Path(__file__).parent
TOP = HERE.parent.parent
FOLDER = TOP / os.environ.get("STRIDE_MUTATION_FOLDER", "build/mutation")
TREE = FOLDER / "tree"
CACHE = FOLDER / "cache"  # what mutants have compiled is nothing for the user's cache
BUILD = TREE / "build/mutation"  # as deep below the sources as other builds, so that ccache knows what they have compiled
# Slow, about something else, or about the sources themselves.
NOT_RUN = re.compile(r"^(qemu\.|faults_test|soak_|hostile_|install_test|docs\.|bench_|large_projects|concurrent_builds|mutation_test|house|"
                     r"conformance|codegen_random|slow_disk|explain_test|bad_input|cycle_trap|debug_test|fmt_test|golden\.format|format_test|syntax_test|"
                     r"documents_test|shared_tasks|diagnostics\.coverage|unit_headers)")
MOST_MUTANTS = 4095
LIMITED = ["prlimit", f"--as={8 << 30}"]  # a mutant may ask for memory without end
QUICK = 1.0  # seconds: tests that run before g++ does


def equivalents():
    """key: reason"""
    path = HERE / "equivalent.toml"
    listed = tomllib.loads(path.read_text())["mutant"] if path.exists() else []
    return {entry["key"]: entry["reason"] for entry in listed}


class State:
    """What is known so far; kept on disk, so that a campaign can go on where it was stopped"""

    def __init__(self):
        self.path = FOLDER / "state.json"
        known = json.loads(self.path.read_text()) if self.path.exists() else {}
        self.broken = set(known.get("broken", []))      # keys of what does not compile
        self.computed = set(known.get("computed", []))  # keys of what the compiler computes
        self.tests = known.get("tests", {})         # name: {"seconds", "fingerprint", "reached"}
        self.numbers = known.get("numbers", {})     # key: the number that it keeps, so that others need not be compiled again
        self.keys = known.get("keys", [])           # the mutants that were there when it was found out what the tests reach
        self.results = known.get("results", {})     # key: {"killed_by"} (null: it survives)

    def save(self):
        """After every result"""
        FOLDER.mkdir(parents=True, exist_ok=True)
        fresh = self.path.with_suffix(".new")
        fresh.write_text(json.dumps({"broken": sorted(self.broken), "computed": sorted(self.computed), "numbers": self.numbers,
                                     "keys": self.keys, "tests": self.tests, "results": self.results}, indent=1))
        fresh.rename(self.path)


def drawn(state, areas):
    """All mutants by number"""
    numbered = {}
    for area in areas:
        for mutant in draw.draw(TOP, area, lambda mutant: mutant.key not in state.broken | state.computed):
            number = state.numbers.setdefault(mutant.key, max(state.numbers.values(), default=0) + 1)
            numbered[number] = mutant
    assert max(numbered) <= MOST_MUTANTS
    return dict(sorted(numbered.items()))


def environment(**more):
    return {**os.environ, "CCACHE_SLOPPINESS": "pch_defines,time_macros", "XDG_CACHE_HOME": str(CACHE), **more}


def is_program(name, tests):
    """A golden program or project of which emission.py knows what the compiler makes"""
    return (name.startswith("golden.programs.")
            or name.startswith("golden.projects.") and emission.project_of(Path(tests[name][0][-1]), TREE) is not None)


def build(state, areas, options):
    """Plants the mutants of all areas, so that another area need not be built later, and builds the tests of these; draws again
    without what does not compile, until all of it does. All mutants by number"""
    while True:
        numbered = drawn(state, draw.AREAS)
        write_tree(TOP, TREE, numbered)
        configure = ["cmake", "-S", str(TREE), "-B", str(BUILD), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON"]
        subprocess.run(configure, check=True, stdout=subprocess.DEVNULL)
        done = subprocess.run(["ninja", "-C", str(BUILD), "-k", "0", f"-j{options.jobs}", *targets_of(areas)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, errors="replace", env=environment())
        (FOLDER / "build.log").write_text(done.stdout)
        if done.returncode == 0:
            (FOLDER / "drawn.json").write_text(json.dumps({number: mutant.key for number, mutant in numbered.items()}))
            return numbered
        wrong = {int(number) for number in re.findall(r"stride_mutant_(\d+):\d+:\d+: (?:\x1b\[[\d;]*[mK])*(?:fatal )?error", plain(done.stdout))}
        if not wrong:
            raise SystemExit(f"the mutated copy does not build; see {FOLDER / 'build.log'}")
        print(f"{len(wrong)} mutants do not compile", flush=True)
        state.broken |= {numbered[number].key for number in wrong}
        state.save()


def targets_of(areas):
    """The programs of the tests of these areas, and what tests start"""
    listed = "".join(path.read_text() for path in BUILD.rglob("CTestTestfile.cmake"))
    programs = re.findall(rf'^add_test\((?:\[=+\[)?([^\s\]]+)(?:\]=+\])? "{re.escape(str(BUILD))}/([^"]+)"', listed, re.MULTILINE)
    return ["stride_programs", *sorted({program for name, program in programs if is_wanted(name, areas)})]


def is_wanted(name, areas):
    return not NOT_RUN.match(name) and any(re.match(area.tests, name) for area in areas)


def of_areas(numbered, areas):
    names = {area.name for area in areas}
    return {number: mutant for number, mutant in numbered.items() if mutant.area in names}


def built(state, areas, options):
    """What was drawn when it was built"""
    known = json.loads((FOLDER / "drawn.json").read_text())
    numbered = drawn(state, draw.AREAS)
    if any(known.get(str(number)) != mutant.key for number, mutant in numbered.items()):
        raise SystemExit("other mutants are drawn now than when the copy was built: leave out --built")
    return numbered


def plain(text):
    return re.sub(r"\x1b\[[\d;]*[mK]", "", text)


def tests_of_build(areas):
    """name: (command, folder, environment) of the tests of any of these areas"""
    listed = subprocess.run(["ctest", "--test-dir", str(BUILD), "--show-only=json-v1"], check=True, capture_output=True, text=True)
    out = {}
    for test in json.loads(listed.stdout)["tests"]:
        properties = {entry["name"]: entry["value"] for entry in test.get("properties", [])}
        if is_wanted(test["name"], areas) and "command" in test:
            variables = dict(pair.split("=", 1) for pair in properties.get("ENVIRONMENT", []))
            out[test["name"]] = (test["command"], properties.get("WORKING_DIRECTORY", str(BUILD)), variables)
    if any(re.match(area.tests, "random_small") for area in areas):
        out["random_small"] = ([sys.executable, str(TREE / "tests/random/random_programs.py"), str(BUILD / "stride"), "--small",
                                "--seeds", "1..8", "--modes", "O0"], str(BUILD), {"PYTHONDONTWRITEBYTECODE": "1"})
    return out


def run(test, limit, **variables):
    """Whether the test passes: True, False, or None when it takes longer than `limit` seconds"""
    command, folder, own = test
    process = subprocess.Popen([*LIMITED, *command], cwd=folder, env=environment(GTEST_FAIL_FAST="1", GTEST_BRIEF="1", **own, **variables),
                               stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        return process.wait(limit) == 0
    except subprocess.TimeoutExpired:
        return None
    finally:
        try:
            os.killpg(process.pid, signal.SIGKILL)  # what it has started
        except ProcessLookupError:
            pass
        process.wait()


def with_marks(name, numbered, work):
    """What `work` gives when STRIDE_MUTATION_REACHED is what it is given, how long it takes, and the keys that it reaches"""
    path = FOLDER / f"reached.{name.replace('/', '_')}"
    path.write_bytes(bytes(MOST_MUTANTS + 1))
    begin = time.monotonic()
    result = work({"STRIDE_MUTATION_REACHED": str(path)})
    seconds = time.monotonic() - begin
    marks = path.read_bytes()
    path.unlink()
    return result, seconds, [numbered[n].key for n in numbered if marks[n]]


def emit(tests, name, **variables):
    """What the compiler makes of a golden program"""
    return emission.emitted([*LIMITED, str(BUILD / "stride")], Path(tests[name][0][-1]), FOLDER / "emitted" / name, TREE, environment(**variables))


def reach(state, tests, everything, jobs):
    """Runs every test without a mutant; which it reaches, and how long that takes. Of a golden program, only what the compiler
    reaches: g++ would take most of the time of a campaign (run_programs)."""
    def one(name):
        if is_program(name, tests):
            text, seconds, keys = with_marks(name, everything, lambda more: emit(tests, name, **more))
            return name, {"seconds": seconds, "fingerprint": fingerprint(tests[name]), "reached": keys, "emitted": text}
        passed, seconds, keys = with_marks(name, everything, lambda more: run(tests[name], 600, **more))
        if not passed:
            print(f"{name} fails without a mutant: not used", flush=True)
        return name, {"seconds": seconds, "fingerprint": fingerprint(tests[name]), "reached": keys if passed else []}

    missing = [name for name in tests if name not in state.tests]
    with ThreadPoolExecutor(jobs) as pool:
        for done, (name, found) in enumerate(pool.map(one, missing), 1):
            state.tests[name] = found
            if done % 10 == 0:
                state.save()
    state.save()


def run_programs(state, tests, names, everything, jobs):
    """Runs these golden programs without a mutant, as reach() does with all others: for mutants of the runtime that have
    survived those"""
    def one(name):
        passed, seconds, keys = with_marks(name, everything, lambda more: run(tests[name], 600, **more))
        return name, {"run_seconds": seconds, "run_reached": keys if passed else []}

    missing = [name for name in names if "run_seconds" not in state.tests[name]]
    with ThreadPoolExecutor(jobs) as pool:
        for done, (name, found) in enumerate(pool.map(one, missing), 1):
            state.tests[name] |= found
            if done % 10 == 0:
                state.save()
    state.save()


def wanted_for(mutant):
    return re.compile(next(area.tests for area in draw.AREAS if area.name == mutant.area))


def order_of(mutant, state, tests, longest):
    """The tests that reach it, quick ones first; no golden programs, and none that takes longer than so many seconds"""
    wanted = wanted_for(mutant)
    found = sorted((state.tests[name]["seconds"], name) for name in tests
                   if not is_program(name, tests) and mutant.key in state.tests[name]["reached"] and wanted.match(name))
    return [name for seconds, name in found if seconds <= longest]


class Hunt:
    """One mutant meets tests until one of them notices it"""

    def __init__(self, number, mutant, state, tests, options):
        self.number, self.mutant, self.state, self.tests, self.options = number, mutant, state, tests, options
        self.wanted = wanted_for(mutant)
        self.killers = []

    def meet(self, names, work):
        """The first killer among the tests, or None"""
        with ThreadPoolExecutor(self.options.jobs) as pool:
            list(pool.map(lambda name: None if self.killers else work(name), names))
        return self.killers[0] if self.killers else None

    def test(self, name, seconds=None):
        limit = 20 + 8 * (self.state.tests[name]["seconds"] if seconds is None else seconds)
        passed = run(self.tests[name], limit, STRIDE_MUTANT=str(self.number))
        # Twice, so that a test that fails by chance, or waits for a loaded machine, kills nothing.
        if passed or run(self.tests[name], limit, STRIDE_MUTANT=str(self.number)):
            return False
        # The first run of a golden program without a mutant may be this one.
        if is_program(name, self.tests) and not run(self.tests[name], limit):
            print(f"{name} fails without a mutant: not used", flush=True)
            return False
        self.killers.append(name + (" (time limit)" if passed is None else ""))
        return True

    def other_text(self, names):
        """Golden programs of which the compiler makes something else, until so many of them have been met"""
        met = []

        def one(name):
            if self.options.golden and len(met) >= self.options.golden:
                return
            if emit(self.tests, name, STRIDE_MUTANT=str(self.number)) != self.state.tests[name]["emitted"]:
                met.append(name)
                self.test(name, seconds=10)

        return self.meet(names, one)

    def programs(self, everything):
        """Golden programs: those of which the compiler makes something else, or that reach the mutant when they run"""
        known = self.state.tests
        some = sorted(name for name in self.tests if is_program(name, self.tests) and self.wanted.match(name))
        if self.mutant.file.startswith("compiler/"):
            reached = [name for name in some if self.mutant.key in known[name]["reached"]]
            return self.other_text(sorted(reached, key=lambda name: known[name]["seconds"]))
        run_programs(self.state, self.tests, some, everything, self.options.jobs)
        reached = [name for name in some if self.mutant.key in known[name]["run_reached"]]
        quickest = sorted(reached, key=lambda name: known[name]["run_seconds"])[:self.options.golden or None]
        return self.meet(quickest, lambda name: self.test(name, known[name]["run_seconds"]))

    def killer(self, everything):
        order = order_of(self.mutant, self.state, self.tests, self.options.longest)
        early = [name for name in order if not self.mutant.file.startswith("compiler/") or self.state.tests[name]["seconds"] < QUICK]
        return (self.meet(early, self.test) or self.programs(everything)
                or self.meet([name for name in order if name not in early], self.test))


def campaign(state, everything, numbered, tests, options):
    equivalent = equivalents()
    for number, mutant in numbered.items():
        known = state.results.get(mutant.key)
        if mutant.key in equivalent or known and not (options.again and known["killed_by"] is None):
            continue
        begin = time.monotonic()
        killer = Hunt(number, mutant, state, tests, options).killer(everything)
        state.results[mutant.key] = {"killed_by": killer}
        state.save()
        print(f"{number:4} {time.monotonic() - begin:6.1f} s  {'killed by ' + killer if killer else 'SURVIVES'}  {mutant.file}:{mutant.line}  {mutant.key}",
              flush=True)


def passed_over(state, area):
    """How many mutants of an area do not compile, and how many the compiler computes"""
    keys = {mutant.key for mutant in draw.candidates(TOP, area)}
    return {"broken": len(keys & state.broken), "computed": len(keys & state.computed)}


def report(state, numbered):
    """Per area: how many were drawn, and passed over for others; killed, survived, equivalent; then every survivor"""
    equivalent = equivalents()
    rows, survivors = {}, []
    areas = {area.name: area for area in draw.AREAS}
    for number, mutant in numbered.items():
        if mutant.area not in rows:
            rows[mutant.area] = {"drawn": 0, **passed_over(state, areas[mutant.area]), "killed": 0, "survived": 0, "equivalent": 0, "open": 0}
        row = rows[mutant.area]
        row["drawn"] += 1
        known = state.results.get(mutant.key)
        verdict = ("equivalent" if mutant.key in equivalent else "open" if known is None
                   else "killed" if known["killed_by"] else "survived")
        row[verdict] += 1
        if verdict == "survived":
            survivors.append((number, mutant))
    rows["all"] = {column: sum(row[column] for row in rows.values()) for column in next(iter(rows.values()))}
    print(f"{'area':12} {'drawn':>6} {'not C++':>8} {'computed':>9} {'killed':>7} {'survived':>9} {'equivalent':>11} {'open':>5}  killed of the others")
    for name, row in rows.items():
        judged = row["killed"] + row["survived"]
        print(f"{name:12} {row['drawn']:6} {row['broken']:8} {row['computed']:9} {row['killed']:7} {row['survived']:9} {row['equivalent']:11} {row['open']:5}  "
              + (f"{100 * row['killed'] / judged:.1f} %" if judged else "-"))
    for number, mutant in survivors:
        reached = sum(mutant.key in test["reached"] for test in state.tests.values())
        print(f"\n{number}: {mutant.file}:{mutant.line}, reached by {reached} tests\n  {mutant.key}")


def fingerprint(test):
    """Changes with the files that the command names: the program, the case"""
    files = []
    for word in test[0]:
        path = Path(word)
        found = path.rglob("*") if path.is_dir() and TREE in path.parents else [path] if path.is_file() else []
        files += [f"{file} {file.stat().st_mtime_ns}" for file in found if file.is_file() and ".stride" not in file.parts]
    return hashlib.sha256("\n".join(sorted(files)).encode()).hexdigest()


def forget_changed(state, tests, everything):
    """Tests that are not what they were when it was found out what they reach"""
    keys = sorted(mutant.key for mutant in everything.values())
    if not set(keys) <= set(state.keys):
        state.tests = {}
    state.keys = sorted(set(keys) | set(state.keys)) if state.tests else keys
    for name in list(state.tests):
        if name in tests and state.tests[name]["fingerprint"] != fingerprint(tests[name]):
            del state.tests[name]


def at_compile_time(state, tests, numbered):
    """Keys of those in functions that no test reaches and that the compiler computes, as it does for tables"""
    reached = {key for name in tests for key in state.tests[name]["reached"]}
    return {mutant.key for mutant in numbered.values()
            if mutant.key not in reached and {"constexpr", "consteval"} & {token.text for token in mutant.body.head}}


def whole(state, areas, options):
    """Build, reach, run, report"""
    while True:
        everything = (built if options.built else build)(state, areas, options)
        numbered = {number: mutant for number, mutant in of_areas(everything, areas).items() if options.file in mutant.file}
        tests = tests_of_build(areas)
        forget_changed(state, tests, everything)
        reach(state, tests, everything, options.jobs)
        computed = at_compile_time(state, tests, numbered)
        if not computed or options.built:
            break
        print(f"{len(computed)} mutants are of functions that the compiler computes", flush=True)
        state.computed |= computed
        state.save()
    campaign(state, everything, numbered, tests, options)
    report(state, of_areas(drawn(state, draw.AREAS), areas))
