# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A column of cubes with true faces that collapses, with our rounded cubes and with Yade's polyhedra: slope of the heap and cost."""
import json
import re

from . import dry, frames, levels, measures, programs, runs
from .programs import SCENES, digest_of, run

SCRIPT, YADE = SCENES / "peers_heap.in", SCENES / "peers_heap_yade.py"
DIAMETER = 6.35e-3
BODIES, SECONDS = (100, 30), (0.5, 0.1)  # of the collapse; with --quick
ROUNDINGS = (0.1, 0.02)
STEPS = {"ours": 2.5e-5, "yade": 5e-5}  # [s]; a face of Yade's cubes swings in 7e-4 s
STIFFNESS, SHEAR = 1e9, 0.3  # of Yade's law, force over the volume that overlaps [N/m3], and of its tangential spring over it
DAMPING = 0.3  # of Yade: it opposes each force, as its polyhedra have no restitution
HEADER = ["", "heaps", "slope [degrees]", "+-", "s of a collapse", "times ours"]


def slope(bodies):
    """Of a heap of bodies (x, y, z, vx, vy, vz), and the speed that is left in it."""
    return dry.heap_slope([dict(enumerate(bodies))], len(bodies))


def ours_job(build, rounding, seed, bodies, seconds):
    words = {"shape": f"smooth cube rounding {rounding:g}", "diameter": DIAMETER, "bodies": bodies, "seed": seed, "step": STEPS["ours"],
             "steps": round(seconds / STEPS["ours"])}

    def work(folder):
        run([build / "bin" / "eccentra-dem", "-in", SCRIPT, "-log", "none", *programs.variables(**words)], folder, folder / "out.txt")
        loops = re.findall(r"^Loop time of (\S+)", (folder / "out.txt").read_text(), re.MULTILINE)
        angle, speed = slope([row[1:] for row in frames.last_rows(folder / "heap.dump")])
        return {"slope": angle, "speed": speed, "cpu": max(map(float, loops[2:]))}  # wall clock of the collapse, the longest run after pouring

    return runs.Job(f"heap of cubes {rounding:g}, seed {seed}", {"what": "peers, heap", "scene": digest_of(SCRIPT), **words}, work, 10)


def yade_job(build, column, seed, bodies, seconds):
    """From the column of our sharpest cubes at rest. column: its job's folder."""
    given = {"density": 2619.0, "stiffness": STIFFNESS, "shear": SHEAR, "friction": 0.5, "skin": 6e-4, "damping": DAMPING, "step": STEPS["yade"],
             "steps": round(seconds / STEPS["yade"])}

    def work(folder):
        volume = levels.measured(build, f"smooth cube rounding {ROUNDINGS[-1]:g}", "--diameter", DIAMETER)["volume"]
        places = [(row[1:4], row[4:]) for row in frames.last_rows(column / "column.dump")]
        (folder / "scene.json").write_text(json.dumps(given | {"half": volume ** (1 / 3) / 2, "bodies": places}))
        (folder / "result.json.yade").unlink(missing_ok=True)
        run(["yade", "-n", "-x", "-j", "1", YADE], folder, folder / "out.txt")
        if not (folder / "result.json.yade").is_file():
            raise programs.RunFailed(f"yade ended without a result (see {folder / 'out.txt'})")
        result = json.loads((folder / "result.json.yade").read_text())
        angle, speed = slope(result["bodies"])
        return {"slope": angle, "speed": speed, "cpu": result["seconds"]}

    inputs = {"what": "peers, heap", "scene": digest_of(YADE), "column": digest_of(SCRIPT), "seed": seed, "bodies": bodies, **given}
    return runs.Job(f"heap of Yade's polyhedra, seed {seed}", inputs, work, 600)


def rows(chosen):
    """Of the table, and with --plan none."""
    bodies, seconds = BODIES[chosen.quick], SECONDS[chosen.quick]
    seeds = dry.SEEDS[: chosen.repeat]
    groups = {f"rounded cubes, rounding {rounding:g}": {seed: ours_job(chosen.build, rounding, seed, bodies, seconds) for seed in seeds}
              for rounding in ROUNDINGS}
    found = chosen.store.run_all("heap", [job for jobs in groups.values() for job in jobs.values()])
    if "yade" in chosen.codes:
        columns = groups[f"rounded cubes, rounding {ROUNDINGS[-1]:g}"]
        groups["Yade, polyhedra"] = {seed: yade_job(chosen.build, chosen.store.folder_of(columns[seed]), seed, bodies, seconds) for seed in seeds}
        found |= chosen.store.run_all("heap", groups["Yade, polyhedra"].values())
    if chosen.plan:
        return []
    table, first = [], None
    for name, jobs in groups.items():
        results = list(runs.needed({job.key(): found[job.key()] for job in jobs.values()}, jobs).values())
        angle, error = measures.mean_and_error([r["slope"] for r in results])
        cpu, _ = measures.mean_and_error([r["cpu"] for r in results])
        first = first or cpu
        table.append([name, len(results), angle, error, cpu, cpu / first])
    return table
