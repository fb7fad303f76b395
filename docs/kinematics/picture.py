"""Sketches of machines: links, joints, slides, measures and frames in a plane or in space, as SVG."""

from math import atan2, cos, hypot, radians, sin

LINK, MEASURE, TURN, AXIS, PALE = "#5b7083", "#374151", "#d55e00", "#0072b2", "#d1d5db"
STYLE = "font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" font-size=\"13\" fill=\"#374151\""


def in_space(point):
    """A point in space as seen from the front, from the right and from above."""
    x, y, z = point
    return (0.87 * x + 0.5 * y, -0.21 * x + 0.37 * y + 0.91 * z)


def polar(length, angle):
    return (length * cos(radians(angle)), length * sin(radians(angle)))


def plus(one, other):
    return tuple(a + b for a, b in zip(one, other))


class Picture:
    """Coordinates are millimetres, y upwards; a point of three is seen in space."""

    def __init__(self):
        self.under, self.body, self.over = [], [], []
        self.low, self.high = [1e9, 1e9], [-1e9, -1e9]

    def at(self, point, margin=0.0):
        x, y = in_space(point) if len(point) == 3 else point
        for i, value in enumerate((x, y)):
            self.low[i] = min(self.low[i], value - margin)
            self.high[i] = max(self.high[i], value + margin)
        return (x, -y)

    def path(self, points, color, width, more="", where=None):
        d = "L".join(f"{x:.1f} {y:.1f}" for x, y in (self.at(point, width) for point in points))
        (self.body if where is None else where).append(
            f'<path d="M{d}" fill="none" stroke="{color}" stroke-width="{width}" stroke-linecap="round" stroke-linejoin="round"{more}/>')

    def text(self, point, words, color=MEASURE, anchor="middle", bold=False):
        x, y = self.at(point, 10)
        for end in (-1, 1):  # the words need room, too
            if anchor == "middle" or (anchor == "start") == (end > 0):
                share = 3.6 if anchor == "middle" else 7.2
                self.at((x + end * share * len(words), -y))
        weight = ' font-weight="600"' if bold else ""
        self.over.append(f'<text x="{x:.1f}" y="{y + 4.5:.1f}" text-anchor="{anchor}" fill="{color}"{weight}>{words}</text>')

    def link(self, *points):
        self.path(points, LINK, 8)

    def rod(self, *points):
        self.path(points, LINK, 4)

    def ghost(self, *points):
        self.path(points, "#9ca3af", 1.2, ' stroke-dasharray="6 4"', self.under)

    def base(self, left, right):
        """Where the machine stands."""
        self.path((left, right), "#9ca3af", 3, where=self.under)

    def joint(self, point, radius=9):
        x, y = self.at(point, radius)
        self.over.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="#ffffff" stroke="{LINK}" stroke-width="3"/>')

    def tool(self, point):
        x, y = self.at(point, 6)
        self.over.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="{TURN}"/>')

    def slide(self, point, size=(30, 20)):
        x, y = self.at(point, max(size) / 2)
        self.body.append(f'<rect x="{x - size[0] / 2:.1f}" y="{y - size[1] / 2:.1f}" width="{size[0]}" height="{size[1]}" rx="3" '
                         f'fill="#e5e7eb" stroke="{LINK}" stroke-width="2.5"/>')

    def head(self, tip, angle, color):
        """The head of an arrow on the screen."""
        x, y = tip
        points = " ".join(f"{x + 9 * cos(angle + turn):.1f},{y + 9 * sin(angle + turn):.1f}" for turn in (2.75, -2.75))
        self.over.append(f'<polygon points="{x:.1f},{y:.1f} {points}" fill="{color}"/>')

    def arrow(self, start, end, words, color=AXIS, width=2.2, beyond=13):
        a, b = self.at(start), self.at(end)
        angle = atan2(b[1] - a[1], b[0] - a[0])
        self.path((start, end), color, width, where=self.over)
        self.head((b[0] + 3 * cos(angle), b[1] + 3 * sin(angle)), angle, color)
        if words:
            anchor = "middle" if abs(cos(angle)) < 0.7 else ("start" if cos(angle) > 0 else "end")
            beyond -= 0 if anchor == "middle" else 3
            self.text((b[0] + beyond * cos(angle), -(b[1] + beyond * sin(angle))), words, color, anchor, True)

    def frame(self, origin, axes, length=46):
        """Axes by name, each with its direction."""
        for name, direction in axes.items():
            if not any(direction):
                x, y = self.at(origin)
                self.over.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4.5" fill="#ffffff" stroke="{AXIS}" stroke-width="2"/>'
                                 f'<circle cx="{x:.1f}" cy="{y:.1f}" r="1.6" fill="{AXIS}"/>')
                self.text((x - 12, -(y + 14)), name, AXIS, bold=True)
            else:
                self.arrow(origin, plus(origin, (length * part for part in direction)), name)

    def turn(self, centre, radius, start, end, words, out=14):
        """An angle in the plane, from `start` to `end` in degrees."""
        steps = [start + (end - start) * i / 24 for i in range(25)]
        self.path([plus(centre, polar(radius, angle)) for angle in steps], TURN, 2, where=self.over)
        tip = self.at(plus(centre, polar(radius, end)))
        self.head(tip, -radians(end + (83 if end > start else -83)), TURN)
        self.text(plus(centre, polar(radius + out, (start + end) / 2)), words, TURN, bold=True)

    def turn_about(self, centre, axis, radius, words):
        """Three quarters of a circle about a direction in space, right-handed."""
        other = (1.0, 0.0, 0.0) if abs(axis[0]) < 0.8 else (0.0, 1.0, 0.0)
        u = cross(axis, other)
        v = cross(axis, u)
        size = hypot(*u)
        points = [plus(centre, (radius / size * (cos(t) * a + sin(t) * b) for a, b in zip(u, v)))
                  for t in (radians(10 * i) for i in range(28))]
        self.path(points, TURN, 2, where=self.over)
        a, b = self.at(points[-2]), self.at(points[-1])
        self.head(b, atan2(b[1] - a[1], b[0] - a[0]), TURN)
        x, y = self.at(points[-1])
        self.text((x + 8, -y + 6), words, TURN, "start", True)

    def measure(self, start, end, words, off=22):
        """A length between two points, drawn beside them; positive `off`: to the left of the way."""
        a, b = self.at(start), self.at(end)
        length = hypot(b[0] - a[0], b[1] - a[1])
        side = ((b[1] - a[1]) / length, -(b[0] - a[0]) / length)
        c, d = (plus(p, (off * s for s in side)) for p in (a, b))
        for p, q in ((a, c), (b, d)):
            self.path(((p[0], -p[1]), (q[0], -q[1])), PALE, 1, where=self.under)
        self.path(((c[0], -c[1]), (d[0], -d[1])), MEASURE, 1.2, where=self.over)
        angle = atan2(d[1] - c[1], d[0] - c[0])
        if length > 24:
            self.head(d, angle, MEASURE)
            self.head(c, angle + 3.14159265, MEASURE)
        sign = 1 if off > 0 else -1
        anchor = "middle" if abs(side[0]) < 0.2 else ("start" if sign * side[0] > 0 else "end")
        away = sign * (12 if anchor == "middle" else 7)
        self.text(((c[0] + d[0]) / 2 + away * side[0], -((c[1] + d[1]) / 2 + away * side[1])), words, anchor=anchor)

    def write(self, file):
        left, top = self.low[0] - 10, -self.high[1] - 10
        width, height = self.high[0] - self.low[0] + 20, self.high[1] - self.low[1] + 20
        file.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{left:.0f} {top:.0f} {width:.0f} {height:.0f}" '
                        f'width="{width:.0f}" height="{height:.0f}" {STYLE}>\n'
                        f'<rect x="{left:.0f}" y="{top:.0f}" width="{width:.0f}" height="{height:.0f}" fill="#ffffff"/>\n'
                        + "\n".join([*self.under, *self.body, *self.over]) + "\n</svg>\n", encoding="utf-8")


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
