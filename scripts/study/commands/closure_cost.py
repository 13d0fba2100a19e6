# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints what each closure costs, alone and together, beside a hand-written drag loop."""
import pathlib
import re

from .. import closure_times, options, runs, section, tables
from ..programs import Failure


def pace_of(case):
    """Particle steps per second that a coupled run took, on one rank."""
    report, log = case / "postProcessing" / "eccentra" / "coupling.csv", case / "log.liggghts"
    for file in (report, log):
        if not file.is_file():
            raise Failure(f"there is no {file}: run the coupled case first")
    step = re.search(r"^timestep\s+([\d.eE+-]+)", log.read_text(errors="replace"), re.M)
    if not step:
        raise Failure(f"{log} shows no line 'timestep SECONDS'")
    table = section.rows_of(case)
    work = sum(row["particles"] * (row["time"] - before["time"]) for before, row in zip(table, table[1:])) / float(step.group(1))
    total = sum(table[-1][f"{part}_seconds"] for part in ("dem", "fluid", "exchange", "link")) if table else 0
    if not work or not total:
        raise Failure(f"{report} has no run with particles in it")
    return work / max(1, len(list(case.glob("processor*")))) / total


def main():
    parser = options.Parser("closure-cost", "Times every closure of fix fluid/force on 4096 particles of the reference case, without LIGGGHTS: "
                            "nanoseconds per particle and step, the least of N interleaved repetitions. What fix fluid/force prints at the end of "
                            "every run of 1000 steps or more is the share measured in that run itself.", "one repetition", at_once=1)
    parser.add_argument("--repetitions", type=options.at_least_one, default=20, metavar="N", help="default 20; about 1 s each")
    parser.add_argument("--csv", type=pathlib.Path, metavar="FILE", help="closure,rheology,ns_per_particle (default: closure-cost.csv among the results)")
    parser.add_argument("--coupled", type=pathlib.Path, metavar="CASE", help="folder of a finished coupled run: a further column shows what part of it "
                        "each closure makes, as ns x particles x DEM steps over the seconds of all parts; time it on the same machine")
    chosen = parser.settle(("tests/closures_benchmark",))
    pace = pace_of(chosen.coupled) if chosen.coupled else None
    jobs = {"": closure_times.job(chosen.build, 1 if chosen.quick else chosen.repetitions)}
    found = chosen.store.run_all("closures", jobs.values())
    if chosen.plan:
        return 0
    least = runs.needed(found, jobs)[""]["least"]
    rows = closure_times.rows(least)
    file = chosen.csv or chosen.out / "closure-cost.csv"
    file.parent.mkdir(parents=True, exist_ok=True)
    tables.write_csv(file, ["closure", "rheology", "ns_per_particle"] + ["share_of_coupled_run"] * bool(pace),
                     [[name, rheology, f"{time:.2f}"] + ([f"{1e-9 * time * pace:.6f}"] if pace else []) for name, rheology, time in rows])
    print(tables.text(["closure", "rheology", "ns"] + ["of the run"] * bool(pace),
                      [[name, rheology, f"{time:.1f}"] + ([f"{1e-7 * time * pace:.2f} %"] if pace else []) for name, rheology, time in rows]))
    print("\n".join(closure_times.lines(least)[len(rows):]))
    print(f"table written to {file}")
    return 0
