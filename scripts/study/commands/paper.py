# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures 7 and 9 to 14 and Table 1 of Akhshik, Behzad & Rajabi (2016) as our own results in a periodic section."""
import dataclasses
import pathlib
import shutil

from .. import charts, figures, ladders, levels, loop_data, options, page_parts, programs, runs, section, tables

RESTITUTION = 0.9
TABLE_1 = {"sphere 1": 1, "sphere 6": 0.98, "cube 8": 0.91, "cube 27": 0.87, "cube 64": 0.85, "disk 7": 0.68, "disk 19": 0.75,
           "disk 48": 0.79}
MU = ("5 %", "25 %", "mean", "largest")
SPEEDS = (0.58, 0.72, 1.165)
SHORTEST, LONGEST = 0.04, 2.0  # sections [m]
MOST_REFINED = 6
RUNGS = (0.02, 0.15, 0.25, 0.35)
SIZES = {
    "quick": (ladders.Size(rungs=RUNGS, length=0.08, cells="8 32 6", seconds=1.4, seeds=1),
              figures.Plan(inclinations=(0, 80), velocities=(1.165,), shape_velocities=(1.165,), coarse_velocities=(),
                           friction_velocities=(1.165,), rpms=(50, 100), friction_inclinations=(0, 80), estimates=("largest",))),
    "standard": (ladders.Size(rungs=RUNGS, length=0.08, cells="8 32 6", seconds=1.4, seeds=1, refine=2),
                 figures.Plan(inclinations=(0, 40, 80), velocities=SPEEDS, shape_velocities=SPEEDS, coarse_velocities=(1.165,),
                              friction_velocities=(1.165,), rpms=(0, 50, 100), friction_inclinations=(0, 40, 80), estimates=MU)),
    "full": (ladders.Size(rungs=(0.01, 0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4), length=0.6, cells="8 32 40", seconds=5.0, seeds=3, refine=3),
             figures.Plan(inclinations=(0, 20, 40, 60, 80), velocities=SPEEDS, shape_velocities=SPEEDS, coarse_velocities=SPEEDS,
                          friction_velocities=SPEEDS, rpms=(0, 25, 50, 100), friction_inclinations=(0, 20, 40, 60, 80), estimates=MU)),
}
LADDER_FIGURES = (7, 10, 11, 12, 13, 14)
ALL = ("table1", "7", "9", "10", "11", "12", "13", "14")
HEAD = ["## The paper's figures\n",
        "The concentration is interpolated linearly between two fillings, its error is that of their fluxes alone: where the bed "
        "begins to move as a whole between two rungs, it says between which, no more. The flux carried at a filling tells more. "
        "In the charts an arrow means: larger than the filling shown.\n"]


def table_1(build, output):
    """Sphericities of the unions of spheres beside those of Table 1."""
    rows = [[shape, printed, levels.measured(build, shape)["sphericity"]] for shape, printed in TABLE_1.items()]
    header = ["shape", "Table 1", "ours"]
    tables.write_csv(output / "table1.csv", header, rows)
    print("Table 1: sphericity\n" + tables.text(header, rows))
    worst = max(abs(ours - printed) for _, printed, ours in rows)
    return ["## Table 1: sphericity\n", tables.markdown(header, [[s, f"{p:g}", f"{o:.3f}"] for s, p, o in rows]),
            f"The unions of spheres have the printed sphericities within {worst:.3f}.\n"]


