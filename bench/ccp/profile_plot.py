"""Step functions over a logarithmic axis, as SVG. Standard library only."""

import math

COLOURS = ("#1b6ca8", "#d1495b", "#2e8b57", "#e08e0b", "#6a4c93", "#00798c", "#8d6a3f", "#c43b8e", "#555555", "#7cb518")
WIDTH, HEIGHT = 640, 400
LEFT, RIGHT, TOP, BOTTOM = 60, 470, 40, 345  # of the axes; the legend stands to the right


def _x(value, greatest):
    return LEFT + (RIGHT - LEFT) * math.log10(value) / math.log10(greatest)


def _y(share):
    return BOTTOM - (BOTTOM - TOP) * share


def _text(x, y, words, anchor="middle", size=12, turn=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}"{turn}>{words}</text>'


def _axes(title, greatest):
    parts = [f'<rect x="{LEFT}" y="{TOP}" width="{RIGHT - LEFT}" height="{BOTTOM - TOP}" fill="none" stroke="black"/>',
             _text((LEFT + RIGHT) / 2, 24, title, size=14),
             _text((LEFT + RIGHT) / 2, HEIGHT - 14, "time over that of the fastest solver of the problem [1]"),
             _text(18, (TOP + BOTTOM) / 2, "share of the problems solved [1]",
                   turn=f' transform="rotate(-90 18 {(TOP + BOTTOM) / 2})"')]
    for k in range(6):
        y = _y(k / 5)
        parts.append(f'<line x1="{LEFT}" x2="{RIGHT}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ddd"/>')
        parts.append(_text(LEFT - 8, y + 4, f"{k / 5:.1f}", "end"))
    for factor in (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000):
        if factor > greatest:
            break
        x = _x(factor, greatest)
        parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{TOP}" y2="{BOTTOM}" stroke="#ddd"/>')
        parts.append(_text(x, BOTTOM + 18, str(factor)))
    return parts


def _curve(ratios, problems, greatest):
    """`ratios`, sorted, of the problems that were solved, among `problems`."""
    share, points = 0.0, [(LEFT, _y(0.0))]
    for k, ratio in enumerate(ratios):
        if ratio > greatest:
            break
        x = _x(ratio, greatest)
        points += [(x, _y(share)), (x, _y((k + 1) / problems))]
        share = (k + 1) / problems
    points.append((RIGHT, _y(share)))
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in points)


def draw(path, title, ratios, problems, greatest=100.0):
    """Writes the profile of each solver: `ratios` maps its name to its times over those of the fastest, where it solved."""
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>', *_axes(title, greatest)]
    for k, (name, values) in enumerate(ratios.items()):
        colour = COLOURS[k % len(COLOURS)]
        dash = ' stroke-dasharray="6 3"' if k >= len(COLOURS) else ""
        parts.append(f'<polyline points="{_curve(sorted(values), problems, greatest)}" fill="none" stroke="{colour}" '
                     f'stroke-width="2"{dash}/>')
        y = TOP + 14 + 20 * k
        parts.append(f'<line x1="{RIGHT + 14}" x2="{RIGHT + 38}" y1="{y - 4}" y2="{y - 4}" stroke="{colour}" stroke-width="2"{dash}/>')
        parts.append(_text(RIGHT + 44, y, name, "start"))
    path.write_text("\n".join([*parts, "</svg>"]) + "\n")
