"""Moves as G-code of Stride: N numbers, G1, G2, G3 with I, J, K relative to the start, units and seconds."""

AXES = "XYZ"
CENTRE = "IJK"
# The axes of the plane of arcs, and its number: seen from the tip of the third axis.
PLANES = {"XY": 17, "ZX": 18, "YZ": 19}


def number(value):
    """Without an exponent, which the language does not have."""
    text = f"{value:.9f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


class Program:
    """Collects moves; those that lead nowhere are left out."""

    def __init__(self, name, velocity):
        self.name = name
        self.velocity = velocity  # feeds above are written as that [u/s]
        self.place = [0.0, 0.0, 0.0]
        self.feed = None  # [u/s]
        self.moves = []  # (letter of the kind, end, centre relative to the start, plane, feed)

    def line(self, end, rapid=False, feed=None):
        end = [here if there is None else there for here, there in zip(self.place, end)]
        if end != self.place:
            self.moves.append(("rapid" if rapid else "line", end, None, "XY", min(feed or self.feed, self.velocity)))
        self.place = end

    def arc(self, end, centre, clockwise, plane="XY"):
        """The centre is relative to the start, a number for each axis."""
        end = [here if there is None else there for here, there in zip(self.place, end)]
        self.moves.append(("clockwise" if clockwise else "counterclockwise", end, centre, plane, min(self.feed, self.velocity)))
        self.place = end

    def text(self, rapids="G1"):
        """Stride stops at both ends of a G0; as G1 rapid moves are blended as other ones are."""
        lines = [f"% {self.name}"]
        place, feed, plane = [0.0, 0.0, 0.0], None, "XY"

        def sentence(words):
            lines.append(f"N{10 * len(lines)} {' '.join(words)}")

        for kind, end, centre, its_plane, its_feed in self.moves:
            arc = centre is not None
            if arc and its_plane != plane:
                plane = its_plane
                sentence([f"G{PLANES[plane]}"])
            words = [{"line": "G1", "rapid": rapids, "clockwise": "G2", "counterclockwise": "G3"}[kind]]
            words += [axis + number(there) for axis, here, there in zip(AXES, place, end) if here != there]
            if arc:
                words += [CENTRE[AXES.index(axis)] + number(centre[AXES.index(axis)]) for axis in sorted(plane)]
            if its_feed != feed and words[0] != "G0":
                words.append("F" + number(its_feed))
                feed = its_feed
            sentence(words)
            place = end
        return "\n".join(lines) + "\n"
