"""Metals and plastics part into bins; without voltage and at equal densities they do not; nothing is lost.

A fifth of the published feed rate for 1.5 s, so that the check takes a minute; `full` checks the published rate.
"""

from math import sqrt
from pathlib import Path

from checking import STEPPERS, Check

PUBLISHED_RATE, SHORT_RATE = 10000, 2000  # [1/s]
FAMILIES = ("spheres", "shavings")
FINE = Path(__file__).with_name("check.toml")


def landing(run, name, observer="families"):
    """Mean position, its standard error, and the number of the bodies of a target or material."""
    bins = run.table(f"bins_{observer}.csv")
    number = bins[f"number_{name}"]
    count = sum(number)
    mean = sum(n * x for n, x in zip(number, bins["x"])) / count
    variance = sum(n * (x - mean) ** 2 for n, x in zip(number, bins["x"])) / (count - 1)
    return mean, sqrt(variance / count), count


def standard_errors(one, other):
    return (one[0] - other[0]) / sqrt(one[1] ** 2 + other[1] ** 2)


def check_books(check, run, what):
    ledger = run.table("bins_families_ledger.csv")
    for i, name in enumerate(ledger["material"]):
        fed, flight, lost, binned = (ledger[f"number_{key}"][i] for key in ("fed", "in_flight", "lost", "collected"))
        check.holds(f"{what}: {name}: fed = in flight + lost + collected, exactly", fed == flight + lost + binned,
                    f"{fed:.0f} = {flight:.0f} + {lost:.0f} + {binned:.0f}")
        mass, *parts = (ledger[f"mass_{key}"][i] for key in ("fed", "in_flight", "lost", "collected"))
        check.near(f"{what}: {name}: the masses close to rounding", sum(parts), mass, 1e-12 * mass)


with Check(__file__) as check:
    RATE = PUBLISHED_RATE if check.full else SHORT_RATE
    SHORT = {"simulation__end_time": 1.5, "source__feed__rate": RATE, "observer__vtk__interval": 1}
    for seed in (1, 2, 3):
        run = check.run(f"seed_{seed}", scene=FINE, simulation__seed=seed, **SHORT)
        for family in FAMILIES:
            apart = standard_errors(landing(run, f"metal_{family}"), landing(run, f"plastic_{family}"))
            check.holds(f"seed {seed}: metal {family} land farther than plastic ones by more than 10 standard errors",
                        apart > 10, f"measured {apart:.1f}")
        check_books(check, run, f"seed {seed}")

        control = check.run(f"control_{seed}", scene=FINE, simulation__seed=seed, electric_field__gap__voltage=0,
                            material__metal__density=946, **SHORT)
        apart = standard_errors(landing(control, "metal"), landing(control, "plastic"))
        check.holds(f"seed {seed}: without voltage and with equal densities they differ by less than 2 standard errors",
                    abs(apart) < 2, f"measured {apart:.2f}")

    for seed in (1, 2, 3):
        # Three in ten grains are mixed ones, not one: enough to tell them from metal, which they resemble most.
        mixture = check.run(f"mixture_{seed}", scene=check.scene.with_name("mixture.toml"), simulation__seed=seed,
                            source__feed__families__mixed__share=0.4,
                            **SHORT | {"source__feed__rate": 2 * RATE, "observer__collector__u_bins": 160})
        metal, mixed, plastic = (landing(mixture, name, "collector") for name in ("metal", "mixed", "plastic"))
        for law, apart, least in (("mixed grains land farther than plastic", standard_errors(mixed, plastic), 10),
                                  ("mixed grains land nearer than metal", standard_errors(metal, mixed), 4)):
            check.holds(f"seed {seed}: {law}, by more than {least} standard errors", apart > least,
                        f"plastic {plastic[0]:.4f} m, mixed {mixed[0]:.4f} m, metal {metal[0]:.4f} m: {apart:.1f}")

    # One feed, two steppers: down the chute and on the roll fields do the same work on grains that slide the same way. What they do after
    # impacts differs, by 4 % of the energy of 125 grains.
    few = {"simulation__end_time": 0.25, "source__feed__rate": 500}
    rigid, soft = (check.run(stepper, scene=FINE, time_stepper__type=stepper, **few).table("steps.csv") for stepper in STEPPERS)
    check.holds("dem is fed what dvi is", rigid["bodies"] == soft["bodies"])
    for column, share in (("force_work", 0.02), ("kinetic_energy", 0.1)):
        check.near(f"dem and dvi: the same {column.replace('_', ' ')}, to {share:.0%}", soft[column][-1], rigid[column][-1],
                   share * rigid[column][-1])
