# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Error of the flow rate against the viscosity ratio, and what convergence costs, for both Herschel-Bulkley models."""
import re

from .. import charts, foam, options, runs, tables
from ..programs import run

EXACT, CONSISTENCY = 0.240396146, 0.28  # mean velocity [m/s] of scenes/channel in closed form; k [Pa s^n]
CONVERGED = 1e-4  # of the last value
MODELS = ("HerschelBulkleyRegularised", "HerschelBulkleyCapped")
RATIOS = (3.6, 36, 360, 3600, 36000, 360000)


def channel_job(build, model, ratio, cells, steps):
    """Steps so long that each is one Picard iteration: mean velocity of each, wall seconds per 100."""
    def work(folder):
        case = folder / "case"
        foam.set_up(case, "channel", settings={"runCells": cells, "runEnd": 1000 * steps, "runModel": model, "runMuY": f"{ratio * CONSISTENCY:g}"})
        run(["blockMesh"], case, folder / "blockMesh.txt")
        cpu, *_ = run([build / "bin" / "annulusFoam"], case, folder / "out.txt")
        text = (folder / "out.txt").read_text()
        means = [float(word) for word in re.findall(r"<alpha U> (\S+)", text)]
        made, seconds = re.search(r"(\d+) steps in (\S+)", text).groups()
        needed = next((k + 1 for k in reversed(range(len(means))) if abs(means[k] / means[-1] - 1) >= CONVERGED), 0) + 1
        return {"mean": means[-1], "iterations": needed, "seconds": 100 * float(seconds) / int(made), "cpu": cpu}

    return runs.Job(f"{model}, muY/k {ratio:g}", {"what": "channel", "case": foam.digest("channel"), "model": model, "ratio": ratio, "cells": cells,
                                                   "steps": steps}, work, 0.02 * steps)


def main():
    parser = options.Parser("rheology-accuracy", f"Plane channel of half-gap 19.685 mm, tau0 2 Pa, k 0.28, n 0.65, 300 Pa/m: exact mean velocity {EXACT} "
                            "m/s. Runs annulusFoam with long steps (each is one Picard iteration) for each ratio muY/k and both models: error of the mean "
                            "velocity, iterations until it is within 0.01 %% of its last value, wall seconds per 100 iterations.",
                            "two ratios, 40 iterations", at_once=1)
    parser.add_argument("--cells", type=options.at_least_one, default=80, metavar="N", help="across the gap (default 80)")
    parser.add_argument("--ratios", action=options.Words, metavar="R", help="muY/k (default: " + " ".join(f"{r:g}" for r in RATIOS) + ")")
    parser.add_argument("--steps", type=options.at_least_one, metavar="N", help="iterations (default 250)")

    def check(chosen):
        try:
            chosen.ratios = [float(word) for word in chosen.ratios or (RATIOS[1:4:2] if chosen.quick else RATIOS)]
        except ValueError as error:
            parser.error(f"--ratios: {error}")
        chosen.steps = chosen.steps or (40 if chosen.quick else 250)

    chosen = parser.settle(("annulusFoam",), check)
    jobs = {(model, ratio): channel_job(chosen.build, model, ratio, chosen.cells, chosen.steps) for model in MODELS for ratio in chosen.ratios}
    found = chosen.store.run_all("channel", jobs.values())
    if chosen.plan:
        return 0
    found = runs.needed(found, jobs)
    rows = [[model, f"{ratio:g}", f"{r['mean']:.9g}", f"{r['mean'] / EXACT - 1:.3g}", r["iterations"], f"{r['seconds']:.3g}"]
            for (model, ratio), r in found.items()]
    tables.publish(chosen, "accuracy", "Mean velocity of the channel", ["model", "ratio", "mean_m_s", "error", "iterations", "seconds_per_100"], rows)
    series = [charts.Series(model, [charts.Point(ratio, 100 * abs(found[model, ratio]["mean"] / EXACT - 1)) for ratio in chosen.ratios],
                            charts.COLOURS[k], True) for k, model in enumerate(MODELS)]
    charts.write(chosen.out / "accuracy.svg", "Error of the flow rate of a channel against the cap of the viscosity",
                 [charts.Panel("", "muY / k", "error of the mean velocity [%]", series, True, True)], 1, (6.0, 4.0))
    return 0
