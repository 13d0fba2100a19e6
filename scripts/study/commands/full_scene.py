# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's full scene (12 m, 140,000 cells, up to 25,837 bodies, 60 s): what it would cost, from measured steps, or with --run the scene itself."""
import shutil

from .. import full_study, levels, measures, options, programs, runs, section, tables

LENGTH, CELLS, MOST_BODIES, SECONDS = 12, "12 48 243", 25837, 60  # cells: 139,968
RESTITUTION = 0.9
PAPER_STEPS = (1e-3, 1e-5)  # fluid and DEM [s]
PAPER_CORE_DAYS = 90  # of CPU time, on a machine of 32 cores
DAY = 86400
STARTING, LEFT_OUT, BLOCKS, BLOCK = 6, 5, 4, 5  # fluid steps alone; coupled ones before the measured; blocks of so many measured ones
SUMMARISED = ("S1", "C64")
# (level, filling, ranks)
SIZES = {"quick": (("S1", 0.5, 1), ("S1", 0.5, 2), ("C64", 0.5, 1)),
         "standard": tuple((name, filling, ranks) for name in ("S1", "C8", "C64", "D48") for filling in (0.1, 0.5, 1.0) for ranks in (1, 2))}


def measure_job(build, level, critical, filling, ranks):
    """Wall seconds of a fluid step and of a DEM step, as on a machine with nothing else to do: those measured times the share of the
    cores that the run had (its CPU time over wall time and ranks)."""
    interval = section.steps_per_fluid_step(critical)
    words = {"length": LENGTH, "cells": CELLS, "count": round(filling * MOST_BODIES), "ranks": ranks, "interval": interval,
             "seconds": (LEFT_OUT + BLOCKS * BLOCK) * section.FLUID_STEP, "run-in": STARTING, "report": BLOCK, "snapshots": SECONDS,
             "pouring": 0.2, **section.level_words(level)}
    inputs = {"what": "full scene", "case": section.case_digest(), **{k: str(v) for k, v in words.items()}}

    def work(folder):
        case, cpu, wall = section.run_case(build, folder, words)
        table = section.rows_of(case)
        share = min(1.0, cpu / (wall * ranks))
        ends = [row for row in table if round(row["time"] / section.FLUID_STEP) >= LEFT_OUT][-BLOCKS - 1:]
        result = {"bodies": int(table[-1]["particles"]), "interval": interval, "share": share, "cpu": cpu, "wall": wall}
        for name, parts, steps in (("fluid_step", ("fluid",), 1), ("exchange", ("exchange", "link"), 1), ("dem_step", ("dem",), interval)):
            blocks = [share * sum(b[f"{p}_seconds"] - a[f"{p}_seconds"] for p in parts) / (BLOCK * steps) for a, b in zip(ends, ends[1:])]
            result[name], result[f"{name}_error"] = measures.mean_and_error(blocks)
        shutil.rmtree(case)
        return result

    return runs.Job(f"{level.name}, {filling:g} of the bodies, {ranks} rank(s)", inputs, work,
                    60 + 60 * filling * (1 + 0.7 * (level.spheres > 1) + 0.03 * level.spheres))


def days(result, fluid_step, dem_step):
    """Days of wall time of the whole run at these steps."""
    return SECONDS * ((result["fluid_step"] + result["exchange"]) / fluid_step + result["dem_step"] / dem_step) / DAY