def figure_9(store, build, size, critical, plan, output):
    """Snapshots of the beds of spheres, cubes and disks: pictures and means by annulusReport."""
    shapes = {"spheres": plan.s1, "cubes": plan.reference["cube"], "disks": plan.reference["disk"]}
    every = {}
    for name, level in shapes.items():
        words = {"inclination": 80, "velocity": 0.58, "seconds": size.seconds, "length": size.length, "cells": size.cells,
                 "seed": section.SEEDS[0], "snapshots": size.seconds / 2, "interval": section.steps_per_fluid_step(critical[level.name]),
                 **section.level_words(level)}
        words["count"] = section.bodies_at(0.1, words["length"])
        words["pouring"] = ladders.POURING
        every[name] = section.section_job(build, f"figure 9: {name}", words, spheres=level.spheres, keep=name)
    results = store.run_all("figure 9", every.values())
    if any("missing" in results[job.key()] for job in every.values()):
        return [], ["## Figure 9: beds of spheres, cubes and disks\n", "Not run.\n"]
    failed = [f"figure 9, {name}: {results[job.key()]['failed']}" for name, job in every.items() if "failed" in results[job.key()]]
    if failed:
        return failed, []
    folder = output / "figure9"
    shutil.rmtree(folder, ignore_errors=True)
    cases = [store.folder_of(job) / name for name, job in every.items()]
    try:
        programs.run([build / "bin" / "annulusReport", *cases, "-o", folder], output, output / "figure9.log")
    except programs.RunFailed as failure:
        return [f"figure 9: {failure}"], []
    heights = {name: results[job.key()]["mean"]["height"] for name, job in every.items()}
    found = "; ".join(f"{name} {1e3 * h:.1f} +- {1e3 * e:.1g} mm" for name, (h, e) in heights.items())
    return [], ["## Figure 9: beds of spheres, cubes and disks, 80 degrees, 0.58 m/s, 10 % solid\n", "![beds](figure9/beds.png)\n",
                "The paper shows a bed on the low side for all shapes. "
                f"We find one, too; height of the solids' centre: {found}. Table, profile and charts: figure9/.\n"]


