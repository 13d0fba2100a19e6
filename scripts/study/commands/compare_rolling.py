# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the scenes of cases/rolling-comparison with every rolling model and with clusters, and compares them in one table."""
import csv
import math
import pathlib
import shutil
import statistics

from .. import charts, cohesion, dry, frames, levels, measures, options, programs, runs, section, tables
from ..dry import SCENE, SEEDS
from ..frames import DIAMETER, RADIUS
from ..programs import RUN_CASE, digest_of, run

TORSION_OFF = "torsionTorque off"
ALL_SEEDS = 8
# Coefficients of eq (19) at each contact of a cluster: what hysteresis adds to shape.
HYSTERESIS = (0.05, 0.1, 0.2, 0.3)
DAMPINGS = (3, 10)  # of rockingDamping


class Model:
    """A rolling model as a user types it; `kind` says which coefficient it takes, `scenes` where it runs (None: in all); mu: of a
    cluster's contacts, beside its shape."""

    def __init__(self, word, words="tangential_damping on", wall_words=None, kind="stock", scenes=None, mu=0):
        self.word, self.words, self.kind, self.scenes, self.mu = word, words, kind, scenes, mu
        self.wall_words = wall_words or words

    def runs_in(self, scene):
        return self.scenes is None or scene in self.scenes


def models(shape):
    return {
        "cluster": Model("off", kind="cluster"),
        **{f"cluster-{mu}": Model("shape", "form limited", kind="cluster", mu=mu) for mu in HYSTERESIS},
        "off": Model("off"),
        "cdt": Model("cdt", TORSION_OFF),
        "cdt-stock-wall": Model("cdt", TORSION_OFF, scenes=("drum",)),
        "epsd": Model("epsd", TORSION_OFF),
        "epsd2": Model("epsd2", TORSION_OFF),
        "epsd3": Model("epsd3", TORSION_OFF),
        "luding": Model("luding"),
        "shape-limited": Model("shape", "form limited", kind="shape"),
        "shape-epsd": Model("shape", "form epsd", kind="shape"),
        "shape-directional": Model("shape", "form directional", kind="shape"),
        **{name: Model("eccentric", f"shape {shape} {damping}".strip(), f"tangential_damping on {damping}".strip(), kind="eccentric")
           for name, damping in {"eccentric": "", **{f"eccentric-{factor}": f"rockingDamping {factor}" for factor in DAMPINGS}}.items()},
    }


def solids_flux(dumped, folder):
    """Mean over the second half of the run."""
    with open(folder / "postProcessing" / "eccentra" / "coupling.csv", newline="") as file:
        rows = [(float(row["time"]), float(row["solids_flux"])) for row in csv.DictReader(file)]
    late = [flux for time, flux in rows if time > 0.5 * rows[-1][0]]
    return 1e9 * statistics.fmean(late), math.nan


# name: (what, unit, measure, bodies in full, bodies with --quick)
SCENES = {
    "plane": ("stopping distance after 0.2 m/s", "diameters", frames.stopping_distance, 1, 1),
    "slope": ("angle at which a body leaves", "degrees", frames.tilting_angle, 1, 1),
    "heap": ("slope of a heap", "degrees", frames.heap_angle, 220, 100),
    "drum": ("angle of the bed at 30 rpm", "degrees", frames.drum_angle, 160, 110),
    "hopper": ("discharge through 32 mm", "bodies/s", frames.discharge_rate, 260, 140),
    "section": ("solids flux in the annulus, 1 % at 1.165 m/s", "mm3/s", solids_flux, 121, 121),
}


def variables_of(chosen, scene, name, seed):
    """What a scene's input script is given."""
    model = models(chosen.shape)[name]
    full, quick = SCENES[scene][3:] if scene in SCENES else (0, 0)
    stock_wall = name == "cdt-stock-wall"
    return {
        "seed": seed, "bodies": quick if chosen.quick else full, "shape": chosen.shape, "clusters": int(model.kind == "cluster"),
        "rolling": model.word, "words": model.words, "wall_words": model.wall_words,
        "mu_r": model.mu if model.kind == "cluster" else 0 if model.kind == "shape" else chosen.mu, "mu_shape": chosen.mu if model.kind == "shape" else 0,
        "turning_wall": "wall/gran" if stock_wall else "wall/gran/cluster",
        # the stock wall takes omega x centre: the contact is a radius further out
        "turn": f"shear x {3.1416 * 0.035 / (0.035 - RADIUS):.6f}" if stock_wall else "rotate 3.1416",
    }


def described(variables):
    """As inputs of a run: files of shapes by their contents."""
    return {name: levels.shape_key(value) if isinstance(value, str) else value for name, value in variables.items()}


