# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is off costs nothing: pairs of runs in turn, least CPU seconds of each, and the counters that runs print."""
import re
import shutil
import sys

from . import runs

REPEATS = 9  # in turn; the least counts, which other load disturbs least
STEPS = 3000
ALLOWED = 1.03  # noise of the least of nine
BED = """atom_style granular
boundary p p f
newton off
communicate single vel yes
units si
region box block 0 0.0496 0 0.0496 -0.005 0.06 units box
create_box 1 box
neighbor 0.002 bin
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype 5e6
fix m2 all property/global poissonsRatio peratomtype 0.25
fix m3 all property/global coefficientRestitution peratomtypepair 1 0.5
fix m4 all property/global coefficientFriction peratomtypepair 1 0.5
{pair}
pair_coeff * *
fix weight all gravity 9.81 vector 0 0 -1
{floor}
lattice sc 0.0062
create_atoms 1 box
set group all diameter 5.9e-3 density 2619
{more}
fix move all nve/sphere
timestep 2e-5
run {steps}
"""
PAIR = "pair_style gran model hertz tangential history"
STOCK_FLOOR = "fix floor all wall/gran model hertz tangential history primitive type 1 zplane -0.0031"
FLOOR = "fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane -0.0031"
SHAPE = "fix m5 all property/global coefficientRollingFriction peratomtypepair 1 0.1\n"
MUD = "fix mud all fluid/force rheology newtonian 0.01 density 1000 "
FLOW = "\nfix flow all fluid/uniform velocity 0 0 0"
# what, program and words of the run in which it is off, those of the run that it is compared with
PAIRS = [
    ("the library is loaded, nothing of it is used", ("eccentra-dem", {}), ("liggghts", {})),
    ("our wall for plain spheres, neither clusters nor rotation", ("eccentra-dem", {"floor": FLOOR}), ("liggghts", {})),
    ("effects named none against not named", ("eccentra-dem", {"more": MUD + "drag chien shear_lift none rotational_lift none drag_torque none "
                                              "pressure_gradient off viscous_stress off" + FLOW}),
     ("eccentra-dem", {"more": MUD + "drag chien" + FLOW})),
    ("torsion off against rolling friction alone", ("eccentra-dem", {"pair": SHAPE.replace("coefficientRolling", "shapeRolling") + SHAPE.replace("m5", "m6") +
                                                                     PAIR + " rolling_friction shape torsionTorque off"}),
     ("eccentra-dem", {"pair": SHAPE.replace("coefficientRolling", "shapeRolling") + SHAPE.replace("m5", "m6") +
                       PAIR + " rolling_friction shape"})),
]


def script(words, steps):
    return BED.format(**{"pair": PAIR, "floor": STOCK_FLOOR, "more": "", "steps": steps, **words})


def program(build, name):
    return build / "bin" / name if name.startswith("eccentra") else name


def least_seconds(build, out, sides):
    """Least CPU seconds of the steps of both sides, without what a start costs."""
    least = {}
    for _ in range(REPEATS):
        for side, (name, words) in enumerate(sides):
            for steps in (0, STEPS):
                (out / "in.off").write_text(script(words, steps))
                _, seconds = runs.run([program(build, name), "-in", out / "in.off", "-log", "none"], out / "off.log")
                least[side, steps] = min(least.get((side, steps), 1e99), seconds)
    return [least[side, STEPS] - least[side, 0] for side in range(len(sides))]


def counters(root, build, out, effects):
    """What the DEM side and the fluid side print about a short coupled run with these effects."""
    folder = out / "off-coupled"
    shutil.rmtree(folder, ignore_errors=True)
    text, _ = runs.run([root / "cases" / "tomren-section" / "run", "--output", folder, "--bin", build / "bin", "--length", "0.1", "--count", "100",
                        "--cells", "8 32 7", "--seconds", "0.05", "--run-in", "2", "--effects", f'"{effects}"'], out / "off-coupled.log")
    dem = re.search(r"effects on:.*", (folder / "log.liggghts").read_text()).group(0)
    return dem, re.search(r"computed in .*", text).group(0)


def run(root, build, out):
    lines, wrong = [], 0
    for number, (what, off, reference) in enumerate(PAIRS):
        print(f"[{number + 1}/{len(PAIRS) + 2}] {what}", file=sys.stderr)
        one, two = least_seconds(build, out, (off, reference))
        wrong += one > ALLOWED * two
        lines.append(f"{what}: {one:.3f} s of CPU against {two:.3f} s, ratio {one / two:.3f} (at most {ALLOWED}){'' if one <= ALLOWED * two else ' WRONG'}")
    everything = " ".join(runs.EVERYTHING.values())
    for number, effects in enumerate(("drag chien", everything)):
        print(f"[{len(PAIRS) + number + 1}/{len(PAIRS) + 2}] coupled, {effects}", file=sys.stderr)
        dem, fluid = counters(root, build, out, effects)
        lines += [f"coupled with '{effects}':", f"  {dem}", f"  {fluid}"]
        if number == 0 and ("pressureGradient 0 times, stressDivergence 0" not in fluid or "evaluates 2 closures" not in dem):
            wrong += 1
            lines.append("  WRONG: drag and buoyancy alone need neither the pressure gradient nor the stress")
    (out / "off.txt").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))
    return wrong
