# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is off costs nothing: instructions of pairs of runs, as Cachegrind counts them, and the counters that runs print."""
import re
import shutil

from . import closure_times, programs, runs, screen, section
from .programs import INSTALLED, ROOT, SCENES, Failure, digest_of, run

# Steps; the difference is what counts. CPU seconds of such runs scatter by 10 % on a virtual machine, instructions by nothing.
SHORT, LONG = 600, 1100
ALLOWED = 1.01
AWAKE = 1.1  # what looking at bodies that stay awake may cost: this one is on
DRAG_ALLOWED = 2.0  # percent
SCRIPT = SCENES / "off.in"
PAIR = "gran model hertz tangential history"
ALL_NONE = "drag chien shear_lift none rotational_lift none drag_torque none pressure_gradient off viscous_stress off"
OF_CLUSTERS = {"pair": "gran/cluster model hertz tangential history rolling_friction off", "wall": "wall/gran/cluster", "move": "nve/cluster"}
WITHOUT_HISTORY = {"pair": "gran model hertz tangential no_history"}
OURS, STOCK = "eccentra-dem", "liggghts"
# what, at most how many times as long, program and variables of the run in which it is off, those of the run that it is compared with
PAIRS = [
    ("stock against itself: the noise", ALLOWED, (STOCK, {}), (STOCK, {})),
    ("plain spheres: the library loaded, nothing of it used, against stock", ALLOWED, (OURS, {}), (STOCK, {})),
    ("no history: the same against stock", ALLOWED, (OURS, WITHOUT_HISTORY), (STOCK, WITHOUT_HISTORY)),
    ("no rolling model: the word `off` against stock without the word", ALLOWED, (OURS, {"pair": PAIR + " rolling_friction off"}), (STOCK, {})),
    ("our wall for plain spheres, neither clusters nor rotation nor rolling, against stock's", ALLOWED, (OURS, {"wall": "wall/gran/cluster"}),
     (STOCK, {})),
    ("torsion off against rolling friction alone", ALLOWED, (OURS, {"rolling": 1, "pair": PAIR + " rolling_friction shape torsionTorque off"}),
     (OURS, {"rolling": 1, "pair": PAIR + " rolling_friction shape"})),
    ("effects of the fluid named none against not named", ALLOWED, (OURS, {"fluid": 1, "effects": ALL_NONE}), (OURS, {"fluid": 1})),
    # 500 steps measure everything and are subtracted.
    ("effects that a screen has dropped against not named", ALLOWED,
     (OURS, {"fluid": 1, "effects": "screen 0.01 screen_steps 500 screen_recheck 0"}), (OURS, {"fluid": 1})),
    ("sleep/cluster where nothing can sleep against without it", AWAKE, (OURS, {**OF_CLUSTERS, "sleep": 1}), (OURS, OF_CLUSTERS)),
]


def portable_build(chosen):
    """The build whose instructions are counted: valgrind does not know all those that the fast build may use."""
    build = ROOT / "build-portable"
    if not chosen.plan and not chosen.show:
        if INSTALLED:
            raise Failure("what is switched off is counted with a build of its own, for which this installation lacks the sources: run scripts/effects of "
                          "the source tree")
        if not shutil.which("valgrind"):
            raise Failure("there is no valgrind, which counts the instructions: install Debian's package valgrind")
        run(["cmake", "--preset", "portable", "-DECCENTRA_OPENFOAM=OFF"], ROOT, chosen.out / "portable.log")
        run(["cmake", "--build", "build-portable", "--target", "eccentra", "eccentra-dem"], ROOT, chosen.out / "portable.log")
    return build


def instructions_job(build, code, what, side, steps):
    """Instructions of a run of so many steps, its start included."""
    name, words = side
    program = build / "bin" / name if name == OURS else shutil.which(name)

    def work(folder):
        cpu, *_ = run(["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null", program, "-in", SCRIPT, "-log", "none",
                      *programs.variables(steps=steps, **words)], folder, folder / "out.txt")
        text = (folder / "out.txt").read_text(errors="replace")
        return {"instructions": int(re.search(r"I +refs: +([0-9,]+)", text).group(1).replace(",", "")), "cpu": cpu}

    return runs.Job(f"{what}: {name}, {steps} steps",
                    {"what": "off", "scene": digest_of(SCRIPT), "program": name, "code": code, "steps": steps, **words}, work, 20)


def counters_job(build, effects):
    """What the DEM side and the fluid side print about a short coupled run with these effects."""
    words = {"length": 0.1, "count": 100, "cells": "8 32 7", "seconds": 0.05, "run-in": 2, "effects": f'"{effects}"'}

    def work(folder):
        case, cpu, _ = section.run_case(build, folder, words)
        return {"dem": re.search(r"effects on:.*", (case / "log.liggghts").read_text()).group(0), "cpu": cpu,
                "fluid": re.search(r"computed in .*", (folder / "out.txt").read_text()).group(0)}

    return runs.Job(f"coupled with '{effects}'", {"what": "counters of effects", "case": section.case_digest(), **words}, work, 5)


def study(chosen):
    build = portable_build(chosen)
    code = programs.code_of(build)
    jobs = {(what, side, steps): instructions_job(build, code, what, pair[side], steps)
            for what, _, *pair in PAIRS for side in (0, 1) for steps in (SHORT, LONG)}
    everything = screen.all_but()
    coupled = {effects: counters_job(chosen.build, effects) for effects in ("drag chien", everything)}
    timed = closure_times.job(chosen.build, 20)
    found = chosen.store.run_all("off", [*jobs.values(), *coupled.values()]) | chosen.store.run_all("closures", [timed])
    if chosen.plan:
        return 0
    counted, said = runs.needed(found, jobs), runs.needed(found, coupled)
    least = runs.needed(found, {"": timed})[""]["least"]
    lines, wrong = [], 0
    for what, allowed, *_ in PAIRS:
        one, two = (counted[what, side, LONG]["instructions"] - counted[what, side, SHORT]["instructions"] for side in (0, 1))
        wrong += one > allowed * two
        verdict = "" if one <= allowed * two else " WRONG"
        lines.append(f"{what}: {one / 1e6:.1f} million instructions against {two / 1e6:.1f}, ratio {one / two:.4f} (at most {allowed:.2f}){verdict}")
    lines += ["nanoseconds per particle and step:"] + ["  " + line for line in closure_times.lines(least)]
    if closure_times.of_hand_written(least) > DRAG_ALLOWED:
        wrong += 1
        lines.append(f"  WRONG: drag alone may cost {DRAG_ALLOWED} % more than the hand-written loop")
    for effects, counters in said.items():
        dem, fluid = counters["dem"], counters["fluid"]
        lines += [f"coupled with '{effects}':", f"  {dem}", f"  {fluid}"]
        if effects != everything and ("pressure_gradient 0 times, stress_divergence 0" not in fluid or "evaluates 2 closures" not in dem):
            wrong += 1
            lines.append("  WRONG: drag and buoyancy alone need neither the pressure gradient nor the stress")
    (chosen.out / "off.txt").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))
    if wrong:
        raise Failure(f"{wrong} of them are not as they must be")
    return 0
