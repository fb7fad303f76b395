#!/usr/bin/env python3
"""Draws moving pictures of machines that are moved as groups, from what their examples drive in simulation.

usage: figures.py STRIDE [OUT]

Without OUT it says which of the pictures beside the examples are no longer what it would draw. OUT/belt-scara.svg: the example BeltScara,
seen from above; sorting-delta.svg, welding-arm.svg: SortingDelta and WeldingArm, seen at a slant; packing-portal.svg: PackingPortal, from
the front.
"""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
FRAME = 0.08  # time between two pictures [s]


def simulate(stride, example, duration, columns, frame=FRAME, start=0.0):
    """A list of rows, each a dictionary of numbers: one every `frame`, from `start` on. [s]"""
    with tempfile.TemporaryDirectory() as folder:
        trace = pathlib.Path(folder) / "trace.csv"
        subprocess.run(
            [stride, "sim", EXAMPLES / example, "--for", duration, "--trace", ",".join(columns), "--out", trace],
            check=True, stdout=subprocess.DEVNULL)
        rows, due = [], start
        for row in csv.DictReader(trace.open()):
            time = float(next(iter(row.values())))
            if time + 1e-9 < due:
                continue
            due += frame
            rows.append({name: float(row[name]) for name in columns})
        return rows


def number(value):
    text = f"{value:.1f}"
    return text[:-2] if text.endswith(".0") else text


def animate(kind, values, seconds):
    """Values of a transformation, one for each picture; one that never changes is none."""
    texts = [" ".join(number(value) for value in each) for each in values]
    return (f'<animateTransform attributeName="transform" type="{kind}" dur="{number(seconds)}s" '
            f'repeatCount="indefinite" values="{";".join(texts)}"/>')


def animate_attribute(name, texts, seconds):
    """An attribute that has one text in each picture."""
    return (f'<animate attributeName="{name}" dur="{number(seconds)}s" repeatCount="indefinite" '
            f'values="{";".join(texts)}"/>')


def line(points):
    """A path through points of the screen."""
    return "M" + "L".join(f"{number(x)} {number(y)}" for x, y in points)


def slanted(x, y, z):
    """A place in space on the screen, Y of which grows downwards: X goes to the right, Y to the back, Z up."""
    return x + 0.45 * y, -(z + 0.3 * y)


