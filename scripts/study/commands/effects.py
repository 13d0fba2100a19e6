# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What each effect of the fluid does in a scene, and what it costs: force, time, change of the result when it is dropped."""
import math
import re

from .. import charts, effect_annulus, effect_scenes, off, options, programs, runs, screen, tables
from ..programs import CASES, digest_of, run

SCRIPT = CASES / "effects" / "in.sheared_suspension"
ORDER = ("drag", "buoyancy", "pressure_gradient", "viscous_stress", "shear_lift", "rotational_lift", "drag_torque")
COLUMNS = ["effect", "mean_of_weight", "p95_of_weight", "p95_of_drag", "ns_per_particle", "change_of_velocity_when_dropped", "share_of_time"]


def suspension_job(chosen, name, effects, steps):
    given = {"rheology": chosen.rheology, "gradient": chosen.gradient, "steps": steps, "effects": effects}

    def work(folder):
        cpu, *_ = run([chosen.build / "bin" / "eccentra-dem", "-in", SCRIPT, "-log", "none", *programs.variables(**given)], folder, folder / "out.txt")
        text = (folder / "out.txt").read_text(errors="replace")
        return {"velocity": screen.mean_velocity(text), "verdicts": screen.verdicts(text) if "screen: " in text else {}, "cpu": cpu}

    return runs.Job(name.replace("_", " "), {"what": "sheared suspension", "scene": digest_of(SCRIPT), **given}, work, 3.0 * steps / 10000)


def suspension(chosen):
    """Everything on, looked at by a screen that drops nothing that acts; without each effect; drag and buoyancy alone."""
    steps = 1000 if chosen.quick else chosen.steps
    words = {"all": f"{screen.all_but()} screen 1e-15 screen_steps {steps - 1} screen_recheck 0"}
    words |= {f"without_{one}": screen.all_but(one) + " buoyancy off" * (one == "buoyancy") for one in ORDER}
    words["drag_and_buoyancy"] = screen.EVERYTHING["drag"]
    jobs = {name: suspension_job(chosen, name, effects, steps) for name, effects in words.items()}
    found = chosen.store.run_all("sheared suspension", jobs.values())
    if chosen.plan:
        return 0
    found = runs.needed(found, jobs)
    x, z = found["all"]["velocity"]
    total = sum(found["all"]["verdicts"][one][4] for one in ORDER)
    rows = []
    for one in ORDER:
        mean, most, of_drag, _, ns, _ = found["all"]["verdicts"][one]
        other = found[f"without_{one}"]["velocity"]
        rows.append([one, mean, most, of_drag, ns, math.dist(other, (x, z)) / math.hypot(x, z), ns / total if total else 0.0])
    tables.write_csv(chosen.out / "effects.csv", COLUMNS, [[one, *(f"{v:.3g}" if k == 3 else f"{v:.3e}" for k, v in enumerate(v))] for one, *v in rows])
    text = tables.text(["effect", "of weight, mean", "95 %", "of drag, 95 %", "ns per particle", "of time", "velocity changes by"],
                       [[r[0], *(f"{v:.2e}" for v in r[1:4]), f"{r[4]:.1f}", f"{100 * r[6]:.1f}%", f"{100 * r[5]:.2f}%"] for r in rows])
    for what, name in (("with all effects", "all"), ("with drag and buoyancy alone", "drag_and_buoyancy")):
        across, along = found[name]["velocity"]
        text += f"mean velocity {what}: across {across:.5f} m/s, along {along:.5f} m/s\n"
    (chosen.out / "effects.txt").write_text(text)
    groups = {"force (95 %) over submerged weight": 2, "change of velocity when dropped": 5, "share of time": 6}
    charts.write(chosen.out / "effects.svg", "What each effect does in a sheared suspension, and what it costs",
                 [charts.Bars("", "ratio", [r[0].replace("_", " ") for r in rows],
                              {what: [(r[column], math.nan) for r in rows] for what, column in groups.items()}, True)], 1, (7.0, 4.2))
    print(f"{text}written to {chosen.out}: effects.txt, effects.csv, effects.svg")
    return 0


def main():
    parser = options.Parser("effects", "Runs cases/effects/in.sheared_suspension with every effect of fix fluid/force on, then with each of them off, "
                            "then with drag and buoyancy alone: a table and a chart.", "1000 steps; with --annulus one point of 0.1 s")
    part = parser.add_mutually_exclusive_group()
    part.add_argument("--scenes", action="store_true", help="24 scenes, two per effect where it decides and two where it does not: verdict of a screen "
                      "at 1 %%, change of the result against everything on, time saved (about 1 minute)")
    part.add_argument("--annulus", action="store_true", help="the nine points of the annulus section of Table 2 with a screen: which effects matter "
                      "where (about 2 minutes)")
    part.add_argument("--off", action="store_true", help="what is off costs nothing: instructions of pairs of runs (valgrind), counters of coupled runs "
                      "(3 minutes)")
    parser.add_argument("--rheology", default="power_law 0.28 0.65", metavar="WORDS", help="default: power_law 0.28 0.65")
    parser.add_argument("--gradient", default="5", metavar="G", help="shear rate of the flow in 1/s (default 5)")
    parser.add_argument("--steps", type=int, default=10000, metavar="N", help="steps of 5e-5 s (default 10000)")

    def check(chosen):
        if chosen.steps < 1000:
            parser.error(f"--steps is {chosen.steps}: a whole number of at least 1000 is needed")
        if not re.fullmatch(r"-?[0-9]*\.?[0-9]+", chosen.gradient):
            parser.error(f"--gradient is '{chosen.gradient}': a number in 1/s is needed")

    needs = lambda c: ("eccentra-dem",) + (("annulusFoam", "annulusMesh") if c.annulus or c.off else ()) + (("tests/closures_benchmark",) if c.off else ())
    chosen = parser.settle(needs, check)
    chosen.store.at_once = chosen.store.at_once if chosen.annulus or chosen.off else 1  # else it is time that is measured
    return (effect_scenes.study if chosen.scenes else effect_annulus.study if chosen.annulus else off.study if chosen.off else suspension)(chosen)
