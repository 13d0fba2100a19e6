# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the link costs: 30,000 particles exchanged, beside a DEM step and a fluid step of the same scene, and two ranks against one."""
import json
import re
import shutil
import statistics

from .. import options, programs, runs, section, tables
from ..programs import ROOT, digest_of, run

BENCHMARKS = ("exchange_benchmark", "link_benchmark")
# A tenth of the annulus full of 30,000 spheres.
CROWD = {"count": 30000, "length": 3.6, "cells": "8 32 240", "seconds": 0.05, "run-in": 5, "report": 1, "snapshots": 1}
SECTIONS = {  # of the comparison of ranks: the case as it stands, and four times its length
    "5120 cells, 1212 spheres": {"seconds": 0.4, "run-in": 10, "report": 1},
    "20480 cells, 4848 spheres": {"seconds": 0.2, "run-in": 10, "report": 1, "length": 1.2, "cells": "8 32 80", "count": 4848},
}
QUICK_CROWD = {"count": 300, "length": 0.3, "cells": "4 16 10", "seconds": 0.03, "run-in": 2, "report": 1, "snapshots": 1}
QUICK_SECTIONS = {"5120 cells, 100 spheres": {"seconds": 0.03, "run-in": 2, "report": 1, "count": 100}}
BARS = {"solver": 2.0, "socket": 5.0}  # ms for 30,000 particles
RANKS_BAR = 1.7
EXCHANGES = ("solver", "socket", "socket, with extents")


def per_exchange(table, part):
    """Median wall seconds of a part in one coupling step, without the first, which reads and builds."""
    values = [row[f"{part}_seconds"] for row in table]
    return statistics.median(b - a for a, b in zip(values[1:], values[2:]))


def case_job(build, name, words, turn=0):
    """A coupled run: seconds of its parts in one coupling step, in all, and the DEM steps of an interval."""
    def work(folder):
        case, cpu, _ = section.run_case(build, folder, words)
        table = section.rows_of(case)
        interval = int(re.search(r"^variable +interval +index +(\d+)", (case / "in.cuttings").read_text(), re.M).group(1))
        shutil.rmtree(case)
        parts = ("dem", "fluid", "exchange", "link")
        return {"step": {part: per_exchange(table, part) for part in parts}, "interval": interval, "cpu": cpu,
                "seconds": sum(table[-1][f"{part}_seconds"] for part in parts)}

    return runs.Job(name, {"what": "link cost", "case": section.case_digest(), "turn": turn, **words}, work, 60 * words["seconds"])


def benchmark_job(build, turn, repetitions):
    """ms for 30,000 particles by the two benchmarks: medians."""
    def work(folder):
        programs.output_of([ROOT / "tests" / "exchange" / "make_mesh", ROOT / "tests" / "exchange" / "mesh",
                            build / "tests" / "run" / "exchange_mesh", build / "bin" / "annulusMesh"])
        cpu, *_ = run([build / "tests" / "exchange_benchmark", "--benchmark_filter=solver", f"--benchmark_repetitions={repetitions}",
                      "--benchmark_report_aggregates_only=true", "--benchmark_format=json", "--benchmark_out=exchange.json"],
                     folder, folder / "exchange.txt")
        measured = json.loads((folder / "exchange.json").read_text())["benchmarks"]
        more, *_ = run(["mpirun", "--oversubscribe", "-np", 2, build / "tests" / "link_benchmark"], folder, folder / "link.txt")
        medians = [float(word) for word in re.findall(r"median ([\d.]+) ms", (folder / "link.txt").read_text())]
        solver = next(one["real_time"] for one in measured if one["aggregate_name"] == "median")
        return {"ms": dict(zip(EXCHANGES, [solver, *medians])), "cpu": cpu + more}

    inputs = {"what": "link benchmarks", "programs": digest_of(*(build / "tests" / name for name in BENCHMARKS)), "turn": turn,
              "mesh": digest_of(ROOT / "tests" / "exchange" / "make_mesh"), "repetitions": repetitions}
    return runs.Job(f"benchmarks, turn {turn + 1}", inputs, work, 20)


def main():
    parser = options.Parser("link-cost", __doc__ + " Give it a machine with nothing else to do.", "tiny runs: whether all of it works", at_once=1)
    parser.add_argument("--parts", action=options.Words, choices=("cost", "ranks"), default=("cost", "ranks"),
                        help="of 30,000 particles; two ranks against one (default: both)")
    parser.add_argument("--turns", type=options.at_least_one, metavar="N", help="of what is compared (default: 5)")
    chosen = parser.settle(lambda c: ("annulusFoam", "annulusMesh") + (tuple(f"tests/{b}" for b in BENCHMARKS) if "cost" in c.parts else ()))
    turns = chosen.turns or (1 if chosen.quick else 5)
    crowd, sections = (QUICK_CROWD, QUICK_SECTIONS) if chosen.quick else (CROWD, SECTIONS)
    benchmarks, coupled, ranks = {}, {}, {}
    if "cost" in chosen.parts:
        benchmarks = {turn: benchmark_job(chosen.build, turn, 1 if chosen.quick else 5) for turn in range(turns)}
        coupled = {link: case_job(chosen.build, f"{crowd['count']} spheres, link {link}", {**crowd, "link": link}) for link in BARS}
    if "ranks" in chosen.parts:
        ranks = {(name, count, turn): case_job(chosen.build, f"{name}: {count} rank(s), turn {turn + 1}", {**words, "ranks": count}, turn)
                 for name, words in sections.items() for turn in range(turns) for count in (1, 2)}
    jobs = benchmarks | coupled | ranks
    found = {}
    for job in jobs.values():  # in turn, whatever each may take
        found |= chosen.store.run_all("link", [job])
    if chosen.plan:
        return 0
    found = runs.needed(found, jobs)
    page = []
    if coupled:
        rows, shares = [], []
        for name in EXCHANGES:
            link = name.split(",")[0]
            step, interval = found[link]["step"], found[link]["interval"]
            ms = statistics.median(found[turn]["ms"][name] for turn in benchmarks)
            rows.append([f"link {name}", ms, BARS[link], ms * 1e-3 * interval / step["dem"], ms * 1e-3 / step["fluid"]])
        for link in coupled:
            step, interval = found[link]["step"], found[link]["interval"]
            dem = step["dem"] / interval
            shares.append([f"link {link}", dem * 1e3, step["fluid"] * 1e3, step["exchange"] * 1e3, step["link"] * 1e3, step["link"] / dem,
                           step["link"] / step["fluid"], 100 * step["link"] / sum(step.values())])
        page.append(tables.publish(chosen, "exchange", "Exchange", ["30,000 particles there and back", "ms", "required", "DEM steps", "fluid steps"], rows))
        page.append(tables.publish(chosen, "coupled", "Coupled runs",
                                   [f"coupled run of {crowd['count']} spheres", "DEM step ms", "fluid step ms", "exchange ms", "link ms",
                                    "link in DEM steps", "in fluid steps", "share %"], shares))
    if ranks:
        rows = []
        for name in sections:
            one, two = ([found[name, count, turn]["seconds"] for turn in range(turns)] for count in (1, 2))
            ratios = sorted(a / b for a, b in zip(one, two))
            rows.append([name, turns, statistics.median(one), statistics.median(two), statistics.median(ratios), ratios[0], ratios[-1], RANKS_BAR])
        page.append(tables.publish(chosen, "ranks", "Ranks",
                                   ["section", "turns", "one rank s", "two ranks s", "times as fast", "least", "largest", "required"], rows))
    return tables.finish(chosen, page, [], "one run at a time, wall clock")