class BeltScara:
    """The arm, and the parts on the belt, in the gripper and in the tray."""
    ARM1, ARM2 = 320, 260
    # As World.st has them.
    GAPS = [390, 265, 310, 445, 280, 350, 240]
    SIDES = [10, -35, 25, 0, 40]
    TURNS = [15, -40, 70, -5]
    COLUMNS = ["Shoulder.fSetPosition", "Elbow.fSetPosition", "Turn.fSetPosition", "Machine.Way", "Machine.Grip",
               "Machine.Status.InSync"]

    def __init__(self, stride):
        self.rows = simulate(stride, "BeltScara", "T#20s", self.COLUMNS)
        self.parts = self.followed()

    def tool(self, row):
        a = math.radians(row["Shoulder.fSetPosition"])
        b = a + math.radians(row["Elbow.fSetPosition"])
        return (self.ARM1 * math.cos(a) + self.ARM2 * math.cos(b), self.ARM1 * math.sin(a) + self.ARM2 * math.sin(b),
                row["Shoulder.fSetPosition"] + row["Elbow.fSetPosition"] + row["Turn.fSetPosition"])

    def starts(self):
        """Ways of the belt at which parts are at its origin."""
        way, ways = 100, []
        while way < self.rows[-1]["Machine.Way"] + 300:
            ways.append(way)
            way += self.GAPS[(len(ways) - 1) % len(self.GAPS)]
        return ways

    def followed(self):
        """For each part its places (x, y, angle) in each picture."""
        starts = self.starts()
        placed, held, before = {}, None, False
        tracks = [[] for _ in starts]
        for row in self.rows:
            places = [(350 - self.SIDES[i % 5], -320 + row["Machine.Way"] - start, 90 + self.TURNS[i % 4])
                      for i, start in enumerate(starts)]
            tool = self.tool(row)
            grips = row["Machine.Grip"] > 0
            if grips and not before:
                free = [i for i in range(len(starts)) if i not in placed]
                held = min(free, key=lambda i: math.dist(places[i][:2], tool[:2]))
                apart = (places[held][0] - tool[0], places[held][1] - tool[1], places[held][2] - tool[2])
                placed[held] = None
            if held is not None:
                placed[held] = (tool[0] + apart[0], tool[1] + apart[1], tool[2] + apart[2])
            if not grips:
                held = None
            before = grips
            for i, track in enumerate(tracks):
                x, y, angle = placed.get(i) or places[i]
                track.append((x, min(max(y, -420), 620), angle))
        return tracks

    def svg(self):
        seconds = FRAME * len(self.rows)
        shapes = []
        for track in self.parts:
            shapes.append('<g>' + animate("translate", [(x, y) for x, y, _ in track], seconds) +
                          '<g>' + animate("rotate", [(angle,) for *_, angle in track], seconds) +
                          '<rect x="-22" y="-13" width="44" height="26" rx="3" fill="#e69f00"/></g></g>')
        shoulder = animate("rotate", [(row["Shoulder.fSetPosition"],) for row in self.rows], seconds)
        elbow = animate("rotate", [(row["Elbow.fSetPosition"],) for row in self.rows], seconds)
        turn = animate("rotate", [(row["Turn.fSetPosition"],) for row in self.rows], seconds)
        jaws = '<path d="M-16-20h32M-16 20h32" stroke="#333" stroke-width="6"/>'
        arm = (f'<g stroke-linecap="round" opacity="0.85"><g>{shoulder}<path d="M0 0h{self.ARM1}" stroke="#0072b2" stroke-width="46"/>'
               f'<g transform="translate({self.ARM1} 0)"><g>{elbow}<path d="M0 0h{self.ARM2}" stroke="#56b4e9" stroke-width="34"/>'
               f'<g transform="translate({self.ARM2} 0)"><g>{turn}{jaws}</g></g></g></g></g></g>')
        return "\n".join([
            '<svg xmlns="http://www.w3.org/2000/svg" width="640" height="720" viewBox="-190 -500 640 850">',
            '<title>A Scara takes parts off a moving belt and puts them into a tray, seen from above</title>',
            '<rect x="-190" y="-500" width="640" height="850" fill="#fff"/>',
            '<g transform="scale(1 -1)" fill="none">',  # Y goes up
            '<rect x="290" y="-360" width="120" height="860" fill="#ddd"/>',
            '<rect x="-95" y="300" width="170" height="160" stroke="#888" stroke-width="3" fill="#f5f5f5"/>',
            *shapes,
            '<circle r="40" fill="#999"/>',
            arm,
            '</g>',
            '</svg>',
            ''])


