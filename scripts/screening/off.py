# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is off costs nothing: instructions of pairs of runs, as Cachegrind counts them, and the counters that runs print."""
import concurrent.futures
import itertools
import re
import shutil
import sys

from . import runs

# Steps; the difference is what counts. CPU seconds of such runs scatter by 10 % on a virtual machine, instructions by nothing.
SHORT, LONG = 600, 1100
ALLOWED = 1.01
AWAKE = 1.1  # what looking at bodies that stay awake may cost: this one is on
DRAG_ALLOWED = 2.0  # percent
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
fix move all {move}
timestep 2e-5
run {steps}
"""
PAIR = "pair_style gran model hertz tangential history"
STOCK_FLOOR = "fix floor all wall/gran model hertz tangential history primitive type 1 zplane -0.0031"
FLOOR = "fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane -0.0031"
SHAPE = "fix m5 all property/global shapeRollingFriction peratomtypepair 1 0.1\n"
ROLLING = SHAPE + "fix m6 all property/global coefficientRollingFriction peratomtypepair 1 0.1\n"
MUD = "fix mud all fluid/force rheology newtonian 0.01 density 1000 "
FLOW = "\nfix flow all fluid/uniform velocity 0 0 0"
ALL_NONE = "drag chien shear_lift none rotational_lift none drag_torque none pressure_gradient off viscous_stress off"
OF_CLUSTERS = {"pair": "pair_style gran/cluster model hertz tangential history rolling_friction off", "floor": FLOOR, "move": "nve/cluster"}
OURS, STOCK = "eccentra-dem", "liggghts"
# what, at most how many times as long, program and words of the run in which it is off, those of the run that it is compared with
PAIRS = [
    ("stock against itself: the noise", ALLOWED, (STOCK, {}), (STOCK, {})),
    ("plain spheres: the library loaded, nothing of it used, against stock", ALLOWED, (OURS, {}), (STOCK, {})),
    ("no history: the same against stock", ALLOWED, (OURS, {"pair": "pair_style gran model hertz tangential no_history"}),
     (STOCK, {"pair": "pair_style gran model hertz tangential no_history"})),
    ("no rolling model: the word `off` against stock without the word", ALLOWED, (OURS, {"pair": PAIR + " rolling_friction off"}), (STOCK, {})),
    ("our wall for plain spheres, neither clusters nor rotation nor rolling, against stock's", ALLOWED, (OURS, {"floor": FLOOR}), (STOCK, {})),
    ("torsion off against rolling friction alone", ALLOWED, (OURS, {"pair": ROLLING + PAIR + " rolling_friction shape torsionTorque off"}),
     (OURS, {"pair": ROLLING + PAIR + " rolling_friction shape"})),
    ("effects of the fluid named none against not named", ALLOWED, (OURS, {"more": MUD + ALL_NONE + FLOW}), (OURS, {"more": MUD + "drag chien" + FLOW})),
    # 500 steps measure everything and are subtracted.
    ("effects that a screen has dropped against not named", ALLOWED, (OURS, {"more": MUD + "screen 0.01 screen_steps 500 screen_recheck 0" + FLOW}),
     (OURS, {"more": MUD + "drag chien" + FLOW})),
    ("sleep/cluster where nothing can sleep against without it", AWAKE, (OURS, {**OF_CLUSTERS, "more": "fix bed all sleep/cluster tolerance 1e-12"}),
     (OURS, OF_CLUSTERS)),
]


def script(words, steps):
    return BED.format(**{"pair": PAIR, "floor": STOCK_FLOOR, "more": "", "move": "nve/sphere", "steps": steps, **words})


def portable_build(root, out):
    """The build whose instructions are counted: valgrind does not know all those that the fast build may use."""
    if not shutil.which("valgrind"):
        raise runs.RunFailed("there is no valgrind, which counts the instructions: install Debian's package valgrind")
    runs.run(["cmake", "--preset", "portable", "-DECCENTRA_OPENFOAM=OFF"], out / "portable.log", root)
    runs.run(["cmake", "--build", "build-portable", "--target", "eccentra", "eccentra-dem"], out / "portable.log", root)
    return root / "build-portable"


def instructions(build, folder, side, steps):
    """Instructions of a run of so many steps, its start included."""
    name, words = side
    folder.mkdir(exist_ok=True)
    (folder / "in.off").write_text(script(words, steps))
    program = build / "bin" / name if name == OURS else shutil.which(name)
    text, _ = runs.run(["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null", program, "-in", "in.off",
                        "-log", "none"], folder / "off.log", folder)
    return int(re.search(r"I +refs: +([0-9,]+)", text).group(1).replace(",", ""))


def pairs(build, out):
    """(what, at most, instructions of LONG - SHORT steps of the run in which it is off, and of the other); two runs at a time."""
    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
        counts = {}
        for (number, pair), side, steps in itertools.product(enumerate(PAIRS), (0, 1), (SHORT, LONG)):
            counts[number, side, steps] = pool.submit(instructions, build, out / f"off-{number}-{side}-{steps}", pair[2 + side], steps)
        for number, (what, allowed, _, _) in enumerate(PAIRS):
            print(f"[{number + 1}/{len(PAIRS) + 3}] {what}", file=sys.stderr)
            yield what, allowed, *(counts[number, side, LONG].result() - counts[number, side, SHORT].result() for side in (0, 1))


def closures(root, build, out):
    """Drag alone beside a hand-written loop, and the sum of single effects beside all of them: lines of scripts/closure-cost."""
    text, _ = runs.run([root / "scripts" / "closure-cost", "--build", build, "--csv", out / "closure-cost.csv"], out / "closure-cost.log")
    return re.findall(r"^(?:\w+ +\w+ +[0-9.]+ *|all seven .*|drag alone .*)$", text, re.M)


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
    for what, allowed, one, two in pairs(portable_build(root, out), out):
        wrong += one > allowed * two
        verdict = "" if one <= allowed * two else " WRONG"
        lines.append(f"{what}: {one / 1e6:.1f} million instructions against {two / 1e6:.1f}, ratio {one / two:.4f} (at most {allowed:.2f}){verdict}")
    print(f"[{len(PAIRS) + 1}/{len(PAIRS) + 3}] closures", file=sys.stderr)
    cost = closures(root, build, out)
    lines += ["nanoseconds per particle and step:"] + ["  " + line for line in cost]
    extra = float(re.search(r"hand-written loop: ([-+0-9.]+)", cost[-1]).group(1))
    if extra > DRAG_ALLOWED:
        wrong += 1
        lines.append(f"  WRONG: drag alone may cost {DRAG_ALLOWED} % more than the hand-written loop")
    everything = " ".join(runs.EVERYTHING.values())
    for number, effects in enumerate(("drag chien", everything)):
        print(f"[{len(PAIRS) + number + 2}/{len(PAIRS) + 3}] coupled, {effects}", file=sys.stderr)
        dem, fluid = counters(root, build, out, effects)
        lines += [f"coupled with '{effects}':", f"  {dem}", f"  {fluid}"]
        if number == 0 and ("pressureGradient 0 times, stressDivergence 0" not in fluid or "evaluates 2 closures" not in dem):
            wrong += 1
            lines.append("  WRONG: drag and buoyancy alone need neither the pressure gradient nor the stress")
    (out / "off.txt").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))
    return wrong
