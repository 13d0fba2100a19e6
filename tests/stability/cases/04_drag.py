# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Particles of all sizes and densities in all fluids, with steps far beyond the time scale of the drag."""
from harness import checks
from harness.case import Check, Fails, Group
from harness.scenes import box, explicit_drag, material, mud, spheres

GROUP = Group("drag", "4. Drag map", """
A particle let go in a fluid at rest moves towards its terminal velocity and never past it; a particle thrown sideways slows down and never
turns back. The terminal speed solves drag (Chien) = submerged weight, independently in Python. The relaxation time is m/(drag/speed), viscous
limit rho_p d^2 8/(6 * 30 mu): explicit drag (here fix addforce with the same law) is lost above twice that.""",
              {
                  "diameters": [0.0001, 1e-3, 6.35e-3, 0.01],
                  "ratios": [0.05, 0.3, 0.5, 0.9, 1.5, 2.619, 8.0],
                  "implicit": True,
              })


def let_go(diameters, ratios, step, implicit, viscosity):
    atoms = "".join("create_atoms 1 single %g %g 0.2 units box\n" % (0.05 + 0.1 * i, 0.05 + 0.1 * j) for j in range(4) for i in range(7))
    settings = "".join("set atom %d diameter %r density %r\n" % (1 + i + 7 * j, diameters[j], 1000 * ratios[i]) for j in range(4) for i in range(7))
    fluid = mud(f"newtonian {viscosity!r}") if implicit else explicit_drag(0, viscosity, 1, 1000)
    later = min(20000, max(600, int(3.0 / step)))
    dumping = f"dump_modify 1 every 20000\nrun {later}\ndump_modify 1 every 1\nrun 1" if implicit else ""
    return f'''{box("0 0.7 0 0.4 0 0.4", "p p p", skin=2e-3)}
{material()}
{spheres()}
{atoms}
{settings}
velocity all set 0.02 0 0
timestep {step}
fix weight all gravity 9.81 vector 0 0 -1
fix move all nve/sphere
{fluid}
dump 1 all custom {2 if implicit else 1} dump id radius density vx vy vz
dump_modify 1 format "%d %.15g %.15g %.15g %.15g %.15g"
run {400 if implicit else 1}
{dumping}
'''


GROUP.case(
    "mu{viscosity}_dt{step}",
    "28 particles (0.1 to 10 mm, density ratio 0.05 to 8) in {viscosity} Pa s, steps of {step} s",
    scene=let_go,
    quick=lambda viscosity, step: viscosity in (0.001, 100.0) and step == 1e-3,
    seconds=1,
    vary={"viscosity": [1e-3, 0.01, 0.1, 1.0, 10.0, 100.0], "step": [1e-5, 0.0001, 1e-3, 0.01]},
    checks=[
        Check("particles that ever pass 1.001 terminal speeds or move against their weight", checks.beyond_terminal, equals=0),
        Check("particles whose sideways velocity ever turns back or grows", checks.turned_back, equals=0),
        Check("largest relative error of the terminal speed", checks.terminal_error, below=1e-3),
    ],
    fails=[
        # below, explicit drag is stable, too; one step: after some more no particle is left to be measured
        Fails("explicit drag above twice the relaxation time of the smallest particles", set={"implicit": False},
              when=lambda viscosity, step: viscosity * step >= 1e-7),
        # at the case's own step explicit drag is stable, too
        Fails("explicit drag with a step of 0.1 s", set={"implicit": False, "step": 0.1}, when=lambda viscosity, step: viscosity * step < 1e-7),
    ])