class SortingDelta:
    """The delta, the parts on the belt, in the cup, and in the chutes."""
    ARM, ROD, MOTORS, PLATE, TOOL = 260, 620, 140, 60, 60
    START, SECONDS, STEP = 2.0, 4.0, 0.02
    CAMERA, BELT, BELT_Y, CHUTE_Y, CHUTE_X = -320, -260, -100, 110, 120
    # As World.st has them.
    GAPS = [98, 112, 82, 107, 92, 87, 101]
    SIDES = [10, -35, 25, 0, 40]
    KINDS = [0, 2, 1, 1, 0, 2, 2, 0, 1, 2, 1]
    COLORS = ["#e69f00", "#009e73", "#cc79a7"]
    COLUMNS = ["Motor1.fSetPosition", "Motor2.fSetPosition", "Motor3.fSetPosition", "World.Tool.Position.c.X",
               "World.Tool.Position.c.Y", "World.Tool.Position.c.Z", "Machine.Way", "Machine.Grip"]

    def __init__(self, stride):
        rows = simulate(stride, "SortingDelta", f"T#{self.START + self.SECONDS}s", self.COLUMNS, self.STEP)
        self.parts = self.followed(rows)
        self.rows = [row for row in rows[round(self.START / self.STEP):]]

    def tool(self, row):
        return tuple(row[f"World.Tool.Position.c.{axis}"] for axis in "XYZ")

    def followed(self, rows):
        """For each part its place in each picture from START on, or None where it is out of sight."""
        way, starts = 100, []
        while way < rows[-1]["Machine.Way"] + 300:
            starts.append(way)
            way += self.GAPS[(len(starts) - 1) % len(self.GAPS)]
        gone, held, before = set(), None, False
        tracks = [[] for _ in starts]
        for row in rows:
            places = [(self.CAMERA + row["Machine.Way"] - start, self.BELT_Y + self.SIDES[i % 5], self.BELT)
                      for i, start in enumerate(starts)]
            tool = self.tool(row)
            grips = row["Machine.Grip"] > 0
            if grips and not before:
                held = min((i for i in range(len(starts)) if i not in gone), key=lambda i: math.dist(places[i][:2], tool[:2]))
                gone.add(held)
            if not grips:
                held = None
            before = grips
            for i, track in enumerate(tracks):
                seen = tool if i == held else None if i in gone or abs(places[i][0]) > 330 else places[i]
                track.append(seen)
        return [track[round(self.START / self.STEP):] for track in tracks]

    def arm(self, row, i):
        """From a motor over the elbow to the plate."""
        turn = math.pi + i * 2 * math.pi / 3
        angle = math.radians(row[f"Motor{i + 1}.fSetPosition"])
        height = math.sqrt(self.ROD ** 2 - (self.MOTORS + self.ARM - self.PLATE) ** 2)
        x, y, z = self.tool(row)
        elbow = self.MOTORS + self.ARM * math.cos(angle)
        place = [(math.cos(turn) * r, math.sin(turn) * r, h)
                 for r, h in ((self.MOTORS, height), (elbow, height - self.ARM * math.sin(angle)))]
        place.append((x + math.cos(turn) * self.PLATE, y + math.sin(turn) * self.PLATE, z + self.TOOL))
        return [slanted(*p) for p in place]

    def moving(self, paths, style):
        return (f'<path d="{paths[0]}" {style}>' + animate_attribute("d", paths, self.SECONDS) + '</path>')

    def part(self, i, track):
        shown = [place is not None for place in track]
        if not any(shown):
            return ""
        first = next(place for place in track if place)
        places, last = [], first
        for place in track:
            last = place or last
            places.append(slanted(*last))
        return (f'<g>{animate("translate", places, self.SECONDS)}<ellipse cy="4" rx="18" ry="10" fill="{self.COLORS[self.KINDS[i % 11]]}" '
                f'stroke="#333">' + animate_attribute("opacity", [str(int(s)) for s in shown], self.SECONDS).replace(
                    "<animate ", '<animate calcMode="discrete" ') + '</ellipse></g>')

    def svg(self):
        height = math.sqrt(self.ROD ** 2 - (self.MOTORS + self.ARM - self.PLATE) ** 2)
        belt = [slanted(x, self.BELT_Y + y, self.BELT) for x, y in ((-330, -55), (330, -55), (330, 55), (-330, 55))]
        base = [slanted(math.cos(t) * (self.MOTORS + 25), math.sin(t) * (self.MOTORS + 25), height)
                for t in (math.pi * k / 12 for k in range(24))]
        chutes = []
        for kind, color in enumerate(self.COLORS):
            x = self.CHUTE_X * (kind - 1)
            corners = [slanted(x + dx, self.CHUTE_Y + dy, self.BELT - 20) for dx, dy in ((-45, -35), (45, -35), (45, 35), (-45, 35))]
            chutes.append(f'<path d="{line(corners)}Z" fill="#fff" stroke="{color}" stroke-width="6"/>')
        arms = [[self.arm(row, i) for row in self.rows] for i in range(3)]
        upper = [self.moving([line(p[:2]) for p in arm], 'stroke="#0072b2" stroke-width="16"') for arm in arms]
        rods = [self.moving([line(p[1:]) for p in arm], 'stroke="#56b4e9" stroke-width="7"') for arm in arms]
        plate = self.moving([line([slanted(*self.tool(row)), slanted(*(p + d for p, d in zip(self.tool(row), (0, 0, self.TOOL))))])
                             for row in self.rows], 'stroke="#333" stroke-width="12"')
        triangle = self.moving([line([arms[i][k][2] for i in range(3)]) + "Z" for k in range(len(self.rows))],
                               'fill="#999" stroke="#333" stroke-width="3" fill-opacity="0.9"')
        # What is farther away is drawn first: the motors of axes 2 and 3 are at -Y and +Y, that of axis 1 at -X.
        return "\n".join([
            '<svg xmlns="http://www.w3.org/2000/svg" width="760" height="870" viewBox="-420 -620 840 960">',
            '<title>A delta takes parts off a moving belt and sorts them into three chutes</title>',
            '<rect x="-420" y="-620" width="840" height="960" fill="#fff"/>',
            '<g fill="none" stroke-linecap="round" stroke-linejoin="round">',
            *chutes,
            f'<path d="{line(belt)}Z" fill="#ddd"/>',
            *[self.part(i, track) for i, track in enumerate(self.parts)],
            f'<path d="{line(base)}Z" fill="#bbb" stroke="#888"/>',
            *[upper[i] + rods[i] for i in (2, 0, 1)],
            plate,
            triangle,
            '</g>',
            '</svg>',
            ''])


