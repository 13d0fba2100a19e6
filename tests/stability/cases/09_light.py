# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Neutral, rising and very light particles, spheres and clusters."""
from harness import checks
from harness.case import Check, Fails, Group
from harness.scenes import box, clusters, explicit_drag, material, mud, place, template

GROUP = Group("light", "9. Light particles", """
A neutral particle stays where it is: no force acts on it. A rising one reaches the terminal speed of Chien's law upward; a particle of 5 % of
the fluid's density has almost no inertia, which an explicit drag does not survive. (There is no added mass: see docs/fix_fluid_force.md.)""",
              {"d": 6.35e-3, "implicit": True, "step": 1e-3, "viscosity": 1.0})


def let_go(shape, d, ratio, step, implicit, viscosity):
    fluid = mud(f"newtonian {viscosity!r}", drag="haider_levenspiel") if implicit else explicit_drag(0, viscosity, 1, 1000)
    return f'''{box("0 0.1 0 0.1 0 0.4", "p p p", skin=2e-3)}
{material()}
{clusters()}
{template("body", shape, d, density=1000 * ratio, orientation="given")}
fix weight all gravity 9.81 vector 0 0 -1
fix move all nve/cluster
timestep 1e-9
{place("body", "0.05 0.05 0.2")}
timestep {step}
{fluid}
variable w equal vcm(all,z)
thermo 1
thermo_style custom step atoms v_w
run 3000
thermo_style custom step atoms v_w
run 100
'''


GROUP.case(
    "{shape}_ratio{ratio}",
    "{shape} of {ratio} times the fluid's density in {viscosity} Pa s, steps of {step} s",
    scene=let_go,
    quick=lambda ratio, shape: ratio in (0.05, 1.0) and shape == 'sphere 1',
    seconds=1,
    vary={"shape": ["sphere 1", "cube 8"], "ratio": [0.05, 0.3, 0.5, 0.9, 1.0]},
    checks=[
        Check("largest speed against the weight (m/s)", checks.against_weight, below=1e-7),
        Check("largest step back of the speed on the way / speed", checks.step_back, below=1e-6),
        Check("change of the speed in the last 100 steps / 1e-9 m/s", checks.speed_change, below=1),
        Check("bodies", checks.bodies, equals=1),
    ],
    fails=[
        Fails("explicit drag", set={"implicit": False, "viscosity": 10.0}, when=lambda ratio: ratio < 1, says="Atom types must start from 1"),
        Fails("a particle that is denser by a thousandth sinks", set={"ratio": 1.001}, when=lambda ratio: ratio == 1),
    ])
