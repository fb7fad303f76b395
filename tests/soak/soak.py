#!/usr/bin/env python3
"""The soak test: random rounds of all scenarios against invariants, for hours. See docs/developers/soak.md.

usage: soak.py --product FOLDER [--hours H | --rounds N] [--seed S] [--scenario NAME,…] [--round N] [--out FOLDER] [--quick]
"""
import argparse
import collections
import ctypes
import importlib
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import time
import traceback

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from frame import Product, Round, Settings, Violation  # noqa: E402  pylint: disable=wrong-import-position

SOURCE = pathlib.Path(__file__).resolve().parents[2]
SCENARIOS = ("programs", "changes", "kills", "disks", "clocks", "clients", "commands", "days")
CLONE_NEWNS = 0x00020000


def arguments():
    parser = argparse.ArgumentParser(description="The soak test: random rounds of all scenarios against invariants; see docs/developers/soak.md.")
    parser.add_argument("--product", type=pathlib.Path, required=True, help="where Stride is installed or was built")
    parser.add_argument("--hours", type=float, default=1.0, help="how long; a round that has begun is finished")
    parser.add_argument("--rounds", type=int, help="so many rounds of each scenario instead")
    parser.add_argument("--seed", type=int, help="everything follows from it; default: a random one")
    parser.add_argument("--scenario", default=",".join(SCENARIOS), help=f"some of {', '.join(SCENARIOS)}")
    parser.add_argument("--round", type=int, help="only this round of each scenario")
    parser.add_argument("--out", type=pathlib.Path, help="where results and findings go")
    parser.add_argument("--quick", action="store_true", help="tiny rounds, for the test of the soak itself")
    parser.add_argument("--keep", action="store_true", help="keep the folders of good rounds, too")
    options = parser.parse_args()
    options.scenario = options.scenario.split(",")
    unknown = [name for name in options.scenario if name not in SCENARIOS]
    if unknown:
        parser.error(f"there is no scenario {', '.join(unknown)}; there are {', '.join(SCENARIOS)}")
    folders = [folder for folder in (options.product / "bin", options.product) if (folder / "stride").is_file()]
    if not folders:
        parser.error(f"there is no Stride in {options.product}")
    options.bin = folders[0].resolve()
    if options.seed is None:
        options.seed = random.SystemRandom().randrange(10**9)
    options.out = options.out or pathlib.Path("build") / "soak" / f"seed-{options.seed}"
    return options


def private_mounts():
    """Whether this process can mount; what it mounts vanishes with it."""
    libc = ctypes.CDLL(None, use_errno=True)
    if os.geteuid() != 0 or libc.unshare(CLONE_NEWNS) != 0:
        return False
    return subprocess.run(["mount", "--make-rprivate", "/"], capture_output=True, check=False).returncode == 0


class Soak:
    def __init__(self, options):
        self.options = options
        out = options.out.resolve()
        self.out, self.findings = out, []
        self.work = out / "work"
        shutil.rmtree(self.work, ignore_errors=True)
        tools = out / "tools"
        tools.mkdir(parents=True, exist_ok=True)
        self.settings = Settings(Product(options.bin), options.seed, options.quick, private_mounts(), SOURCE, tools)
        self.counts = {name: collections.Counter() for name in options.scenario}
        self.started = time.monotonic()
        self.began = time.strftime("%Y-%m-%d %H:%M:%S")

    def rounds(self):
        """Scenario and number, one after the other, until the time is over"""
        if self.options.round is not None:
            yield from ((name, self.options.round) for name in self.options.scenario)
            return
        number = 0
        while self.options.rounds is None or number < self.options.rounds:
            for name in self.options.scenario:
                if self.options.rounds is None and time.monotonic() - self.started > self.options.hours * 3600:
                    return
                yield name, number
            number += 1

    def play(self, name, number):
        folder = self.work / f"{name}-{number}"
        round_ = Round(self.settings, name, number, folder)
        try:
            importlib.import_module(f"scenarios.{name}").play(round_)
        except Violation as violation:
            round_.expect(False, str(violation))
        except Exception:  # pylint: disable=broad-except # one of the soak itself, or an answer that nobody expects
            round_.expect(False, traceback.format_exc())
        finally:
            round_.close()
        counts = self.counts[name]
        counts.update(round_.counts)
        counts["rounds"] += 1
        counts["seconds"] += round(time.monotonic() - round_.started, 1)
        text = "ok" if not round_.violations else f"FINDING {round_.violations[0].splitlines()[0][:300]}"
        print(f"{name} {number} {round(time.monotonic() - round_.started, 1)} s {round_.parameters} {dict(round_.counts)}: {text}", flush=True)
        if round_.violations:
            counts["findings"] += 1
            self.keep(round_, folder)
        elif not self.options.keep:
            shutil.rmtree(folder, ignore_errors=True)

    def keep(self, round_, folder):
        """The round's folder with what is needed to repeat it"""
        place = self.out / "findings" / folder.name
        shutil.rmtree(place, ignore_errors=True)
        place.parent.mkdir(exist_ok=True)
        quick = " --quick" if self.settings.quick else ""
        command = f"./dev soak --seed {self.settings.seed} --scenario {round_.scenario} --round {round_.number}{quick}"
        report = {"repeat": command, "parameters": round_.parameters, "violations": round_.violations}
        (folder / "finding.json").write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")
        shutil.move(folder, place)
        self.findings.append({"scenario": round_.scenario, "round": round_.number, **report})
        print("".join(f"  {v[:2000]}\n" for v in round_.violations) + f"  repeat: {command}\n  kept: {place}", flush=True)

    def summary(self):
        total = sum(self.counts.values(), collections.Counter())
        return {"began": self.began, "seconds": round(time.monotonic() - self.started), "seed": self.settings.seed, "quick": self.settings.quick,
                "mounts": self.settings.can_mount, "scenarios": {name: dict(sorted(c.items())) for name, c in self.counts.items()},
                "total": dict(sorted(total.items())), "findings": self.findings}

    def report(self):
        summary = self.summary()
        (self.out / "summary.json").write_text(json.dumps(summary, indent=2) + "\n", encoding="utf-8")
        lines = [f"soak: began {summary['began']}, {summary['seconds']} s, seed {summary['seed']}"]
        if not self.settings.can_mount:
            lines.append("skipped: full disks by a small file system, mounting needs root; limits of the size of files were played")
        for name, counts in [*summary["scenarios"].items(), ("total", summary["total"])]:
            shown = ", ".join(f"{k} {round(v, 1)}" for k, v in counts.items() if k not in ("rounds", "findings"))
            lines.append(f"  {name:9} rounds {counts.get('rounds', 0)}, findings {counts.get('findings', 0)}, {shown}")
        lines += [f"  finding: {f['repeat']}: {f['violations'][0].splitlines()[0][:200]}" for f in self.findings]
        text = "\n".join(lines) + "\n"
        (self.out / "summary.txt").write_text(text, encoding="utf-8")
        return text


def main():
    options = arguments()
    soak = Soak(options)
    print(f"seed {options.seed}, results in {soak.out}", flush=True)
    try:
        for name, number in soak.rounds():
            soak.play(name, number)
            soak.report()
    except KeyboardInterrupt:
        print("interrupted")
    print(soak.report(), end="")
    return 1 if soak.findings else 0


if __name__ == "__main__":
    sys.exit(main())
