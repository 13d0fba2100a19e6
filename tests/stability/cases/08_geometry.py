# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Annuli from concentric to nearly touching, pipe at rest and fast."""
from math import pi

from harness import checks, checks_flow
from harness.case import Check, Fails, Group
from harness.scenes import box, material, spheres, spheres_at, weight_along

GROUP = Group("geometry", "8. Geometry", """
A Newtonian fluid in an eccentric annulus has the pressure gradient of Piercy, Hooper & Winny (1933), whatever the inclination (p_rgh) and, in
creeping flow, whatever the speed of the pipe: turning moves nothing along the axis. Viscosity 1 Pa s: the flow creeps.""",
              {"hole": 0.0635, "pipe": 0.02413, "Ubar": 0.01, "viscosity": 1.0, "cells": "(12 48 2)", "steps": 40})


def annulus(steps, viscosity, e, hole, pipe, rpm):
    """What the dictionaries of the annulus read."""
    return {"end": steps * 10, "nu": viscosity / 1000, "pipe_y": -e * (hole - pipe), "omega": rpm * pi / 30}


PIERCY = Check("pressure gradient against Piercy's, relative error", checks_flow.annulus_error, below=0.02)
COARSE = Fails("two cells across the gap", set={"cells": "(2 8 2)"})


GROUP.case(
    "e{e}_rpm{rpm}_inclination{inclination}",
    "annulus of eccentricity {e}, inclined by {inclination} degrees, pipe at {rpm} rpm",
    quick=lambda e: e == 0.5,
    seconds=8,
    vary={"e": [0.0, 0.5, 0.8, 0.95], "rpm": [0], "inclination": [80]},
    files=["geometry"],
    settings=annulus,
    commands=["annulusMesh", "annulusFoam"],
    checks=[
        PIERCY,
    ],
    fails=[
        COARSE,
    ])


GROUP.case(
    "turning_e{e}_inclination{inclination}",
    "annulus of eccentricity {e}, inclined by {inclination} degrees, pipe at {rpm} rpm, 20 Pa s",
    seconds=8,
    vary={"e": [0.0, 0.5, 0.9, 0.95], "inclination": [0, 40, 90, 100]},
    values={"rpm": 300, "viscosity": 20.0},
    files=["geometry"],
    settings=annulus,
    commands=["annulusMesh", "annulusFoam"],
    checks=[
        PIERCY,
    ],
    fails=[
        COARSE,
    ])


def narrow_gap(hole, pipe_wall, pipe, e, d):
    atoms = spheres_at((s * (0.040 + 0.0075 * (i // 6 % 2)),
    -0.012 - 0.0075 * (i // 12) + (0.002 if s > 0 else 0), 0.004 + 0.008 * (i % 6)) for s in (-1, 1) for i in range(30))
    return f'''{box("%r %r %r %r 0 0.05" % (-hole, hole, -hole, hole), "f f p", skin=2e-3)}
{material(5e6, 0.5, 0.5)}
{spheres()}
{weight_along("0 -1 0")}
fix bore all wall/gran/cluster model hertz tangential history primitive type 1 zcylinder {hole} 0 0
{"fix pipe all wall/gran/cluster model hertz tangential history primitive type 1 zcylinder %r 0 %r" % (pipe, -e * (hole - pipe)) if pipe_wall else ""}
{atoms}
set group all diameter {d} density 2619
fix move all nve/sphere
timestep 5e-5
fix mud all fluid/force rheology newtonian 0.1 density 1000 drag chien pressure_gradient on
fix flow all fluid/couple link solver every 100
thermo 1000
thermo_style custom step atoms ke
run 30000
dump 1 all custom 100 dump id x y z vx vy
dump_modify 1 format "%d %.15g %.15g %.15g %.15g %.15g"
run 100
'''


GROUP.case(
    "narrow_gap",
    "60 spheres of 6.35 mm sink to the low side of an annulus whose gap is 3.9 mm there (e = 0.9), flow of 0.3 m/s",
    scene=narrow_gap,
    seconds=60,
    values={"e": 0.9, "rpm": 0, "inclination": 90, "d": 6.35e-3, "pipe_wall": True},
    files=["geometry", "geometry/narrow_gap"],
    settings=annulus,
    commands=["annulusMesh", "annulusFoam"],
    checks=[
        Check("spheres", checks.bodies_in_frame, equals=60),
        Check("deepest overlap with bore or pipe / d", checks_flow.deepest_overlap, below=0.01),
        Check("spheres below the pipe, where none fits", checks_flow.below_the_pipe, equals=0),
        Check("fastest sphere across the hole at the end (m/s)", checks_flow.fastest_across, below=0.05),
        Check("least fluid fraction", checks_flow.least_fraction, above=0.25),
        Check("error of the solid volume on the mesh", checks_flow.volume_error, below=1e-12),
        Check("spread of the pressure gradient over the last half", checks_flow.spread_of_gradient, below=0.5),
    ],
    fails=[
        Fails("the DEM side knows no pipe", set={"pipe_wall": False}),
    ])
