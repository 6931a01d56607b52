"""Step functions over a logarithmic axis, as SVG. Standard library only."""

import math

COLOURS = ("#1b6ca8", "#d1495b", "#2e8b57", "#e08e0b", "#6a4c93", "#00a5a8", "#8d6a3f", "#c43b8e", "#555555", "#7cb518")
LEFT, RIGHT, TOP, BOTTOM = 60, 560, 40, 400  # of the axes; the legend stands to the right
WIDTH, HEIGHT = 840, 455


def _x(value, greatest):
    return LEFT + (RIGHT - LEFT) * math.log10(value) / math.log10(greatest)


def _y(share):
    return BOTTOM - (BOTTOM - TOP) * share


def _text(x, y, words, anchor="middle", size=12, turn=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}"{turn}>{words}</text>'


def _axes(title, greatest):
    parts = [_text((LEFT + RIGHT) / 2, 24, title, size=14),
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
    parts.append(f'<rect x="{LEFT}" y="{TOP}" width="{RIGHT - LEFT}" height="{BOTTOM - TOP}" fill="none" stroke="black"/>')
    return parts


def _curve(ratios, problems, greatest, style):
    """`ratios`, sorted, of the problems that were solved, among `problems`. Ends in a dot at the last of them, and goes on thin."""
    if not ratios:
        return []
    points = []
    for k, ratio in enumerate(ratios):
        x = _x(min(ratio, greatest), greatest)
        points += [(x, _y(k / problems)), (x, _y((k + 1) / problems))]
    x, y = points[-1]
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return [f'<polyline points="{path}" fill="none" stroke-width="2" {style}/>',
            f'<line x1="{x:.1f}" x2="{RIGHT}" y1="{y:.1f}" y2="{y:.1f}" stroke-width="0.8" {style}/>',
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="white" stroke-width="2" {style.split(" stroke-dasharray")[0]}/>']


def draw(path, title, ratios, problems, dashed=()):
    """Writes the profile of each solver: `ratios` maps its name to its times over those of the fastest, where it solved.

    Solvers stand in the legend by the share that they solve, with it; those in `dashed` are drawn so. The axis takes all ratios up
    to 1000; what took longer stands at its end.
    """
    slowest = max((max(values) for values in ratios.values() if values), default=1.0)
    greatest = next((limit for limit in (10, 20, 50, 100, 200, 500) if slowest <= limit), 1000)
    order = sorted(ratios, key=lambda name: (-len(ratios[name]), sorted(ratios[name])))
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>', *_axes(title, greatest)]
    colours = {name: COLOURS[k % len(COLOURS)] for group in (set(ratios) - set(dashed), set(dashed))
               for k, name in enumerate(name for name in ratios if name in group)}
    pitch = min(20.0, (BOTTOM - TOP) / max(len(order), 1))
    for k, name in enumerate(order):
        style = f'stroke="{colours[name]}"' + (' stroke-dasharray="5 3"' if name in dashed else "")
        parts += _curve(sorted(ratios[name]), problems, greatest, style)
        y = TOP + 14 + pitch * k
        parts.append(f'<line x1="{RIGHT + 14}" x2="{RIGHT + 42}" y1="{y - 4:.1f}" y2="{y - 4:.1f}" stroke-width="2" {style}/>')
        parts.append(_text(RIGHT + 86, y, f"{100 * len(ratios[name]) / problems:.0f} %", "end"))
        parts.append(_text(RIGHT + 94, y, name, "start"))
    path.write_text("\n".join([*parts, "</svg>"]) + "\n")
