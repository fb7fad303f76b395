"""What applications say of their types: the lists of symbols of runtime/app/abi.h."""
import struct

import gdb

from .values import ELEMENTARY

# Kinds of the type table (runtime/iec/types.h) that the debug information of an array's elements does
# not tell apart: template arguments lose their typedefs.
KINDS = ["", "BOOL", "SINT", "INT", "DINT", "LINT", "USINT", "UINT", "UDINT", "ULINT", "BYTE", "WORD", "DWORD",
         "LWORD", "REAL", "LREAL", "TIME", "LTIME", "DATE", "LDATE", "TOD", "LTOD", "DT", "LDT", "STRING",
         "WSTRING", "CHAR", "WCHAR"]
ENUM, COMPOSED, ARRAY = 32, (33, 34, 35, 36), 37


def state():
    """The state of the application whose code is running."""
    frame = gdb.selected_frame()
    while frame is not None:
        try:
            context = frame.read_var("ctx__")
        except (ValueError, RuntimeError):
            context = None
        if context is not None and not context.is_optimized_out:
            if context.type.code == gdb.TYPE_CODE_REF:
                context = context.referenced_value().address
            return context["state"].cast(gdb.lookup_type("st::user::App__").pointer()).dereference()
        frame = frame.older()
    raise gdb.GdbError("no POU is being executed here: set a breakpoint in one and continue")


def element_type(value):
    """The type (of gdb) that the elements of the array `value` have in ST, or None: the type table says it for arrays
    in the application's state."""
    try:
        base, table = int(state().address), next(applications())
    except (gdb.error, StopIteration):
        return None
    if value.address is None or not 0 <= int(value.address) - base < table.state_size:
        return None
    offset, size = int(value.address) - base, value.type.sizeof
    entries = table.roots
    while True:
        entry = next((e for e in entries if e.offset <= offset < e.offset + table.types[e.type].size), None)
        if entry is None:
            return None
        offset -= entry.offset
        found = table.types[entry.type]
        while found.kind == ARRAY:
            element = table.types[found.element]
            if found.size == size and offset % size == 0:
                return named_type(element)
            found, offset = element, offset % element.size
        if found.kind not in COMPOSED:
            return None
        entries = found.members


def named_type(entry):
    if entry.kind == ENUM:
        for name in (f"st::user::{entry.name}", entry.name):
            try:
                return gdb.lookup_type(name)
            except gdb.error:
                pass
    elif entry.kind < len(KINDS) and KINDS[entry.kind] in ELEMENTARY:
        return gdb.lookup_type(f"stride::{KINDS[entry.kind]}")
    return None


def enumerators_of(name):
    """{value: enumerator} of the enumeration `name`, or None, from the applications' type tables."""
    for table in applications():
        for entry in table.types:
            if entry.kind == ENUM and entry.name == name:
                return entry.enumerators
    return None


class Member:
    """A member or a root: its type's number, and its offset in bytes."""

    def __init__(self, kind, offset):
        self.type, self.offset = kind, offset


class Type:
    """A type; sizes are in bytes."""

    def __init__(self, columns, numbers):
        self.name, element = columns[1], (columns + [""] * 2)[3]
        self.element = int(element) if element else None
        self.kind, self.size, _ = next(numbers), next(numbers), next(numbers)
        self.members, self.enumerators = [], {}


class Application:
    """What `description` (StrideAppV1) says of types, members, enumerators and roots: SymbolLines of
    runtime/app/abi.h."""

    def __init__(self, description):
        self.state_size, self.types, self.roots = int(description["stateSize"]), [], []
        lines = description["symbols"]
        if not lines or not lines["text"]:
            return  # not relocated yet
        inferior = gdb.selected_inferior()
        text = bytes(inferior.read_memory(int(lines["text"]), int(lines["length"]))).decode(errors="replace")
        values = b""
        for i in range(int(lines["numberLists"])):
            part = lines["numbers"][i]
            values += bytes(inferior.read_memory(int(part["values"]), 8 * int(part["count"])))
        numbers = iter(number for number, in struct.iter_unpack("<Q", values))
        for line in text.split("\n"):
            columns = line.split("\t")
            if line.startswith("T"):
                self.types.append(Type(columns, numbers))
            elif line.startswith("E"):
                self.types[-1].enumerators[int((columns + ["0"])[2])] = columns[1]
            elif line:
                members = self.roots if line.startswith("R") else self.types[-1].members
                members.append(Member(int(columns[2]), next(numbers)))


def applications():
    """The loaded applications. What is read of one is kept with its file."""
    for objfile in gdb.objfiles():
        found = getattr(objfile, "stride_application", None)
        if found is None:
            symbol = objfile.lookup_global_symbol("st::user::application__")
            if symbol is None:
                continue
            found = Application(symbol.value())
            if found.types:
                objfile.stride_application = found
        yield found
