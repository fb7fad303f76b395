"""The commands for ST programs."""
import re

import gdb

from .applications import applications, state
from .literals import encoded, st_type
from .paths import resolve, roots


class St(gdb.Command):
    """Commands for ST programs."""

    def __init__(self):
        super().__init__("st", gdb.COMMAND_DATA, prefix=True)


class Print(gdb.Command):
    """st print PATH: a variable by its ST path, whatever its case.
Local names first, then programs and global variables: st print Main.axis[3].fPos, st print p^.x"""

    def __init__(self):
        super().__init__("st print", gdb.COMMAND_DATA)

    def invoke(self, argument, from_tty):
        print(f"{argument.strip()} = {resolve(argument).format_string()}")


class Set(gdb.Command):
    """st set PATH := VALUE: gives a variable a value, an ST literal or another variable of its type.
st set Main.delay := T#2s, st set gText := 'new', st set Main.color := green"""

    def __init__(self):
        super().__init__("st set", gdb.COMMAND_DATA)

    def invoke(self, argument, from_tty):
        path, assign, text = argument.partition(":=")
        path, text = path.strip(), text.strip()
        if not assign or not path or not text:
            raise gdb.GdbError("say what: st set Main.total := 20")
        place = resolve(path)
        if place.address is None:
            raise gdb.GdbError(f"`{path}` has no address")
        data = encoded(text, place)
        if data is None:
            kind = st_type(place.type)
            try:
                source = resolve(text)
            except gdb.GdbError:
                raise gdb.GdbError(f"`{text}` is neither a literal for `{path}` ({kind}) nor a variable")
            if st_type(source.type) != kind or not kind or source.address is None:
                raise gdb.GdbError(f"`{text}` is of another type than `{path}` ({kind})")
            data = bytes(gdb.selected_inferior().read_memory(int(source.address), source.type.sizeof))
        gdb.selected_inferior().write_memory(int(place.address), data)


class Roots(gdb.Command):
    """st roots: the programs, variable lists and global variables."""

    def __init__(self):
        super().__init__("st roots", gdb.COMMAND_DATA)

    def invoke(self, argument, from_tty):
        for name, _ in roots():
            print(name)


class Start(gdb.Command):
    """st start: run until the application is loaded, so that breakpoints find its POUs."""

    def __init__(self):
        super().__init__("st start", gdb.COMMAND_RUNNING)

    def invoke(self, argument, from_tty):
        program = gdb.execute("show args", to_string=True).split('"', 1)[1].rsplit('"', 1)[0]
        application = next((word for word in program.split() if word.endswith(".so")), None)
        if application is None:
            raise gdb.GdbError(f"there is no application in the arguments of the program: {program}")
        gdb.execute(f"tcatch load {re.escape(application.rsplit('/', 1)[-1].strip(chr(39)))}$", to_string=True)
        gdb.execute("run", to_string=True)


class Break(gdb.Command):
    """st break POU: stop when a program, block, function or method (Block.Method) is entered."""

    def __init__(self):
        super().__init__("st break", gdb.COMMAND_BREAKPOINTS)

    def invoke(self, argument, from_tty):
        name = argument.strip().replace(".", "::")
        if not name:
            raise gdb.GdbError("say where: st break Counter, st break Counter.Reset")
        for place in (f"st::user::{name}::body__", f"st::user::{name}", f"st::{name}::body__", f"st::{name}"):
            try:
                gdb.decode_line(place)
            except gdb.error:
                continue
            gdb.Breakpoint(function=place, qualified=True)
            return
        loaded = any(True for _ in applications())
        hint = "its name as in ST: Counter, Counter.Reset" if loaded else "`st start` loads the application"
        raise gdb.GdbError(f"there is no POU `{argument.strip()}`; {hint}")


CONDITION = re.compile(r"\s(?:if\b|thread\s|task\s|mask\s)|$")


def lasting(expression):
    """What names the same place as gdb's expression without the frame, if it is in the application's state; or None."""
    try:
        base, table = int(state().address), next(applications())
        place = gdb.parse_and_eval(f"&({expression})")
        if not 0 <= int(place) - base < table.state_size:
            return None
    except (gdb.error, gdb.GdbError, StopIteration):
        return None
    stem = name = "watched_" + re.sub(r"\W+", "_", expression.strip()).strip("_")
    number = 1
    while (known := gdb.convenience_variable(name)) is not None and int(known) != int(place):
        number += 1
        name = f"{stem}_{number}"
    gdb.set_convenience_variable(name, place)
    return "*$" + name


class Watch(gdb.Command):
    """Stops when a variable changes (rwatch: is read; awatch: either): watch total, watch total if n > 3.
That of a program or an instance is watched from cycle to cycle, any other one until its POU ends."""

    def __init__(self, name, kind):
        super().__init__(name, gdb.COMMAND_BREAKPOINTS, gdb.COMPLETE_EXPRESSION)
        self.kind = kind

    def invoke(self, argument, from_tty):
        if not argument.strip():
            raise gdb.GdbError("say what: watch total, watch total if n > 3")
        expression = argument[:CONDITION.search(argument).start()]
        place = lasting(expression)
        rest = argument[len(expression):]
        if place: # in its condition, too, which is tested where the variable changes
            rest = re.sub(rf"(?<![\w.]){re.escape(expression.strip())}(?![\w.\[])", lambda _: f"({place})", rest)
        try:
            gdb.Breakpoint((place or expression) + rest, gdb.BP_WATCHPOINT, self.kind)
        except gdb.error as error:
            raise gdb.GdbError(str(error))


class Catch(gdb.Command):
    """st catch: stop where an ST exception (division by zero, index, null pointer …) is raised."""

    def __init__(self):
        super().__init__("st catch", gdb.COMMAND_BREAKPOINTS)

    def invoke(self, argument, from_tty):
        for function in ("stride::raise", "stride::raiseDetail"):
            gdb.Breakpoint(function)
