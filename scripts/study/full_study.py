# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole scene as it was run: pages of one or several levels, and what longer steps and looser tolerances change."""
import argparse
import dataclasses
import math

from . import full_pictures, full_report, full_run, hole, levels, runs, section, tables

LEVELS = ("S1", "C8", "C64", "D48", "smooth")
USUAL_ANGLE = 80.0  # [degrees]
FEWER = {"S1": 200, "C64": 320}  # DEM steps in 20 ms of the whole runs: 0.55 and 0.49 of the critical step instead of 0.3
COMPARED = ((5e-3, "tight"), (20e-3, "tight"), (5e-3, "loose"), (20e-3, "loose"))
SHORT = {"length": 1.2, "end": 5.0}  # of the comparison [m, s]
LARGEST_CHANGE = 0.02


def positive(text):
    value = float(text)
    if not (0 < value < math.inf):
        raise argparse.ArgumentTypeError(f"'{text}' is not above 0")
    return value


def whole(text):
    if not text.isdigit() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is not a whole number from 1 on")
    return int(text)


def add_options(parser):
    parser.add_argument("--run", nargs="+", metavar="LEVEL", choices=LEVELS, default=(),
                        help=f"run the whole scene with these levels ({', '.join(LEVELS)}), or go on with it; the options below are of this run")
    parser.add_argument("--accuracy", action="store_true", help="what steps of 20 ms and loose tolerances change in 1.2 m of the scene (--levels, default S1)")
    parser.add_argument("--angle", type=float, default=USUAL_ANGLE, metavar="DEGREES", help="of the hole from the vertical (default 80)")
    parser.add_argument("--velocity", type=positive, default=0.58, metavar="U", help="mean velocity [m/s] (default 0.58)")
    parser.add_argument("--rpm", type=float, default=50.0, metavar="N", help="of the pipe (default 50)")
    parser.add_argument("--end", type=positive, metavar="T", help=f"[s] (default 60; with --accuracy {SHORT['end']:g})")
    parser.add_argument("--length", type=positive, metavar="L", help=f"[m] (default 12; with --accuracy {SHORT['length']:g})")
    parser.add_argument("--fluid-step", type=positive, default=full_run.FLUID_STEP, metavar="DT", help="[s] (default 0.02)")
    parser.add_argument("--interval", type=whole, metavar="N", help="DEM steps in a step of the fluid (default: 0.3 of the critical step)")
    parser.add_argument("--safety", type=positive, metavar="S",
                        help="part of the critical step at which fix timestep/limit ends the run (default: that of the case, 0.9)")
    parser.add_argument("--tolerances", choices=full_run.TOLERANCES, default="loose", help="of the linear solvers (default loose)")


def known():
    named = {level.name: level for body in ("cube", "disk") for level in levels.levels_of(body, {}, "")}
    return named | {"smooth": dataclasses.replace(levels.smooth("cube", levels.ROUNDING["cube"]), name="smooth")}


def completed(words, **values):
    """The options of one run."""
    chosen = argparse.Namespace(**vars(words))
    chosen.ranks = words.ranks[0] if words.ranks else 1
    chosen.end = words.end or (SHORT["end"] if words.accuracy else 60.0)
    chosen.length = words.length or (SHORT["length"] if words.accuracy else 12.0)
    for name, value in values.items():
        setattr(chosen, name, value)
    return chosen


def label_of(chosen, name):
    """Of a level's run: names its files and its part of the page."""
    return name + (f"-{chosen.angle:g}-degrees" if chosen.angle != USUAL_ANGLE else "")


def run_pages(words, critical):
    """Runs the levels one after another; yields (part, page, failed) of each."""
    named = known()
    for name in words.run:
        chosen = completed(words, accuracy=False)
        one = full_run.job(chosen, named[name], critical[name])
        result = words.store.run_all("whole scene", [one])[one.key()]
        failed = [f"{one.name}: {result['failed']}"] if "failed" in result else []
        case = full_run.case_of(words.store, one)
        if words.plan:
            continue
        label, page = label_of(chosen, name), []
        if case is not None:
            interval = full_run.interval_of(chosen, critical[name])
            cost = full_report.cost_row(label, chosen, section.rows_of(case), interval, full_run.read_note(case.parent))
            page = ["## The whole scene, run\n", tables.publish(words, f"{label}-beside-the-paper", f"{label} beside the paper:", full_report.COST_HEADER,
                                                               [full_report.PAPER, cost]), *level_page(words, chosen, named[name], case, interval)]
        yield f"run {label}", page, failed