class WeldingArm:
    """The arm as links, the box, and the seam as it grows."""
    D1, A1, A2, A3, D4, D6 = 450, 150, 600, 100, 640, 100
    TOOL = (60, 280, 35)  # X, Z and B of the torch
    PLATE = (820, -90, 260, 20)  # X, Y, Z and A of PCS_1
    LENGTH, WIDTH, HEIGHT = 240, 150, 90
    STEP, SECONDS = 0.2, 46.0
    COLUMNS = [f"Joint{i}.fSetPosition" for i in range(1, 7)] + ["Machine.Arc"]

    def __init__(self, stride):
        self.rows = simulate(stride, "WeldingArm", f"T#{self.SECONDS}s", self.COLUMNS, self.STEP)

    @staticmethod
    def product(a, b):
        return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]

    def link(self, theta, d, a, twist):
        """After Denavit and Hartenberg. [°]"""
        c, s = math.cos(math.radians(theta)), math.sin(math.radians(theta))
        ct, st = math.cos(math.radians(twist)), math.sin(math.radians(twist))
        return [[c, -s * ct, s * st, a * c], [s, c * ct, -c * st, a * s], [0, st, ct, d], [0, 0, 0, 1]]

    def joints(self, row):
        """From the base over shoulder, elbow, wrist and flange to the end of the wire, on the screen; and that end in space."""
        q = [row[f"Joint{i}.fSetPosition"] for i in range(1, 7)]
        table = [(q[0], self.D1, self.A1, 90), (q[1] + 90, 0, self.A2, 0), (q[2], 0, self.A3, 90), (q[3], self.D4, 0, 90),
                 (q[4], 0, 0, -90), (q[5], self.D6, 0, 0)]
        frame = [[float(i == j) for j in range(4)] for i in range(4)]
        places = [(0, 0, 0), (0, 0, self.D1)]
        for i, entry in enumerate(table):
            frame = self.product(frame, self.link(*entry))
            if i != 4:
                places.append(tuple(frame[k][3] for k in range(3)))
        x, z, lean = self.TOOL
        neck = z - x / math.tan(math.radians(lean))  # where the wire's line meets the flange's axis
        for point in ((0, 0, max(neck, 0), 1), (x, 0, z, 1)):
            places.append(tuple(sum(frame[k][j] * point[j] for j in range(4)) for k in range(3)))
        return [slanted(*p) for p in places], places[-1]

    def on_plate(self, x, y, z):
        px, py, pz, a = self.PLATE
        c, s = math.cos(math.radians(a)), math.sin(math.radians(a))
        return slanted(px + c * x - s * y, py + s * x + c * y, pz + z)

    def box(self):
        x, y, h = self.LENGTH / 2, self.WIDTH / 2, self.HEIGHT
        corners = [(-x, -y), (x, -y), (x, y), (-x, y)]
        plate = line([self.on_plate(1.6 * u, 1.8 * v, 0) for u, v in corners]) + "Z"
        top = line([self.on_plate(u, v, h) for u, v in corners]) + "Z"
        front = line([self.on_plate(*corners[0], 0), self.on_plate(*corners[1], 0), self.on_plate(*corners[1], h),
                      self.on_plate(*corners[0], h)]) + "Z"
        side = line([self.on_plate(*corners[0], 0), self.on_plate(*corners[3], 0), self.on_plate(*corners[3], h),
                     self.on_plate(*corners[0], h)]) + "Z"
        return (f'<path d="{plate}" fill="#e5e5e5" stroke="#999"/>', f'<path d="{side}" fill="#bbb" stroke="#888"/>'
                f'<path d="{front}" fill="#ccc" stroke="#888"/><path d="{top}" fill="#ddd" stroke="#888"/>')

    def svg(self):
        poses = [self.joints(row) for row in self.rows]
        seam, seams = [], []
        for row, (_, tip) in zip(self.rows, poses):
            if row["Machine.Arc"] > 0:
                seam.append(slanted(*tip))
            seams.append(list(seam))
        whole = line(seam)
        lengths = [sum(math.dist(a, b) for a, b in zip(s, s[1:])) for s in seams]
        arm = [line(screen[:7]) for screen, _ in poses]
        torch = [line(screen[6:]) for screen, _ in poses]
        sparks = animate_attribute("opacity", [str(int(row["Machine.Arc"] > 0)) for row in self.rows], self.SECONDS)
        plate, box = self.box()
        return "\n".join([
            '<svg xmlns="http://www.w3.org/2000/svg" width="800" height="800" viewBox="-150 -1250 1350 1350">',
            '<title>An arm of six axes welds a box onto a plate, once around it</title>',
            '<rect x="-150" y="-1250" width="1350" height="1350" fill="#fff"/>',
            '<g fill="none" stroke-linecap="round" stroke-linejoin="round">',
            '<ellipse rx="130" ry="55" fill="#999"/>',
            plate,
            box,
            f'<path d="{whole}" stroke="#d55e00" stroke-width="9" stroke-dasharray="{number(lengths[-1] + 1)}">' +
            animate_attribute("stroke-dashoffset", [number(lengths[-1] + 1 - length) for length in lengths], self.SECONDS) + '</path>',
            f'<path d="{arm[0]}" stroke="#0072b2" stroke-width="40" stroke-opacity="0.8">' +
            animate_attribute("d", arm, self.SECONDS) + '</path>',
            f'<path d="{torch[0]}" stroke="#333" stroke-width="14">' + animate_attribute("d", torch, self.SECONDS) + '</path>',
            f'<g>{animate("translate", [screen[-1] for screen, _ in poses], self.SECONDS)}<circle r="16" fill="#f0e442" stroke="#e69f00">'
            + sparks + '</circle></g>',
            '</g>',
            '</svg>',
            ''])


