"""A small chart as an SVG file: points and lines over two axes, linear or logarithmic. Standard library only."""

import math

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 640, 440, 76, 20, 34, 54
COLOURS = ["#1f5fa8", "#c2571a", "#2e8b57", "#8a3f9e"]


def ticks(low, high, log):
    """About five round values between two bounds."""
    if log:
        steps = [m * 10.0**e for e in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1) for m in range(1, 10)]
        inside = [s for s in steps if low <= s <= high]
        return inside if len(inside) < 8 else [s for s in inside if f"{s:e}"[0] in "125"]
    rough = (high - low) / 5
    size = 10 ** math.floor(math.log10(rough))
    step = next(m * size for m in (1, 2, 5, 10) if m * size >= rough)
    return [k * step for k in range(math.ceil(low / step), math.floor(high / step) + 1)]


class Chart:
    """Collects series; `save` draws them. `log` makes both axes logarithmic."""

    def __init__(self, title, x_label, y_label, log=False):
        self.title, self.labels, self.log, self.series = title, (x_label, y_label), log, []

    def add(self, name, x, y, colour=0, points=True, dashed=False):
        """A series: points, or a line."""
        self.series.append((name, list(x), list(y), COLOURS[colour], points, dashed))

    def _bounds(self, axis):
        values = [v for series in self.series for v in series[axis]]
        low, high = min(values), max(values)
        if self.log:
            return low / (high / low) ** 0.06, high * (high / low) ** 0.06
        margin = 0.06 * (high - low) or 1.0
        return low - margin, high + margin

    def save(self, path):
        (x0, x1), (y0, y1) = self._bounds(1), self._bounds(2)
        scale = math.log if self.log else float

        def place(v, low, high, start, end):
            return start + (scale(v) - scale(low)) / (scale(high) - scale(low)) * (end - start)

        def px(v):
            return place(v, x0, x1, LEFT, WIDTH - RIGHT)

        def py(v):
            return place(v, y0, y1, HEIGHT - BOTTOM, TOP)

        out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" '
               f'font-size="13"><rect width="100%" height="100%" fill="white"/>',
               f'<text x="{LEFT}" y="22" font-size="15">{self.title}</text>']
        for v in ticks(x0, x1, self.log):
            out.append(f'<path d="M{px(v):.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#ddd"/><text x="{px(v):.1f}" '
                       f'y="{HEIGHT - BOTTOM + 18}" text-anchor="middle">{v:.4g}</text>')
        for v in ticks(y0, y1, self.log):
            out.append(f'<path d="M{LEFT} {py(v):.1f}H{WIDTH - RIGHT}" stroke="#ddd"/><text x="{LEFT - 6}" '
                       f'y="{py(v) + 4:.1f}" text-anchor="end">{v:.4g}</text>')
        out.append(f'<rect x="{LEFT}" y="{TOP}" width="{WIDTH - LEFT - RIGHT}" height="{HEIGHT - TOP - BOTTOM}" fill="none" '
                   f'stroke="black"/><text x="{(LEFT + WIDTH) / 2}" y="{HEIGHT - 14}" text-anchor="middle">{self.labels[0]}'
                   f'</text><text transform="translate(18 {HEIGHT / 2}) rotate(-90)" text-anchor="middle">{self.labels[1]}</text>')
        for k, (name, x, y, colour, points, dashed) in enumerate(self.series):
            out += self._marks([(px(a), py(b)) for a, b in zip(x, y)], colour, points, dashed)
            row = TOP + 18 + 18 * k
            out += self._marks([(LEFT + 12, row - 4), (LEFT + 34, row - 4)] if not points else [(LEFT + 23, row - 4)], colour,
                               points, dashed)
            out.append(f'<text x="{LEFT + 42}" y="{row}">{name}</text>')
        path.write_text("\n".join(out) + "\n</svg>\n")

    @staticmethod
    def _marks(places, colour, points, dashed):
        if points:
            return [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{colour}"/>' for x, y in places]
        way = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in places)
        dash = ' stroke-dasharray="5 4"' if dashed else ""
        return [f'<path d="{way}" fill="none" stroke="{colour}" stroke-width="1.6"{dash}/>']