def result_of(scene, dumped, folder, cpu, seed):
    value, residual = SCENES[scene][2](dumped, folder)
    shown = {}
    if seed == SEEDS[0]:  # what of the run stands in its picture: a body's whole way, a silo halfway through, else the end
        chosen = dumped if SCENES[scene][3] == 1 else [dumped[len(dumped) // 2 if scene == "hopper" else -1]]
        shown = {"shown": [body[:3] for frame in chosen for body in frame.values()]}
    return {"value": value, "residual": residual, "bodies": len(dumped[0]), "cpu": cpu, **shown}


def scene_job(chosen, scene, name, seed, program="eccentra-dem", turn=None):
    """A dry scene. turn: its number where the time alone is measured, several times over."""
    variables = variables_of(chosen, scene, name, seed)
    inputs = {"what": "rolling", "scene": digest_of(SCENE / f"in.{scene}", SCENE / "bodies.in"), "ring": digest_of(pathlib.Path(dry.__file__)),
              "program": program, **described(variables), **({} if turn is None else {"turn": turn})}

    def work(folder):
        dry.write_ring(folder / "ring.stl", *dry.RING[False])
        line = [program if program == "liggghts" else chosen.build / "bin" / program, "-in", SCENE / f"in.{scene}", "-log", "none"]
        cpu, *_ = run([*line, *programs.variables(here=SCENE, **variables)], folder, folder / "out.txt")
        return {"cpu": cpu} if turn is not None else result_of(scene, frames.read_frames(folder / "frames.dump"), folder, cpu, seed)

    return runs.Job(f"{scene} {name} seed {seed}" if turn is None else f"{scene} {name} {program}, turn {turn + 1}", inputs, work,
                    (20 if variables["clusters"] else 3) * (0.1 if variables["bodies"] == 1 else 1))


def section_job(chosen, name, seed):
    """The coupled section: cases/tomren-section with in.section in place of its own script."""
    variables = variables_of(chosen, "section", name, seed)
    words = {"velocity": 1.165, "cells": "8 32 10", "report": 5, "count": variables["bodies"], "seconds": 1.5 if chosen.quick else 3,
             "sphericity": chosen.sphericity, **({"shape": variables["shape"]} if variables["clusters"] else {}),
             **{key: variables[key] for key in ("seed", "rolling", "mu_r", "mu_shape")},
             **{key: f'"{variables[key]}"' for key in ("words", "wall_words")}}
    inputs = {"what": "rolling in the section", "case": section.case_digest(), "script": digest_of(SCENE / "in.section", SCENE / "bodies.in"),
              **described(words)}

    def work(folder):
        case = folder / "case"
        shutil.rmtree(case, ignore_errors=True)
        shutil.copytree(section.CASE, case, ignore=shutil.ignore_patterns("results*"))
        shutil.copy(SCENE / "in.section", case / "in.cuttings")
        shutil.rmtree(folder / "run", ignore_errors=True)
        cpu, *_ = run([RUN_CASE, case, "--bin", chosen.build / "bin", "--output", folder / "run",
                      *programs.options(here=SCENE, **words)], folder, folder / "out.txt")
        return result_of("section", frames.read_frames(folder / "run" / "frames.dump"), folder / "run", cpu, seed)

    return runs.Job(f"section {name} seed {seed}", inputs, work, 40 if words.get("shape") else 15)


# Of a picture of a scene: left, right, low, high [m], which coordinate is up, and what of walls is seen.
FLOOR = [[(-1, 1), (0, 0)]]
VIEWS = {
    "plane": ((-0.02, 0.24, -0.002, 0.02), 2, FLOOR),
    "slope": ((-0.02, 0.24, -0.002, 0.02), 2, FLOOR),
    "heap": ((-0.1, 0.1, -0.003, 0.045), 2, FLOOR),
    "drum": ((-0.036, 0.036, -0.036, 0.036), 1, [(0, 0, 0.035)]),
    "hopper": ((-0.03, 0.03, -0.03, 0.045), 2, [[(-0.025, -0.025, -0.016), (0.2, 0, 0)], [(0.025, 0.025, 0.016), (0.2, 0, 0)]]),
    "section": ((-0.066, 0.066, -0.066, 0.066), 1, [(0, 0, 0.0635), (0, -0.019685, 0.02413)]),
}


def pictures(path, scene, bodies_of):
    """Side views at one scale: circles of R_eq. `bodies_of`: name -> [(x, y, z)]."""
    view, up, walls = VIEWS[scene]
    wide = view[1] - view[0] > 4 * (view[3] - view[2])
    across = 5.0 if wide else 2.4
    panels = [charts.Bodies(name, bodies, RADIUS, view, up, walls) for name, bodies in bodies_of.items()]
    charts.write(path, f"{scene}: {SCENES[scene][0]} (clusters drawn as spheres of equal volume)", panels, 2 if wide else 4,
                 (across, across * (view[3] - view[2]) / (view[1] - view[0]) + 0.3))


def report(chosen, results):
    """results: {(scene, model): [result of a seed]}."""
    header = ["scene", "result", "unit", "model", "mean", "standard_error", "runs", "deviation_from_cluster", "deviation_percent",
              "cpu_against_cdt", "residual_speed_m_per_s"]
    rows, text, bars = [], [], []
    for scene in chosen.scenes:
        what, unit = SCENES[scene][:2]
        names = [name for at, name in results if at == scene]
        good = {name: [r for r in results[scene, name] if runs.good(r)] for name in names}
        reference, reference_error = measures.mean_and_error([r["value"] for r in good.get("cluster", [])])
        # a scene's cost per body: eccentric spheres can leave the scene
        cost = {name: statistics.fmean([r["cpu"] / max(1, r["bodies"]) for r in good[name]]) if good[name] else math.nan for name in names}
        table, shown = [], []
        for name in names:
            mean, error = measures.mean_and_error([r["value"] for r in good[name]])
            residuals = [r["residual"] for r in good[name] if not math.isnan(r["residual"])]
            residual = statistics.fmean(residuals) if residuals else math.nan
            ratio = cost[name] / cost["cdt"] if cost.get("cdt") else math.nan
            percent = 100 * (mean - reference) / reference if reference else math.nan
            rows.append([scene, what, unit, name, mean, error, len(good[name]), mean - reference, percent, ratio, residual])
            failures = sorted({r["failed"] for r in results[scene, name] if "failed" in r})
            left = len(results[scene, name]) - len(good[name])
            table.append([name, f"{mean:.3f}", f"{error:.3f}", len(good[name]), f"{percent:+.0f}%", f"{ratio:.2f}", f"{residual:.1e}",
                          f"{'FAILED' if failures else 'not run'} {left}: {' '.join(failures[:1])}".rstrip(": ") if left else ""])
            shown.append((mean, error))
        text += [f"{scene}: {what} [{unit}]", "", tables.text(["model", "mean", "+-", "runs", "to cluster", "cpu/cdt", "residual m/s", ""], table)]
        bars.append(charts.Bars(f"{scene}: {what}", f"{unit} (bars: standard error; dashed: clusters)", names, {"": shown}, reference=reference))
        charts.write(chosen.out / f"{scene}.svg", f"Rolling models against clusters: {scene}", bars[-1:], 1, (6.4, 3.4))
        seen = {name: r["shown"] for name in names for r in good[name] if "shown" in r}
        if seen:
            pictures(chosen.out / f"{scene}-pictures.svg", scene, seen)
    charts.write(chosen.out / "comparison.svg", "Rolling models against clusters", bars, 2)
    tables.write_csv(chosen.out / "comparison.csv", header, rows)
    table = "\n".join(text)
    (chosen.out / "comparison.txt").write_text(table)
    print(f"{table}\ntable: {chosen.out}/comparison.txt and .csv; charts and pictures: {chosen.out}/*.svg")


COST_RUNS = 3
COST_SCENES = {"bed": "settling bed of 200 spheres", "heap": "collapsing column", "drum": "drum", "hopper": "silo"}
COST_MODELS = ("cdt", "epsd2 (stock program)", "epsd2", "shape-limited", "shape-epsd", "shape-directional", "eccentric")


def report_cost(chosen):
    """CPU time of scenes of many spheres, models in turn; the least of several runs, which other load disturbs least."""
    jobs = {}
    for scene in [s for s in COST_SCENES if s == "bed" or s in chosen.scenes]:
        for turn in range(COST_RUNS):
            for label in COST_MODELS:
                name, stock = label.split(" ")[0], "stock" in label
                if name in chosen.models and not (stock and scene == "drum"):  # its walls are ours
                    jobs[scene, label, turn] = scene_job(chosen, scene, name, SEEDS[0], "liggghts" if stock else "eccentra-dem", turn)
    results = {key: r for key, job in jobs.items() if runs.good(r := chosen.store.run_all(f"cost of {key[0]}", [job])[job.key()])}
    if chosen.plan:
        return 0
    rows = []
    for scene, what in COST_SCENES.items():
        least = {label: min(times) for label in COST_MODELS
                 if (times := [r["cpu"] for (at, of, _), r in results.items() if (at, of) == (scene, label)])}
        rows += [[what, label, used, used / least.get("cdt", math.nan)] for label, used in least.items()]
    if not rows:
        raise programs.Failure("no run is there: leave out --show")
    page = tables.publish(chosen, "cost", f"CPU seconds (least of {COST_RUNS} runs, in turn) and ratio to cdt; one core",
                          ["scene", "model", "CPU s", "of cdt"], rows)
    (chosen.out / "cost.txt").write_text(page)
    return 0 if len(results) == len(jobs) else 1


def default_seeds(scene, quick):
    if SCENES[scene][3] == 1:
        return ALL_SEEDS
    return 2 if quick or scene == "section" else 4


def main():
    names = list(models("cube 64"))
    few = [name for name in names if not name.startswith(("cluster-", "eccentric-"))]
    parser = options.Parser(
        "compare-rolling", "Compares rolling models with clusters: " + "; ".join(f"{k}: {v[0]} [{v[1]}]" for k, v in SCENES.items()),
        "fewer bodies, 2 seeds (8 for single bodies): within 5 minutes on 2 cores",
        epilog="Writes comparison.txt, comparison.csv, charts and pictures (SVG), cost.txt.")
    parser.add_argument("--scenes", action=options.Words, choices=list(SCENES), help="default: all; with --cohesion heap and drum")
    parser.add_argument("--models", action=options.Words, choices=names + list(cohesion.MODELS),
                        help="default: all, with --quick and --cost without clusters that have rolling friction, too; with --cohesion "
                        f"{', '.join(cohesion.USUAL)} of {', '.join(cohesion.MODELS)}")
    parser.add_argument("--seeds", type=int, help="runs per scene and model (default 4, with --quick and in the section 2; single bodies always 8)")
    parser.add_argument("--mu", type=float, help="rolling friction coefficient (default 0.32, the paper's for cubes)")
    parser.add_argument("--shape", default="cube 64", help="shape of clusters and of eccentric (default 'cube 64')")
    only = parser.add_mutually_exclusive_group()
    only.add_argument("--cost", action="store_true", help="only measure what the models cost, one at a time")
    only.add_argument("--cohesion", action="store_true", help="only heap and drum of clusters that stick to each other or are wet, beside dry ones; with "
                      "pictures by annulusReport")

    def check(chosen):
        if chosen.cohesion:
            for scene in chosen.scenes or ():
                if scene not in cohesion.SCENES:
                    parser.error(f"--scenes: {scene} is not there with --cohesion; expected {', '.join(cohesion.SCENES)}")
            if chosen.mu is not None:
                parser.error("--mu is not read with --cohesion, whose clusters have no rolling friction; leave it out")
        of_study = list(cohesion.MODELS) if chosen.cohesion else names
        for name in chosen.models or ():
            if name not in of_study:
                parser.error(f"--models: {name} is {'not there' if chosen.cohesion else 'there only'} with --cohesion; expected {', '.join(of_study)}")
        if chosen.cohesion:
            chosen.models = chosen.models or list(cohesion.USUAL)
        chosen.scenes = chosen.scenes or list(cohesion.SCENES if chosen.cohesion else SCENES)
        chosen.mu = 0.32 if chosen.mu is None else chosen.mu
        chosen.models = chosen.models or (few if chosen.quick or chosen.cost else names)
        if chosen.seeds is not None and not 1 <= chosen.seeds <= ALL_SEEDS:
            parser.error(f"--seeds is {chosen.seeds}: give 1 to {ALL_SEEDS}")
        if not chosen.mu >= 0:
            parser.error(f"--mu is {chosen.mu}: give a number >= 0")

    coupled = ("annulusFoam", "annulusMesh")

    def needs(chosen):
        if chosen.cohesion:
            return "eccentra-dem", "clusterShape", "annulusReport"
        return ("eccentra-dem", "clusterShape") + (coupled if "section" in (chosen.scenes or SCENES) and not chosen.cost else ())

    chosen = parser.settle(needs, check)
    # Runs have folders of their own: files of shapes by their whole paths.
    chosen.shape = " ".join(str(pathlib.Path(word).resolve()) if pathlib.Path(word).is_file() else word for word in chosen.shape.split())
    chosen.sphericity = levels.measured(chosen.build, chosen.shape, "--diameter", DIAMETER)["sphericity"]
    if chosen.cohesion:
        return cohesion.report(chosen, lambda scene, seed: variables_of(chosen, scene, "cluster", seed))
    if chosen.cost:
        return report_cost(chosen)
    jobs = {}
    for scene in chosen.scenes:
        for name in chosen.models:
            if models("")[name].runs_in(scene):
                for seed in SEEDS[: chosen.seeds or default_seeds(scene, chosen.quick)]:
                    jobs[scene, name, seed] = section_job(chosen, name, seed) if scene == "section" else scene_job(chosen, scene, name, seed)
    found = chosen.store.run_all("rolling models", jobs.values())
    if chosen.plan:
        return 0
    results = {}
    for (scene, name, _), job in jobs.items():
        results.setdefault((scene, name), []).append(found[job.key()])
    report(chosen, results)
    return 1 if any("failed" in r for every in results.values() for r in every) else 0