def main():
    parser = options.Parser("full-scene", __doc__, "S1 and C64 with half of the bodies, S1 also on 2 ranks", at_once=1,  # it is time that is measured
                            epilog="Half of the bodies is the mean over the run, as they come in evenly and none leaves in this estimate.")
    parser.add_argument("--levels", nargs="+", metavar="NAME", help="of S1, C8, C64, D48 (default: those of the study)")
    parser.add_argument("--fillings", nargs="+", type=float, metavar="SHARE", help="of the bodies (default: those of the study: 0.1, 0.5, 1)")
    parser.add_argument("--ranks", nargs="+", type=int, metavar="N", help="1 or 2 (default: those of the study)")

    full_study.add_options(parser)

    def check(words):
        if words.run or words.accuracy:
            if words.ranks and (len(words.ranks) > 1 or words.ranks[0] < 1):
                parser.error("--ranks of a run is one number from 1 on")
            return
        everything = words.plan_of = SIZES["quick" if words.quick else "standard"]
        for k, (option, wanted) in enumerate((("--levels", words.levels), ("--fillings", words.fillings), ("--ranks", words.ranks))):
            for value in wanted or ():
                if value not in (row[k] for row in everything):
                    parser.error(f"{option} names '{value}': there are {', '.join(str(v) for v in dict.fromkeys(row[k] for row in everything))}")
            words.plan_of = [row for row in words.plan_of if not wanted or row[k] in wanted]

    words = parser.settle(("eccentra-dem", "annulusMesh", "annulusFoam", "clusterShape"), check)
    if words.run or words.accuracy:
        return full_study.main(words)
    known = {level.name: level for body in ("cube", "disk") for level in levels.levels_of(body, {}, "")}
    plan = words.plan_of
    chosen = list(dict.fromkeys(n for n, _, _ in plan))
    steps = {n: levels.step_job(words.build, known[n], RESTITUTION) for n in chosen}
    found = words.store.run_all("time steps", steps.values())
    bad = [f"the time step of {n}: {found[j.key()]['failed']}" for n, j in steps.items() if "failed" in found[j.key()]]
    if bad:
        raise programs.Failure(bad[0])
    critical = {n: found[j.key()]["critical"] for n, j in steps.items() if runs.good(found[j.key()])}
    jobs = {key: measure_job(words.build, known[key[0]], critical[key[0]], *key[1:]) for key in plan if key[0] in critical}
    results = words.store.run_all("full scene", jobs.values())

    if words.plan:
        return 0

    rows, failed, page = [], [], []
    missing = [f"{n} (all rows)" for n in chosen if n not in critical]
    with_error = lambda r, name: f"{tables.number(1e3 * r[name])} +- {tables.number(1e3 * r[name + '_error'], 1)}"
    for (level, filling, ranks), job in jobs.items():
        r = results[job.key()]
        if not runs.good(r):
            (failed if "failed" in r else missing).append(f"{job.name}: {r.get('failed', 'not run')}")
            continue
        ours = section.FLUID_STEP / r["interval"]
        at_ours = days(r, section.FLUID_STEP, ours)
        rows.append([level, str(ranks), str(r["bodies"]), with_error(r, "fluid_step"), with_error(r, "exchange"), with_error(r, "dem_step"),
                     days(r, *PAPER_STEPS), ours * 1e5, at_ours])
        if ranks == 1 and level in SUMMARISED and filling == 0.5:
            page.append(f"{level}: {at_ours:.2g} core-days for the 60 s at our steps; the paper's took about "
                        f"{PAPER_CORE_DAYS} days on 32 cores.")
    header = ["level", "ranks", "bodies", "ms a fluid step", "ms exchange", "ms a DEM step", "days at 1e-3 and 1e-5 s",
              "our DEM step 1e-5 s", f"days at {section.FLUID_STEP:g} s and ours"]
    tables.write_csv(words.out / "full-scene.csv", header, rows)
    print(tables.text(header, rows))
    print("\n".join(page))
    if missing:
        page.append("Not run: " + "; ".join(sentence.removesuffix(": not run") for sentence in missing) + ".")
    head = ("12 m, 139,968 cells, bodies poured across the hole at 80 degrees, 0.58 m/s; 60 s of it. Half of the bodies is the mean over the "
            "run; `+-` over blocks of fluid steps. Days of wall time on so many ranks. Projected, not run.\n")
    page = ["## The full scene, projected\n", head, tables.markdown(header, rows), *(f"{sentence}\n" for sentence in page)]
    return tables.finish(words, page, failed, f"{BLOCKS * BLOCK} coupled fluid steps each after {STARTING} of the fluid alone and {LEFT_OUT} "
                         "coupled ones, one run at a time", "wall seconds times the share of the cores that the run had")
