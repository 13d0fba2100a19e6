# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Heap and drum of cases/rolling-comparison whose clusters stick to each other, beside the dry ones."""
import math
import shutil

from . import charts, frames, measures, programs, runs, tables
from .dry import SCENE, SEEDS
from .programs import digest_of, run

# Variables of cohesion.in: an adhesive stress, or water of 2 % of the volume of the bodies.
MODELS = {"dry": {}, "sjkr": {"energy": 1.5e5}, "washino": {"liquid": 0.02, "bridges": "washino"}, "easo": {"liquid": 0.02, "bridges": "easo"}}
USUAL = ("dry", "sjkr", "washino")
SCENES = {"heap": ("slope of a heap", frames.heap_angle), "drum": ("angle of the bed in a drum at 30 rpm", frames.drum_angle)}
DRAWN = ("log.liggghts", "grains_*.vtp", "particles_*.vtk")
HEADER = ["scene", "cohesion", "angle_degrees", "standard_error", "runs", "more_than_dry", "its_standard_error", "cpu_of_dry"]


def job(chosen, scene, name, seed, given):
    """A run of clusters. given: variables of the scene; the first seed leaves files for a picture."""
    variables = given | MODELS[name] | {"drawn": int(seed == SEEDS[0])}
    inputs = {"what": "cohesion", "scene": digest_of(*(SCENE / file for file in (f"in.{scene}", "bodies.in", "cohesion.in"))), **variables}

    def work(folder):
        for pattern in DRAWN:
            for file in folder.glob(pattern):
                file.unlink()
        line = [chosen.build / "bin" / "eccentra-dem", "-in", SCENE / f"in.{scene}", "-log", "log.liggghts"]
        cpu, *_ = run([*line, *programs.variables(here=SCENE, **variables)], folder, folder / "out.txt")
        dumped = frames.read_frames(folder / "frames.dump")
        angle, _ = SCENES[scene][1](dumped, folder)
        return {"angle": angle, "bodies": len(dumped[-1]), "cpu": cpu}

    return runs.Job(f"{scene} {name} seed {seed}", inputs, work, 20 if name == "dry" else 60)


def rows_of(results, scene):
    """Rows of the table; results: {(scene, model, seed): result}. What a seed does to both leaves the difference."""
    rows = []
    of_scene = {name: {seed: r for (at, of, seed), r in results.items() if (at, of) == (scene, name)} for name in MODELS}
    dry = of_scene["dry"]
    for name, each in of_scene.items():
        if not each:
            continue
        both = [(r, dry[seed]) for seed, r in each.items() if seed in dry]
        more = measures.mean_and_error([r["angle"] - of_dry["angle"] for r, of_dry in both])
        rows.append([scene, name, *measures.mean_and_error([r["angle"] for r in each.values()]), len(each), *more,
                     sum(r["cpu"] for r, _ in both) / sum(of_dry["cpu"] for _, of_dry in both) if both else math.nan])
    return rows


def draw(chosen, scene, jobs):
    """A picture of the runs of the first seed beside each other, by annulusReport."""
    folder = chosen.out / "drawn"
    shutil.rmtree(folder, ignore_errors=True)
    for name, drawn in jobs.items():
        (folder / name).mkdir(parents=True)
        for pattern in DRAWN:
            for file in chosen.store.folder_of(drawn).glob(pattern):
                shutil.copy(file, folder / name)
    run([chosen.build / "bin" / "annulusReport", *(folder / name for name in jobs), "-o", folder / "report"], folder, folder / "report.txt")
    shutil.copy(folder / "report" / "scene.png", chosen.out / f"cohesion-{scene}.png")
    shutil.rmtree(folder)


def report(chosen, given):
    """Runs both scenes with each model and writes table, chart and pictures. given(scene, seed): variables of a run."""
    seeds = SEEDS[: chosen.seeds or (2 if chosen.quick else 4)]
    jobs = {(scene, name, seed): job(chosen, scene, name, seed, given(scene, seed)) for scene in chosen.scenes for name in chosen.models for seed in seeds}
    found = chosen.store.run_all("cohesion", jobs.values())
    if chosen.plan:
        return 0
    results = {key: found[one.key()] for key, one in jobs.items()}
    failed = [f"{jobs[key].name}: {r['failed']}" for key, r in results.items() if "failed" in r]
    good = {key: r for key, r in results.items() if runs.good(r)}
    rows = [row for scene in chosen.scenes for row in rows_of(good, scene)]
    if not rows:
        raise programs.Failure("no run is there: leave out --show" if not failed else failed[0])
    page = [tables.publish(chosen, "cohesion", "Angle of clusters that stick to each other, and how much steeper than dry it is [degrees]", HEADER, rows)]
    bars = [charts.Bars(f"{scene}: {SCENES[scene][0]}", "degrees (bars: standard error)", [row[1] for row in rows if row[0] == scene],
                        {"": [tuple(row[2:4]) for row in rows if row[0] == scene]}) for scene in chosen.scenes]
    charts.write(chosen.out / "cohesion.svg", "Clusters that stick to each other", bars, 2, (4.2, 3.0))
    for scene in chosen.scenes:
        drawn = {name: jobs[scene, name, SEEDS[0]] for name in chosen.models if (scene, name, SEEDS[0]) in good}
        if drawn and not chosen.show:
            draw(chosen, scene, drawn)
    return tables.finish(chosen, page, failed, f"{len(seeds)} seeds", f"shape {chosen.shape}")
