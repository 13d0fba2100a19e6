# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes in which an effect decides and scenes in which it does not: what the screen keeps, the result, the time saved."""
from . import programs, runs, screen, tables
from .programs import CASES, digest_of, run

SCRIPT = CASES / "effects" / "in.scene"
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


def scene_job(build, name, given, turn):
    """A run of a scene; given: its variables."""
    def work(folder):
        cpu, *_ = run([build / "bin" / "eccentra-dem", "-in", SCRIPT, "-log", "none", *programs.variables(**given)], folder, folder / "out.txt")
        text = (folder / "out.txt").read_text(errors="replace")
        found = screen.verdicts(text) if "screen: " in text else {}
        return {"cpu": cpu, "ns": screen.nanoseconds(text), "closures": screen.closures(text), "velocity": screen.mean_velocity(text),
                "verdicts": {effect: (share, stays) for effect, (*_, share, _, stays) in found.items()}}

    return runs.Job(name, {"what": "effect scene", "scene": digest_of(SCRIPT), "turn": turn, **given}, work, 1.0)


def study(chosen):
    """Runs all scenes, with everything on and with a screen in turn; 1 where one is not as it must be."""
    jobs = {}
    for number, (_, _, name, fluid, flow, none) in enumerate(SCENES):
        given = " ".join(f"{one} none" for one in none)
        words = {"all": screen.all_but(*none), "screened": f"{given} screen {TOLERANCE} screen_steps 1000 screen_recheck 0"}
        for turn in range(REPEATS):
            for kind, effects in words.items():
                jobs[number, kind, turn] = scene_job(chosen.build, f"{name}, {kind}, turn {turn + 1}",
                                                     {"fluid": fluid, "flow": flow, "effects": effects}, turn)
    found = {}
    for number, (effect, _, name, *_) in enumerate(SCENES):  # one at a time and in turn: it is time that is measured
        found |= chosen.store.run_all(f"[{number + 1}/{len(SCENES)}] {effect}: {name}", [job for key, job in jobs.items() if key[0] == number])
    if chosen.plan:
        return 0
    found = runs.needed(found, jobs)
    rows, wrong = [], 0
    for number, (effect, decides, name, *_) in enumerate(SCENES):
        every = {kind: [found[number, kind, turn] for turn in range(REPEATS)] for kind in ("all", "screened")}
        cost, cpu = ({kind: min(r[what] for r in of) for kind, of in every.items()} for what in ("ns", "cpu"))
        share, stays = every["screened"][0]["verdicts"][effect]
        one, two = (every[kind][0]["velocity"] for kind in ("all", "screened"))
        change = max(abs(a - b) for a, b in zip(one, two)) / max(sum(a * a for a in one) ** 0.5, 1e-300)
        good = stays == decides and change <= 2 * TOLERANCE
        wrong += not good
        rows.append([effect, name, share, "stays" if stays else "dropped", change, every["all"][0]["closures"], every["screened"][0]["closures"],
                     cost["all"], cost["screened"], 1 - cost["screened"] / cost["all"], 1 - cpu["screened"] / cpu["all"],
                     "as it must be" if good else "WRONG"])
    header = ["effect", "scene", "share", "verdict", "result_changes_by", "closures_all", "closures_screened", "ns_all", "ns_screened",
              "force_time_saved", "run_time_saved", "judged"]
    tables.write_csv(chosen.out / "scenes.csv", header, rows)
    shown = [[*r[:2], f"{r[2]:.1e}", r[3], f"{r[4]:.1e}", f"{r[5]} to {r[6]}", f"{r[7]:.0f}", f"{r[8]:.0f}", f"{r[9]:.0%}", r[11]] for r in rows]
    text = (f"Screen at {TOLERANCE:g} against everything on; a result may change by {2 * TOLERANCE:g} of the mean velocity.\n\n"
            + tables.text(["effect", "scene", "share", "verdict", "changes", "closures", "ns all", "screened", "saved", "judged"], shown))
    (chosen.out / "scenes.txt").write_text(text)
    print(text)
    if wrong:
        raise programs.Failure(f"{wrong} of them are not as they must be")
    return 0
