"""Kinetic energy over time on a logarithmic axis, as SVG. Standard library only."""

import math

COLOURS = {"scree": "#1b6ca8", "LAMMPS": "#d1495b"}
LEFT, RIGHT, TOP, BOTTOM = 70, 700, 40, 400  # of the axes
DECADES = 7


def _text(x, y, words, anchor="middle", size=12, more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}"{more}>{words}</text>'


def _axes(title, x_of, y_of, end, top):
    parts = [_text((LEFT + RIGHT) / 2, 24, title, size=14), _text((LEFT + RIGHT) / 2, BOTTOM + 38, "time [s]"),
             _text(18, (TOP + BOTTOM) / 2, "kinetic energy [J]", more=f' transform="rotate(-90 18 {(TOP + BOTTOM) / 2})"')]
    for k in range(DECADES + 1):
        y = y_of(10.0 ** (top - k))
        parts.append(f'<line x1="{LEFT}" x2="{RIGHT}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ddd"/>')
        parts.append(_text(LEFT - 8, y + 4, f"1e{top - k}", "end"))
    for k in range(6):
        x = x_of(end * k / 5)
        parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{TOP}" y2="{BOTTOM}" stroke="#ddd"/>')
        parts.append(_text(x, BOTTOM + 18, f"{end * k / 5:.2g}"))
    parts.append(f'<rect x="{LEFT}" y="{TOP}" width="{RIGHT - LEFT}" height="{BOTTOM - TOP}" fill="none" stroke="black"/>')
    return parts


def draw(path, title, curves):
    """`curves` maps a program to its runs, each (times [s], energies [J])."""
    runs = [run for of_program in curves.values() for run in of_program]
    end = max(run[0][-1] for run in runs)
    top = math.ceil(math.log10(max(max(run[1]) for run in runs)))

    def x_of(time):
        return LEFT + (RIGHT - LEFT) * time / end

    def y_of(energy):
        return TOP + (BOTTOM - TOP) * min(max((top - math.log10(max(energy, 1e-300))) / DECADES, 0.0), 1.0)

    parts = _axes(title, x_of, y_of, end, top)
    for row, (name, of_program) in enumerate(curves.items()):
        for times, energies in of_program:
            points = " ".join(f"{x_of(t):.1f},{y_of(e):.1f}" for t, e in zip(times, energies))
            parts.append(f'<polyline points="{points}" fill="none" stroke="{COLOURS[name]}" stroke-opacity="0.6"/>')
        y = TOP + 20 + 18 * row
        parts.append(f'<line x1="{RIGHT - 110}" x2="{RIGHT - 80}" y1="{y - 4}" y2="{y - 4}" stroke="{COLOURS[name]}" stroke-width="2"/>')
        parts.append(_text(RIGHT - 72, y, name, "start"))
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 730 450" font-family="sans-serif">'
                    f'<rect width="730" height="450" fill="white"/>{"".join(parts)}</svg>\n')
