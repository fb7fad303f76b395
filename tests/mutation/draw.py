"""Which mutants there are, and in which order the seed draws them.

A mutant is known by its file's name, the text of its line and its operator, not by its place, and its rank is a hash of
those: when files move or lines are added elsewhere, what is left is drawn in the same order.
"""

import hashlib
import re
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path

from cpp_source import Body, bodies_of
from operators import mutations_of

SEED = "stride 2026-11-23"


@dataclass(frozen=True)
class Area:
    """Files (globs from the top) and how many mutants of them are drawn"""
    name: str
    count: int
    files: tuple
    tests: str  # names of those that say something about these files


RUNTIME_TESTS = r"(?!codegen_|random_|oracle|golden\.diagnostics|golden\.programs\.(?!cam|cycles|config|fail_endless|retain|digital))"
COMPILER_TESTS = r"golden\.(programs|diagnostics|projects)|codegen_test|random_|oracle|unit_(iec|semantics|syntax|project|app|tests_test)|headers"
AREAS = (
    Area("numerics", 70, ("runtime/numeric/**/*.[ch]pp",), RUNTIME_TESTS),
    Area("scheduler", 35, ("runtime/task/*.[ch]pp",), RUNTIME_TESTS),
    Area("retain", 35, ("runtime/app/retain_*.[ch]pp", "runtime/host/retain_*.[ch]pp", "runtime/app/byte_stream.hpp",
                        "runtime/app/checksum.hpp"), RUNTIME_TESTS),
    Area("conversions", 45, ("runtime/iec/convert.h", "runtime/iec/ops.h", "runtime/iec/text*", "runtime/iec/strings.*",
                             "compiler/semantics/**/conversions.?pp", "compiler/semantics/**/fold*.?pp",
                             "compiler/semantics/**/constant*.?pp", "compiler/semantics/**/coerce*.?pp"), COMPILER_TESTS),
    Area("codegen", 60, ("compiler/codegen/**/*.[ch]pp",), COMPILER_TESTS),
)
# No more from one file than this share of an area, and one from a line.
MOST_OF_A_FILE = 0.2


@dataclass(frozen=True)
class Mutant:
    area: str
    file: str  # from the top
    line: int
    key: str   # what the seed and the list of equivalent mutants know it by
    operator: str
    body: Body = field(repr=False)
    start: int = 0
    end: int = 0
    text: str = ""


def line_around(text, place):
    begin = text.rfind("\n", 0, place) + 1
    end = text.find("\n", place)
    return " ".join(text[begin:end if end >= 0 else len(text)].split())


def candidates(top, area):
    """All mutants of an area"""
    files = sorted({path for pattern in area.files for path in Path(top).glob(pattern) if path.suffix in (".h", ".hpp", ".cpp")})
    seen = defaultdict(int)
    for path in files:
        text = path.read_text()
        for body in bodies_of(text):
            for operator, start, end, new in mutations_of(text, body):
                key = f"{path.name} | {line_around(text, start)} | {operator}"
                seen[key] += 1
                key += f" #{seen[key]}" if seen[key] > 1 else ""
                yield Mutant(area.name, path.relative_to(top).as_posix(), text.count("\n", 0, start) + 1, key, operator, body,
                             start, end, new)


def rank(mutant):
    return hashlib.sha256(f"{SEED} | {mutant.key}".encode()).hexdigest()


def sequence(top, area):
    """The mutants of an area in the order of the seed, at most one of a line"""
    lines = set()
    for mutant in sorted(candidates(top, area), key=rank):
        if (mutant.file, mutant.line) not in lines:
            lines.add((mutant.file, mutant.line))
            yield mutant


def is_stream(mutant):
    """<< that writes: what it would be with >> does not compile"""
    return mutant.operator == "<< to >>" and re.search(r"""\bout <<|\bw_ <<|["']""", mutant.key) is not None


def draw(top, area, works=lambda mutant: True):
    """The first of the sequence; those that do not compile (`works`) are passed over"""
    per_file = defaultdict(int)
    drawn = []
    for mutant in sequence(top, area):
        if per_file[mutant.file] + 1 > area.count * MOST_OF_A_FILE or is_stream(mutant) or not works(mutant):
            continue
        per_file[mutant.file] += 1
        drawn.append(mutant)
        if len(drawn) == area.count:
            break
    return drawn