def level_page(words, chosen, level, case, interval):
    """Files and lines of one level's run, as far as it has come."""
    name, step = label_of(chosen, level.name), chosen.fluid_step / interval
    rows, pictures = section.rows_of(case), hole.history(case, step, chosen.length)
    note = full_run.read_note(case.parent)
    page = [f"### {name}\n", *(f"{sentence}\n" for sentence in full_report.sentences(name, chosen, rows, pictures, note)),
            f"{full_report.limit_sentence(name, case)}\n"]
    table = full_report.time_table(rows, pictures, full_report.contact_loads(case), step)
    page.append(tables.publish(words, f"{name}-time", f"{name} in time:", full_report.TIME_HEADER, table))
    if len(pictures) > 1:
        hole.write_csv(words.out / f"{name}-along.csv", pictures)
        full_report.chart(words.out / f"{name}.svg", name, rows, pictures, chosen.length)
        full_pictures.whole_hole(words.out / f"{name}-hole.png", name, case, step, chosen.length)
        full_pictures.film(words.out / f"{name}-film.png", name, case, step, chosen.length)
        form = full_pictures.form_of(words.build, level, words.out)
        full_pictures.piece(words.out / f"{name}-piece.png", name, case, step, chosen.length, form)
        page.append(f"![{name}: along the hole and in time]({name}.svg)\n\n![{name}: strip of frames]({name}-hole.png)\n\n"
                    f"![{name}: film]({name}-film.png)\n\n![{name}: a piece of the hole at the end]({name}-piece.png)\n")
    return page


def accuracy_page(words, name, critical):
    """Runs a short scene with all steps and tolerances; (page, failed)."""
    jobs, fewer = {}, words.interval or FEWER.get(name)
    for fluid_step, tolerances, interval in [*((*pair, None) for pair in COMPARED), *([(*COMPARED[-1], fewer)] if fewer else [])]:
        chosen = completed(words, fluid_step=fluid_step, tolerances=tolerances, interval=interval)
        jobs[fluid_step, tolerances, interval] = full_run.job(chosen, known()[name], critical), chosen
    results = words.store.run_all("steps and tolerances", [one for one, _ in jobs.values()])
    if words.plan:
        return [], []
    failed, found, rows = [], {}, []
    for key, (one, chosen) in jobs.items():
        result = results[one.key()]
        if not runs.good(result):
            failed.append(f"{one.name}: {result.get('failed', 'not run')}")
            continue
        case = full_run.case_of(words.store, one)
        step = chosen.fluid_step / full_run.interval_of(chosen, critical)
        found[key] = full_report.measures_of(case, step, chosen.length) | {"cpu": result["cpu"]}
    reference = found.get((*COMPARED[0], None))
    for (fluid_step, tolerances, interval), m in found.items():
        label = f"{1e3 * fluid_step:g} ms, {tolerances}" + (f", {interval} DEM steps" if interval else "")
        change = [f"{100 * (m[quantity] / reference[quantity] - 1):+.2f}" if reference and reference[quantity] else "-"
                  for quantity in ("hold-up", "front", "gradient")]
        rows.append([label, 100 * m["hold-up"], change[0], m["front"], change[1], m["gradient"], change[2], m["cpu"]])
        if reference:
            failed += [f"{label}: {quantity} differs by more than {100 * LARGEST_CHANGE:g} %"
                       for quantity in ("hold-up", "front", "gradient") if not abs(m[quantity] / reference[quantity] - 1) <= LARGEST_CHANGE]
    header = ["", "solid [%]", "change [%]", "front [m]", "change [%]", "pressure gradient [Pa/m]", "change [%]", "CPU [s]"]
    title = f"Steps and tolerances, {name}, {completed(words).length:g} m, {completed(words).end:g} s, last fifth:"
    return ["## Steps and tolerances\n", tables.publish(words, f"accuracy-{name}", title, header, rows)], failed


def main(words):
    """The study of --run and --accuracy; the exit status."""
    named = known()
    compared = (words.levels or ["S1"]) if words.accuracy else []
    steps = {name: levels.step_job(words.build, named[name], 0.9) for name in dict.fromkeys([*words.run, *compared])}
    critical = {name: result["critical"] for name, result in runs.needed(words.store.run_all("time steps", steps.values()), steps).items()}
    parts = [*run_pages(words, critical), *((f"steps {name}", *accuracy_page(words, name, critical[name])) for name in compared)]
    if words.plan:
        return 0
    settings = "wall hours are those of DEM, fluid, exchange and link; CPU days are of all processes"
    failed = [sentence for _, _, sentences in parts for sentence in sentences]
    return tables.finish(words, {part: page for part, page, _ in parts if page}, failed, settings)
