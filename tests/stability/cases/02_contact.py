# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Contacts that go wrong in many codes: slopes, stacks, faces, rims, corners, deep overlap, unequal partners."""
from math import atan, degrees, sqrt

from harness import checks
from harness.case import Check, Fails, Group
from harness.references import cubes_apart
from harness.scenes import about, box, clusters, floor, material, place, pour, spheres, template, weight

GROUP = Group("contact", "2. Contact", """
A sphere rests on a slope of angle a if tan a < mu_r and tan a < mu_s; at rest means no creep, not a small one. A stack and a pile at
rest stay. A face that lands returns at e whatever the number of sub-spheres that touch. Without walls and gravity a frictional, damped
impact never gains energy. Two elastic spheres that are put into each other fly apart with the energy 8/15 E* sqrt(R*) overlap^2.5 of Hertz.""",
              {"d": 6.35e-3, "E": 1e7, "form": "limited", "step": 1e-5})


def slope(E, mu, form, angle, d, step):
    return f'''{box("-0.05 0.05 -0.05 0.05 -0.01 0.05")}
{material(E, 0.5, 1.0, mu_shape=mu)}
{spheres("rolling_friction shape form " + form)}
{weight(min(angle, 0.97 * degrees(atan(mu))))}
fix floor all wall/gran model hertz tangential history rolling_friction shape primitive type 1 zplane 0.0 form {form}
create_atoms 1 single 0 0 {d / 2 - 1e-6} units box
set group all diameter {d} density 2619
fix move all nve/sphere
timestep {step}
compute spin all erotate/sphere
thermo 10
thermo_style custom step ke c_spin
variable x equal vcm(all,x)
thermo_style custom step ke v_x
run 30000
run 2000
'''


GROUP.case(
    "slope{angle}_mu{mu}",
    "sphere on a slope of {angle} degrees, mu_r = {mu}, mu_s = 1: at rest",
    scene=slope,
    quick=lambda angle: angle == 10,
    seconds=1,
    vary={"mu": [0.2, 0.32, 0.6, 0.95], "angle": [10, 30, 40]},
    checks=[
        Check("largest speed in the last 0.02 s (m/s)", checks.fastest_along, below=1e-12, column="v_x"),
    ],
    fails=[
        Fails("the directional form chatters and creeps", set={"form": "directional"}),
    ])


def heap(E, mu, form, d, step):
    return f'''{box("-0.5 0.5 -0.5 0.5 -0.01 0.1", skin=2e-3)}
{material(E, 0.3, 0.5, mu_shape=mu)}
{spheres("rolling_friction shape form " + form)}
{weight()}
fix floor all wall/gran model hertz tangential history rolling_friction shape primitive type 1 zplane 0.0 form {form}
fix grain all particletemplate/sphere 15485863 atom_type 1 density constant 2619 radius constant {d / 2}
fix d_grain all particledistribution/discrete 32452843 1 grain 1.0
fix move all nve/sphere
timestep {2 * step}
{pour("grain", 80, "-0.014 0.014 -0.014 0.014 0.004 0.09")}
thermo 100
thermo_style custom step atoms ke
run 40000
run 4000
'''


GROUP.case(
    "heap_mu{mu}",
    "heap of 80 spheres on a plane, mu_r = {mu}, left alone for 0.8 s: at rest",
    scene=heap,
    quick=lambda mu: mu == 0.32,
    seconds=3,
    vary={"mu": [0.1, 0.32, 0.95]},
    checks=[
        Check("kinetic energy left / (N m g 1e-9 d)", checks.late_motion, below=1, count=80, columns=["ke"]),
        Check("spheres lost", checks.bodies_lost, equals=0, since=-2),
    ],
    fails=[
        Fails("the directional form chatters", set={"form": "directional"}),
    ])


def stack10_disk48(E, d, step, count):
    return f'''{box("-0.02 0.02 -0.02 0.02 -0.002 0.06")}
{material(E, 0.5, 0.5)}
{clusters()}
{weight()}
{floor()}
{template("disk", "disk 48", d, orientation="given")}
fix move all nve/cluster
timestep {min(step, 4e-5)}
{"".join(place("disk", "0 0 %r" % (1.9e-3 + 3.68e-3 * i)) for i in range(count))}
fix damp all viscous 0.05
run 20000
unfix damp
thermo 100
thermo_style custom step atoms f_move[1] f_move[2]
timestep {step}
dump 1 all custom 10000 dump id x y z
dump_modify 1 format "%d %.15g %.15g %.15g"
run 10000
'''


