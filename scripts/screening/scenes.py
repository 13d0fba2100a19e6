# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes in which an effect decides and scenes in which it does not: what the screen keeps, the result, the time saved."""
import re
import sys
import time

from . import runs

TOLERANCE = 0.01
REPEATS = 3  # in turn; the least time counts
MUD, OIL = "herschel_bulkley 1 0.28 0.65 density 1000", "newtonian 0.1 density 1000"
AIR, GAS = "newtonian 2e-5 density 1.2", "newtonian 1e-5 density 0.1"
SHEAR = "velocity_gradient 0 0 0 0 0 0 20 0 0 origin 0.05 0 0"
WEAK = "velocity_gradient 0 0 0 0 0 0 0.001 0 0 origin 0.05 0 0"
STILL = "pressure_gradient 0 0 0"
# effect, whether it decides, name, fluid, flow, effects that are not up to the screen
SCENES = [
    ("pressure_gradient", True, "3000 Pa/m in mud", MUD, "pressure_gradient 0 3000 0", ()),
    ("pressure_gradient", True, "2000 Pa/m in oil", OIL, "pressure_gradient 2000 0 0", ()),
    ("pressure_gradient", False, "30 Pa/m in mud", MUD, "pressure_gradient 0 30 0", ()),
    ("pressure_gradient", False, "40 Pa/m in oil", OIL, "pressure_gradient 0 0 40", ()),
    ("viscous_stress", True, "1000 N/m3 in mud", MUD, "stress_divergence 1000 0 0", ()),
    ("viscous_stress", True, "2000 N/m3 in oil", OIL, "stress_divergence 0 0 2000", ()),
    ("viscous_stress", False, "20 N/m3 in mud", MUD, "stress_divergence 20 0 0", ()),
    ("viscous_stress", False, "20 N/m3 in oil", OIL, "stress_divergence 20 0 0", ()),
    ("shear_lift", True, "20 1/s in mud", MUD, SHEAR, ("drag_torque",)),
    ("shear_lift", True, "20 1/s in oil", OIL, SHEAR, ()),
    ("shear_lift", False, "0.001 1/s in oil", OIL, WEAK, ()),
    ("shear_lift", False, "no shear, in mud", MUD, STILL, ()),
    ("rotational_lift", True, "20 1/s in mud, spin free", MUD, SHEAR, ("drag_torque",)),
    ("rotational_lift", True, "20 1/s in oil, spin free", OIL, SHEAR, ("drag_torque",)),
    ("rotational_lift", False, "1 Pa s: the spin follows", "newtonian 1 density 1000", WEAK, ()),
    ("rotational_lift", False, "no shear, in mud", MUD, STILL, ()),
    ("drag", True, "settling in mud", MUD, STILL, ()),
    ("drag", True, "settling in oil", OIL, STILL, ()),
    ("drag", False, "falling in a thin gas", GAS, STILL, ()),
    ("drag", False, "short fall in air", AIR, STILL, ()),
    ("buoyancy", True, "settling in mud", MUD, STILL, ()),
    ("buoyancy", True, "settling in oil", OIL, STILL, ()),
    ("buoyancy", False, "falling in air", AIR, STILL, ()),
    ("buoyancy", False, "falling in a thin gas", GAS, STILL, ()),
]


def mean_velocity(text):
    return [float(word) for word in re.search(r"^MEAN VELOCITY (.*)$", text, re.M).group(1).split()]


def run(root, build, out):
    """Runs all scenes; returns the number of scenes that are not as they must be."""
    launcher, script = build / "bin" / "eccentra-dem", root / "cases" / "effects" / "in.scene"
    rows, wrong, began = [], 0, time.monotonic()
    for number, (effect, decides, name, fluid, flow, none) in enumerate(SCENES):
        print(f"[{number + 1}/{len(SCENES)}] {effect}: {name}{runs.left(number, len(SCENES), began, time.monotonic())}", file=sys.stderr)
        given = " ".join(f"{one} none" for one in none)
        words = {"all": " ".join(text for one, text in runs.EVERYTHING.items() if one not in none),
                 "screened": f"{given} screen {TOLERANCE} screen_steps 1000 screen_recheck 0"}
        cost, cpu, text = {}, {}, {}
        for _ in range(REPEATS):
            for kind, effects in words.items():
                text[kind], seconds = runs.run([launcher, "-in", script, "-log", "none", "-var", "fluid", fluid, "-var", "flow", flow,
                                                "-var", "effects", effects], out / f"scene-{number + 1}-{kind}.log")
                cost[kind] = min(cost.get(kind, 1e99), runs.nanoseconds(text[kind]))
                cpu[kind] = min(cpu.get(kind, 1e99), seconds)
        share, _, stays = runs.verdicts(text["screened"])[effect]
        one, two = (mean_velocity(text[kind]) for kind in ("all", "screened"))
        change = max(abs(a - b) for a, b in zip(one, two)) / max(sum(a * a for a in one) ** 0.5, 1e-300)
        good = stays == decides and change <= 2 * TOLERANCE
        wrong += not good
        rows.append((effect, name, share, "stays" if stays else "dropped", change, runs.closures(text["all"]), runs.closures(text["screened"]),
                     cost["all"], cost["screened"],
                     1 - cost["screened"] / cost["all"], 1 - cpu["screened"] / cpu["all"], "as it must be" if good else "WRONG"))
    header = ("effect", "scene", "share", "verdict", "result_changes_by", "closures_all", "closures_screened", "ns_all", "ns_screened", "force_time_saved", "run_time_saved", "judged")
    with open(out / "scenes.csv", "w") as stream:
        stream.write(",".join(header) + "\n")
        stream.writelines(",".join(f"{v:.4g}" if isinstance(v, float) else str(v).replace(",", ";") for v in row) + "\n" for row in rows)
    lines = [f"Screen at {TOLERANCE:g} against everything on; a result may change by {2 * TOLERANCE:g} of the mean velocity.", "",
             f"{'effect':18s} {'scene':26s} {'share':>9s} {'verdict':8s} {'changes':>9s} {'closures':>9s} {'ns all':>7s} {'screened':>9s} {'saved':>6s}"]
    lines += [f"{r[0]:18s} {r[1]:26s} {r[2]:9.1e} {r[3]:8s} {r[4]:9.1e} {f'{r[5]} to {r[6]}':>9s} {r[7]:7.0f} {r[8]:9.0f} {r[9]:6.0%} {'' if r[11] != 'WRONG' else r[11]}" for r in rows]
    (out / "scenes.txt").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))
    return wrong
