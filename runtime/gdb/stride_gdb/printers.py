"""How gdb prints values, and `a[i]` as ST counts."""
import gdb
import gdb.printing
import gdb.xmethod

from .applications import element_type, enumerators_of
from .values import ELEMENTARY, codes_of, text_literal


class TextPrinter:
    def __init__(self, text):
        self.text = text

    def to_string(self):
        return self.text


class ArrayPrinter:
    """ARRAY[lo..hi]: the elements under their ST indices."""

    def __init__(self, value):
        self.value = value
        self.low = int(value.type.strip_typedefs().template_argument(1))
        self.high = int(value.type.strip_typedefs().template_argument(2))

    def to_string(self):
        return f"ARRAY[{self.low}..{self.high}]"

    def children(self):
        elements, kind = self.value["v"], element_type(self.value)
        for index in range(self.low, self.high + 1):
            element = elements[index - self.low]
            yield f"[{index}]", element.cast(kind) if kind else element


class Lookup(gdb.printing.PrettyPrinter):
    """Picks the printer by the ST type's name, which C++ keeps as that of a typedef."""

    def __init__(self):
        super().__init__("stride", [gdb.printing.SubPrettyPrinter("values")])

    def __call__(self, value):
        kind = value.type.unqualified()
        if kind.code == gdb.TYPE_CODE_REF:
            return self(value.referenced_value())
        name = kind.name or ""
        if kind.code == gdb.TYPE_CODE_TYPEDEF:
            return self.of_typedef(value, kind, name)
        if name.startswith("stride::STRING<"):
            return TextPrinter(text_literal(codes_of(value["s"], 1), "'"))
        if name.startswith("stride::WSTRING<"):
            return TextPrinter(text_literal(codes_of(value["s"], 2), '"'))
        if name.startswith("stride::Array<"):
            return ArrayPrinter(value)
        return None

    def of_typedef(self, value, kind, name):
        if name.startswith("stride::"):
            writer = ELEMENTARY.get(name[len("stride::"):])
            return TextPrinter(writer(value)) if writer else None
        if not name.startswith("st::"):
            return None
        target = kind.target()
        if target.code != gdb.TYPE_CODE_TYPEDEF or not target.name.startswith("stride::"):
            return self(value.cast(target))
        names = enumerators_of(name.rsplit("::", 1)[1])
        if names is None:
            return self(value.cast(target)) # an alias of an elementary type
        number = int(value)
        return TextPrinter(f"{names[number]} ({number})" if number in names else str(number))


class IndexWorker(gdb.xmethod.XMethodWorker):
    def get_arg_types(self):
        return gdb.lookup_type("long")

    def __call__(self, obj, index):
        if obj.type.strip_typedefs().code in (gdb.TYPE_CODE_PTR, gdb.TYPE_CODE_REF):
            obj = obj.referenced_value()
        kind = obj.type.strip_typedefs().unqualified()
        low, high = int(kind.template_argument(1)), int(kind.template_argument(2))
        if not low <= int(index) <= high:
            raise gdb.GdbError(f"index {int(index)} is outside of {low}..{high}")
        kind, found = element_type(obj), obj["v"][int(index) - low]
        return found.address.cast(kind.pointer()).dereference() if kind else found


class IndexMatcher(gdb.xmethod.XMethodMatcher):
    def __init__(self):
        super().__init__("stride-array")
        self.methods = [gdb.xmethod.XMethod("index")]

    def match(self, class_type, method_name):
        name = class_type.strip_typedefs().unqualified().name or ""
        return IndexWorker() if method_name == "operator[]" and name.startswith("stride::Array<") else None
