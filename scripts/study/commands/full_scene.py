# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's full scene (12 m, 140,000 cells, up to 25,837 bodies, 60 s): what its steps cost on one, two and four ranks, and would on more,
or with --run the scene itself."""
import shutil

from .. import full_run, full_study, levels, measures, options, runs, scaling, section, tables

LENGTH, MOST_BODIES, SECONDS = 12, 25837, 60
CELLS = full_run.cells_of(LENGTH)  # 139,968
RESTITUTION = 0.9
STARTING, LEFT_OUT, BLOCKS, BLOCK = 6, 5, 4, 5  # fluid steps alone; coupled ones before the measured; blocks of so many measured ones
MORE_RANKS = (8, 16, 32)
# (level, filling, ranks)
SIZES = {"quick": tuple((name, 0.5, ranks) for name in ("S1", "C64") for ranks in (1, 2, 4)),
         "standard": tuple((name, filling, ranks) for name in ("S1", "C8", "C64", "D48") for filling in (0.1, 0.5, 1.0) for ranks in (1, 2, 4))}


def measure_job(build, level, critical, filling, ranks):
    """Wall seconds of a fluid step and of a DEM step, as on a machine with nothing else to do and a core for each rank: those measured
    times the share of the cores that the run had (its CPU time over wall time and ranks); and what the ranks sent."""
    interval = section.steps_per_fluid_step(critical, full_run.FLUID_STEP)
    words = {"length": LENGTH, "cells": CELLS, "count": round(filling * MOST_BODIES), "ranks": ranks, "fluid_step": full_run.FLUID_STEP,
             "interval": interval, "seconds": (LEFT_OUT + BLOCKS * BLOCK) * full_run.FLUID_STEP, "run-in": STARTING, "report": BLOCK,
             "snapshots": SECONDS, "pouring": 0.2, **section.level_words(level)}
    solvers = full_run.solvers_of(LENGTH, "loose")
    inputs = {"what": "full scene", "case": section.case_digest(), "solvers": solvers, **{k: str(v) for k, v in words.items()}}

    def work(folder):
        case, cpu, wall = section.run_case(build, folder, words, source=full_run.source_of(folder, solvers, section.CASE))
        table = section.rows_of(case)
        share = min(1.0, cpu / (wall * ranks))
        ends = [row for row in table if round(row["time"] / full_run.FLUID_STEP) >= LEFT_OUT][-BLOCKS - 1:]
        result = {"bodies": int(table[-1]["particles"]), "interval": interval, "share": share, "cpu": cpu, "wall": wall,
                  "sent": {name: [sent.messages, sent.kilobytes, sent.operations] for name, sent in scaling.sent_in((folder / "out.txt").read_text()).items()}}
        for name, parts, steps in (("fluid_step", ("fluid",), 1), ("exchange", ("exchange", "link"), 1), ("dem_step", ("dem",), interval)):
            blocks = [share * sum(b[f"{p}_seconds"] - a[f"{p}_seconds"] for p in parts) / (BLOCK * steps) for a, b in zip(ends, ends[1:])]
            result[name], result[f"{name}_error"] = measures.mean_and_error(blocks)
        shutil.rmtree(case)
        return result

    return runs.Job(f"{level.name}, {filling:g} of the bodies, {ranks} rank(s)", inputs, work,
                    40 + 60 * filling * (1 + 0.7 * (level.spheres > 1) + 0.03 * level.spheres))


def step_seconds(result):
    """[s] of a fluid step with its exchange and its DEM steps."""
    return result["fluid_step"] + result["exchange"] + result["interval"] * result["dem_step"]


def hours(seconds):
    """Of the whole run, whose fluid steps take so many seconds each."""
    return seconds * SECONDS / full_run.FLUID_STEP / 3600


def sent_of(result):
    """{part: scaling.Sent}"""
    return {name: scaling.Sent(*numbers) for name, numbers in result["sent"].items()}


def cost_rows(found):
    with_error = lambda r, name: f"{tables.number(1e3 * r[name])} +- {tables.number(1e3 * r[name + '_error'], 1)}"
    return [[level, str(ranks), str(r["bodies"]), with_error(r, "fluid_step"), with_error(r, "exchange"), with_error(r, "dem_step"),
             r["interval"], hours(step_seconds(r))] for (level, filling, ranks), r in found.items()]


def sent_rows(found):
    rows = []
    for (level, filling, ranks), r in found.items():
        for part, sent in sent_of(r).items():
            rows.append([level, str(ranks), str(r["bodies"]), part, sent.messages, sent.kilobytes, sent.operations])
    return rows


def scaled_rows(found):
    """Hours of the whole run with so many ranks, from one rank's computing and the largest run's messages; beside those measured."""
    rows = []
    for level, filling in dict.fromkeys(key[:2] for key in found):
        of_ranks = {ranks: r for (l, f, ranks), r in found.items() if (l, f) == (level, filling)}
        most = max(of_ranks)
        if 1 not in of_ranks or most == 1:
            continue
        sent = sum(sent_of(of_ranks[most]).values(), scaling.Sent())
        computing = step_seconds(of_ranks[1])
        for ranks in (*of_ranks, *(n for n in MORE_RANKS if n > most)):
            measured = hours(step_seconds(of_ranks[ranks])) if ranks in of_ranks else None
            rows.append([level, str(of_ranks[1]["bodies"]), str(ranks), measured,
                         *(hours(scaling.seconds_on(ranks, computing, sent, network)) for network in scaling.NETWORKS)])
    return rows


COST_HEADER = ["level", "ranks", "bodies", "ms a fluid step", "ms exchange", "ms a DEM step", "DEM steps in it", "hours for 60 s"]
SENT_HEADER = ["level", "ranks", "bodies", "part", "messages", "kB", "operations of all ranks"]
SCALED_HEADER = ["level", "bodies", "ranks", "hours measured", *(f"hours with {network.name}" for network in scaling.NETWORKS)]
HEAD = """12 m, 139,968 cells, bodies poured evenly along the hole at 80 degrees, 0.58 m/s; 60 s of it. Half of the bodies is the mean over the run. Steps of
20 ms, DEM steps of 0.3 of the critical one, solvers and tolerances of the whole run; `+-` over blocks of fluid steps. Where ranks outnumber
the cores of the machine their times contain waiting for each other, and tell little; what they send does not.
"""
SCALED = """What more ranks would take: the time of one rank divided by their number, and the latency and transfer of the messages, operations and bytes
counted on the most ranks that were run. A rank has two neighbours along the hole however many there are, so that they stay as they are. Not in it are
cores that share memory, and a load that is not even (in the whole run all bodies of a minute are in the first 2 m).
"""


def main():
    parser = options.Parser("full-scene", __doc__, "S1 and C64 with half of the bodies", at_once=1,  # it is time that is measured
                            epilog="Half of the bodies is the mean over the run, as they come in evenly and none leaves.")
    parser.add_argument("--levels", nargs="+", metavar="NAME", help="of S1, C8, C64, D48 (default: those of the study)")
    parser.add_argument("--fillings", nargs="+", type=float, metavar="SHARE", help="of the bodies (default: those of the study: 0.1, 0.5, 1)")
    parser.add_argument("--ranks", nargs="+", type=int, metavar="N", help="1, 2 or 4 (default: those of the study)")

    full_study.add_options(parser)

    def check(words):
        if words.run or words.accuracy:
            if words.ranks and (len(words.ranks) > 1 or words.ranks[0] < 1):
                parser.error("--ranks of a run is one number from 1 on")
            for name in words.levels or ():
                if name not in full_study.LEVELS:
                    parser.error(f"--levels names '{name}': there are {', '.join(full_study.LEVELS)}")
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
    chosen = list(dict.fromkeys(n for n, _, _ in words.plan_of))
    steps = {n: levels.step_job(words.build, known[n], RESTITUTION) for n in chosen}
    critical = {n: result["critical"] for n, result in runs.needed(words.store.run_all("time steps", steps.values()), steps).items()}
    jobs = {key: measure_job(words.build, known[key[0]], critical[key[0]], *key[1:]) for key in words.plan_of}
    results = words.store.run_all("full scene", jobs.values())
    if words.plan:
        return 0

    found = {key: results[job.key()] for key, job in jobs.items() if runs.good(results[job.key()])}
    failed = [f"{job.name}: {results[job.key()]['failed']}" for job in jobs.values() if "failed" in results[job.key()]]
    missing = [job.name for key, job in jobs.items() if key not in found and "failed" not in results[job.key()]]
    lines = ["## What the steps of the whole scene cost\n", HEAD, tables.publish(words, "cost", "Time:", COST_HEADER, cost_rows(found)),
             tables.publish(words, "sent", "Sent by a rank in a fluid step with its DEM steps:", SENT_HEADER, sent_rows(found)),
             SCALED, tables.publish(words, "scaled", "More ranks:", SCALED_HEADER, scaled_rows(found)),
             *([f"Not run: {'; '.join(missing)}.\n"] if missing else [])]
    return tables.finish(words, {"cost": lines}, failed, f"{BLOCKS * BLOCK} coupled fluid steps each after {STARTING} of the fluid alone and {LEFT_OUT} "
                         "coupled ones, one run at a time", "wall seconds times the share of the cores that the run had")
