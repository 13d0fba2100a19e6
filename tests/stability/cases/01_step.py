# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Beds at rest at parts of the critical step."""
from math import sqrt

from harness import checks
from harness.case import Check, Fails, Group
from harness.references import GRAVITY, sphere_mass
from harness.scenes import box, clusters, floor, material, pour, template, weight

GROUP = Group("step", "1. Step", """
An explicit scheme is stable below dt = 2/w (sqrt(1 + z^2) - z). Below it a bed at rest stays at rest: its kinetic energy does not
grow. The scale is the energy that one body wins by falling 1e-8 of its diameter (stiff contacts soften as a heated bed
loosens: its energy stays small, but not that small). Above it, `fix timestep/limit` must say so before a body
is lost; twice the limit must heat the bed.""",
              {
                  "d": 6.35e-3,
                  "count": 60,
                  "high": 0.9,  # largest part of the limit at which the bed must rest
              })


def step(E):
    """A part of the critical step [s] that any bed settles with."""
    return 0.15 * 2.5e-4 * sqrt(5e6 / E)


def damping(d):
    """Of fix viscous, under which a bed comes to rest [kg/s]."""
    return 0.05 * sphere_mass(d, 2619) / 2.5e-4


def poured(E, shape, d, count):
    """Bodies above a floor, before they fall."""
    return f'''{box("0 0.0254 0 0.0254 -0.002 0.3", "p p f")}
{material(youngs=E, e=0.5)}
{clusters()}
{weight()}
{floor()}
{template("body", shape, d)}
fix move all nve/cluster
fix limit all timestep/limit safety 1.0 every 100
timestep {step(E)}
{pour("body", count, "0 0.0254 0 0.0254 0.005 0.2")}
'''


BEDS = {"shape": ["sphere 1", "cube 8", "cube 64", "disk 48"], "E": [5e6, 5e9]}
GUARD = "fix limit all timestep/limit safety 1.0 every 100 enforce yes"
STOPPED = [Check("exit status", checks.status, above=0),
           Check("sentences that name the step and the limit", checks.says_step_and_limit, equals=1),
           Check("bodies left before it", checks.bodies, equals=lambda count: count)]


def bed(E, shape, d, count, high):
    return f'''{poured(E, shape, d, count)}
thermo 100
thermo_style custom step atoms f_move[1] f_move[2] f_limit f_limit[2]
run {int(0.35 / step(E))}
fix damp all viscous {damping(d)}
run {int(0.2 / step(E))}
unfix damp
variable moves equal f_move[1]+f_move[2]
variable tries loop 10
label settle
fix damp all viscous {damping(d)}
run {int(0.05 / step(E))}
unfix damp
run {int(0.05 / step(E))}  # at rest only if nothing tips over when it is left alone
if "${{moves}} < {count * sphere_mass(d, 2619) * GRAVITY * 1e-8 * d}" then "jump in.case settled"
next tries
jump in.case settle
label settled
run 1000
variable allowed equal f_limit
variable half equal 0.5*${{allowed}}
timestep ${{half}}
run 3000
variable allowed equal f_limit
variable most equal {high}*${{allowed}}
timestep ${{most}}
run 6000
'''


GROUP.case(
    "bed_{shape}_E{E:g}",
    "bed of 60 {shape}, E = {E:g} Pa, at 0.5 and {high} of the limit",
    scene=bed,
    quick=lambda E, shape: E == 5e6 and shape in ('sphere 1', 'cube 64'),
    seconds=6,
    vary=BEDS,
    checks=[
        Check("kinetic energy at half the limit / (N m g 1e-8 d)", checks.late_motion, below=1, part=1e-8, columns=["f_move[1]"], table=-2),
        Check("kinetic energy at the end / (N m g 1e-8 d)", checks.late_motion, below=1, part=1e-8, columns=["f_move[1]"]),
        Check("bodies", checks.bodies, equals=lambda count: count),
    ],
    fails=[
        Fails("twice the limit heats the bed", set={"high": 2.0}, says="they have run into each other"),
    ])


def says_so(E, shape, d, count, guard):
    return f'''{poured(E, shape, d, count)}
thermo 100
thermo_style custom step atoms f_move[1] f_move[2] f_limit f_limit[2]
run {int(0.35 / step(E))}
fix damp all viscous {damping(d)}
run {int(0.2 / step(E))}
unfix damp
run 1000
variable allowed equal f_limit
variable most equal 1.1*${{allowed}}
unfix limit
thermo_style custom step atoms f_move[1] f_move[2]
{guard}
timestep ${{most}}
run 2000
'''


GROUP.case(
    "says_so_{shape}_E{E:g}",
    "bed of 60 {shape}, E = {E:g} Pa, at 1.1 of the limit: timestep/limit stops the run, nothing is lost",
    scene=says_so,
    quick=lambda shape, E: shape == 'disk 48' and E == 5e6,
    seconds=4,
    vary=BEDS,
    values={"guard": GUARD},
    checks=STOPPED,
    fails=[
        Fails("without the fix nobody says so", set={"guard": ""}),
    ])


def flowing(E, shape, d, count, high):
    return f'''{poured(E, shape, d, count)}
run {int(0.35 / step(E))}
unfix weight
{weight(35)}
variable x equal xcm(all,x)
variable z equal xcm(all,z)
thermo 50
thermo_style custom step atoms f_move[1] f_move[2] v_x v_z f_limit
run 1000
variable allowed equal f_limit
variable half equal 0.5*${{allowed}}
timestep ${{half}}
run 2000
variable allowed equal f_limit
variable most equal {high}*${{allowed}}
timestep ${{most}}
run 2000
'''


GROUP.case(
    "flowing_{shape}_E{E:g}",
    "bed of 60 {shape}, E = {E:g} Pa, that slides down a floor of 35 degrees (friction 0.5), at 0.5 and {high} of the limit",
    scene=flowing,
    seconds=6,
    vary=BEDS,
    checks=[
        Check("gain of kinetic energy / work of gravity, at half the limit", checks.gain_over_gravity, below=1, table=-2),
        Check("gain of kinetic energy / work of gravity, at the end", checks.gain_over_gravity, below=1),
        Check("bodies", checks.bodies, equals=lambda count: count),
    ],
    fails=[
        Fails("4 times the limit: a flowing bed gains energy", set={"high": 4.0}, says="they have run into each other"),
    ])


def flowing_says_so(E, shape, d, count, guard):
    return f'''{poured(E, shape, d, count)}
run {int(0.35 / step(E))}
unfix weight
{weight(35)}
thermo 50
thermo_style custom step atoms f_move[1] f_move[2] f_limit
run 1000
variable allowed equal f_limit
variable most equal 1.1*${{allowed}}
unfix limit
thermo_style custom step atoms f_move[1] f_move[2]
{guard}
timestep ${{most}}
run 2000
'''


GROUP.case(
    "flowing_says_so_{shape}_E{E:g}",
    "the same bed (60 {shape}, E = {E:g} Pa) at 1.1 of the limit: timestep/limit stops the run, nothing is lost",
    scene=flowing_says_so,
    seconds=5,
    vary=BEDS,
    values={"guard": GUARD},
    checks=STOPPED,
    fails=[
        Fails("without the fix nobody says so", set={"guard": ""}),
    ])
