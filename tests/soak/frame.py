"""What every scenario works with: the product, a round with its random numbers, its folder and its processes."""
import collections
import contextlib
import dataclasses
import os
import pathlib
import random
import shlex
import signal
import subprocess
import time


class Violation(Exception):
    """An invariant does not hold; the round cannot go on."""


@dataclasses.dataclass
class Product:
    """An installed Stride. Everything that runs here is one of its two commands."""
    bin: pathlib.Path

    @property
    def stride(self):
        return str(self.bin / "stride")

    @property
    def host(self):
        return str(self.bin / "stride-host")


@dataclasses.dataclass
class Settings:
    """What is the same for all rounds of a run."""
    product: Product
    seed: int
    quick: bool  # tiny rounds, for the test of the soak itself
    can_mount: bool
    source: pathlib.Path  # the repository
    tools: pathlib.Path  # what was built for the run, the clock's interposer


class Round:
    """One round of a scenario. All its choices come from `rng`, which is made of the seed, the scenario and the number."""

    def __init__(self, settings, scenario, number, folder):
        self.settings, self.scenario, self.number, self.folder = settings, scenario, number, folder
        self.rng = random.Random(f"{settings.seed}/{scenario}/{number}")
        self.quick = settings.quick
        self.counts = collections.Counter()
        self.violations = []
        self.parameters = {}
        self.processes = []
        self.cleanups = []
        self.started = time.monotonic()
        self.scratch = folder  # for caches and temporary files
        folder.mkdir(parents=True)
        self.log = open(folder / "log.txt", "w", encoding="utf-8")

    def note(self, text):
        """A line in the log of the round, with the time since its start."""
        self.log.write(f"[{time.monotonic() - self.started:8.3f}] {text}\n")
        self.log.flush()

    def choose(self, name, value):
        """Remembers a parameter for the report and gives it back."""
        self.parameters[name] = value
        return value

    def expect(self, holds, text):
        """Notes a violation and goes on; gives back whether it holds."""
        if not holds:
            self.violations.append(text)
            self.note(f"VIOLATION {text}")
        return bool(holds)

    def demand(self, holds, text):
        """As expect, but the round ends there."""
        if not holds:
            raise Violation(text)

    def environment(self, extra=None):
        (self.scratch / "tmp").mkdir(exist_ok=True)
        return {**os.environ, "XDG_CACHE_HOME": str(self.scratch / "cache"), "TMPDIR": str(self.scratch / "tmp"), **(extra or {})}

    @contextlib.contextmanager
    def surroundings(self):
        """For code of others that starts commands: their caches belong to the round."""
        before = dict(os.environ)
        os.environ.update(self.environment())
        try:
            yield
        finally:
            os.environ.clear()
            os.environ.update(before)

    def start(self, *arguments, cwd=None, env=None, name=None, place=None):
        """Starts a command whose output goes to files in `place`; it is ended with the round at the latest."""
        name = name or f"{len(self.processes):03d}"
        self.note(f"start {name}: {shlex.join(map(str, arguments))}")
        process = Process(self, name, [str(a) for a in arguments], cwd or self.folder, self.environment(env), place or self.folder)
        self.processes.append(process)
        return process

    def run(self, *arguments, timeout=600, **more):
        """Runs a command to its end. One that does not end, or dies of a signal, is a violation."""
        process = self.start(*arguments, **more)
        process.finish(timeout)
        return process

    def stride(self, *arguments, **more):
        return self.run(self.settings.product.stride, *arguments, **more)

    def host(self, *arguments, **more):
        return self.run(self.settings.product.host, *arguments, **more)

    def build(self, project, *options):
        """Builds a project that must build."""
        made = self.stride("build", project, "-W", "off=lints", *options)
        self.demand(made.code == 0, f"the project does not build (exit code {made.code}): {made.err[-1500:]}")
        self.counts["builds"] += 1

    def at_end(self, what):
        self.cleanups.append(what)

    def close(self):
        for process in self.processes:
            process.end()
        for what in reversed(self.cleanups):
            what()
        self.log.close()


class Process:
    """A command with its output in files of the round's folder."""

    def __init__(self, round_, name, arguments, cwd, environment, place):
        self.round, self.name, self.arguments = round_, name, arguments
        self.out_path, self.err_path = place / f"{name}.out", place / f"{name}.err"
        with open(self.out_path, "wb") as out, open(self.err_path, "wb") as err:
            self.popen = subprocess.Popen(arguments, cwd=cwd, env=environment, stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                                          start_new_session=True)
        self.killed = False

    @property
    def pid(self):
        return self.popen.pid

    @property
    def code(self):
        return self.popen.returncode

    @property
    def out(self):
        return self.out_path.read_text(encoding="utf-8", errors="replace")

    @property
    def err(self):
        return self.err_path.read_text(encoding="utf-8", errors="replace")

    def alive(self):
        return self.popen.poll() is None

    def signal(self, number):
        if self.alive():
            self.popen.send_signal(number)

    def kill(self):
        """kill -9, as a part of the scenario."""
        self.killed = True
        self.signal(signal.SIGKILL)
        self.popen.wait()

    def finish(self, timeout):
        try:
            self.popen.wait(timeout)
        except subprocess.TimeoutExpired:
            state = threads_of(self.pid)
            self.kill()
            raise Violation(f"{shlex.join(self.arguments)} has not ended within {timeout} s; its threads: {state}") from None
        self.round.note(f"end {self.name}: exit code {self.code}")
        if self.code < 0 and not self.killed:
            self.round.expect(False, f"{shlex.join(self.arguments)} died of signal {-self.code}: {self.err[-800:]}")

    def stop(self, timeout=120):
        """Ctrl-C, and the end."""
        self.signal(signal.SIGCONT)
        self.signal(signal.SIGINT)
        self.finish(timeout)

    def end(self):
        """Whatever the round left: no process survives it."""
        if self.alive():
            self.signal(signal.SIGCONT)
            self.kill()


def threads_of(pid):
    """Names, states and waiting places of a process's threads, for a process that hangs."""
    found = []
    for task in pathlib.Path(f"/proc/{pid}/task").glob("*"):
        try:
            stat = (task / "stat").read_text().rsplit(")", 1)
            found.append(f"{stat[0].split('(', 1)[1]}:{stat[1].split()[0]}:{(task / 'wchan').read_text()}")
        except OSError:
            pass
    return ", ".join(found)


def wait_until(condition, seconds, step=0.02):
    """Whether the condition became true in time."""
    end = time.monotonic() + seconds
    while True:
        if condition():
            return True
        if time.monotonic() > end:
            return False
        time.sleep(step)