class PackingPortal:
    """Beam, carriage and gripper, and the parts."""
    STEP, SECONDS = 0.04, 12.0
    COLUMNS = ["World.Tool.Position.c.X", "World.Tool.Position.c.Y", "Machine.Grip", "Machine.Placed", "World.Ready",
               "Left.fSetPosition", "Right.fSetPosition"]

    def __init__(self, stride):
        self.rows = simulate(stride, "PackingPortal", f"T#{self.SECONDS}s", self.COLUMNS, self.STEP)

    @staticmethod
    def place(part):
        return 480 + 60 * (part % 4), 40 + 35 * (part // 4)

    def part(self, i):
        """A part: in the feeder, in the gripper, in the box; it is not seen before."""
        places, seen = [], []
        for row in self.rows:
            placed, grips = row["Machine.Placed"], row["Machine.Grip"] > 0
            if placed > i or (placed == i and not grips and row["World.Tool.Position.c.X"] > 300):
                places.append(self.place(i))
            elif placed == i and grips:
                places.append((row["World.Tool.Position.c.X"], row["World.Tool.Position.c.Y"]))
            else:
                places.append((0, 60))
            seen.append(placed >= i and (grips or placed > i or row["World.Ready"] > 0 or places[-1] != (0, 60)))
        if not any(seen):
            return ""
        return ('<g>' + animate("translate", places, self.SECONDS) + '<rect x="-26" y="-34" width="52" height="34" rx="2" fill="#e69f00" '
                'stroke="#333">' + animate_attribute("opacity", [str(int(s)) for s in seen], self.SECONDS).replace(
                    "<animate ", '<animate calcMode="discrete" ') + '</rect></g>')

    def svg(self):
        tool = [(row["World.Tool.Position.c.X"], row["World.Tool.Position.c.Y"]) for row in self.rows]
        beam = animate("translate", [(0, y) for _, y in tool], self.SECONDS)
        carriage = animate("translate", tool, self.SECONDS)
        # A belt pulley of 40 mm turns by 360 degrees in 126 mm of belt.
        turns = {side: animate("rotate", [(row[f"{side}.fSetPosition"] * 180 / math.pi / 20,) for row in self.rows], self.SECONDS)
                 for side in ("Left", "Right")}
        motors = [f'<g transform="translate({x} 420)"><circle r="26" fill="#999" stroke="#333" stroke-width="3"/><g>{turns[side]}'
                  f'<path d="M0 0H24" stroke="#fff" stroke-width="5"/></g></g>' for side, x in (("Left", -80), ("Right", 740))]
        count = int(max(row["Machine.Placed"] for row in self.rows)) + 1
        return "\n".join([
            '<svg xmlns="http://www.w3.org/2000/svg" width="760" height="460" viewBox="-150 -480 960 580">',
            '<title>A portal moved by one belt stacks parts into a box</title>',
            '<rect x="-150" y="-480" width="960" height="580" fill="#fff"/>',
            '<g transform="scale(1 -1)" fill="none">',  # Y goes up
            '<path d="M-80 -40V440M740 -40V440" stroke="#bbb" stroke-width="24"/>',
            '<rect x="-60" y="-30" width="120" height="56" fill="#ddd"/>',
            '<path d="M400 220V5H715V220" stroke="#888" stroke-width="10"/>',
            *motors,
            *[self.part(i) for i in range(count)],
            f'<g>{beam}<path d="M-80 70H740" stroke="#0072b2" stroke-width="18"/></g>',
            f'<g>{carriage}<rect x="-34" y="48" width="68" height="44" rx="4" fill="#56b4e9" stroke="#333" stroke-width="3"/>'
            '<path d="M0 48V8M-24 -14V8H24V-14" stroke="#333" stroke-width="7"/></g>',
            '</g>',
            '</svg>',
            ''])


PICTURES = {"belt-scara.svg": (BeltScara, "BeltScara/machine.svg"),
            "sorting-delta.svg": (SortingDelta, "SortingDelta/machine.svg"),
            "welding-arm.svg": (WeldingArm, "WeldingArm/machine.svg"),
            "packing-portal.svg": (PackingPortal, "PackingPortal/machine.svg")}


def draw(pictures, script):
    """Draws them into the folder that the command line names, or says which ones beside the examples are stale: the exit code."""
    stride = sys.argv[1]
    out = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
    stale = []
    for name, (machine, place) in pictures.items():
        text = machine(stride).svg()
        if out:
            (out / name).write_text(text)
        elif not (EXAMPLES / place).exists() or (EXAMPLES / place).read_text() != text:
            stale.append(place)
    for place in stale:
        print(f"examples/{place} is not what docs/groups/{script} draws")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(draw(PICTURES, "figures.py"))
