"""Nothing leaves a turning drum; friction carries the heap to the side that rises, and without friction it stays in the middle."""

import math

from checking import Check

R, HALF = 0.1, 0.04
INRADIUS = 0.006   # no grain is thinner than the rods [m]
DEPTH = 1e-4       # that a step of 1 ms may drive a grain into the wall at 0.1 m/s [m]


def lean(track, since):
    """Mean of x over grains and times after `since`, in radii."""
    grains = [i for i, t in enumerate(track["time"]) if t >= since and track["id"][i] > 0]
    return sum(track["x"][i] for i in grains) / len(grains) / R


with Check(__file__) as check:
    track = check.run().table("track.csv")
    grains = [i for i in range(len(track["time"])) if track["id"][i] > 0]
    check.holds("32 grains tumble", len({track["id"][i] for i in grains}) == 32)
    far = max(math.hypot(track["x"][i], track["y"][i]) for i in grains)
    check.holds("every grain stays within the mantle", far < R - INRADIUS + DEPTH, f"middles up to {far:.4g} m")
    wide = max(abs(track["z"][i]) for i in grains)
    check.holds("and between the lids", wide < HALF - INRADIUS + DEPTH, f"up to {wide:.4g} m")

    # The bottom moves towards +x, and there the mantle rises. A rough heap slides where it is as steep as its friction:
    # 27 degrees for mu = 0.5; a tenth of the radius is far below that.
    rough = lean(track, 1.0)
    check.holds("the heap leans to the side that rises", rough > 0.1, f"{rough:.3g} radii")
    # Without friction the drum does no work sideways: the heap swings about the lowest point and comes to no side.
    smooth = lean(check.run("smooth", material__wood__friction=0.0).table("track.csv"), 1.0)
    check.holds("without friction it does not", abs(smooth) < 0.05, f"{smooth:.2g} radii")
