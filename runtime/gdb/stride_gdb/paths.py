"""What an ST path names, seen from the selected frame."""
import re

import gdb

from .applications import state
from .printers import IndexWorker

STEP = re.compile(r"\s*(?:\.?\s*(?P<name>[A-Za-z_]\w*)|\[(?P<index>[^\]]*)\]|(?P<deref>\^))")


def field(value, name):
    """The member `name` of a structure, whatever its case, also an inherited one; or None."""
    kind = value.type.strip_typedefs()
    if kind.code in (gdb.TYPE_CODE_PTR, gdb.TYPE_CODE_REF):
        return field(value.referenced_value(), name)
    if kind.code not in (gdb.TYPE_CODE_STRUCT, gdb.TYPE_CODE_UNION):
        return None
    for member in kind.fields():
        if member.name and member.name.lower() in (name.lower(), name.lower() + "_"):
            return value[member]
    for member in kind.fields():
        if member.name == "base__":
            return field(value[member], name)
    return None


def local(name):
    """A variable of the selected frame: local, argument, or of its instance."""
    frame = gdb.selected_frame()
    block = frame.block() if frame.is_valid() else None
    while block is not None and not block.is_global and not block.is_static:
        for symbol in block:
            if (symbol.is_variable or symbol.is_argument) and symbol.name.lower() == name.lower():
                return symbol.value(frame) if symbol.needs_frame else symbol.value()
        if block.function is not None:
            break
        block = block.superblock
    try:
        return field(frame.read_var("this"), name)
    except ValueError:
        return None


def roots():
    """(ST name, value) of every program and variable list, then of every global variable."""
    everything = state()
    lists = []
    for member in everything.type.fields():
        if member.name.endswith("__program"):
            yield member.name[:-len("__program")], everything[member]
        elif member.name.endswith("__") and everything[member].type.strip_typedefs().code == gdb.TYPE_CODE_STRUCT:
            lists.append((member.name[:-2].replace("__", "."), everything[member]))
    yield from lists
    for _, variables in lists:
        for member in variables.type.strip_typedefs().fields():
            yield member.name, variables[member]


def resolve(path):
    """The value that an ST path names, seen from the selected frame."""
    position, value, walked = 0, None, ""
    while position < len(path.rstrip()):
        step = STEP.match(path, position)
        if step is None:
            raise gdb.GdbError(f"`{path[position:]}` is no part of an ST path like Main.axis[3].fPos")
        position = step.end()
        if step.group("name"):
            value = first(step.group("name")) if value is None else field(value, step.group("name"))
            if value is None:
                where = f" in `{walked}`" if walked else "; `st roots` lists the programs and global variables"
                raise gdb.GdbError(f"there is no `{step.group('name')}`{where}")
        elif value is None:
            raise gdb.GdbError("a path begins with a name")
        elif step.group("index") is not None:
            for index in step.group("index").split(","):
                value = element(value, index)
        else:
            value = value.dereference()
        walked = path[:position].strip()
    if value is None:
        raise gdb.GdbError("say what: st print Main.axis[3].fPos")
    return value.referenced_value() if value.type.code == gdb.TYPE_CODE_REF else value


def first(name):
    found = local(name)
    if found is not None:
        return found
    return next((value for root, value in roots() if root.lower() == name.lower()), None)


def element(value, text):
    try:
        index = int(text)
    except ValueError:
        index = int(resolve(text.strip()))
    if value.type.code == gdb.TYPE_CODE_REF:
        value = value.referenced_value()
    if not (value.type.strip_typedefs().name or "").startswith("stride::Array<"):
        raise gdb.GdbError(f"`[{text}]`: that is no array")
    return IndexWorker()(value, index)
