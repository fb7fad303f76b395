"""Values whose parts share bytes: unions and located variables."""
import math
import struct

from model import NUMBERS, Array, Overlay, Skip, Struct, Type

REALS = {"REAL": "<f", "LREAL": "<d"}


class Union(Type):
    def __init__(self, name, fields):
        super().__init__(name, set().union(*(t.leaves for t in fields.values())))
        self.fields = fields  # name: type

    def default(self):
        return Whole(self, bytearray(layout(self)[0]), 0)

    def copy(self, value):
        size = layout(self)[0]
        return Whole(self, bytearray(value.data[value.at:value.at + size]), 0)

    def flat(self, path, value):
        for name, kind in self.fields.items():
            yield from kind.flat(f"{path}.{name}", value[name])


def layout(kind):
    """Size and alignment of numbers and what is made of them"""
    if isinstance(kind, Array):
        size, alignment = layout(kind.element)
        return size * kind.count, alignment
    if isinstance(kind, Union):
        parts = [layout(t) for t in kind.fields.values()]
        size, alignment = max(p[0] for p in parts), max(p[1] for p in parts)
        return -(-size // alignment) * alignment, alignment
    if isinstance(kind, Struct):
        size, alignment = 0, 1
        for name in kind.fields:
            alignment = max(alignment, layout(kind.fields[name])[1])
        size = offset(kind, None)
        return -(-size // alignment) * alignment, alignment
    size = struct.calcsize(REALS[kind.name]) if kind.name in REALS else NUMBERS[kind.name][1] // 8
    return size, size


def offset(kind, wanted):
    """Of a field of a structure; None: the end of the last one"""
    at = 0
    for name, field in kind.fields.items():
        size, alignment = layout(field)
        at = -(-at // alignment) * alignment
        if name == wanted:
            return at
        at += size
    return at


def load(kind, data, at):
    if isinstance(kind, (Array, Struct, Union)):
        return Whole(kind, data, at)
    size, _ = layout(kind)
    if kind.name in REALS:
        value = struct.unpack(REALS[kind.name], data[at:at + size])[0]
        if math.isnan(value):
            raise Skip
        return value
    return int.from_bytes(data[at:at + size], "little", signed=NUMBERS[kind.name][0])


def store(kind, data, at, value):
    size, _ = layout(kind)
    if kind.name in REALS:
        data[at:at + size] = struct.pack(REALS[kind.name], value)
    else:
        data[at:at + size] = value.to_bytes(size, "little", signed=NUMBERS[kind.name][0])


class Whole(Overlay):
    """A union, or an array or a structure within one or at an address, as a row of bytes"""

    def __init__(self, kind, data, at):
        self.kind, self.data, self.at = kind, data, at

    def part(self, key):
        if isinstance(self.kind, Array):
            if not 0 <= key < self.kind.count:
                raise IndexError(key)
            return self.kind.element, self.at + key * layout(self.kind.element)[0]
        field = self.kind.fields[key]
        return field, self.at + (0 if isinstance(self.kind, Union) else offset(self.kind, key))

    def __len__(self):
        return self.kind.count

    def __getitem__(self, key):
        kind, at = self.part(key)
        return load(kind, self.data, at)

    def __setitem__(self, key, value):
        kind, at = self.part(key)
        store(kind, self.data, at, value)

    def assign(self, value):
        size = layout(self.kind)[0]
        self.data[self.at:self.at + size] = bytes(value.data[value.at:value.at + size])


class Image:
    """The bytes of %M; a key is a type and the number of a byte."""

    def __init__(self, size):
        self.data = bytearray(size)

    def __getitem__(self, key):
        return load(key[0], self.data, key[1])

    def __setitem__(self, key, value):
        store(key[0], self.data, key[1], value)