GROUP.case(
    "stack10_disk48",
    "ten disks of 48 spheres stacked flat: stand still for 0.4 s",
    scene=stack10_disk48,
    quick=True,
    seconds=4,
    values={"E": 5e6, "step": 4e-5, "count": 10},
    checks=[
        Check("kinetic energy left / (N m g 1e-9 d)", checks.late_motion, below=1),
        Check("largest displacement / d", checks.displacement, below=1e-6),
    ],
    fails=[
        Fails("a step beyond the limit", set={"step": 0.0004}, says="they have run into each other"),
    ])


def face(E, sharing, shape, d):
    return f'''{box("-0.02 0.02 -0.02 0.02 -0.002 0.06")}
{material(E, 0.9, 0.0)}
{clusters(sharing)}
{floor(sharing)}
{template("body", shape, d, orientation="given")}
fix move all nve/cluster
timestep 5e-6
{place("body", "0 0 0.006", velocity="0 0 -0.3")}
variable u equal vcm(all,z)
thermo 100
thermo_style custom step v_u
run 8000
'''


GROUP.case(
    "face_{shape}",
    "{shape} dropped on its face, e = 0.9: returns at 0.9",
    scene=face,
    quick=lambda shape: shape == 'cube 64',
    seconds=1,
    vary={"shape": ["cube 8", "cube 27", "cube 64", "disk 7", "disk 48"]},
    values={"sharing": "contacts shared", "E": 5e6},
    checks=[
        Check("error of the restitution", checks.drop_error, below=0.01),
    ],
    fails=[
        Fails("contacts parallel damp once per sub-sphere", set={"sharing": "contacts parallel"}),
    ])


def rim_disk48(E, d, step):
    return f'''{box("-0.06 0.06 -0.06 0.06 -0.002 0.06")}
{material(E, 0.5, 0.5)}
{clusters()}
{weight()}
{floor()}
{template("disk", "disk 48", d, orientation="given")}
fix move all nve/cluster
timestep {step}
{place("disk", "0 0 0.0050", orientation=about("x", 89.0))}
variable z equal xcm(all,z)
thermo {int(2e-3 / step)}
thermo_style custom step atoms f_move[1] f_move[2] v_z
run {int(0.6 / step)}
run {int(0.4 / step)}
'''


GROUP.case(
    "rim_disk48",
    "disk of 48 spheres dropped on its rim on a rough floor, for 0.6 s: energy never grows, it ends at rest",
    scene=rim_disk48,
    quick=True,
    seconds=2,
    values={"E": 5e6, "step": 1e-5},
    checks=[
        Check("largest gain of energy between lines / (m g d)", checks.energy_gain, below=1e-3),
        Check("kinetic energy at the end / (m g 1e-9 d)", checks.last_motion, below=1),
        Check("bodies left", checks.bodies, equals=1),
    ],
    fails=[
        Fails("a step beyond the limit", set={"step": 0.0003}),
    ])


def corner_in_edge(E, e, d, step):
    return f'''{box("-0.1 0.1 -0.1 0.1 -0.1 0.1")}
{material(E, e, 0.5)}
{clusters()}
{template("cube", "cube 8", d, orientation="given")}
fix move all nve/cluster
timestep {step}
{place("cube", "0 0 0", orientation=about("y", 45.0))}
{place("cube", "0.0005 0.0003 0.0075", velocity="0 0 -0.5", orientation="0.88 0.28 0.36 %r" % sqrt(1 - 0.88 ** 2 - 0.28 ** 2 - 0.36 ** 2))}
thermo {max(1, int(1e-4 / step))}
thermo_style custom step f_move[1] f_move[2] f_move[3] f_move[5]
run {int(0.03 / step)}
'''


GROUP.case(
    "corner_in_edge",
    "cube of 8 spheres, corner first, at 0.5 m/s into the edge of another, e = 0.9",
    scene=corner_in_edge,
    quick=True,
    seconds=1,
    values={"E": 5e6, "step": 5e-6, "e": 0.9},
    checks=[
        Check("energy after / before", checks.energy_kept, below=1),
        Check("relative change of momentum", checks.momentum_change, below=1e-9),
    ],
    fails=[
        Fails("a step beyond the limit gains energy", set={"step": 0.0008, "e": 1.0}),
    ])


