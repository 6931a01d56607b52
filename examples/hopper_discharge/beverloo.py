"""The law of Beverloo et al. and that of Mankoc et al., fitted to rates with errors. Standard library only.

    W = C rho sqrt(g) (D - k d)^n,  n = 5/2                               Beverloo, Leniger, van de Velde 1961, Chem. Eng. Sci. 15: 260-269
    W = C' rho sqrt(g) (1 - exp(-b (D/d - 1)) / 2) (D - d)^(5/2)          Mankoc et al. 2007, Granular Matter 9: 407-414; b = 0.05
"""

import math

GRAVITY = 9.81
K_LITERATURE, EXPONENT, B_LITERATURE = 1.4, 2.5, 0.05


def solve(matrix, right):
    """Solution of a small linear system, by elimination with pivots; `right` has columns."""
    n = len(matrix)
    rows = [list(row) + list(r) for row, r in zip(matrix, right)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda r: abs(rows[r][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [x / rows[i][i] for x in rows[i]]
        for r in range(n):
            if r != i:
                rows[r] = [a - rows[r][i] * b for a, b in zip(rows[r], rows[i])]
    return [row[n:] for row in rows]


def beverloo(ratio, ln_c, k, n):
    """ln(W / (rho sqrt(g) d^(5/2))) at D/d = ratio, and its derivatives by ln C, k and n."""
    x = ratio - k
    return ln_c + n * math.log(x), [1.0, -n / x, math.log(x)]


def fit(outlets, grain, rates, errors, density, free):
    """Least squares of ln W, weighted with its errors; `free`: names of {"k", "n"} that are sought beside C.

    Dict of C, k, n with `errors` (their standard errors, of the rates' errors) and `misfit` (sum of squares over the errors, and
    the number of rates less that of parameters: about equal when the law holds).
    """
    known = {"C": math.log(0.58), "k": K_LITERATURE, "n": EXPONENT}
    sought = ["C"] + [name for name in ("k", "n") if name in free]
    columns = [list(known).index(name) for name in sought]
    y = [math.log(w / (density * math.sqrt(GRAVITY) * grain**2.5)) for w in rates]
    weight = [w / e for w, e in zip(rates, errors)]
    for _ in range(50):  # Gauss-Newton; a step of k stays below the smallest outlet
        values = [beverloo(outlet / grain, *known.values()) for outlet in outlets]
        rest = [s * (a - v[0]) for s, a, v in zip(weight, y, values)]
        rows = [[s * v[1][c] for c in columns] for s, v in zip(weight, values)]
        normal = [[sum(r[i] * r[j] for r in rows) for j in range(len(sought))] for i in range(len(sought))]
        step = [s[0] for s in solve(normal, [[sum(r[i] * e for r, e in zip(rows, rest))] for i in range(len(sought))])]
        for name, s in zip(sought, step):
            known[name] += max(-0.5, min(0.5, s))
    unit = [[float(i == j) for j in range(len(sought))] for i in range(len(sought))]
    spread = solve(normal, unit)
    error = {name: math.sqrt(spread[i][i]) for i, name in enumerate(sought)}
    c = math.exp(known["C"])
    error["C"] *= c
    return {"C": c, "k": known["k"], "n": known["n"], "errors": error,
            "misfit": (sum(e * e for e in rest), len(rates) - len(sought))}


def fit_mankoc(outlets, grain, rates, errors, density):
    """The law of Mankoc et al. with their b: dict of C, `errors` and `misfit`."""
    shape = [density * math.sqrt(GRAVITY) * (1 - 0.5 * math.exp(-B_LITERATURE * (D / grain - 1))) * (D - grain) ** 2.5 for D in outlets]
    weight = [(w / e) ** 2 for w, e in zip(rates, errors)]
    ln = sum(s * math.log(w / f) for s, w, f in zip(weight, rates, shape)) / sum(weight)
    misfit = sum(s * (math.log(w / f) - ln) ** 2 for s, w, f in zip(weight, rates, shape))
    return {"C": math.exp(ln), "errors": {"C": math.exp(ln) / math.sqrt(sum(weight))}, "misfit": (misfit, len(rates) - 1)}
