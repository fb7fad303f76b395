"""gdb for ST: values as ST literals, frames as POUs, `st print`, `st set`, `st break`, `st roots`, `st catch`.

Loaded by `stride debug`, or by hand: (gdb) source <prefix>/share/stride/gdb/stride.py
Knows the form of generated code (docs/developers/generated-code.md) and nothing of a particular program: types
come from the debug information, the names of enumerators from the application's type table.
"""
import os
import sys

import gdb
import gdb.printing
import gdb.xmethod

# Its modules lie beside this file; nothing is written there.
_before = sys.path[:], sys.dont_write_bytecode
sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
sys.dont_write_bytecode = True
try:
    from stride_gdb.commands import Break, Catch, Print, Roots, Set, St, Start, Watch
    from stride_gdb.frames import PouFilter
    from stride_gdb.printers import IndexMatcher, Lookup
finally:
    sys.path[:], sys.dont_write_bytecode = _before


def install():
    gdb.printing.register_pretty_printer(None, Lookup(), replace=True)
    gdb.xmethod.register_xmethod_matcher(None, IndexMatcher(), replace=True)
    PouFilter()
    for command in (St, Start, Print, Set, Roots, Break, Catch):
        command()
    Watch("watch", gdb.WP_WRITE)
    Watch("rwatch", gdb.WP_READ)
    Watch("awatch", gdb.WP_ACCESS)
    # The application is loaded by the host, so breakpoints in it wait; names are as in ST; `step` goes
    # over the runtime's helpers.
    gdb.execute("set breakpoint pending on")
    gdb.execute("set case-sensitive off", to_string=True)
    gdb.execute("skip -gfi */runtime/iec/*", to_string=True)
    gdb.execute("set print pretty on")


install()
