# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Suspension by a yield stress, and slip through zero."""
from math import pi

from harness import checks
from harness.case import Check, Fails, Group
from harness.references import ANSLEY_SMITH, sphere_mass
from harness.scenes import box, explicit_drag, material, mud, spheres

GROUP = Group("yield", "5. Yield stress", """
A sphere is held once the yield force (pi/8) d^2 30 (7 pi/24) tau0 reaches its submerged weight: tau0 >= 0.0485 (rho_p - rho_f) g d, 4.89 Pa for
the cuttings. Held means exactly: the velocity is that of the fluid to the last digit, no creep and no chatter. Below, the terminal speed
is that of Chien's law with the effective viscosity (in Python). A constant yield force in an explicit scheme chatters by
(F0/m) dt: 1.2 m/s2 per Pa times the step.""",
              {"d": 6.35e-3, "tau0": 0.0, "start": 0.05, "implicit": True, "step": 0.0001})


def held(d, start, step, implicit, tau0):
    fluid = mud(f"herschel_bulkley {tau0!r} 0.28 0.65") if implicit else explicit_drag(tau0, 0.28, 0.65, 1000)
    return f'''{box("0 0.1 0 0.1 0 0.4", "p p p", skin=2e-3)}
{material()}
{spheres()}
create_atoms 1 single 0.05 0.05 0.2 units box
set group all diameter {d} density 2619
velocity all set {start} 0.02 0.01
timestep {step}
fix weight all gravity 9.81 vector 0 0 -1
fix move all nve/sphere
{fluid}
run 40000
dump 1 all custom 1 dump id x y z vx vy vz
dump_modify 1 format "%d %.17g %.17g %.17g %.17g %.17g %.17g"
run 50
'''


GROUP.case(
    "tau{tau0}",
    "sphere let go at {start} m/s in a Herschel-Bulkley fluid of tau0 = {tau0} Pa",
    scene=held,
    quick=lambda tau0: tau0 in (0.0, 4.8, 5.0, 20.0),
    seconds=1,
    vary={"tau0": [0.0, 0.1, 1.0, 4.0, 4.8, 4.88, 4.9, 5.0, 10.0, 20.0]},
    checks=[
        Check("speed against the terminal speed / max(terminal, 1e-15 m/s)", checks.yield_speed_error, below=1),
        Check("sideways speed left / 1e-15 m/s", checks.sideways_left, below=1),
    ],
    fails=[
        Fails("explicit yield force chatters", set={"implicit": False}, when=lambda tau0: tau0 > 4.89),
        # what stock says when its last sphere is no number any more
        Fails("explicit drag with a step beyond the relaxation time", set={"implicit": False, "step": 0.2}, when=lambda tau0: tau0 < 4.89,
              says="Atom types must start from 1"),
    ])


def through_zero(d, step, implicit, tau0):
    fluid = mud(f"herschel_bulkley {tau0!r} 0.28 0.65", "v_u 0 0") if implicit else explicit_drag(tau0, 0.28, 0.65, 1000, "v_u")
    return f'''{box("0 0.1 0 0.1 0 0.4", "p p p", skin=2e-3)}
{material()}
{spheres()}
create_atoms 1 single 0.05 0.05 0.2 units box
set group all diameter {d} density 1000
timestep {step}
fix move all nve/sphere
variable u equal 0.1*sin(2*PI*step*{step})
{fluid}
variable slip equal v_u-vcm(all,x)
thermo_style custom step v_slip v_u
thermo 3  # odd: chatter has a period of two steps
run 20000
'''


GROUP.case(
    "through_zero_tau{tau0}",
    "fluid that swings by 0.1 m/s about a neutral sphere, tau0 = {tau0} Pa: the slip passes through zero",
    scene=through_zero,
    quick=lambda tau0: tau0 == 5.0,
    seconds=1,
    vary={"tau0": [0.5, 5.0, 20.0]},
    checks=[
        Check("largest slip after the first quarter period, where the yield force exceeds the inertia (m/s)", checks.late_slip, below=lambda d, step,
              tau0: 0.1 * 2 * pi * step * 1.01 + 1e-12 if ANSLEY_SMITH * tau0 * 30 * pi / 8 * d ** 2 > 0.1 * 2 * pi * sphere_mass(d, 1000) else 0.1),
    ],
    fails=[
        # there it cancels between the half steps of velocity Verlet
        Fails("explicit yield force chatters by (F0/m) dt", set={"implicit": False}, when=lambda tau0: tau0 < 20),
    ])