def main():
    parser = options.Parser("paper", __doc__ + " docs/paper.md says how.", sizes=("quick", "full"))
    group = parser.add_mutually_exclusive_group()
    group.add_argument("--quick", action="store_true", help="1.165 m/s alone, 0 and 80 degrees, without figure 11: within 10 minutes on 2 idle cores")
    group.add_argument("--full", action="store_true", help="five inclinations, 0.6 m, three seeds: for a cluster")
    parser.add_argument("--figures", action=options.Words, choices=ALL, default=ALL, metavar="FIGURE", help="some of: " + " ".join(ALL))
    parser.add_argument("--measured", type=pathlib.Path, metavar="CSV", help="flow-loop runs to compare signs and sizes of effects with: "
                        "the 116 runs of Yu et al., University of Tulsa, as published in awojinrin/ML-Workflow-for-the-Determination-of-"
                        "Hole-Cleaning-Conditions (files/dataframe.csv)")
    parser.add_argument("--velocities", nargs="+", type=float, choices=SPEEDS, help="mean velocities [m/s] (default: all of the figure)")
    parser.add_argument("--turbulence", choices=("kEpsilon", "realizableKE", "kOmegaSST"), help="model of the flow (default: laminar, as the paper)")
    parser.add_argument("--seeds", type=int, metavar="N", help=f"runs of each filling, 1 to {len(section.SEEDS)} (default 1; --full 3)")
    parser.add_argument("--length", type=float, metavar="M", help=f"of the section [m], {SHORTEST:g} to {LONGEST:g} (default 0.08; --full 0.6)")
    parser.add_argument("--refine", type=int, metavar="N", help=f"further fillings, 0 to {MOST_REFINED}, between the two that enclose the injected flux, until "
                        f"they are {100 * ladders.NARROW:g} % apart (default 2; --quick 0, --full 3)")
    parser.add_argument("--rungs", nargs="+", type=float, metavar="SHARE", help="fillings of the ladder, rising, such as 0.02 0.15 0.35")

    def check(words):
        if words.rungs and not (0 < words.rungs[0] and words.rungs[-1] <= 0.5 and words.rungs == sorted(set(words.rungs))):
            parser.error(f"--rungs is {' '.join(f'{r:g}' for r in words.rungs)}: give rising shares of the volume, more than 0 and at most 0.5")
        for name, value, low, high in (("seeds", words.seeds, 1, len(section.SEEDS)), ("length", words.length, SHORTEST, LONGEST),
                                       ("refine", words.refine, 0, MOST_REFINED)):
            if value is not None and not low <= value <= high:
                parser.error(f"--{name} is {value:g}: give {low:g} to {high:g}")
        try:
            words.loop = loop_data.read(words.measured) if words.measured else None
        except (OSError, ValueError) as error:
            parser.error(f"--measured {words.measured}: {error}")

    words = parser.settle(("eccentra-dem", "clusterShape", "annulusMesh", "annulusFoam", "annulusReport"), check)
    name = "quick" if words.quick else "full" if words.full else "standard"
    size, plan = SIZES[name]
    if words.velocities:
        kept = lambda speeds: tuple(u for u in speeds if u in words.velocities)
        plan = dataclasses.replace(plan, **{name: kept(getattr(plan, name)) for name in (
            "velocities", "shape_velocities", "coarse_velocities", "friction_velocities")})
    if words.rungs:
        size = dataclasses.replace(size, rungs=tuple(words.rungs))
    if words.length:
        across, around, along = size.cells.split()
        size = dataclasses.replace(size, length=words.length, cells=f"{across} {around} {max(3, round(int(along) * words.length / size.length))}")
    size = dataclasses.replace(size, seeds=words.seeds or size.seeds, refine=size.refine if words.refine is None else words.refine)
    if words.turbulence:
        size = dataclasses.replace(size, turbulence=words.turbulence)

    parts, failed = {page_parts.HEAD: HEAD}, []
    if "table1" in words.figures:
        parts["table1"] = table_1(words.build, words.out)
    fine = words.out / "disk80.clump"
    levels.fine_disk(fine)
    estimates = {body: levels.eccentricities(words.build, body) for body in ("cube", "disk")}
    drawn = figures.Figures(plan, estimates, fine)
    chosen = [n for n in LADDER_FIGURES if str(n) in words.figures]
    if chosen or "9" in words.figures:
        steps = {level.name: levels.step_job(words.build, level, RESTITUTION) for level in drawn.levels_needed([int(n) for n in words.figures if n.isdigit()])}
        found = runs.needed(words.store.run_all("time steps", steps.values()), steps)
        critical = {name: result["critical"] for name, result in found.items()}
        climbed = ladders.Ladders(words.store, words.build, size, critical)
        for number in chosen:
            series = drawn.points(number)
            points = [p for line in series.values() for _, p in line]
            if not points:  # none at the velocities asked for
                continue
            failed += climbed.run(points)
            if words.plan:
                continue
            parts[f"figure {number}"] = figure(number, series, climbed, words.out)
        if "9" in words.figures:
            bad, lines = figure_9(words.store, words.build, size, critical, drawn, words.out)
            failed += bad
            parts["figure 9"] = lines
        if words.loop and not words.plan:
            parts["measured"] = loop_data.compare(words.loop, climbed.values, drawn)
    if words.plan:
        return 0
    further = f" and up to {size.refine} between" if size.refine else ""
    settings = (f"fillings {', '.join(f'{100 * r:g} %' for r in size.rungs)}{further}, {size.length} m, cells {size.cells.replace(' ', 'x')}, "
                f"{size.seconds} s, {size.turbulence or 'laminar'}, means over the last {100 * ladders.SHARE:.0f} % of it, {size.seeds} seed(s)")
    return tables.finish(words, {part: lines for part, lines in parts.items() if lines}, failed, settings)


def figure(number, series, climbed, output):
    """Chart, CSV, table and words of one figure."""
    points = list(dict.fromkeys(p for line in series.values() for _, p in line))
    tables.write_csv(output / f"figure{number}.csv", ladders.HEADER, climbed.rows(points))
    charts.write(output / f"figure{number}.svg", figures.TITLES[number][0].upper() + figures.TITLES[number][1:],
                 [figures.panel(number, series, climbed.values), figures.flux_panel(number, series, climbed.values)], 2)
    header, rows = ladders.long_table(series, climbed.values, figures.X[number] + (" or rpm" if number in (13, 14) else ""))
    found = figures.finds(number, series, climbed.values)
    further = [f"{sentence}\n" for sentence in (ladders.not_steady(series, climbed), ladders.not_run(series, climbed.values, figures.X[number])) if sentence]
    print(f"Figure {number}: {figures.TITLES[number]}\n\n{tables.text(header, rows)}\nPaper: {figures.SAYS[number]}\nWe find: {found}\n")
    return [f"## Figure {number}: {figures.TITLES[number]}\n", f"![figure {number}](figure{number}.svg)\n", tables.markdown(header, rows),
            f"**Paper:** {figures.SAYS[number]}\n", f"**We find:** {found}\n", *further]
