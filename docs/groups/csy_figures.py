#!/usr/bin/env python3
"""Draws moving pictures of machines that a module TSX CSY 85 moves, from what their examples drive in simulation.

usage: csy_figures.py STRIDE [OUT]

Without OUT it says which of the pictures beside the examples are no longer what it would draw. OUT/tangential.svg: the example
CsyTangential, seen from above; coordinated.svg: CsyCoordinated, seen at a slant.
"""
import math
import sys

from figures import animate, animate_attribute, draw, line, number, simulate, slanted


class Tangential:
    """The sheet, the part that is cut out of it, and the knife."""
    STEP, START, SECONDS = 0.05, 1.6, 6.2
    COLUMNS = ["X.fSetPosition", "Y.fSetPosition", "Knife.fSetPosition", "Master.fSetPosition"]

    def __init__(self, stride):
        self.rows = simulate(stride, "CsyTangential", f"T#{self.START + self.SECONDS}s", self.COLUMNS, self.STEP, self.START)

    def svg(self):
        places = [(row["X.fSetPosition"], row["Y.fSetPosition"]) for row in self.rows]
        lengths = [0.0]
        for one, next_ in zip(places, places[1:]):
            lengths.append(lengths[-1] + math.dist(one, next_))
        cut = animate_attribute("stroke-dashoffset", [number(lengths[-1] + 1 - length) for length in lengths], self.SECONDS)
        angles = [(360 * row["Knife.fSetPosition"],) for row in self.rows]
        contour = line(places)
        return "\n".join([
            '<svg xmlns="http://www.w3.org/2000/svg" width="640" height="400" viewBox="-40 -110 240 150">',
            '<title>A knife that points along its path cuts a part out of a sheet, seen from above</title>',
            '<rect x="-40" y="-110" width="240" height="150" fill="#fff"/>',
            '<g transform="scale(1 -1)" fill="none" stroke-linejoin="round">',  # Y goes up
            '<rect x="-25" y="-25" width="210" height="125" fill="#f5f0e0" stroke="#bbb"/>',
            f'<path d="{contour}" stroke="#ddd" stroke-width="1.5"/>',
            f'<path d="{contour}" stroke="#d55e00" stroke-width="1.5" stroke-dasharray="{number(lengths[-1] + 1)}">{cut}</path>',
            f'<g>{animate("translate", places, self.SECONDS)}<g>{animate("rotate", angles, self.SECONDS)}'
            '<path d="M-14-3L6-3L13 0L6 3L-14 3Z" fill="#56b4e9" fill-opacity="0.8" stroke="#0072b2"/></g></g>',
            '</g>',
            '</svg>',
            ''])


class Coordinated:
    """Bridge, carriage and gripper, the belt and the tray, and the part that is carried."""
    STEP, START, SECONDS = 0.04, 0.08, 5.4
    TOP = 190  # where the bridge runs [mm]
    COLUMNS = ["X.fSetPosition", "Y.fSetPosition", "Z.fSetPosition", "Machine.Grip", "Machine.Parts"]

    def __init__(self, stride):
        self.rows = simulate(stride, "CsyCoordinated", f"T#{self.START + self.SECONDS}s", self.COLUMNS, self.STEP, self.START)

    @staticmethod
    def slab(x, y, z, width, depth, fill):
        """A board, the middle of the upper side of which is there."""
        corners = [slanted(x + a * width / 2, y + b * depth / 2, z) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        return f'<path d="{line(corners)}Z" fill="{fill}" stroke="#888"/>'

    def svg(self):
        tools = [tuple(row[f"{axis}.fSetPosition"] for axis in "XYZ") for row in self.rows]
        bridge = [line([slanted(-40, y, self.TOP), slanted(460, y, self.TOP)]) for _, y, _ in tools]
        column = [line([slanted(x, y, self.TOP), slanted(x, y, z)]) for x, y, z in tools]
        rails = [line([slanted(x, -40, self.TOP), slanted(x, 330, self.TOP)]) for x in (-40, 460)]
        legs = [line([slanted(x, y, self.TOP), slanted(x, y, -30)]) for x in (-40, 460) for y in (-40, 330)]
        held = [tool if row["Machine.Grip"] > 0 else (420, 290, 35) for tool, row in zip(tools, self.rows)]
        return "\n".join([
            '<svg xmlns="http://www.w3.org/2000/svg" width="760" height="420" viewBox="-90 -310 760 420">',
            '<title>A portal carries parts from a belt to a tray along straight lines in space</title>',
            '<rect x="-90" y="-310" width="760" height="420" fill="#fff"/>',
            '<g fill="none" stroke-linecap="round">',
            *[f'<path d="{leg}" stroke="#ddd" stroke-width="8"/>' for leg in legs],
            self.slab(0, 0, -14, 150, 70, "#ddd"),
            self.slab(420, 290, 21, 110, 80, "#f5f5f5"),
            f'<path d="{line([slanted(*tool) for tool in tools])}" stroke="#d55e00" stroke-dasharray="4 4"/>',
            *[f'<path d="{rail}" stroke="#bbb" stroke-width="8"/>' for rail in rails],
            f'<g>{animate("translate", [slanted(*place) for place in held], self.SECONDS)}'
            '<rect x="-20" y="0" width="40" height="18" rx="2" fill="#e69f00" stroke="#333"/></g>',
            f'<path d="{column[0]}" stroke="#56b4e9" stroke-width="12">{animate_attribute("d", column, self.SECONDS)}</path>',
            f'<path d="{bridge[0]}" stroke="#0072b2" stroke-width="14">{animate_attribute("d", bridge, self.SECONDS)}</path>',
            '</g>',
            '</svg>',
            ''])


PICTURES = {"tangential.svg": (Tangential, "CsyTangential/machine.svg"),
            "coordinated.svg": (Coordinated, "CsyCoordinated/machine.svg")}


if __name__ == "__main__":
    sys.exit(draw(PICTURES, "csy_figures.py"))
