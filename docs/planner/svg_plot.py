"""A plot for pictures of the documentation: a frame with scales, and lines in it."""

COLORS = ("#0072b2", "#d55e00", "#009e73", "#6b7280")
FONT = "font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" font-size=\"12\" fill=\"#374151\""


class Plot:
    """A frame with scales, and lines in it."""

    def __init__(self, size, x, y, titles):
        self.width, self.height = size
        self.x, self.y = x, y
        self.body = []
        self.legend = 0
        left, top, right, bottom = self.frame = (60, 34, self.width - 20, self.height - 46)
        for value in x[2]:
            at = self.place(value, y[0])[0]
            self.body.append(f'<path d="M{at:.1f} {top}V{bottom}" stroke="#e5e7eb"/>')
            self.body.append(f'<text x="{at:.1f}" y="{bottom + 16}" text-anchor="middle">{value:g}</text>')
        for value in y[2]:
            at = self.place(x[0], value)[1]
            self.body.append(f'<path d="M{left} {at:.1f}H{right}" stroke="#e5e7eb"/>')
            self.body.append(f'<text x="{left - 6}" y="{at + 4:.1f}" text-anchor="end">{value:g}</text>')
        self.body.append(f'<rect x="{left}" y="{top}" width="{right - left}" height="{bottom - top}" fill="none" stroke="#9ca3af"/>')
        self.body.append(f'<text x="{(left + right) / 2}" y="{bottom + 36}" text-anchor="middle" font-weight="600">{titles[0]}</text>')
        middle = (top + bottom) / 2
        self.body.append(f'<text x="16" y="{middle}" text-anchor="middle" transform="rotate(-90 16 {middle})" font-weight="600">{titles[1]}</text>')

    def place(self, x, y):
        left, top, right, bottom = self.frame
        return (left + (x - self.x[0]) / (self.x[1] - self.x[0]) * (right - left),
                bottom - (y - self.y[0]) / (self.y[1] - self.y[0]) * (bottom - top))

    def line(self, points, color, name, width=2, dash=""):
        d = "L".join(f"{x:.1f} {y:.1f}" for x, y in (self.place(*point) for point in points))
        style = f' stroke-dasharray="{dash}"' if dash else ""
        self.body.append(f'<path d="M{d}" fill="none" stroke="{color}" stroke-width="{width}"{style}/>')
        if not name:
            return
        at = self.frame[0] + self.legend
        self.body.append(f'<path d="M{at} 18h18" stroke="{color}" stroke-width="{min(width, 12)}"{style}/>')
        self.body.append(f'<text x="{at + 24}" y="22">{name}</text>')
        self.legend += 44 + 6.4 * len(name)

    def write(self, path):
        head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{self.width}" height="{self.height}" viewBox="0 0 {self.width} {self.height}" {FONT}>'
        back = f'<rect width="{self.width}" height="{self.height}" fill="#ffffff"/>'
        path.write_text("\n".join((head, back, *self.body, "</svg>\n")), encoding="utf-8")
