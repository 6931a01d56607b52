"""Wear of two liners by two sizes of ore of the same mass, means of three packings: table and bar chart.

usage: study.py SCREE FOLDER: results, table.md and wear_study.svg go into FOLDER. Some minutes.
"""

import csv
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
LINERS, SIZES = ("bars", "waves"), {"8 mm": 270, "5 mm": 1106}  # grains of 195 g in all
SHIFTS = (0.0, 0.1, 0.2)  # of the grains at the start: enough for other collisions [mm]
START = 0.5  # the grains have fallen, and the drum has turned by 250 degrees [s]


def column(folder, table, name):
    with open(folder / table, newline="") as file:
        rows = list(csv.reader(file))
    names = [word.split(" [")[0] for word in rows[0]]
    return [(float(row[names.index("time")]), row[names.index("body")], float(row[names.index(name)])) for row in rows[1:]]


def rate(folder, body, name):
    """Growth of a column of wear.csv from START on [1/s]."""
    values = [(t, v) for t, b, v in column(folder, "wear.csv", name) if b == body and t >= START - 1e-9]
    return (values[-1][1] - values[0][1]) / (values[-1][0] - values[0][0])


def power(folder):
    """Mean power that the drum gives [W]."""
    values = [v for t, _, v in column(folder, "body_load.csv", "power") if t > START]
    return -2 * sum(values) / len(values)  # two bodies


def run(program, results, liner, size, shift, end):
    """One run: rates [mm3/h], power [W]."""
    subprocess.run([program, "run", str(HERE / "scene.toml"), "-o", str(results), "--overwrite", "--quiet",
                    "--set", f"body.liner.shape={liner}", "--set", f"source.ore.families.ore.size={size}",
                    "--set", f"source.ore.count={SIZES[size]}", "--set", f"source.ore.lower=['-38 mm', '{shift - 38} mm', '-17 mm']",
                    "--set", f"simulation.end_time={end} s"], check=True, capture_output=True, text=True)
    found = {f"{body} {what}": 3600 * 1e9 * rate(results, body, f"{what}_volume")
             for body in ("liner", "shell") for what in ("sliding", "impact")}
    found["lifters"] = found["liner sliding"] + found["liner impact"]
    found["power"] = power(results)
    found["per energy"] = 1000 * found["lifters"] / found["power"]
    return found


def study(program, folder, liners=LINERS, sizes=tuple(SIZES), shifts=SHIFTS, end=2.0):
    """One row for each liner and size: means over shifts, and the greatest distance of lifters' wear from its mean."""
    rows = []
    for liner in liners:
        for size in sizes:
            runs = [run(program, folder / f"{liner}_{size.replace(' ', '')}_{k}", liner, size, shift, end)
                    for k, shift in enumerate(shifts)]
            row = {key: sum(r[key] for r in runs) / len(runs) for key in runs[0]}
            row["scatter"] = max(abs(r["lifters"] - row["lifters"]) for r in runs)
            rows.append({"liner": liner, "grains": size, **row})
    return rows


def table(rows):
    lines = ["| liner | grains | lifters [mm3/h] | of it sliding | shell, sliding [mm3/h] | shell, impacts [mm3/h] | power [W] "
             "| lifters' wear per energy [mm3/kWh] |", "|" + "---|" * 8]
    for r in rows:
        lines.append(f"| {r['liner']} | {r['grains']} | {r['lifters']:.2f} +- {r['scatter']:.2f} | {r['liner sliding']:.3f} "
                     f"| {r['shell sliding']:.3f} | {r['shell impact']:.2f} | {r['power']:.3f} | {r['per energy']:.0f} |")
    return "\n".join(lines) + "\n"


def chart(rows):
    """Stacked bars: sliding and impacts on the lifters."""
    width, height, left, bottom, top = 640, 360, 70, 300, 60
    most = max(r["lifters"] + r["scatter"] for r in rows)
    scale = (bottom - top) / most
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" '
             f'font-size="13"><rect width="{width}" height="{height}" fill="white"/>'
             '<text x="20" y="24" font-weight="bold">Wear of the lifters [mm3/h]</text>'
             '<rect x="320" y="13" width="12" height="12" fill="#D55E00"/><text x="338" y="24">sliding (Archard)</text>'
             '<rect x="470" y="13" width="12" height="12" fill="#0072B2"/><text x="488" y="24">impacts (Finnie)</text>']
    for k in range(int(2 * most) + 1):
        y = bottom - 0.5 * k * scale
        parts.append(f'<line x1="{left}" x2="{width - 20}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ddd"/>'
                     f'<text x="{left - 8}" y="{y + 4:.1f}" text-anchor="end">{0.5 * k:.1f}</text>')
    for k, r in enumerate(rows):
        x = left + 30 + k * (width - left - 40) / len(rows)
        low = scale * r["liner sliding"]
        high = scale * r["liner impact"]
        parts.append(f'<rect x="{x:.1f}" y="{bottom - low:.1f}" width="80" height="{low:.1f}" fill="#D55E00"/>'
                     f'<rect x="{x:.1f}" y="{bottom - low - high:.1f}" width="80" height="{high:.1f}" fill="#0072B2"/>'
                     f'<line x1="{x + 40:.1f}" x2="{x + 40:.1f}" y1="{bottom - scale * (r["lifters"] - r["scatter"]):.1f}" '
                     f'y2="{bottom - scale * (r["lifters"] + r["scatter"]):.1f}" stroke="black"/>'
                     f'<text x="{x + 40:.1f}" y="{bottom + 20}" text-anchor="middle">{r["liner"]}, {r["grains"]}</text>')
    return "\n".join(parts) + "\n</svg>\n"


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    out = pathlib.Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    found = study(sys.argv[1], out)
    (out / "table.md").write_text(table(found))
    (out / "wear_study.svg").write_text(chart(found))
    print(table(found), end="")