def overlapping(E, d, step, overlap):
    return f'''{box("-0.2 0.2 -0.1 0.1 -0.1 0.1")}
{material(E, 1.0, 0.0)}
{clusters()}
{template("ball", "sphere 1", d)}
fix move all nve/cluster
timestep {step * 1e-6}
{place("ball", "%r 0 0" % (-d * (1 - overlap) / 2))}
{place("ball", "%r 0 0" % (d * (1 - overlap) / 2))}
timestep {step}
thermo 100
thermo_style custom step f_move[1]
run {max(10, int(4e-3 / step))}
'''


GROUP.case(
    "overlap{overlap}",
    "two elastic spheres put into each other by {overlap} of their diameter, frictionless: Hertz's energy comes out",
    scene=overlapping,
    quick=lambda overlap: overlap == 0.2,
    seconds=1,
    vary={"overlap": [0.01, 0.05, 0.2, 0.4]},
    values={"E": 5e6, "step": 2e-6},
    checks=[
        Check("energy that came out / Hertz's energy, - 1", checks.hertz_error, below=1e-3),
    ],
    fails=[
        Fails("a step beyond the limit", set={"step": 0.0002}),
    ])


def size_ratio(E, d, shape, step):
    return f'''{box("-0.2 0.2 -0.1 0.1 -0.1 0.1", skin=5e-4)}
{material(E, 0.9, 0.0)}
{clusters()}
{template("big", "sphere 1", d)}
{template("small", shape, d / 20, orientation="given")}
fix move all nve/cluster
timestep {step}
{place("big", "0 0 0")}
{place("small", "%r 0 0" % (0.56 * d), velocity="-0.2 0 0")}
dump 1 all custom 100 dump id vx
dump_modify 1 format "%d %.15g"
run {int(0.02 / step)}
'''


GROUP.case(
    "size_ratio_{shape}",
    "two bodies ({shape}) of 1:20 in size, impact at 0.2 m/s, e = 0.9, frictionless and central: returns at 0.9",
    scene=size_ratio,
    quick=lambda shape: shape == 'sphere 1',
    seconds=1,
    vary={"shape": ["sphere 1", "cube 8"]},
    values={"E": 5e6, "step": 2e-6},
    checks=[
        Check("error of the restitution", checks.impact_error, below=0.01),
    ],
    fails=[
        Fails("a step that suits the big body alone", set={"step": 4e-5}),
    ])


GROUP.case(
    "random_impacts",
    "{impacts} random impacts of two clusters (C8, C27, D7, C64, D48), e = 0.9, friction 0.5, shared and parallel contacts: none gains energy",
    seconds=60,
    values={"impacts": 10000, "step": 5e-6},
    commands=["env ECCENTRA_IMPACTS={impacts} ECCENTRA_IMPACT_STEP={step} {tests}/cluster_energy --gtest_filter=Energy.RandomImpacts*"],
    checks=[
        Check("pairs", checks.impact_pairs, equals=lambda impacts: impacts),
        Check("largest relative gain of energy", checks.impact_gain, below=1e-6),
        Check("momentum kept, most pairs met: exit status", checks.status, equals=0),
    ],
    fails=[
        Fails("a step beyond the limit", set={"impacts": 500, "step": 0.0003}),
    ])


def overlap_cubes(E, sharing, d, step, overlap):
    return f'''{box("-0.2 0.2 -0.1 0.1 -0.1 0.1")}
{material(E, 1.0, 0.0)}
{clusters(sharing)}
{template("cube", "cube 8", d, orientation="given")}
fix move all nve/cluster
timestep {step * 1e-6}
{place("cube", "%r 0 0" % -cubes_apart(d, overlap))}
{place("cube", "%r 0 0" % cubes_apart(d, overlap))}
timestep {step}
thermo 100
thermo_style custom step f_move[1] f_move[2]
run {max(10, int(8e-3 / step))}
'''


GROUP.case(
    "overlap_cubes{overlap}",
    "two elastic cubes of 8 spheres put into each other face on by {overlap} of a sub-sphere's diameter, frictionless: Hertz's energy of all their contacts comes out",
    scene=overlap_cubes,
    quick=lambda overlap: overlap == 0.2,
    seconds=1,
    vary={"overlap": [0.02, 0.2, 0.5]},
    values={"E": 5e6, "step": 1e-6, "sharing": "contacts parallel"},
    commands=["clusterShape cube 8 --diameter {d} -o cube.clump", "eccentra-dem -in in.case -log none"],
    checks=[
        Check("energy that came out / Hertz's energy, - 1", checks.hertz_error_of_cubes, below=1e-3),
    ],
    fails=[
        Fails("a step beyond the limit", set={"step": 0.0002}),
    ])
