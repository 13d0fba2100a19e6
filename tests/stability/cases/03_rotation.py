# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Free bodies that spin about their intermediate axis."""
from harness import checks
from harness.case import Check, Fails, Group
from harness.scenes import box, clusters, material, place, template

GROUP = Group("rotation", "3. Rotation", """
A free rigid body keeps its angular momentum and its energy of rotation; about the intermediate axis it tumbles without end (Dzhanibekov).
The step is 0.1/w. The rotation is a symplectic splitting of exact rotations (Dullweber, Leimkuhler & McLachlan 1997): the angular momentum is
kept to the round-off of N steps, 1e-16 N; the energy stays within the second order of the step, (w dt)^2/12, and does not drift.""",
              {
                  "steps": 100000,
                  "spin": 500.0,  # rad/s
                  "stock": False,
                  "needle": ["-2e-3 0 0 5e-4", "-1.5e-3 0 0 5e-4", "-1e-3 0 0 5e-4", "-5e-4 0 0 5e-4", "0 0 0 5e-4", "5e-4 0 0 5e-4",
                  "1e-3 0 0 5e-4", "1.5e-3 0 0 5e-4", "2e-3 0 0 5e-4", "0 4e-4 0 4e-4"],
                  "flake": ["-2e-3 -1e-3 0 1e-3", "-1e-3 -1e-3 0 1e-3", "0 -1e-3 0 1e-3", "1e-3 -1e-3 0 1e-3", "2e-3 -1e-3 0 1e-3", "-2e-3 0 0 1e-3",
                  "-1e-3 0 0 1e-3", "0 0 0 1e-3", "1e-3 0 0 1e-3", "2e-3 0 0 1e-3", "-2e-3 1e-3 0 1e-3", "-1e-3 1e-3 0 1e-3", "0 1e-3 0 1e-3",
                  "1e-3 1e-3 0 1e-3", "2e-3 1e-3 0 1e-3"],
              })


def spinning(spin, stock, steps):
    pair = "pair_style gran model hertz tangential history\npair_coeff * *" if stock else clusters()
    template_words = "fix body all particletemplate/multisphere/shape 15485863 atom_type 1 volume_limit 1e-25 density constant 2619 shape file body.clump\nfix d_body all particledistribution/discrete 32452843 1 body 1.0" if stock else template("body", "file body.clump", 6.35e-3, orientation="given")
    energy = "compute rotation all erotate/multisphere\nvariable rotation equal c_rotation" if stock else "variable rotation equal f_move[2]"
    return f'''{box("-0.01 0.01 -0.01 0.01 -0.01 0.01", "p p p")}
{material()}
timestep {0.1 / spin}
{pair}
{template_words}
{"fix move all multisphere" if stock else "fix move all nve/cluster"}
{place("body", "0 0 0", omega="0.5 " + repr(spin) + " 0.5")}
{energy}
thermo {steps // 100}
thermo_style custom step v_rotation {"" if stock else "f_move[6] f_move[7] f_move[8]"}
run {steps}
'''


GROUP.case(
    "{body}",
    "{body} spinning at {spin} rad/s about its intermediate axis, {steps} steps of 0.1/w",
    scene=spinning,
    quick=True,
    seconds=2,
    vary={"body": ["needle", "flake"]},
    full={"steps": 1000000},
    files=["rotation"],
    settings=lambda needle, flake, body: {"spheres": '\n'.join(needle if body == 'needle' else flake)},
    checks=[
        Check("largest relative change of the energy of rotation", checks.rotation_change, below=0.1 ** 2 / 12),
        Check("drift of the energy, last quarter against first, relative", checks.rotation_drift, below=1e-6),
        Check("relative change of the angular momentum", checks.angular_momentum_change, below=lambda steps: 1e-16 * steps),
    ],
    fails=[
        Fails("stock fix multisphere drifts", set={"stock": True, "steps": 4000}),
    ])
