# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Long runs of a small bed at rest."""
from harness import checks
from harness.case import Check, Fails, Group
from harness.references import sphere_mass
from harness.scenes import box, clusters, floor, material, pour, spheres, template, weight

GROUP = Group("long", "11. Long run", """
A bed at rest is at rest for ever: energy, height and momentum do not drift, and memory does not grow. (--full: 1e7 steps.)""",
              {"d": 6.35e-3, "steps": 200000, "form": "limited"})


def clusters_at_rest(shape, d, count, steps, factor):
    return f'''{box("0 0.0175 0 0.0175 -0.002 0.2", "p p f")}
{material(5e6, 0.5, 0.5)}
{clusters()}
{weight()}
{floor()}
{template("body", shape, d)}
fix move all nve/cluster
timestep 4e-5
{pour("body", count, "0 0.0175 0 0.0175 0.005 0.1")}
run 6000
fix damp all viscous {0.05 * sphere_mass(d, 2619) / 2.5e-4}
run 6000
unfix damp
variable z equal xcm(all,z)
thermo {steps // 200}
thermo_style custom step atoms f_move[1] f_move[2] f_move[3] f_move[4] f_move[5] v_z
timestep {4e-5 * factor}
run {int(steps / factor)}
'''


GROUP.case(
    "clusters_{shape}",
    "20 bodies ({shape}) at rest for {steps} steps",
    scene=clusters_at_rest,
    quick=lambda shape: shape == 'cube 8',
    seconds=6,
    vary={"shape": ["cube 8", "disk 48"]},
    values={"count": 20, "factor": 1.0},
    full={"steps": 10000000},
    checks=[
        Check("energy, mean of the last quarter / (N m g 1e-9 d)", checks.late_motion, below=1),
        Check("drift of the height / d", checks.height_drift, below=1e-6),
        Check("momentum / (N m sqrt(g 1e-9 d))", checks.momentum_left, below=1),
        Check("bodies lost", checks.bodies_lost, equals=0),
        Check("growth of memory in the second half of the run (MB)", checks.memory_growth, below=1),
    ],
    fails=[
        Fails("a step beyond the limit", set={"factor": 6.0, "steps": 200000}, says="they have run into each other"),
    ])


def spheres_at_rest(form, d, count, steps):
    return f'''{box("0 0.0175 0 0.0175 -0.002 0.2", "p p f", skin=2e-3)}
{material(5e6, 0.5, 0.5, mu_shape=0.32)}
{spheres("rolling_friction shape form " + form)}
{weight()}
fix floor all wall/gran model hertz tangential history rolling_friction shape primitive type 1 zplane 0.0 form {form}
fix body all particletemplate/sphere 15485863 atom_type 1 density constant 2619 radius constant {d / 2}
fix d_body all particledistribution/discrete 32452843 1 body 1.0
fix move all nve/sphere
timestep 2e-5
{pour("body", count, "0 0.0175 0 0.0175 0.004 0.1")}
run 20000
variable z equal xcm(all,z)
variable px equal vcm(all,x)
variable py equal vcm(all,y)
variable pz equal vcm(all,z)
thermo {steps // 200}
thermo_style custom step atoms ke v_px v_py v_pz v_z
run {steps}
'''


GROUP.case(
    "spheres",
    "20 spheres with rolling friction at rest for {steps} steps",
    scene=spheres_at_rest,
    quick=True,
    seconds=6,
    values={"count": 20},
    full={"steps": 10000000},
    checks=[
        Check("kinetic energy, mean of the last quarter / (N m g 1e-9 d)", checks.late_motion, below=1, columns=["ke"]),
        Check("drift of the height / d", checks.height_drift, below=1e-6),
        Check("mean velocity / sqrt(g 1e-9 d)", checks.mean_velocity_left, below=1),
        Check("growth of memory in the second half of the run (MB)", checks.memory_growth, below=1),
    ],
    fails=[
        Fails("the directional form chatters and creeps", set={"form": "directional", "steps": 200000}),
    ])
