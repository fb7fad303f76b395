"""The variables of a case of random_loops.py, and what changes them from elsewhere."""
from loop_parts import Cell, Node


class Variables:
    def name(self, stem):
        self.names += 1
        return f"{stem}{self.names}"

    def cell(self, key, kind, text, limits_=None):
        self.cells[key] = Cell(kind, limits_)
        self.variables.append((text, key))
        return key

    def own(self, section, name, type_):
        self.sections.setdefault(section, []).append(f"  {name} : {type_};")

    def path(self, name):
        """Where it is printed, or None"""
        if self.style == "program":
            return f"C{self.number}.{name}"
        return None if self.style == "function" else f"G{self.number}_fb.{name}"

    def declare(self):
        rng, kind = self.rng, self.kind
        sections = {"program": ["VAR"], "function": ["VAR", "VAR", "VAR_INPUT", "VAR_STAT"],
                    "block": ["VAR", "VAR_INPUT", "VAR_OUTPUT"], "method": ["VAR", "LOCAL"], "derived": ["VAR", "BASE"]}[self.style]
        for _ in range(rng.randint(2, 4)):
            name = self.name("v")
            section = sections[0] if self.clean and rng.random() < 0.8 else rng.choice(sections)
            key = self.path(name) if section not in ("LOCAL", "VAR_INPUT") or self.style == "block" else None
            limits_, type_ = None, kind
            if rng.random() < 0.08 * self.dirt and section != "VAR_STAT":
                limits_ = (0, 30)
                type_ = f"{kind}(0..30)"
            self.own(section, name, type_ + (" := 0" if section == "VAR_INPUT" else ""))
            self.cell(key or name, kind, name, limits_)
        self.globals.append(f"  G{self.number}_g : {kind};")
        self.cell(f"G{self.number}_g", kind, f"G{self.number}_g")
        if rng.random() < 0.3 * self.dirt:
            self.own("VAR", "u", f"U_{kind}")
            key = self.path("u.one") or "u.one"
            self.cell(key, kind, "u.one")
            self.variables.append(("u.two", key))
        if rng.random() < 0.2 * self.dirt:
            self.own("VAR", "s", f"S_{kind}")
            self.cell(self.path("s.m") or "s.m", kind, "s.m")
        plain = [(t, k) for t, k in self.variables if self.cells[k].limits is None]
        if rng.random() < 0.2 * self.dirt:
            self.own("VAR", "r", f"REFERENCE TO {kind}")
            text, key = rng.choice(plain)
            self.first.append(f"r REF= {text};")
            self.variables.append(("r", key))
        if rng.random() < 0.3 * self.dirt:
            self.own("VAR", "p", f"POINTER TO {kind}")
            text, key = rng.choice(plain)
            self.first.append(f"p := ADR({text});")
            self.targets["p"] = key
            self.variables.append(("p^", "p"))
            self.repoint = plain
        if self.style in ("function", "block", "method") and rng.random() < 0.3 * self.dirt:
            self.own("VAR_IN_OUT" if self.style != "method" else "METHOD_IN_OUT", "io", kind)
            self.variables.append(("io", f"G{self.number}_g"))
        if rng.random() < 0.3:
            self.own("VAR CONSTANT", "K", f"{kind} := {self.some_constant()}")
            value = int(self.sections["VAR CONSTANT"][-1].split(":= ")[1].rstrip(";"))
            self.values.append(Node("K", kind, lambda: value))
        for letter, dimensions in (("a", 1), ("b", 2), ("c", 2)):
            if letter != "a" and rng.random() < 0.5:
                continue
            where = rng.choice(["own", "own", "global"])
            text = letter if where == "own" else f"G{self.number}_{letter}"
            key = self.path(letter) if where == "own" else text
            self.arrays[letter] = (key or letter, text, where, dimensions, rng.choice(["DINT", kind]))
        self.cells_of_result()

    def cells_of_result(self):
        self.own("VAR", "x", "DINT")
        self.cells[self.path("x") or "x"] = Cell("DINT")
        self.result = self.path("x") or "x"

    def change(self):
        """What changes variables from elsewhere: a function, an action, a method."""
        rng, kind, n = self.rng, self.kind, self.number
        step = rng.choice([1, 2, 5, 100])

        def changing(key):
            def run():
                cell = self.find(key)
                cell.set(cell.value + step)
                return cell.value
            return run

        key = f"G{n}_g"
        self.helpers += [f"FUNCTION H{n} : {kind}", f"G{n}_g := G{n}_g + {step};", f"H{n} := G{n}_g;", "END_FUNCTION"]
        self.changers.append((f"H{n}()", changing(key), True))
        self.helpers += [f"FUNCTION O{n} : {kind}", f"VAR_IN_OUT io : {kind}; END_VAR", f"io := io + {step};", f"O{n} := io;",
                         "END_FUNCTION"]
        for text, key in self.variables:
            if key in self.cells and self.cells[key].limits is None and text != "p^" and rng.random() < 0.5:
                self.changers.append((f"O{n}(io := {text})", changing(key), True))
        owns = [(t, k) for t, k in self.variables if k in self.cells and self.cells[k].limits is None and t[0] == "v" and
                k != t]
        if owns and self.style == "program":
            text, key = rng.choice(owns)
            self.methods += ["ACTION Act", f"{text} := {text} + {step};", "END_ACTION"]
            self.changers.append(("Act()", changing(key), False))
            text, key = rng.choice(owns)
            self.helpers += [f"FUNCTION Q{n} : {kind}", f"C{n}.{text} := C{n}.{text} + {step};", f"Q{n} := C{n}.{text};", "END_FUNCTION"]
            self.changers.append((f"Q{n}()", changing(key), True))
        elif owns and self.style != "function":
            text, key = rng.choice(owns)
            self.methods += [f"METHOD Bump : {kind}", f"{text} := {text} + {step};", f"Bump := {text};", "END_METHOD"]
            self.changers.append((rng.choice(["Bump()", "THIS^.Bump()"]), changing(key), True))
            if self.style == "derived":
                base = [(t, k) for t, k in owns if f"  {t} : {kind};" in self.sections.get("BASE", [])]
                if base:
                    text, key = rng.choice(base)
                    self.hook = text
                    self.methods += [f"METHOD Hook : {kind}", f"{text} := {text} + {step};", f"Hook := {text};", "END_METHOD"]
                    self.changers.append((rng.choice(["Hook()", "THIS^.Hook()"]), changing(key), True))
        self.changes = rng.random() < 0.35 * (self.dirt + 0.1)

    hook = None
    repoint = None

    def find(self, key):
        return self.cells[self.pointers.get(key, key)]
