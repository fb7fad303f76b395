"""Frames as POUs."""
import re

import gdb
from gdb.FrameDecorator import FrameDecorator

POU = re.compile(r"^st::(?:user::)?(?P<name>.+?)(?:::body__(?:call)?|__call)?(?:\(.*\))?$")


def pou_name(function):
    """`Counter` of st::user::Counter::body__, `Counter.Reset` of a method; None: not of ST."""
    if not isinstance(function, str) or not function.startswith("st::"):
        return None
    name = POU.match(function).group("name")
    for inner, outer in (("__get", ".Get"), ("__set", ".Set")):
        if name.endswith(inner):
            name = name[:-len(inner)] + outer
    name = name.replace("::init__", " (initial values)").replace("::exit__", " (FB_Exit)")
    return name.replace("::", ".").replace("__", ".")


class PouFrame(FrameDecorator):
    """A frame of ST: the POU's name, its inputs and variables without what Stride adds."""

    def function(self):
        return pou_name(super().function()) or super().function()

    def visible(self, entries):
        return [e for e in entries or [] if "__" not in str(e.symbol()) and str(e.symbol()) != "this"]

    def frame_args(self):
        return self.visible(super().frame_args())

    def frame_locals(self):
        return self.visible(super().frame_locals())


class PouFilter:
    """`bt` shows the POUs; `bt -no-filters` everything."""

    def __init__(self):
        self.name = "stride"
        self.priority = 100
        self.enabled = True
        gdb.frame_filters[self.name] = self

    def filter(self, frames):
        frames = list(frames)
        kept = [PouFrame(f) for f in frames if pou_name(FrameDecorator.function(f))]
        return iter(kept or frames)
