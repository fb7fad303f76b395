#!/usr/bin/env python3
"""Random located variables and addresses, compared with rows of bytes that are kept here.

usage: random_images.py STRIDE [--seeds FIRST..LAST] [--keep FOLDER]

Each project has one way of addressing, located variables of many types that overlap at random, instances whose variables
VAR_CONFIG places, and a body that writes through one view after another: variables, elements, fields, bits, parts,
direct addresses, in-outs, pointers. After every few writes all views are read in the program; at the end they are
printed by `stride sim`, too. Projects that disagree are left in FOLDER and named.
"""
import argparse
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import tempfile

SIZE = 48  # bytes of each area
FORMATS = {"BYTE": "<B", "USINT": "<B", "SINT": "<b", "WORD": "<H", "UINT": "<H", "INT": "<h", "DWORD": "<I", "UDINT": "<I",
           "DINT": "<i", "LWORD": "<Q", "ULINT": "<Q", "LINT": "<q"}
LETTERS = {1: "B", 2: "W", 4: "D", 8: "L"}


def width(name):
    return struct.calcsize(FORMATS[name])


def literal(name, value):
    if value == -(1 << 63):
        return "(-9223372036854775807 - 1)"
    return f"{name}#{value}" if value >= 0 else str(value)


class Image:
    def __init__(self, addressing):
        self.addressing = addressing
        self.areas = {area: bytearray(SIZE) for area in "IQM"}

    def address(self, rng, area, size):
        """An address of so many bytes: its text and its first byte."""
        if self.addressing == "bytes":
            byte = rng.randrange(SIZE - size + 1)
            return f"%{area}{LETTERS[size]}{byte}", byte
        number = rng.randrange(SIZE // size)
        return f"%{area}{LETTERS[size]}{number}", number * size

    def bit(self, rng, area):
        byte, bit = rng.randrange(SIZE), rng.randrange(8)
        form = rng.randrange(4)
        if form == 0:
            return f"%{area}X{byte * 8 + bit}", byte, bit
        if form == 1:
            word = byte // 2 * 2
            number = word if self.addressing == "bytes" else word // 2
            return f"%{area}W{number}.{byte % 2 * 8 + bit}", byte, bit
        letter = rng.choice(["X", ""])
        if self.addressing == "words":
            return f"%{area}{letter}{byte // 2}.{byte % 2 * 8 + bit}", byte, bit
        return f"%{area}{letter}{byte}.{bit}", byte, bit


class View:
    """A value of so many bytes somewhere, or one bit."""

    def __init__(self, text, area, byte, kind, bit=None, printed=None):
        self.text, self.area, self.byte, self.kind, self.bit = text, area, byte, kind, bit
        self.printed = printed or text

    def read(self, image):
        row = image.areas[self.area]
        if self.bit is not None:
            return row[self.byte] >> self.bit & 1
        return struct.unpack_from(FORMATS[self.kind], row, self.byte)[0]

    def write(self, image, value):
        row = image.areas[self.area]
        if self.bit is not None:
            row[self.byte] = row[self.byte] & ~(1 << self.bit) | value << self.bit
        else:
            struct.pack_into(FORMATS[self.kind], row, self.byte, value)


class Project:
    def __init__(self, seed):
        rng = self.rng = random.Random(seed)
        self.addressing = ["units", "bytes", "words"][seed % 3]
        self.image = Image(self.addressing)
        self.views, self.lines, self.globals, self.locals, self.config, self.count = [], [], [], [], [], 0
        for number in range(14):
            self.declare(f"v{number}")
        for number in range(6):
            self.direct()
        self.instances()
        self.checks = 0
        for _ in range(40):
            self.step()
            if rng.random() < 0.15:
                self.compare()
        self.compare()

    def declare(self, name):
        rng = self.rng
        area = rng.choice("IQMMQ")
        where, prefix = rng.choice([(self.globals, ""), (self.locals, "PLC_PRG.")])
        choice = rng.randrange(5)
        if choice == 0:
            address, byte, bit = self.image.bit(rng, area)
            where.append(f"  {name} AT {address} : BOOL;")
            self.views.append(View(name, area, byte, "BOOL", bit, prefix + name))
        elif choice == 1:
            kind = rng.choice(list(FORMATS))
            count = rng.randint(2, 4)
            while width(kind) * count > 24:
                kind = rng.choice(list(FORMATS))
            address, byte = self.address(area, width(kind), width(kind) * count)
            low = rng.randint(-2, 2)
            where.append(f"  {name} AT {address} : ARRAY[{low}..{low + count - 1}] OF {kind};")
            for i in range(count):
                text = f"{name}[{low + i}]"
                self.views.append(View(text, area, byte + i * width(kind), kind, None, prefix + text))
        elif choice == 2:
            address, byte = self.address(area, 4, 12)
            where.append(f"  {name} AT {address} : Rec;")
            for field, offset, kind in (("a", 0, "BYTE"), ("b", 2, "INT"), ("c", 4, "DWORD"), ("d", 8, "SINT"),
                                        ("e", 9, "BYTE")):
                self.views.append(View(f"{name}.{field}", area, byte + offset, kind, None, f"{prefix}{name}.{field}"))
        else:
            kind = rng.choice(list(FORMATS))
            address, byte = self.address(area, width(kind), width(kind))
            where.append(f"  {name} AT {address} : {kind};")
            self.views.append(View(name, area, byte, kind, None, prefix + name))

    def address(self, area, unit, size):
        while True:
            text, byte = self.image.address(self.rng, area, unit)
            if byte + size <= SIZE:
                return text, byte

    def direct(self):
        area = self.rng.choice("IQM")
        if self.rng.random() < 0.4:
            address, byte, bit = self.image.bit(self.rng, area)
            self.views.append(View(address, area, byte, "BOOL", bit))
        else:
            size = self.rng.choice([1, 2, 4, 8])
            address, byte = self.image.address(self.rng, area, size)
            self.views.append(View(address, area, byte, {1: "BYTE", 2: "WORD", 4: "DWORD", 8: "LWORD"}[size]))

    def instances(self):
        for number in range(2):
            for field, kind in (("x", "BOOL"), ("n", "INT"), ("d", "DWORD")):
                path = f"PLC_PRG.fb[{number}].{field}"
                area = {"x": "Q", "n": "M", "d": "M"}[field]
                if kind == "BOOL":
                    address, byte, bit = self.image.bit(self.rng, area)
                    view = View(None, area, byte, kind, bit, path)
                else:
                    while True:
                        address, byte = self.image.address(self.rng, area, width(kind))
                        if byte % width(kind) == 0:
                            break
                    view = View(None, area, byte, kind, None, path)
                self.config.append(f"  {path} AT {address} : {kind};")
                self.views.append(view)
                setattr(self, f"slot_{field}{number}", view)

    def value(self, kind):
        rng = self.rng
        if kind == "BOOL":
            return rng.randrange(2)
        bits = width(kind) * 8
        value = rng.choice([0, 1, (1 << bits) - 1, 1 << (bits - 1), rng.getrandbits(bits), rng.getrandbits(bits)])
        if FORMATS[kind][1].islower() and value >> (bits - 1):
            value -= 1 << bits
        return value

    def step(self):
        rng, image = self.rng, self.image
        if rng.random() < 0.15:
            number = rng.randrange(2)
            x, n, d = rng.randrange(2), self.value("INT"), self.value("DWORD")
            self.lines.append(f"fb[{number}](setX := {'TRUE' if x else 'FALSE'}, setN := {n}, setD := {d});")
            for field, value in (("x", x), ("n", n), ("d", d)):
                getattr(self, f"slot_{field}{number}").write(image, value)
            return
        named = [v for v in self.views if v.text]
        target = rng.choice(named)
        choice = rng.randrange(6)
        if target.bit is not None:
            if choice < 2:
                value = rng.randrange(2)
                self.lines.append(f"{target.text} {'S=' if value else 'R='} TRUE;")
            elif choice < 4:
                source = rng.choice([v for v in named if v.bit is not None] + [target])
                value = source.read(image)
                self.lines.append(f"{target.text} := {source.text};")
            else:
                value = rng.randrange(2)
                self.lines.append(f"{target.text} := {'TRUE' if value else 'FALSE'};")
            target.write(image, value)
            return
        bits = width(target.kind) * 8
        row = image.areas[target.area]
        if choice == 0:
            bit = rng.randrange(bits)
            value = rng.randrange(2)
            dot = "." if not target.text.startswith("%") else ".%X"
            self.lines.append(f"{target.text}{dot}{bit} := {'TRUE' if value else 'FALSE'};")
            View("", target.area, target.byte + bit // 8, "BOOL", bit % 8).write(image, value)
        elif choice == 1 and bits > 8:
            part = rng.choice([k for k in ("BYTE", "WORD", "DWORD") if width(k) * 8 < bits])
            index = rng.randrange(bits // (width(part) * 8))
            value = self.value(part)
            self.lines.append(f"{target.text}.%{LETTERS[width(part)]}{index} := {literal(part, value)};")
            struct.pack_into(FORMATS[part], row, target.byte + index * width(part), value)
        elif choice == 2:
            same = [v for v in named if v.kind == target.kind]
            source = rng.choice(same)
            self.lines.append(f"{target.text} := {source.text};")
            target.write(image, source.read(image))
        elif choice == 3 and target.kind == "WORD" and target.byte % 2 == 0:
            value = rng.getrandbits(15)
            self.lines.append(f"Put(target := {target.text}, value := {value});")
            target.write(image, value)
        elif choice == 4 and target.kind == "BYTE":
            value = self.value("BYTE")
            self.lines.append(f"p := ADR({target.text}); p^ := {value};")
            target.write(image, value)
        else:
            value = self.value(target.kind)
            self.lines.append(f"{target.text} := {literal(target.kind, value)};")
            target.write(image, value)

    def compare(self):
        """Counts the views that differ, in the program."""
        for view in self.views:
            if not view.text:
                continue
            value = view.read(self.image)
            shown = ("TRUE" if value else "FALSE") if view.bit is not None else literal(view.kind, value)
            self.count += 1
            self.lines.append(f"IF {view.text} <> {shown} THEN wrong := wrong + 1; last := {self.count}; END_IF")

    def text(self):
        return "\n".join(["""TYPE Rec : STRUCT a : BYTE; b : INT; c : DWORD; d : SINT; e : BYTE; END_STRUCT END_TYPE
FUNCTION_BLOCK Placed
VAR_INPUT setX : BOOL; setN : INT; setD : DWORD; END_VAR
VAR x AT %Q* : BOOL; n AT %M* : INT; d AT %MD* : DWORD; END_VAR
x := setX; n := setN; d := setD;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Set
VAR_IN_OUT target : WORD; END_VAR
VAR_INPUT value : WORD; END_VAR
target := value;
END_FUNCTION_BLOCK
VAR_GLOBAL""", *self.globals, "END_VAR", "VAR_CONFIG", *self.config, "END_VAR",
                          "PROGRAM PLC_PRG", "VAR", *self.locals,
                          "  fb : ARRAY[0..1] OF Placed; Put : Set; p : POINTER TO BYTE; wrong, last : DINT;", "END_VAR",
                          *self.lines, "END_PROGRAM", ""])

    def expected(self):
        out = {"PLC_PRG.wrong": "0"}
        for view in self.views:
            value = view.read(self.image)
            out[view.printed] = ("TRUE" if value else "FALSE") if view.bit is not None else str(value)
        for area, row in self.image.areas.items():
            for byte, value in enumerate(row):
                out[f"%{area}B{byte}"] = str(value)
        return out


def check(stride, folder, seed):
    project = Project(seed)
    path = folder / f"random_image{seed}"
    path.mkdir(parents=True, exist_ok=True)
    (path / "main.st").write_text(project.text())
    (path / "stride.toml").write_text(f'[image]\naddressing = "{project.addressing}"\ninputs = {SIZE}\noutputs = {SIZE}\n'
                                      f"memory = {SIZE}\n")
    expected = project.expected()
    result = subprocess.run([stride, "sim", path, "--for", "T#10ms", "--print", ",".join(["PLC_PRG.last", *expected])],
                            capture_output=True, text=True, check=False)
    found = dict(line.split(" = ", 1) for line in result.stdout.splitlines() if " = " in line)
    wrong = [name for name, value in expected.items() if found.get(name) != value]
    if result.returncode == 0 and not wrong:
        shutil.rmtree(path)
        return True
    print(f"{path}: exit code {result.returncode}, {project.addressing}, last {found.get('PLC_PRG.last')}")
    for name in wrong[:5]:
        print(f"  {name}: expected {expected[name]}, found {found.get(name)}")
    print(result.stderr[-1500:])
    return False


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("stride")
    parser.add_argument("--seeds", default="1..20")
    parser.add_argument("--keep", type=pathlib.Path, default=pathlib.Path(tempfile.gettempdir()))
    options = parser.parse_args()
    first, last = map(int, options.seeds.split(".."))
    results = [check(options.stride, options.keep, seed) for seed in range(first, last + 1)]
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
