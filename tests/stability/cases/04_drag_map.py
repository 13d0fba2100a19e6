# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Coupled drag over Stokes number and coupling interval."""
from math import pi

from harness import checks_flow
from harness.case import Check, Fails, Group
from harness.drag_map import FLUID, SOLID, map_drive, map_gravity, map_settles, response_time
from harness.scenes import box, held_drag, material, spheres, spheres_at

GROUP = Group("drag_map", "4. Drag: map over Stokes number and coupling interval", """
A uniform suspension (40 % solid, a sphere in each cell) sinks or rises in its fluid, and a gradient carries the submerged weight, so that nothing but drag acts between
the two and the slip becomes the terminal velocity in the suspension. St is the interval between two coupling steps over the response time m u/F, r the ratio of inertia of particles and fluid.
An interval multiplies a deviation of the slip by 1 - St if its first drag is held, as explicit couplings do (here fix store/state, particles alone): lost above St = 2. With the drag of every
DEM step but explicit momentum in the fluid it is E - r (1 - E), E = (1 + St/N)^-N: lost where 1 - E > 2/(1 + r), which is never for r < 1. Semi-implicit momentum must be stable everywhere: after a kick of half the
slip in the fluid the slip never reverses, and comes back. Gravity is so weak that a sphere sinks by 1e-9 cells in an interval: the factors are exact.""",
              {
                  "scheme": "semiImplicit",
                  "stokes": [0.1, 0.5, 1.5, 2.5, 10.0, 100.0],
                  "side": 2,  # cells, and spheres, along each edge
              })


def suspension(d, side, cell, rho, every, tau, stokes, which, kind, scheme, mu):
    middles = [(i + 0.5) * cell for i in range(side)]
    atoms = spheres_at((x, y, z) for x in middles for y in middles for z in middles)
    if scheme == "held":
        drag = held_drag(mu, d, FLUID, SOLID, every, map_gravity(kind, stokes[which], cell))
    else:
        drag = f"fix mud all fluid/force rheology newtonian {mu!r} density {FLUID!r} drag chien\nfix flow all fluid/couple link solver every {every}"
    return f'''{box("0 %r 0 %r 0 %r" % ((side * cell,) * 3), "p p p", skin=0.1 * d)}
{material()}
{spheres()}
{atoms}
set group all diameter {d} density {rho}
timestep {stokes[which] * tau / every}
fix weight all gravity {map_gravity(kind, stokes[which], cell)} vector 0 0 -1
fix move all nve/sphere
{drag}
variable w equal vcm(all,z)
thermo {every}
thermo_style custom step atoms v_w
thermo_modify format float %.12g
run {every * (map_settles(stokes[which], scheme, every) * (2 if scheme == "semiImplicit" else 1))}
'''


GROUP.case(
    "{kind[0]}_N{every}",
    "suspension of {size_mm:g} mm, density ratio {kind[2]}, {kind[3]:g} Pa s, coupling steps every {every} DEM steps, intervals of 0.1 to 100 response times",
    scene=suspension,
    quick=lambda every, kind: kind[0] == 'cutting' and every == 10,
    seconds=8,
    vary={"kind": [["dust", 1e-4, 8.0, 1e-3], ["foam", 1e-3, 0.05, 0.1], ["cutting", 6.35e-3, 2.619, 1.0], ["bubble", 0.01, 0.3, 10.0],
                   ["boulder", 0.01, 8.0, 100.0]],
          "every": [1, 10, 100, 1000]},
    derive=lambda kind: {"d": kind[1], "rho": FLUID * kind[2], "mu": kind[3], "tau": response_time(kind[1], FLUID * kind[2], kind[3]),
                         "cell": kind[1] * (pi / 6 / SOLID) ** (1 / 3), "size_mm": kind[1] * 1e3},
    runs=[{"which": 0}, {"which": 1}, {"which": 2}, {"which": 3}, {"which": 4}, {"which": 5}],
    files=["drag_map"],
    settings=lambda side, cell, tau, mu, kind, scheme, every, stokes, which: {
        "edge": side * cell, "interval": stokes[which] * tau, "nu": mu / 1000, "gradient": map_drive(kind, stokes[which], cell, scheme, every)},
    commands=lambda scheme: ["serial true", "eccentra-dem -in in.case -log none"] if scheme == "held" else ["serial blockMesh", "annulusFoam"],
    points=checks_flow.map_points,
    checks=[
        Check("Stokes numbers at which the deviation grows", checks_flow.growing_stokes, equals=0),
        Check("largest error of the slip that particles feel, before the kick", checks_flow.slip_error_before_the_half_step, below=1e-3),
        Check("least slip after a kick of -0.5 / terminal slip: it never reverses", checks_flow.least_slip_after, above=0),
        Check("largest slip after it: no overshoot beyond the kick", checks_flow.largest_slip_after, below=1.5),
        Check("largest error of the slip that particles feel, at the end", checks_flow.slip_error_at_the_end, below=1e-3),
    ],
    fails=[
        Fails("explicit momentum in the fluid", set={"scheme": "explicit"}),
        Fails("drag of the coupling step, held over the interval", set={"scheme": "held"}, twin="fails_held"),
    ])
