"""A settled bed in Yade: run by `yade -n -x bed.py BED STEP STEPS WARM_STEPS SKIN`. Prints wall time and kinetic energy.

The law of bench/peers/lammps: linear spring and dashpot (ViscElMat, whose parameters are those of one of two bodies in series), Coulomb.
"""

import math
import pathlib
import sys
import time

from yade import *  # noqa: F403  the interpreter's own names: O, Vector3, engines
from yade import utils

STIFFNESS, TANGENT, FRICTION, RESTITUTION, DENSITY = 2000.0, 2 / 7, 0.5, 0.5, 1000.0

bed, step, steps, warm, skin = pathlib.Path(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4]), float(sys.argv[5])
lines = bed.read_text().split("\n")
side = float(lines[0].split()[1])
rows = [[float(x) for x in line.split()] for line in lines[1:] if line.strip()]
mass = 0.5 * DENSITY * 4 / 3 * math.pi * min(row[3] for row in rows) ** 3
zeta = -math.log(RESTITUTION) / math.hypot(math.pi, math.log(RESTITUTION))
damping = 2 * zeta * math.sqrt(STIFFNESS * mass)
grain = O.materials.append(ViscElMat(density=DENSITY, frictionAngle=math.atan(FRICTION), kn=2 * STIFFNESS, ks=2 * TANGENT * STIFFNESS,
                                     cn=2 * damping, cs=damping))
for x, y, z, radius, vx, vy, vz in rows:
    i = O.bodies.append(utils.sphere((x, y, z), radius, material=grain))
    O.bodies[i].state.vel = (vx, vy, vz)
O.bodies.append(utils.wall(0.0, axis=2, sense=1, material=grain))
for axis in (0, 1):
    O.bodies.append(utils.wall(-0.5 * side, axis=axis, sense=1, material=grain))
    O.bodies.append(utils.wall(0.5 * side, axis=axis, sense=-1, material=grain))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.5 * skin),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
                    [Law2_ScGeom_ViscElPhys_Basic()]),
    NewtonIntegrator(damping=0.0, gravity=(0, 0, -9.81)),
]
O.dt = step
O.run(warm, True)
began = time.time()
O.run(steps, True)
print(f"seconds {time.time() - began!r} energy {utils.kineticEnergy()!r} contacts {O.interactions.countReal()}", flush=True)
