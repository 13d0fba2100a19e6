# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The same scene on 1, 2 and 4 ranks; ranks without particles; bodies on the corner of four ranks."""
from harness import checks
from harness.case import Check, Fails, Group
from harness.scenes import about, box, clusters, floor, material, place, template, weight

GROUP = Group("parallel", "10. Parallel", """
The number of ranks changes the order of sums, nothing else: from the same start, positions agree to round-off times the growth of the motion
over the run. A change of the start by 1e-7 m must be seen by the same comparison.""",
              {"d": 6.35e-3, "count": 24, "shift": 0.0})


def on_ranks(grid, shape, d, count, shift, place_, ranks):
    bodies = "".join(place("body",
    "%r %r %r" % ((0 if place_ == "corner" else 0.05) + 9e-3 * (i % 2 - 0.5) + 1e-4 * (i // 4) + (shift if ranks > 1 and i == 0 else 0),
    (0 if place_ == "corner" else 0.05) + 9e-3 * (i // 2 % 2 - 0.5), 0.006 + 9e-3 * (i // 4)), orientation=about("xyz"[i % 3],
    17.0 * i)) for i in range(count))
    return f'''{box("-0.1 0.1 -0.1 0.1 -0.002 0.06", processors=grid)}
{material(5e6, 0.5, 0.5)}
{clusters()}
{weight()}
{floor()}
{template("body", shape, d, orientation="given")}
fix move all nve/cluster
fix mud all fluid/force rheology herschel_bulkley 0.5 0.28 0.65 density 1000 drag chien
fix flow all fluid/uniform velocity 0.05 0 0
timestep 2e-5
{bodies}
thermo 1000
thermo_style custom step atoms f_move[1]
run 3000
dump 1 all custom 1 dump id x y z vx vy vz
dump_modify 1 format "%d %.17g %.17g %.17g %.17g %.17g %.17g"
run 1
'''


GROUP.case(
    "{place_}_{shape}",
    "{shape}: {place_}, on 1, 2 and 4 ranks",
    scene=on_ranks,
    quick=lambda shape: shape == 'cube 8',
    seconds=8,
    vary={"shape": ["sphere 1", "cube 8", "cube 64"], "place_": ["corner", "one_rank"]},
    runs=[{"ranks": 1, "grid": "1 1 1"}, {"ranks": 2, "grid": "2 1 1"}, {"ranks": 4, "grid": "2 2 1"}],
    checks=[
        Check("largest difference of position, 2 ranks against 1 (m)", checks.difference_from_one_rank, below=1e-9, which=1),
        Check("largest difference of position, 4 ranks against 1 (m)", checks.difference_from_one_rank, below=1e-9, which=2),
        Check("bodies on 1, 2, 4 ranks, all there", checks.fewest_bodies, equals=lambda count: count),
        Check("they moved (m/s)", checks.fastest_sideways, above=0.0001),
    ],
    fails=[
        Fails("a start that is 1e-7 m off on more than one rank", set={"shift": 1e-7}),
    ])


def nobody(grid, d, poison):
    return f'''{box("-0.1 0.1 -0.1 0.1 -0.002 0.06", processors=grid)}
{material(5e6, 0.5, 0.5)}
{clusters()}
{weight()}
{floor()}
{template("body", "cube 8", d)}
fix move all nve/cluster
fix limit all timestep/limit safety 0.5 every 100 enforce yes
fix mud all fluid/force rheology herschel_bulkley 0.5 0.28 0.65 density 1000 drag chien
fix flow all fluid/uniform velocity 0.05 0 0
timestep 2e-5
thermo 100
thermo_style custom step atoms f_move[1] f_floor
{poison}
run 1000
'''


GROUP.case(
    "nobody",
    "not a single body, on 1 and 4 ranks: runs to its end",
    scene=nobody,
    quick=True,
    seconds=2,
    values={"poison": ""},
    runs=[{"ranks": 1, "grid": "1 1 1"}, {"ranks": 4, "grid": "2 2 1"}],
    checks=[
        Check("last step", checks.last_step, equals=1000),
        Check("energy", checks.largest_energy, equals=0),
        Check("exit statuses", checks.statuses, equals=0),
    ],
    fails=[
        Fails("one body that falls is not nobody",
              set={"poison": "create_atoms 1 single 0 0 0.03 units box\nset group all diameter 5e-3 density 2619"}),
    ])
